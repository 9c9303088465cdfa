// SPDX-License-Identifier: MIT
// How a board's world and its chip are wired: which pin an analog input is on,
// and what the chip's registers say about its converter and its drive. The
// linker chooses the board, as it does the world.
#ifndef BOARD_HH
#define BOARD_HH
#include <cstdint>
#include <vector>

#include "chip.hh"

struct AnalogPin {
    unsigned channel;
    const char *pin;
};

struct Board {
    const char *processor;
    double oscillator_hz; // 0: the firmware sets it
    uint64_t step_cycles; // the world moves at least this often
    std::vector<unsigned> interrupt_vectors;
    std::vector<AnalogPin> analog_pins;
    unsigned converter_register;
    unsigned converter_go;                 // its bit that starts a conversion
    unsigned ground_channel;               // inside the chip, or no_channel
    std::vector<unsigned> drive_registers; // a write may change the drive
};

extern const Board board;

constexpr unsigned no_channel = 0x100;

// The channel of the conversion that a write of `control` to that register has
// started, as port_read was asked for it.
unsigned board_channel(const Chip &chip, unsigned control);

// The signed duty that the registers command, in counts of 1 / PORT_DRIVE_FULL;
// 0 while the pins are not driven. From registers, because gpsim shows a
// PIC's pins in steps of four counts only.
int board_drive_counts(const Chip &chip);

#endif
