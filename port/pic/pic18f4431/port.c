// SPDX-License-Identifier: MIT
// port.h on a PIC18F4431, the chip of AN937, with 40 MHz: what all PIC18s do,
// its own pins, and an A/D converter of its own.
#include "port.h"

#include "configuration.h"
#include "registers.h"

// RA0 to RA2 are AN0 to AN2, RA6 and RA7 the crystal. Pins without a use are
// outputs at 0.
#define TRISA_BOARD 0xC7u
#define ANSEL0_BOARD 0x07u
#define ADCON0_ON 0x01u

#define ACCESS_RAM_END 0x5F
#define T1CON_ON 0x81u
#define CCP2_COUNTS_TIMER1() ((void)0) // it has no other

// The converter samples a group of inputs, A to D, by two bits of ADCON0 that
// are where other chips have a channel's number: with the first input of each
// in ADCHS the group's number is the channel's. Without a FIFO each conversion
// overwrites the last one.
static void init_converter(void)
{
    ADCON1 = 0u; // no FIFO, reference VDD and VSS
    ADCON3 = 0u; // nothing but GO starts it
    ADCHS = 0u;  // AN0, AN1, AN2
    ANSEL0 = ANSEL0_BOARD;
    ANSEL1 = 0u;
    ADCON0 = ADCON0_ON; // it starts up while init_drive waits for a PWM period
}

static void init_pins(void)
{
    init_converter();
    PWMCON0 = 0u; // the pins of the power PWM are ports
    LATA = 0u;
    LATB = 0u;
    LATC = 0u;
    LATD = 0u;
    LATE = 0u;
    TRISA = TRISA_BOARD;
    TRISB = 0u;
    TRISD = 0u;
    TRISE = 0u;
}

// Deviation 20.1: it uses what is above.
#include "pic/pic18/port_pic18.h"
