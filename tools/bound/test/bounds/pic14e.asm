; SPDX-License-Identifier: MIT
; As pic14.asm, for what an enhanced core has besides.
        list p=16f1788, r=dec
        include "p16f1788.inc"
        __config _CONFIG1, _FOSC_INTOSC & _WDTE_OFF
        __config _CONFIG2, _LVP_OFF

count   equ 0x70
other   equ 0x71

        global main, branches, zero, through_wreg_read, another_bank_bit

vector  code 0
        goto main

program code
main:
        clrf other
        call branches
        call zero
        call through_wreg_read
        call another_bank_bit
forever:
        goto forever

branches:                       ; 12
        movlw 3
        movwf count
branches_turn:
        decfsz count, f
        bra branches_turn
        return

zero:                           ; 771
        movlw 0
        movwf count
zero_turn:
        decfsz count, f
        bra zero_turn
        return

; WREG is a register, too: it may be read.
through_wreg_read:              ; 18
        movlw 3
        addwf WREG, w
        movlw 4
        movwf count
        movf WREG, w
through_wreg_read_turn:
        decfsz count, f
        bra through_wreg_read_turn
        return

; STATUS selects no bank.
another_bank_bit:               ; 13
        movlw 3
        movwf count
        bcf STATUS, 5
another_bank_bit_turn:
        decfsz count, f
        bra another_bank_bit_turn
        return

through_wreg:                   ; refused: no constant is loaded
        movlw 3
        incf WREG, f
        movwf count
through_wreg_turn:
        decfsz count, f
        bra through_wreg_turn
        return

moviw_loads:                    ; refused: no constant is loaded
        movlw 3
        moviw FSR0++
        movwf count
moviw_loads_turn:
        decfsz count, f
        bra moviw_loads_turn
        return

movwi_writes:                   ; refused: may also change
        movlw 3
        movwf count
movwi_writes_turn:
        movwi FSR1++
        decfsz count, f
        bra movwi_writes_turn
        return

movwi_indexed:                  ; refused: may also change
        movlw 3
        movwf count
movwi_indexed_turn:
        movwi 1[FSR1]
        decfsz count, f
        bra movwi_indexed_turn
        return

through_indf1:                  ; refused: may also change
        movlw 3
        movwf count
through_indf1_turn:
        incf INDF1, f
        decfsz count, f
        bra through_indf1_turn
        return

bank_in_loop:                   ; refused: may also change
        movlw 3
        movwf count
bank_in_loop_turn:
        movlb 2
        decfsz count, f
        bra bank_in_loop_turn
        return

bank_of_load:                   ; refused: no constant is loaded
        movlw 3
        movwf count
        movlb 2
bank_of_load_turn:
        decfsz count, f
        bra bank_of_load_turn
        return

through_bsr:                    ; refused: may also change
        movlw 3
        movwf count
through_bsr_turn:
        clrf BSR
        decfsz count, f
        bra through_bsr_turn
        return

shifted:                        ; refused: may also change
        movlw 3
        movwf count
shifted_turn:
        lslf count, f
        decfsz count, f
        bra shifted_turn
        return

z_of_other:                     ; refused: may go on with 0
        movlw 3
        movwf count
z_of_other_turn:
        decf count, f
        movf other, w
        btfss STATUS, Z
        bra z_of_other_turn
        return

computed_branch:                ; refused: computed
        brw
        return
        end
