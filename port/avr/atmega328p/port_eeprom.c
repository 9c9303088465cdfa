// SPDX-License-Identifier: MIT
#include "port_eeprom.h"

#include <avr/eeprom.h>

uint8_t port_eeprom_read(uint8_t address)
{
    // Deviation 11.4: an address in another memory.
    return eeprom_read_byte((const uint8_t *)(uintptr_t)address);
}

void port_eeprom_write(uint8_t address, uint8_t value)
{
    // Deviation 11.4: as above.
    eeprom_update_byte((uint8_t *)(uintptr_t)address, value);
    eeprom_busy_wait();
}
