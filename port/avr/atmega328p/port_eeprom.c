// SPDX-License-Identifier: MIT
#include "port_eeprom.h"

#include <avr/eeprom.h>

// Deviation 11.4: an address in another memory.
#define CELL(address) ((uint8_t *)(uintptr_t)(address))

uint8_t port_eeprom_read(uint8_t address)
{
    return eeprom_read_byte(CELL(address));
}

void port_eeprom_write(uint8_t address, uint8_t value)
{
    eeprom_update_byte(CELL(address), value);
    eeprom_busy_wait();
}
