// SPDX-License-Identifier: MIT
// What SDCC's run-time library asks of every chip of this family.
__sfr __at(0x02) PCL;
__sfr __at(0x03) STATUS;
__sfr __at(0x0A) PCLATH;
#ifdef __SDCC_PIC14_ENHANCED
__sfr __at(0x00) INDF0;
__sfr __at(0x04) FSR0L;
__sfr __at(0x05) FSR0H;
__sfr __at(0x08) BSR;
#else
__sfr __at(0x00) INDF;
__sfr __at(0x04) FSR;
#endif
