; SPDX-License-Identifier: MIT
; Routines of known length for the 14-bit core. Each is called once; then one is
; called for ever while the test interrupts it at every instruction.
        list p=16f684, r=dec
        include "p16f684.inc"
        __config _INTOSCIO & _WDT_OFF & _MCLRE_ON

value   equ 0x20
count   equ 0x21

        org 0
        goto start
        org 4
        bcf INTCON, T0IF        ; 1
        retfie                  ; 2
start:  movlw 3
        movwf value
        call nops
        call jump
        call skip
        call no_skip
        call loop
        call nested
        call computed
        call literal
        movlw 5
        movwf count
        call turns
called_all:
        movlw 0xA0              ; GIE, T0IE; the test sets T0IF
        movwf INTCON
forever:
        call interrupted
        goto forever

nops:   nop                     ; 4
        nop
        return
jump:   goto jumped             ; 4
jumped: return
skip:   btfss value, 0          ; 4
        nop
        return
no_skip:
        btfsc value, 0          ; 4
        nop
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
        addwf PCL, f
        retlw 0
        retlw 1
literal:
        retlw 7                 ; 2
turns:  decfsz count, f      ; 16, its first instruction five times
        goto turns
        return
interrupted:                    ; 25
        call nested
        movlw 4
        movwf count
more:   decfsz count, f
        goto more
        return
        end
