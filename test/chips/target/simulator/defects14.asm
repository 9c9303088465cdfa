; SPDX-License-Identifier: MIT
; One firmware with a defect of each kind that the guards catch; `command`
; chooses. The last is no defect: a loop that waits for ever.
        list p=16f684, r=dec
        include "p16f684.inc"
        __config _INTOSCIO & _WDT_ON & _MCLRE_ON

command equ 0x20

        org 0
        goto main
        org 4
        retfie
main:   clrf STATUS
        clrwdt
        bsf STATUS, RP0
        movlw 0x80              ; the prescaler is not the watchdog's
        movwf OPTION_REG
        bcf STATUS, RP0
        movf command, w
        addwf PCL, f
        goto overflow
        goto underflow
        goto outside
        goto outside_read
        goto erased
        goto hang
        goto restart
idle:   clrwdt
        goto idle

overflow:
        call overflow
underflow:
        return
outside:
        movlw 0xC8              ; a PIC16F684's RAM ends at 0xBF
        movwf FSR
        clrf INDF
        goto idle
outside_read:
        movlw 0xC8
        movwf FSR
        movf INDF, w
        goto idle
erased: goto 0x600
hang:   goto hang
restart:
        goto 0
        end
