// SPDX-License-Identifier: MIT
// What SDCC's run-time library asks of every chip of this family.
__sfr __at(0xFE5) POSTDEC1;
__sfr __at(0xFE6) POSTINC1;
__sfr __at(0xFE8) WREG;
__sfr __at(0xFE9) FSR0L;
__sfr __at(0xFEA) FSR0H;
__sfr __at(0xFED) POSTDEC0;
__sfr __at(0xFEE) POSTINC0;
__sfr __at(0xFF3) PRODL;
__sfr __at(0xFF4) PRODH;
__sfr __at(0xFF5) TABLAT;
__sfr __at(0xFF6) TBLPTRL;
__sfr __at(0xFF7) TBLPTRH;
__sfr __at(0xFF8) TBLPTRU;

// Reached by pointers into the EEPROM only; there are none.
void __eeprom_gptrget1(void)
{
}

void __eeprom_gptrget2(void)
{
}
