// SPDX-License-Identifier: MIT
// Bytes that stay without power, where a chip has an EEPROM: at least 256. Not
// every port has it, so it is no part of port.h: port_eeprom.c, beside the
// chip's port.c or in what its family shares, is a source for those
// applications that call it.
#ifndef PORT_EEPROM_H
#define PORT_EEPROM_H
#include <stdint.h>

// What was written there last; 0xFF in a new chip.
uint8_t port_eeprom_read(uint8_t address);

// Writes a byte, unless it is there already, which spares the cell. Waits until
// it is written, some 4 ms, without feeding the watchdog: one byte in a pass of
// the loop. A byte that the supply leaves in the middle of it has any value.
// Interrupts are masked for a few cycles, and then are as the caller had them.
void port_eeprom_write(uint8_t address, uint8_t value);

#endif
