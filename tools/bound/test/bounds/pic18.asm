; SPDX-License-Identifier: MIT
; As pic14.asm, for what is a PIC18's own.
        list p=18f4520, r=dec
        include "p18f4520.inc"
        config OSC = INTIO67, WDT = OFF, LVP = OFF, XINST = OFF

count   equ 0x20
other   equ 0x22
twin    equ 0x220       ; the same number as count, in bank 2

vector  code 0
        goto main

        global main, plain, with_bnz, with_bz, with_movf, zero
        global cleared, within_bank, access
        global skips_two_words, banked_f9

program code
main:
        clrf other, 0
        call plain
        call with_bnz
        call with_bz
        call with_movf
        call zero
        call cleared
        call within_bank
        call access
        call skips_two_words
        call banked_f9
forever:
        bra forever

plain:                          ; 12
        movlw 3
        movwf count, 0
plain_turn:
        decfsz count, f, 0
        bra plain_turn
        return

with_bnz:                       ; 18
        movlw 5
        movwf count, 0
with_bnz_turn:
        decf count, f, 0
        bnz with_bnz_turn
        return

with_bz:                        ; 23
        movlw 5
        movwf count, 0
with_bz_turn:
        decf count, f, 0
        bz with_bz_end
        bra with_bz_turn
with_bz_end:
        return

with_movf:                      ; 23
        movlw 5
        movwf count, 0
with_movf_turn:
        decf count, f, 0
        movf count, w, 0
        bnz with_movf_turn
        return

zero:                           ; 771
        movlw 0
        movwf count, 0
zero_turn:
        decfsz count, f, 0
        bra zero_turn
        return

cleared:                        ; 770
        clrf count, 0
cleared_turn:
        decfsz count, f, 0
        bra cleared_turn
        return

z_of_other:                     ; refused: may go on with 0
        movlw 3
        movwf count, 0
z_of_other_turn:
        decf count, f, 0
        movf other, w, 0
        bnz z_of_other_turn
        return

written:                        ; refused: may also change
        movlw 3
        movwf count, 0
written_turn:
        bsf count, 1, 0
        decfsz count, f, 0
        bra written_turn
        return

moved:                          ; refused: may also change
        movlw 3
        movwf count, 0
moved_turn:
        movff other, count
        decfsz count, f, 0
        bra moved_turn
        return

; MOVFF loads what no path shows.
loaded_by_movff:                ; refused: no constant is loaded
        movlw 3
        movff other, count
loaded_by_movff_turn:
        decfsz count, f, 0
        bra loaded_by_movff_turn
        return

; FSR0 leads to the counter, so that it is counted twice.
through_indf:                   ; refused: may also change
        lfsr 0, count
        movlw 9
        movwf count, 0
through_indf_turn:
        decf INDF0, f, 0
        decfsz count, f, 0
        bra through_indf_turn
        return

through_postdec:                ; refused: may also change
        movlw 9
        movwf count, 0
through_postdec_turn:
        movff WREG, POSTDEC1
        decfsz count, f, 0
        bra through_postdec_turn
        return

indf:                           ; refused: does not count down from a constant
        movlw 3
        movwf INDF0, 0
indf_turn:
        decfsz INDF0, f, 0
        bra indf_turn
        return

timer:                          ; refused: does not count down from a constant
        movlw 3
        movwf TMR0L, 0
timer_turn:
        decfsz TMR0L, f, 0
        bra timer_turn
        return

; 200 was loaded into the register in the access bank.
access_bit:                     ; refused: no constant
        movlw 200
        movwf count, 0
        movlb 2
        movlw 3
        movwf twin, 1
access_bit_turn:
        decfsz count, f, 0
        bra access_bit_turn
        return

; 200 was loaded into the register in bank 1.
bank:                           ; refused: no constant
        movlb 1
        movlw 200
        movwf 0x120, 1
        movlb 2
        movlw 3
        movwf twin, 1
        movlb 1
bank_turn:
        decfsz 0x120, f, 1
        bra bank_turn
        return

bank_in_loop:                   ; refused: may also change
        movlb 2
        movlw 3
        movwf twin, 1
bank_in_loop_turn:
        movlb 1
        movlb 2
        decfsz twin, f, 1
        bra bank_in_loop_turn
        return

; A fast return restores BSR.
fast_return:                    ; refused: may also change
        movlb 2
        movlw 3
        movwf twin, 1
fast_return_turn:
        call returns_fast
        decfsz twin, f, 1
        bra fast_return_turn
        return
returns_fast:
        return 1

within_bank:                    ; 16
        movlb 2
        movlw 3
        movwf twin, 1
within_bank_turn:
        bcf STATUS, C, 0
        decfsz twin, f, 1
        bra within_bank_turn
        return

; The access bank needs no bank.
access:                         ; 15
        movlw 3
        movwf count, 0
access_turn:
        movlb 2
        decfsz count, f, 0
        bra access_turn
        return

changed:                        ; refused: no constant is loaded
        movlw 3
        addlw 7
        movwf count, 0
changed_turn:
        decfsz count, f, 0
        bra changed_turn
        return

; WREG is a register, too.
through_wreg:                   ; refused: no constant is loaded
        movlw 3
        movff other, WREG
        movwf count, 0
through_wreg_turn:
        decfsz count, f, 0
        bra through_wreg_turn
        return

; The skip leads over both words.
skips_two_words:                ; 33
        movlw 5
        movwf count, 0
skips_two_words_turn:
        btfss other, 0, 0
        movff other, other
        decfsz count, f, 0
        bra skips_two_words_turn
        return

sleeping:                       ; refused: SLEEP
        sleep
        return

popping:                        ; refused: POP
        pop
        return

changing_return:                ; refused: a changed return address
        clrf TOSL, 0
        return

jumping_by_movff:               ; refused: computed
        dw 0xC022, 0xFFF9       ; MOVFF other, PCL, which gpasm refuses
        return

; Another register of that number, in a bank.
banked_f9:                      ; 4
        movlb 2
        movwf 0x2F9, 1
        return

jumping:                        ; refused: computed
        movf PORTA, w, 0
        addwf PCL, f, 0
        return
        return
        end
