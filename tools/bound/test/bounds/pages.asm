; SPDX-License-Identifier: MIT
; Code in two pages: where a call leads depends on PCLATH.
        list p=16f887, r=dec
        include "p16f887.inc"

        global main, near

vector  code 0
        goto main

program code
main:
        call near
forever:
        goto forever

; Without a jump the page does not matter.
near:                           ; 3
        nop
        return

calls_far:                      ; refused: code of several pages
        bsf PCLATH, 3
        call far
        bcf PCLATH, 3
        return

second  code 0x800
far:
        return
        end
