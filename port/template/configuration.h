// SPDX-License-Identifier: MIT
// The configuration words of a PIC; no other chip needs this file. What is not
// said here stays as erased flash has it: replace it by your chip's settings,
// oscillator, watchdog and brown-out reset first, as in
// ../pic/pic18f26k22/configuration.h and ../pic/pic16f684/configuration.h.
#ifndef PORT_CONFIGURATION_H
#define PORT_CONFIGURATION_H

// SDCC's code does not work with the extended instructions of a PIC18, and its
// run-time stack needs a place: the first address and the size, in RAM that the
// chip has. An older chip has no XINST: there, say STVREN = ON instead.
#if defined(__SDCC_pic16)
#pragma config XINST = OFF
#pragma stack 0x200 0x100
#endif

#endif
