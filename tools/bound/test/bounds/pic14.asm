; SPDX-License-Identifier: MIT
; Loops for the 14-bit core. Behind each routine stands what it takes with its
; return, measured in the simulator, which the bound must be; or why there can be
; no bound.
        list p=16f684, r=dec
        include "p16f684.inc"
        __config _INTOSCIO & _WDT_OFF & _MCLRE_ON

count   equ 0x20
outer   equ 0x21
other   equ 0x22
twin    equ 0xA0        ; the same number as count, in bank 1

vector  code 0
        goto main

        global main, plain, with_z, with_movf, chosen, zero, zero_chosen, cleared
        global nested, calling, bank_left, within_bank, in_call

program code
main:
        clrf other
        call plain
        call with_z
        call with_movf
        call chosen
        call zero
        call zero_chosen
        call cleared
        call nested
        call calling
        call bank_left
        call within_bank
        call in_call
forever:
        goto forever

plain:                          ; 12
        movlw 3
        movwf count
plain_turn:
        decfsz count, f
        goto plain_turn
        return

with_z:                         ; 23
        movlw 5
        movwf count
with_z_turn:
        decf count, f
        btfss STATUS, Z
        goto with_z_turn
        return

with_movf:                      ; 28
        movlw 5
        movwf count
with_movf_turn:
        decf count, f
        movf count, w
        btfss STATUS, Z
        goto with_movf_turn
        return

; The larger constant is loaded where the skip is taken.
chosen:                         ; 36
        bcf STATUS, C
        movlw 10
        btfsc STATUS, C
        movlw 3
        movwf count
chosen_turn:
        decfsz count, f
        goto chosen_turn
        return

; 0 is more than 10.
zero_chosen:                    ; 774
        bcf STATUS, C
        movlw 0
        btfsc STATUS, C
        movlw 10
        movwf count
zero_chosen_turn:
        decfsz count, f
        goto zero_chosen_turn
        return

zero:                           ; 771
        movlw 0
        movwf count
zero_turn:
        decfsz count, f
        goto zero_turn
        return

cleared:                        ; 770
        clrf count
cleared_turn:
        decfsz count, f
        goto cleared_turn
        return

nested:                         ; 41
        movlw 2
        movwf outer
nested_outer:
        movlw 5
        movwf count
nested_turn:
        decfsz count, f
        goto nested_turn
        decfsz outer, f
        goto nested_outer
        return

; The second time the inner loop begins with 0.
not_nested:                     ; refused: no constant is loaded
        movlw 2
        movwf outer
        movlw 5
        movwf count
not_nested_outer:
        nop
not_nested_turn:
        decfsz count, f
        goto not_nested_turn
        decfsz outer, f
        goto not_nested_outer
        return

calling:                        ; 27
        movlw 3
        movwf count
calling_turn:
        call touches_other
        decfsz count, f
        goto calling_turn
        return
touches_other:
        incf other, f
        return

called:                         ; refused: may also change
        movlw 3
        movwf count
called_turn:
        call touches_count
        decfsz count, f
        goto called_turn
        return
touches_count:
        btfsc other, 0
        incf count, f
        return

leaves_elsewhere:               ; refused: may go on with 0
        movlw 3
        movwf count
leaves_elsewhere_turn:
        decf count, f
        btfss PORTA, 0
        goto leaves_elsewhere_turn
        return

; At 0 it goes round once more.
stays:                          ; refused: may go on with 0
        movlw 3
        movwf count
stays_turn:
        decfsz count, f
        goto stays_turn
        btfss PORTA, 0
        goto stays_turn
        return

z_of_other:                     ; refused: may go on with 0
        movlw 3
        movwf count
z_of_other_turn:
        decf count, f
        movf other, w
        btfss STATUS, Z
        goto z_of_other_turn
        return

not_every_turn:                 ; refused: not every turn
        movlw 3
        movwf count
not_every_turn_head:
        btfsc PORTA, 0
        goto not_every_turn_head
        decfsz count, f
        goto not_every_turn_head
        return

written:                        ; refused: may also change
        movlw 3
        movwf count
written_turn:
        bsf count, 1
        decfsz count, f
        goto written_turn
        return

; FSR leads to the counter, so that it is counted twice.
through_indf:                   ; refused: may also change
        movlw count
        movwf FSR
        movlw 9
        movwf count
through_indf_turn:
        decf INDF, f
        decfsz count, f
        goto through_indf_turn
        return

indf:                           ; refused: does not count down from a constant
        movlw 3
        movwf INDF
indf_turn:
        decfsz INDF, f
        goto indf_turn
        return

timer:                          ; refused: does not count down from a constant
        movlw 3
        movwf TMR0
timer_turn:
        decfsz TMR0, f
        goto timer_turn
        return

from_before:                    ; refused: it comes from before
        decfsz count, f
        goto from_before
        return

; 200 was loaded into the register in bank 0.
bank:                           ; refused: no constant
        movlw 200
        movwf count
        bsf STATUS, RP0
        movlw 3
        movwf twin ^ 0x80
        bcf STATUS, RP0
bank_turn:
        decfsz count, f
        goto bank_turn
        return

bank_in_loop:                   ; refused: may also change
        movlw 3
        movwf count
bank_in_loop_turn:
        bsf STATUS, RP0
        bcf STATUS, RP0
        decfsz count, f
        goto bank_in_loop_turn
        return

through_status:                 ; refused: may also change
        movlw 3
        movwf count
through_status_turn:
        clrf STATUS
        decfsz count, f
        goto through_status_turn
        return

bank_left:                      ; 14
        bsf STATUS, RP0
        bcf STATUS, RP0
        movlw 3
        movwf count
bank_left_turn:
        decfsz count, f
        goto bank_left_turn
        return

; Another bit of STATUS selects no bank.
within_bank:                    ; 15
        movlw 3
        movwf count
within_bank_turn:
        bcf STATUS, C
        decfsz count, f
        goto within_bank_turn
        return

changed:                        ; refused: no constant is loaded
        movlw 3
        addlw 7
        movwf count
changed_turn:
        decfsz count, f
        goto changed_turn
        return

from_call:                      ; refused: it may change in what
        movlw 3
        call nine
        movwf count
from_call_turn:
        decfsz count, f
        goto from_call_turn
        return
nine:   retlw 9

; The function that it calls begins with a loop.
in_call:                        ; 17
        call in_call_inner
        nop
        return
in_call_inner:
        movlw 3
        movwf count
in_call_turn:
        decfsz count, f
        goto in_call_turn
        return

itself: call itself             ; refused: calls itself
        return

; A jump to its first instruction: whoever calls has left the counter.
entered_again:                  ; refused: it comes from before
        decfsz count, f
        goto entered_again_turn
        return
entered_again_turn:
        nop
        goto entered_again

; Its first instruction is reached with 3 in the counter, and by its callers.
from_both:                      ; refused: it comes from before
        nop
from_both_turn:
        decfsz count, f
        goto from_both_turn
        btfsc PORTA, 0
        return
        movlw 3
        movwf count
        goto from_both

two_entrances:                  ; refused: has 2 entrances
        movlw 3
        movwf count
        btfsc PORTA, 0
        goto two_entrances_middle
two_entrances_turn:
        nop
two_entrances_middle:
        decfsz count, f
        goto two_entrances_turn
        return

sleeping:                       ; refused: SLEEP
        sleep
        return

jumping:                        ; refused: computed
        movf PORTA, w
        addwf PCL, f
        return
        return
        end
