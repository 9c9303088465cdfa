// SPDX-License-Identifier: MIT
// The registers of a PIC that port.c uses, as in its data sheet; no other chip
// needs this file. SDCC wants each of them here with its address, but for those
// of the core, such as STATUS and WREG; XC8 has them.
#ifndef PORT_REGISTERS_H
#define PORT_REGISTERS_H
#include "pic/compiler.h"

// PORT_REGISTER(0xF8B, LATC);

#endif
