; SPDX-License-Identifier: MIT
; For SDCC only: two bytes through a generic pointer, in place of the run-time
; library's, in half of its words. W is what the pointer points into, 0x80 for
; flash, where each byte is a RETLW; STK00 is its high byte and STK01 its low
; one. Returns the high byte in W and the low one in STK00.
        list    p=16f684
        include "p16f684.inc"

        global  __gptrget2
        extern  STK00
        extern  STK01

        code
__gptrget2:
        andlw   0x80
        btfss   STATUS, Z
        goto    from_flash
        bcf     STATUS, IRP     ; all RAM is in banks 0 and 1
        movf    STK01, w
        movwf   FSR
        movf    INDF, w
        movwf   STK00
        incf    FSR, f
        movf    INDF, w
        return
from_flash:
        movf    STK00, w
        movwf   PCLATH
        call    byte_from_flash
        movwf   STK00
        incf    STK01, f
        btfsc   STATUS, Z
        incf    PCLATH, f       ; it returns the second byte to the caller
byte_from_flash:
        movf    STK01, w
        movwf   PCL
        end
