; SPDX-License-Identifier: MIT
; As pic14.asm, for an ATmega328P, in bytes of RAM.
        .global main
        jmp main
        .org 0x38               ; of the timer's compare match A
        jmp __vector_14

; The return address, two registers and what it calls.
__vector_14:
        push r24
        in r24, 0x3f
        push r24
        call first
        .ifdef LETS_IN
        sei
        .endif
        pop r24
        out 0x3f, r24
        pop r24
        reti

main:                           ; all: 15 bytes
        ldi r28, 0xff
        ldi r29, 0x08
        out 0x3e, r29
        out 0x3d, r28
        call third
        ldi r20, 1
        sts done, r20
forever:
        rjmp forever

first:                          ; 2 bytes
        ret
second:                         ; 5 bytes
        push r20
        ldi r20, 100
        out 0x27, r20           ; the compare match A of timer 0
        ldi r20, 1
        out 0x25, r20           ; without a prescaler
        ldi r20, 2
        sts 0x6e, r20           ; its interrupt
        sei
        call waits
        cli
        pop r20
        ret
waits:                          ; 2 bytes
        ldi r20, 200
waits_turn:
        dec r20
        brne waits_turn
        ret
third:                          ; 9 bytes
        push r17
        push r18
        sbrs r20, 8 - 1
        call second
        call first
        pop r18
        pop r17
        ret
makes_room:                     ; 6 bytes
        rcall .+0
        call first
        pop r0
        pop r0
        ret
tail:                           ; 6 bytes
        push r20
        call makes_nothing
        pop r20
        jmp first
makes_nothing:                  ; 3 bytes
        push r20
        pop r20
        ret
for_ever:                       ; 4 bytes
        call first
        rjmp for_ever
sleeps:                         ; 4 bytes
        sleep
        call first
        ret
pushes_in_loop:                 ; refused: not the same on all paths
        push r20
        dec r20
        brne pushes_in_loop
        ret
pushes_sometimes:               ; refused: not the same on all paths
        sbrc r20, 0
        push r20
        ret
frame:                          ; 26 bytes
        push r28
        push r29
        in r28, 0x3d
        in r29, 0x3e
        sbiw r28, 20
        in r0, 0x3f
        cli
        out 0x3e, r29
        out 0x3f, r0
        out 0x3d, r28
        call first
        adiw r28, 20
        out 0x3e, r29
        out 0x3d, r28
        pop r29
        pop r28
        ret
large_frame:                    ; 402 bytes
        in r28, 0x3d
        in r29, 0x3e
        subi r28, lo8(400)
        sbci r29, hi8(400)
        out 0x3e, r29
        out 0x3d, r28
        subi r28, lo8(-400)
        sbci r29, hi8(-400)
        out 0x3e, r29
        out 0x3d, r28
        ret
frame_left:                     ; refused: not all returns leave the same
        in r28, 0x3d
        in r29, 0x3e
        sbiw r28, 20
        sbrc r20, 0
        ret
        out 0x3e, r29
        out 0x3d, r28
        ret
frame_sometimes:                ; refused: the stack pointer is set
        push r20
        in r28, 0x3d
        in r29, 0x3e
        sbrc r20, 0
        adiw r28, 1
        out 0x3e, r29
        out 0x3d, r28
        pop r20
        ret
frame_of_another:               ; refused: the stack pointer is set
        push r20
        in r28, 0x3d
        in r29, 0x3e
        mov r28, r20
        out 0x3e, r29
        out 0x3d, r28
        pop r20
        ret
set_from_argument:              ; refused: changes by what is not known
        out 0x3e, r25
        out 0x3d, r24
        ret
itself:                         ; refused: calls itself
        call itself
        ret
through_pointer:                ; refused: no path through icall
        icall
        ret

; Of a function nm has to say a size.
        .macro sized names:vararg
        .irp name, \names
        .size \name, 2
        .endr
        .endm
        sized __vector_14, main, forever, first, second, waits, third
        sized makes_room, tail, makes_nothing, for_ever, sleeps, pushes_in_loop
        sized pushes_sometimes, frame, large_frame, frame_left, frame_sometimes
        sized frame_of_another, set_from_argument, itself, through_pointer
        .lcomm done, 1
