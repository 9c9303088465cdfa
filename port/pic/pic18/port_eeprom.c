// SPDX-License-Identifier: MIT
#include "port_eeprom.h"

#include "registers_pic18.h"

#define EECON1_RD 0x01u
#define EECON1_WR 0x02u
#define EECON1_WREN 0x04u // of the EEPROM, not of the flash
#define GIEH 0x80u

uint8_t port_eeprom_read(uint8_t address)
{
    EEADR = address;
    EECON1 = EECON1_RD;
    return EEDATA;
}

// The chip takes the three writes only one right after the other, so the
// interrupt is masked for them. A caller may have masked it before.
void port_eeprom_write(uint8_t address, uint8_t value)
{
    if (port_eeprom_read(address) == value) {
        return;
    }
    EEDATA = value;
    EECON1 = EECON1_WREN;
    const uint8_t enabled = (uint8_t)(INTCON & GIEH);
    INTCON &= (uint8_t)~GIEH;
    EECON2 = 0x55u;
    EECON2 = 0xAAu;
    EECON1 |= EECON1_WR;
    INTCON |= enabled;
    while ((EECON1 & EECON1_WR) != 0u) {
    }
    EECON1 = 0u;
}
