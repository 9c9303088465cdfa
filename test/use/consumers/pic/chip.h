// SPDX-License-Identifier: MIT
// This program's own registers, and its configuration with the watchdog off.
#ifndef CHIP_H
#define CHIP_H
#include <stdint.h>

#if defined(__SDCC_PIC14_ENHANCED)
__sfr __at(0x0C) PORTA;
__sfr __at(0x0E) PORTC;
static __code uint16_t __at(0x8007) configuration_word = 0x3FE4;
#elif defined(__SDCC_pic14)
#ifdef REGISTER_IN_BANK_1 // any: it is not run
__sfr __at(0x85) PORTA;
#else
__sfr __at(0x05) PORTA;
#endif
__sfr __at(0x07) PORTC;
static __code uint16_t __at(0x2007) configuration_word = 0x33E4;
#else
__sfr __at(0xF80) PORTA;
__sfr __at(0xF82) PORTC;
#pragma config OSC = HSPLL, WDT = OFF, LVP = OFF, XINST = OFF
#pragma stack 0x500 0x100
#endif

#endif
