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
clear:
        clrf    INDF            ; 0x20..0x7F, then 0xA0..0xBF
        incf    FSR, f
        btfsc   FSR, 7
        bsf     FSR, 5          ; 0x80 becomes 0xA0, and 0xC0 ends it
        movlw   0x40
        addwf   FSR, w
        btfss   STATUS, C
        goto    clear
        goto    _main           ; PCLATH is 0: all 2048 words are one page
        end
