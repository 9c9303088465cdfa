// SPDX-License-Identifier: MIT
// examples/kept on this machine, over an EEPROM that is an array.
#ifndef KEPT_HOST_H
#define KEPT_HOST_H
#include <stdbool.h>
#include <stdint.h>

#define KEPT_RECORD_AT 1u
#define KEPT_EEPROM 256u

extern uint8_t kept_eeprom[KEPT_EEPROM];

// Its controller's object before the first step, byte by byte as a chip has it,
// and the size of that without padding at its end.
uint8_t kept_byte(unsigned at);
extern const unsigned kept_object_size;

// Stores a record: 0 gentle, 1 brisk, 2 one that the firmware does not have, 3
// one that fixpid_pid_init refuses.
enum { KEPT_GENTLE, KEPT_BRISK, KEPT_OTHER, KEPT_REFUSED };
void kept_store(unsigned which);

// What the application does first, with these bytes in its EEPROM.
void kept_start(void);

// The controller as it starts with a tuning.
void kept_expect(unsigned which);

#endif
