// SPDX-License-Identifier: MIT
// The configuration word of the PIC16F684: internal oscillator with both of its
// pins free, watchdog and power-up timer on, MCLR a reset, brown-out reset on.
#ifndef PORT_PIC16F684_CONFIGURATION_H
#define PORT_PIC16F684_CONFIGURATION_H

#if defined(__SDCC)
#include <stdint.h>
static __code uint16_t __at(0x2007) configuration_word = 0x33EC;
#elif defined(__XC8)
#pragma config FOSC = INTOSCIO, WDTE = ON, PWRTE = ON, MCLRE = ON
#pragma config CP = OFF, CPD = OFF, BOREN = ON, IESO = OFF, FCMEN = OFF
#endif

#endif
