; SPDX-License-Identifier: MIT
; Routines of known length for the 16-bit core, as cycles14.asm.
        list p=18f4520, r=dec
        include "p18f4520.inc"
        CONFIG OSC=INTIO67, WDT=OFF, LVP=OFF

value   equ 0x20
count   equ 0x21

        org 0
        goto start
        org 8
        bcf INTCON, TMR0IF, 0   ; 1
        retfie 0                ; 2
start:  movlw 3
        movwf value, 0
        call nops
        call jump
        call branch
        call branch_taken
        call branch_not_taken
        call skip_one
        call skip_two
        call move
        call load_fsr
        call multiply
        call table_read
        call table_reads
        call nested
        call loop
        call compare
        call table_write
        movlw 5
        movwf count, 0
        call turns
called_all:
        movlw 0xA0              ; GIE, TMR0IE; the test sets TMR0IF
        movwf INTCON, 0
forever:
        call interrupted
        bra forever

nops:   nop                     ; 4
        nop
        return
jump:   goto jumped             ; 4
jumped: return
branch: bra branched            ; 4
branched:
        return
branch_taken:
        clrf WREG, 0            ; 5
        bz is_zero
        nop
is_zero:
        return
branch_not_taken:
        movlw 1                 ; 6
        iorlw 1
        bz is_not
        nop
is_not: return
skip_one:
        btfss value, 0, 0       ; 4
        nop
        return
skip_two:
        btfss value, 0, 0       ; 5
        movff value, count
        return
move:   movff value, count      ; 4
        return
load_fsr:
        lfsr 0, 0x100           ; 4
        return
multiply:
        mulwf value, 0          ; 3
        return
table_read:
        tblrd*                  ; 4
        return
table_reads:
        tblrd*+                 ; 6
        tblrd*+
        return
nested: rcall nops              ; 8
        return
loop:   movlw 5                 ; 18
        movwf count, 0
again:  decfsz count, f, 0
        bra again
        return
compare:
        movf value, w, 0        ; 5
        cpfseq value, 0
        nop
        return
table_write:
        tblwt*                  ; 4
        return
turns:  decfsz count, f, 0      ; 16, its first instruction five times
        bra turns
        return
interrupted:                    ; 25
        rcall nested
        movlw 4
        movwf count, 0
more:   decfsz count, f, 0
        bra more
        return
        end
