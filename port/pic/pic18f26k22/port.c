// SPDX-License-Identifier: MIT
// port.h on a PIC18F26K22 with 40 MHz: what all PIC18s do, and its own pins.
#include "port.h"

#include "configuration.h"
#include "registers.h"

// RA0 to RA2 are AN0 to AN2, RA6 and RA7 the crystal. Pins without a use are
// outputs at 0.
#define TRISA_BOARD 0xC7u
#define ANSELA_BOARD 0x07u

#define ACCESS_RAM_END 0x5F
#define T1CON_ON 0x03u
#define CCP2_COUNTS_TIMER1() (CCPTMRS0 = 0u)

static void init_pins(void)
{
    ADCON1 = 0u; // reference VDD and VSS
    ANSELA = ANSELA_BOARD;
    ANSELB = 0u;
    ANSELC = 0u;
    LATA = 0u;
    LATB = 0u;
    LATC = 0u;
    TRISA = TRISA_BOARD;
    TRISB = 0u;
}

// Deviation 20.1: it uses what is above.
#include "pic/pic18/port_pic18.h"
