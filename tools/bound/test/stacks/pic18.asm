; SPDX-License-Identifier: MIT
; As pic14.asm, for a PIC18, with the bytes on SDCC's stack. gpsim lets no
; interrupt of high priority into one of low priority: it shows a level less.
        list p=18f4520, r=dec
        include "p18f4520.inc"
        config OSC = INTIO67, WDT = OFF, LVP = OFF, XINST = OFF

value   equ 0x20

        global main, third, stack, stack_end

stacks  udata 0x500
stack     res 255
stack_end res 1

vector  code 0
        goto main

; A level, and one of what it calls; a byte for WREG.
high_interrupt code 0x08
        bra high_handler

; The high one may come meanwhile; two bytes.
low_interrupt code 0x18
        bra low_handler

program code
main:                           ; all: 6 levels, 8 bytes, 5 seen
        lfsr 1, stack_end
        clrf value, 0
        bsf RCON, IPEN, 0
        bcf INTCON2, TMR0IP, 0
        movlw 0xE0              ; GIEH, GIEL, TMR0IE
        movwf INTCON, 0
        rcall switches
        rcall third
        bra main

high_handler:
        movwf POSTDEC1, 0
        bcf INTCON, TMR0IF, 0
        rcall first
        movf PREINC1, w, 0
        ifdef LETS_IN
        bsf INTCON, GIEH, 0
        endif
        ifdef LETS_ALL_IN
        movwf INTCON, 0
        endif
        retfie 0
low_handler:
        movff WREG, POSTDEC1
        movff STATUS, POSTDEC1
        bcf INTCON, TMR0IF, 0
        movff PREINC1, STATUS
        movff PREINC1, WREG
        retfie 0

first:                          ; 1 levels, 0 bytes
        return
second:                         ; 2 levels, 3 bytes
        movwf POSTDEC1, 0
        movff WREG, POSTDEC1
        setf POSTDEC1, 0
        rcall interrupted
        movlw 3
        addwf FSR1L, f, 0
        return
interrupted:                    ; 1 levels, 0 bytes
        bsf INTCON, TMR0IF, 0
        nop
        bsf INTCON2, TMR0IP, 0
        bsf INTCON, TMR0IF, 0
        nop
        nop
        bcf INTCON2, TMR0IP, 0
        return
third:                          ; 3 levels, 5 bytes
        clrf POSTDEC1, 0
        clrf POSTDEC1, 0
        btfss value, 0, 0
        rcall second
        movf POSTINC1, f, 0
        movff PREINC1, value
        return

; The pointer that is read and the one that is written.
moves:                          ; 1 levels, 1 bytes
        clrf POSTDEC1, 0
        movff PREINC1, POSTDEC1
        movff INDF1, WREG
        movf PREINC1, w, 0
        return

both_move:                      ; 1 levels, 2 bytes
        movff POSTDEC1, POSTDEC1
        movff PREINC1, PREINC1
        return

; It takes its argument, as SDCC's writing through a pointer does.
takes:                          ; 1 levels, 0 bytes
        movf PREINC1, w, 0
        return
gives:                          ; 2 levels, 2 bytes
        clrf POSTDEC1, 0
        clrf POSTDEC1, 0
        rcall takes
        clrf POSTDEC1, 0
        movlw 2
        addwf FSR1L, f, 0
        return
tail:                           ; 3 levels, 4 bytes
        clrf POSTDEC1, 0
        bra tail_end
tail_end:
        rcall second
        movf POSTINC1, f, 0
        return
for_ever:                       ; 3 levels, 3 bytes
        rcall second
        bra for_ever
; Another register of that number, in a bank.
banked:                         ; 1 levels, 0 bytes
        movlb 2
        movwf 0x2E5, 1
        return
switches:                       ; 2 levels, 0 bytes
        movlw HIGH(switch_table)
        movwf PCLATH, 0
        movlw LOW(switch_table)
        movwf PCL, 0
switch_table:
        goto first
        goto switch_end
switch_end:
        rcall first
        return
pushes_in_loop:                 ; refused: not the same on all paths
        clrf POSTDEC1, 0
        decfsz value, f, 0
        bra pushes_in_loop
        return
pushes_sometimes:               ; refused: not the same on all paths
        btfsc value, 0, 0
        clrf POSTDEC1, 0
        return
returns_differ:                 ; refused: not all returns leave the same
        btfsc value, 0, 0
        return
        clrf POSTDEC1, 0
        return
sets:                           ; refused: the stack pointer is set
        movwf FSR1L, 0
        return
sets_by_movff:                  ; refused: the stack pointer is set
        movff value, FSR1L
        return
sets_late:                      ; refused: the stack pointer is set
        clrf POSTDEC1, 0
        lfsr 1, stack_end
        return
pops_unknown:                   ; refused: changes by what is not known
        movf value, w, 0
        addwf FSR1L, f, 0
        return
pops_either:                    ; refused: changes by what is not known
        movlw 1
        btfsc value, 0, 0
        movlw 2
        addwf FSR1L, f, 0
        return
pops_level:                     ; refused: no path through POP
        pop
        return
itself:                         ; refused: calls itself
        rcall itself
        return
through_pointer:                ; refused: no path through a computed GOTO
        movf value, w, 0
        movwf PCL, 0
        nop
        end
