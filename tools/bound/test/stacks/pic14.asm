; SPDX-License-Identifier: MIT
; Calls for the 14-bit core. Behind each routine stands how many levels of the
; return stack it takes with its own call, or why nobody can tell; those of the
; whole program are measured, where an interrupt comes at the deepest place.
        list p=16f684, r=dec
        include "p16f684.inc"
        __config _INTOSCIO & _WDT_OFF & _MCLRE_ON

value   equ 0x70

        global main, third

vector  code 0
        goto main

; One level, and one of what it calls.
interrupt code 4
        bcf INTCON, T0IF
        call first
        ifdef LETS_IN
        bsf INTCON, GIE
        endif
        ifdef LETS_ALL_IN
        movwf INTCON
        endif
        retfie

program code
main:                           ; all: 5 levels
        clrf value
        movlw 0xA0              ; GIE, T0IE
        movwf INTCON
        call switches
        call third
        goto main

first:                          ; 1 levels
        return
second:                         ; 2 levels
        call interrupted
        return
interrupted:                    ; 1 levels
        bsf INTCON, T0IF
        nop
        nop
        return
third:                          ; 3 levels
        btfsc value, 0
        goto third_end
        call second
third_end:
        call first
        return
tail:                           ; 2 levels
        goto second
for_ever:                       ; 2 levels
        call first
        goto for_ever
sleeps:                         ; 3 levels
        sleep
        call second
        return
switches:                       ; 2 levels
        movf value, w
        andlw 1
        addlw switch_table
        movwf PCL
switch_table:
        goto first
        goto switch_end
switch_end:
        call first
        return
reads_flash:                    ; 1 levels
        movlw 5
        movwf PCL
itself:                         ; refused: calls itself
        call calls_itself
        return
calls_itself:                   ; refused: calls itself
        call itself
        return

; In C it may call through a pointer.
S_c__pointer code
through_pointer:                ; refused: no path through a computed GOTO
        movf value, w
        movwf PCL
        end
