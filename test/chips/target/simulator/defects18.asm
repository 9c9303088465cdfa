; SPDX-License-Identifier: MIT
; As defects14.asm, for a PIC18. Its stack does not reset the chip (STVREN is
; off), which gpsim by itself lets pass. After the last command it waits, and
; `alu` shows what gpsim makes of some instructions.
        list p=18f4520, r=dec
        include "p18f4520.inc"
        CONFIG OSC=HSPLL, WDT=ON, WDTPS=1, LVP=OFF, STVREN=OFF, XINST=OFF

command equ 0x20
left    equ 0x21
right   equ 0x22
status  equ 0x23
result  equ 0x24

        org 0
        goto main
        org 8
        retfie 0
        org 0x18
        bra $
main:   nop
        clrwdt
        movf command, w, 0
        bz overflow
        dcfsnz WREG, f, 0
        bra underflow
        dcfsnz WREG, f, 0
        bra outside
        dcfsnz WREG, f, 0
        bra outside_read
        dcfsnz WREG, f, 0
        bra erased
        dcfsnz WREG, f, 0
        bra hang
        dcfsnz WREG, f, 0
        bra restart
        dcfsnz WREG, f, 0
        bra reset_instruction
        dcfsnz WREG, f, 0
        bra idle
        bra alu
idle:   clrwdt
        bra idle

overflow:
        call overflow
underflow:
        return
outside:
        lfsr 0, 0x700           ; a PIC18F4520's RAM ends at 0x5FF
        clrf INDF0, 0
        bra idle
outside_read:
        lfsr 0, 0x700
        movf INDF0, w, 0
        bra idle
erased: goto 0x6000
hang:   bra hang
restart:
        goto 0
reset_instruction:
        reset

alu:    clrwdt
        movf left, w, 0
        addwf right, w, 0
        movff STATUS, status
        lfsr 0, 0x100
        movlw 1
added:  addwf PREINC0, f, 0     ; adds to the byte at 0x101
        movff 0x101, result
done:   bra alu
        end
