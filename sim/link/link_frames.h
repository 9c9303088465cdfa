// SPDX-License-Identifier: MIT
// Frames of fixpid_link, made and read from the definition in its header and
// not from src/.
#ifndef LINK_FRAMES_H
#define LINK_FRAMES_H
#include <stdint.h>

#define LINK_FRAMES_MAX 64u // bytes of any frame here

// First bytes of payloads.
enum { LINK_KEY = 1, LINK_ANSWER, LINK_HELLO, LINK_RECORD, LINK_STEP = 8 };
enum {
    LINK_ASK_HELLO = 0x40,
    LINK_ASK_RECORD,
    LINK_SET_STREAM,
    LINK_SET_SETPOINT,
    LINK_SET_MANUAL,
    LINK_SET_AUTO,
    LINK_SET_SEED,
    LINK_WRITE
};
enum { LINK_DONE, LINK_NOT_ALLOWED, LINK_REFUSED };

// Why there is a key frame.
enum {
    LINK_IN_TURN = 1,
    LINK_BEGAN = 2,
    LINK_COMMANDED = 4,
    LINK_CHANGED = 8,
    LINK_LOST = 16
};

// The CRC-16 of a payload.
uint16_t link_check(const uint8_t bytes[], unsigned count);

// COBS: makes a frame of a payload with what stands behind it, as its CRC;
// returns its bytes, with the 0 behind it.
unsigned link_stuffed(const uint8_t bytes[], unsigned count, uint8_t framed[]);

// Makes a command of a payload; returns its bytes, with the 0 behind it.
unsigned link_command(const uint8_t payload[], unsigned bytes,
                      uint8_t framed[]);

// Reads a frame of the board, without the 0 behind it; returns the payload's
// bytes, and 0 for what is no frame.
unsigned link_payload(const uint8_t framed[], unsigned bytes,
                      uint8_t payload[]);

// A number of so many bytes, the lowest first.
uint32_t link_number(const uint8_t bytes[], unsigned count);

#endif
