; SPDX-License-Identifier: MIT
; Routines of known length for the enhanced 14-bit core, most with instructions
; that the other has not. Before them all 16 levels of the return stack are used;
; `command` 1 takes one more, 2 returns without a call.
        list p=16f1788, r=dec
        include "p16f1788.inc"
        __config _CONFIG1, _FOSC_INTOSC & _WDTE_OFF & _MCLRE_ON

command equ 0x20
count   equ 0x21

        org 0
        goto start
        org 4
        retfie
start:  movlb 0
        decf command, w
        btfsc STATUS, Z
        goto overflow
        decf WREG, w
        btfsc STATUS, Z
        return
        movlw 16
        movwf count
        call deep
        clrf FSR0H
        movlw count
        movwf FSR0L
        call nops
        call branch
        call backward
        call banks
        call shifts
        call carries
        call moves
        call pages
        call loop
        call nested
        call computed
        call literal
        movlw 5
        movwf count
        call turns
called_all:
        goto called_all

overflow:
        movlw 17
        movwf count
        call deep
        goto called_all
deep:   decfsz count, f
        call deep
        return

forever:
        goto forever
nops:   nop                     ; 4
        nop
        return
branch: bra branched            ; 4
        nop
branched:
        return
backward:
        bra branched            ; 4
banks:  movlb 25                ; 4
        movlb 0
        return
shifts: lslf count, f           ; 5
        lsrf count, f
        asrf count, f
        return
carries:
        addwfc count, w         ; 4
        subwfb count, w
        return
moves:  moviw FSR0++            ; 5
        addfsr FSR0, -1
        movwi 0[FSR0]
        return
pages:  movlp 0                 ; 3
        return
loop:   movlw 5                 ; 18
        movwf count
again:  decfsz count, f
        goto again
        return
nested: call nops               ; 8
        return
computed:
        movlw 1                 ; 5
        brw
        retlw 0
        retlw 1
literal:
        retlw 7                 ; 2
turns:  decfsz count, f      ; 16, its first instruction five times
        goto turns
        return
        end
