// SPDX-License-Identifier: MIT
// For PICs without a port. The configuration words stay as erased flash has
// them, but for what SDCC's code needs of a PIC18.
#ifndef CONFIGURATION_H
#define CONFIGURATION_H

#if defined(__SDCC_pic16)
#pragma config XINST = OFF
#pragma stack 0x500 0x100
#endif

#endif
