// SPDX-License-Identifier: MIT
// For SDCC only, in place of the device library: defines the registers of
// registers.h and the core registers that the run-time library refers to.
#define PORT_REGISTERS_HERE
#include "../registers.h"

PORT_REGISTER(0x00, INDF);
PORT_REGISTER(0x02, PCL);
PORT_REGISTER(0x03, STATUS);
PORT_REGISTER(0x04, FSR);
PORT_REGISTER(0x0A, PCLATH);
