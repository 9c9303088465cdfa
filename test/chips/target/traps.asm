; SPDX-License-Identifier: MIT
; A program with this file has a loop without an end behind each short function,
; so that one which does not return is noticed: gplink puts sections in the order
; of their sizes, and here is one of each.
    processor p18f4520
    variable words = 1
    while words < 0x80
trap#v(words) code
    bra $
    if words > 1
    fill 0, 2 * (words - 1)
    endif
words += 1
    endw
    end
