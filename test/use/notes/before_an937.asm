; SPDX-License-Identifier: MIT
; A motor as AN937 has it, before: a program that calls PIDMain.
        list    p=18f4520, r=dec
        include "p18f4520.inc"
        CONFIG  OSC = HSPLL, WDT = OFF, LVP = OFF, XINST = OFF

#define SETPOINT        2000
#define a_err_1_lim     high .4000
#define a_err_2_lim     low .4000
#define timer1_hi       high (0x10000 - .10000) ; 1 ms at 40 MHz
#define timer1_lo       low (0x10000 - .10000)
#define deriv_period    .4      ; overflows for a d_error

        cblock  0x00
        measured0, measured1            ; by measure
        endc

        org     0x0000
        goto    main
        org     0x0008
        goto    PIDInterrupt

main    call    PIDInitialize
        movlw   .96
        movwf   kp
        movlw   .80
        movwf   ki
        movlw   .16
        movwf   kd
        movlw   timer1_hi
        movwf   TMR1H
        movlw   timer1_lo
        movwf   TMR1L
        movlw   0x01
        movwf   T1CON
        bsf     INTCON, PEIE
        bsf     INTCON, GIE
loop    call    measure
        bcf     PIE1, TMR1IE    ; whose routine reads the error
        movlw   low SETPOINT
        movwf   error1
        movlw   high SETPOINT
        movwf   error0
        movf    measured1, w
        subwf   error1, f
        movf    measured0, w
        subwfb  error0, f
        bsf     pid_stat1, err_sign
        btfss   error0, 7
        bra     signed
        bcf     pid_stat1, err_sign
        comf    error0, f       ; its magnitude
        negf    error1
        btfsc   STATUS, C
        incf    error0, f
signed  call    PIDMain
        bsf     PIE1, TMR1IE
        call    drive
        bra     loop

measure return                  ; measured0:measured1 of a converter
drive   return                  ; pid_out0:pid_out2 and pid_sign to a bridge

        include "an937.inc"
        end
