// SPDX-License-Identifier: MIT
// For SDCC only, in place of the device library, for a PIC16 whose port has no
// support/ of its own: defines the registers of registers.h and the core
// registers that code, start-up and run-time library refer to.
#define PORT_REGISTERS_HERE
#include "registers.h"

PORT_REGISTER(0x02, PCL);
PORT_REGISTER(0x03, STATUS);
PORT_REGISTER(0x0A, PCLATH);
#if defined(__SDCC_PIC14_ENHANCED)
PORT_REGISTER(0x00, INDF0);
PORT_REGISTER(0x04, FSR0L);
PORT_REGISTER(0x05, FSR0H);
PORT_REGISTER(0x08, BSR);
#else
PORT_REGISTER(0x00, INDF);
PORT_REGISTER(0x04, FSR);
#endif
