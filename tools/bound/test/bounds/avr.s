; SPDX-License-Identifier: MIT
; As pic14.asm, for what is an ATmega328P's own.
        .global main
main:
        clr r1
        clr r21
        clr r29
        call plain
        call with_breq
        call zero
        call reading
        call skips_two_words
        ldi r20, 1
        sts done, r20
forever:
        rjmp forever

plain:                          ; 13
        ldi r20, 3
plain_turn:
        dec r20
        brne plain_turn
        ret

with_breq:                      ; 24
        ldi r20, 5
with_breq_turn:
        dec r20
        breq with_breq_end
        rjmp with_breq_turn
with_breq_end:
        ret

zero:                           ; 772
        ldi r20, 0
zero_turn:
        dec r20
        brne zero_turn
        ret

; 30 if the outer loop is stated to turn three times and the inner one twice.
stated:                         ; refused: no constant is loaded
        mov r18, r20
stated_inner:
        dec r18
        brne stated_inner
        dec r21
        brne stated
        ret

z_of_other:                     ; refused: may go on with 0
        ldi r20, 3
z_of_other_turn:
        dec r20
        tst r21
        brne z_of_other_turn
        ret

written:                        ; refused: may also change
        ldi r20, 3
written_turn:
        ori r20, 2
        dec r20
        brne written_turn
        ret

; X leads to r20, so that it is counted twice.
through_x:                      ; refused: may also change
        ldi r26, 20
        ldi r27, 0
        ldi r20, 9
through_x_turn:
        st X, r21
        dec r20
        brne through_x_turn
        ret

direct:                         ; refused: may also change
        ldi r20, 9
direct_turn:
        sts 20, r21
        dec r20
        brne direct_turn
        ret

; The register of the pointer is the counter.
pointer:                        ; refused: may also change
        ldi r26, 9
pointer_turn:
        ld r21, X+
        dec r26
        brne pointer_turn
        ret

product:                        ; refused: may also change
        ldi r20, 9
        mov r1, r20
product_turn:
        mul r21, r21
        dec r1
        brne product_turn
        ret

pair:                           ; refused: may also change
        ldi r25, 9
pair_turn:
        adiw r24, 1
        dec r25
        brne pair_turn
        ret

; Stores elsewhere, and a displacement that moves no pointer.
reading:                        ; 25
        ldi r28, 3
reading_turn:
        ldd r21, Y+5
        sts 0x0200, r21
        dec r28
        brne reading_turn
        ret

changed:                        ; refused: no constant is loaded
        ldi r20, 3
        subi r20, 7
changed_turn:
        dec r20
        brne changed_turn
        ret

; The skip leads over both words.
skips_two_words:                ; 28
        ldi r20, 4
skips_two_words_turn:
        sbrc r21, 0
        sts 0x0200, r21
        dec r20
        brne skips_two_words_turn
        ret

sleeping:                       ; refused: sleep
        sleep
        ret

jumping:                        ; refused: ijmp
        ijmp

; Of a function nm has to say a size.
        .macro sized names:vararg
        .irp name, \names
        .size \name, 2
        .endr
        .endm
        sized main, forever, plain, with_breq, chosen, zero, zero_chosen, nested
        sized not_nested, calling, touches_other, called, touches_count
        sized leaves_elsewhere, stays, z_of_other, not_every_turn, written
        sized through_x, direct, pointer, product, pair, reading
        sized from_before, changed, from_call, nine, skips_two_words
        sized itself, two_entrances, sleeping, jumping, stated
        .lcomm done, 1
