// SPDX-License-Identifier: MIT
// The configuration words of the PIC18F4431, in the spelling that SDCC and XC8
// share: 10 MHz crystal times four, watchdog of 32 ms without a window,
// power-up timer, brown-out reset at 4.5 V (40 MHz need 4.2 V), reset on a
// stack fault, no pin for the power PWM.
#ifndef PORT_PIC18F4431_CONFIGURATION_H
#define PORT_PIC18F4431_CONFIGURATION_H

#if defined(__SDCC) || defined(__XC8)
#pragma config OSC = HSPLL, FCMEN = OFF, IESO = OFF
#pragma config PWRTEN = ON, BOREN = ON, BORV = 45
#pragma config WDTEN = ON, WDPS = 8, WINEN = OFF
#pragma config PWMPIN = OFF, MCLRE = ON
#pragma config STVREN = ON, LVP = OFF, DEBUG = OFF
#endif

// The run-time stack of SDCC, with room for any application.
#if defined(__SDCC)
#pragma stack 0x200 0x100
#endif

#endif
