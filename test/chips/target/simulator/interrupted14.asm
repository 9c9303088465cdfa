; SPDX-License-Identifier: MIT
; Looks to the co-simulation like a pendulum's firmware. Its start-up takes some
; milliseconds and ends when Timer2 has come round; then it is in its interrupt
; most of the time. So a fault finds it where gpsim's reset forgets something.
        list p=16f684, r=dec
        include "p16f684.inc"
        __config _INTOSCIO & _WDT_ON & _MCLRE_ON
        global _pendulum, _port_wait_tick

objects udata
_pendulum
        res 20

; Written without changing STATUS, which the interrupt does not save.
shared  udata_shr
inner   res 1
outer   res 1
ticked  res 1           ; bit 0

reset   code 0
        goto main
tick    code 4
        movlw 2
        call spend
        clrwdt
        bcf INTCON, T0IF
        bsf ticked, 0
        retfie

program code
; 770 cycles times W.
spend:  movwf outer
        movlw 0
        movwf inner
more:   decfsz inner, F
        goto more
        decfsz outer, F
        goto more
        return

_port_wait_tick
        btfss ticked, 0
        goto _port_wait_tick
        bcf ticked, 0
        return

main:   clrwdt
        banksel OPTION_REG
        movlw 0xC2      ; Timer0 comes round every 2048 cycles
        movwf OPTION_REG
        banksel T2CON
        movlw 6
        call spend
        bcf PIR1, TMR2IF
        bsf T2CON, TMR2ON
round:  btfss PIR1, TMR2IF
        goto round
        movlw 0xA0      ; GIE, T0IE
        movwf INTCON
loop:   call _port_wait_tick
        goto loop
        end
