// SPDX-License-Identifier: MIT
// Stands in for XC8's <xc.h>, for a check of syntax and types only: what the
// ports use of it, in its spelling. The real one declares thousands of names
// more, and gives them their addresses.
#ifndef XC_H
#define XC_H

#define __interrupt(...) __attribute__((used))
#define CLRWDT() ((void)0)
#define __near

extern volatile unsigned char ADCON0, ADCON1, ADRESH, ADRESL;
extern volatile unsigned char CCP1CON, CCPR1L, INTCON, PIR1, PR2, T2CON;
extern volatile unsigned char T1CON, TRISA, TRISC;

extern volatile struct {
    unsigned : 1;
    unsigned TMR2IF : 1;
} PIR1bits;
extern volatile struct {
    unsigned : 1;
    unsigned GO : 1;
} ADCON0bits;

#if defined(_16F684)
extern volatile unsigned char ANSEL, CMCON0, OPTION_REG, OSCCON, PIE1;
extern volatile unsigned char PORTA, PORTC, TMR0, TMR1H, TMR1L, WDTCON;
#elif defined(_18F4520)
extern volatile unsigned char ADCON2, CCP2CON, CCPR2H, CCPR2L, IPR2, PIE2, PIR2;
extern volatile unsigned char LATA, LATB, LATC, LATD, LATE, RCON, T3CON;
extern volatile unsigned char TRISB, TRISD, TRISE;
#else
#error "xc.h: _16F684 or _18F4520"
#endif

#endif
