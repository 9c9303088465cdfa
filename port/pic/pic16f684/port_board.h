// SPDX-License-Identifier: MIT
// The pendulum's board, as in AN964: PIC16F684, 8 MHz internal oscillator.
#ifndef PORT_BOARD_H
#define PORT_BOARD_H

// Timer1 makes it 256.02.
#define PORT_TICKS_PER_SECOND 256u

// Full bridge on P1A to P1D at 31.25 kHz (PR2 = 0x3F).
#define PORT_DRIVE_FULL 256

// Shorter pulses are not made: 1 to 3 counts are 125 to 375 ns, too short for
// a bridge to follow.
#define PORT_DRIVE_LEAST 4

// Analog inputs AN0, AN2, AN4 and AN5, as ADCON0 has them from bit 2; with it
// right justified, VDD as the reference and the converter on.
#define PORT_ANGLE 0x81u // half scale is upright; 1024 counts are 60 degrees
#define PORT_KP 0x89u
#define PORT_KI 0x91u
#define PORT_KD 0x95u

// On the chip; the host has this board, too.
#if defined(__SDCC) || defined(__XC8)
#define port_running() true
#endif

#endif
