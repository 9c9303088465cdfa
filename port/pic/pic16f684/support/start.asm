; SPDX-License-Identifier: MIT
; For SDCC only: start-up that clears all RAM of the PIC16F684, in place of the
; run-time library's, which clears none of it, spends 13 bytes of it and copies
; initialized data, of which this firmware has none.
        list    p=16f684
        include "p16f684.inc"

        global  __sdcc_gsinit_startup
        extern  _main

STARTCODE code
__sdcc_gsinit_startup:
        clrf    STATUS          ; bank 0, IRP = 0
        movlw   0x20
        movwf   FSR
clear_bank_0:
        clrf    INDF            ; 0x20..0x7F
        incf    FSR, f
        btfss   FSR, 7
        goto    clear_bank_0
        movlw   0xA0
        movwf   FSR
clear_bank_1:
        clrf    INDF            ; 0xA0..0xBF
        incf    FSR, f
        btfss   FSR, 6
        goto    clear_bank_1
        clrf    PCLATH
        goto    _main           ; all 2048 words are one page
        end
