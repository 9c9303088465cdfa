// SPDX-License-Identifier: MIT
// The configuration words of a PIC; no other chip needs this file. What is not
// said here stays as erased flash has it: replace it by your chip's settings,
// oscillator, watchdog and brown-out reset first, as in
// ../pic/pic18f26k22/configuration.h and ../pic/pic16f684/configuration.h.
#ifndef PORT_CONFIGURATION_H
#define PORT_CONFIGURATION_H

// SDCC's code does not work with the extended instructions of a PIC18, which an
// older one has not, and its run-time stack needs a place: the first address
// and the size, in RAM that the chip has. tools/firmware defines both names as
// the chip is; your own configuration.h needs only the lines for it.
#if defined(__SDCC_pic16)
#if !defined(PORT_NO_XINST)
#pragma config XINST = OFF
#endif
#if defined(PORT_SMALL_RAM) // less than 768 bytes
#pragma stack 0xC0 0x40
#else
#pragma stack 0x200 0x100
#endif
#endif

#endif
