// SPDX-License-Identifier: MIT
// The configuration words of the PIC18F4520, in the spelling that SDCC and XC8
// share: 10 MHz crystal times four, watchdog of 32 ms, power-up timer,
// brown-out reset at 4.36 V at least (40 MHz need 4.2 V), reset on a stack
// fault.
#ifndef PORT_PIC18F4520_CONFIGURATION_H
#define PORT_PIC18F4520_CONFIGURATION_H

#if defined(__SDCC) || defined(__XC8)
#pragma config OSC = HSPLL, FCMEN = OFF, IESO = OFF
#pragma config PWRT = ON, BOREN = SBORDIS, BORV = 0
#pragma config WDT = ON, WDTPS = 8
#pragma config MCLRE = ON, LPT1OSC = OFF, PBADEN = OFF, CCP2MX = PORTC
#pragma config STVREN = ON, LVP = OFF, XINST = OFF, DEBUG = OFF
#endif

// The run-time stack of SDCC, with room for any application.
#if defined(__SDCC)
#pragma stack 0x500 0x100
#endif

#endif
