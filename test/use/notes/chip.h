// SPDX-License-Identifier: MIT
// The registers of both programs, beyond those of a port's registers.h, and
// the configuration, with the watchdog off.
#ifndef CHIP_H
#define CHIP_H
#include "registers.h"

#if defined(__SDCC_pic14)
static __code uint16_t __at(0x2007) configuration_word = 0x33E4;
#elif defined(__SDCC)
__sfr __at(0xFCE) TMR1L;
__sfr __at(0xFCF) TMR1H;
#endif

#if defined(_PIC18) || defined(__SDCC_pic16)
#pragma config OSC = HSPLL, WDT = OFF, LVP = OFF, XINST = OFF
#if defined(__SDCC)
#pragma stack 0x500 0x100
#endif
#endif

#endif
