// SPDX-License-Identifier: MIT
// The configuration words of the PIC18F26K22, in the spelling that SDCC and XC8
// share: 10 MHz crystal times four, watchdog of 32 ms, power-up timer,
// brown-out reset at 2.85 V (40 MHz need 2.7 V), reset on a stack fault.
#ifndef PORT_PIC18F26K22_CONFIGURATION_H
#define PORT_PIC18F26K22_CONFIGURATION_H

#if defined(__SDCC) || defined(__XC8)
#pragma config FOSC = HSMP, PLLCFG = ON, PRICLKEN = ON, FCMEN = OFF, IESO = OFF
#pragma config PWRTEN = ON, BOREN = SBORDIS, BORV = 285
#pragma config WDTEN = ON, WDTPS = 8
#pragma config MCLRE = EXTMCLR, PBADEN = OFF, CCP2MX = PORTC1
#pragma config STVREN = ON, LVP = OFF, XINST = OFF, DEBUG = OFF
#endif

// The run-time stack of SDCC, with room for any application.
#if defined(__SDCC)
#pragma stack 0xE00 0x100
#endif

#endif
