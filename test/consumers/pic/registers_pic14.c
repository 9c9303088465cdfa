// SPDX-License-Identifier: MIT
// What SDCC's run-time library asks of every chip of this family.
__sfr __at(0x00) INDF;
__sfr __at(0x02) PCL;
__sfr __at(0x03) STATUS;
__sfr __at(0x04) FSR;
__sfr __at(0x0A) PCLATH;
