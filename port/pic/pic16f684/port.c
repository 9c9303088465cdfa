// SPDX-License-Identifier: MIT
// port.h on a PIC16F684 with 8 MHz: 2 MHz of instruction cycles, the tick from
// Timer0 and the drive from the ECCP as a full bridge. docs/ports.md has the
// pins, the measured period and the reasons.
#include "port.h"

#include "configuration.h"
#include "registers.h"

// RA0 and RA2 are AN0 and AN2, RA3 is MCLR. RC0 and RC1 are AN4 and AN5; RC5 to
// RC2 are P1A to P1D. Pins without a use are outputs at 0.
#define TRISA_BOARD 0x0Du
#define TRISC_BOARD 0x03u
#define ANSEL_BOARD 0x35u

// P1M: 01 forward, 11 reverse; CCP1M: 1100, all outputs active high.
#define BRIDGE_FORWARD 0x4Cu
#define BRIDGE_REVERSE 0xCCu

// Timer0 counts 32 cycles. The interrupt leaves out this many counts.
#define TMR0_LEFT_OUT 12u

#define TICKS_MAX 255u

// ADCON0: right justified, reference VDD, converter on; the channel from bit 2.
#define ADCON0_BOARD 0x81u

// At least 32 cycles: 8 us of rest after the last conversion, and 5 us for the
// input capacitor behind a potentiometer of 10 kOhm.
#define ACQUISITION_TURNS 8u

// The interrupt writes only the first and the loop only the second, so neither
// ever waits for the other or masks it. Their difference is the ticks to tell.
// Deviation 8.9: the interrupt uses them, too.
static volatile uint8_t ticks_counted;
// Deviation 8.9: as above.
static volatile uint8_t ticks_taken;

// Writing TMR0 clears its prescaler, and with it the time since the last count.
// So the interrupt waits for the first count, which comes 32 cycles after the
// overflow, and then writes: its latency does not enter the period.
PORT_TICK_INTERRUPT()
{
    INTCON &= (uint8_t)~INTCON_T0IF;
    if ((uint8_t)(ticks_counted - ticks_taken) != TICKS_MAX) {
        ticks_counted += 1u;
    }
    while (TMR0 == 0u) {
    }
    TMR0 += TMR0_LEFT_OUT;
}

// Full drive off, at the end of the PWM period at the latest. The low bits go
// first: CCPR1L = 0 with low bits would be one of the pulses never made.
static void drive_off(void)
{
    CCP1CON &= (uint8_t)~CCP1CON_DC1B;
    CCPR1L = 0u;
}

static void init_pins(void)
{
    PORTA = 0u;
    PORTC = 0u;
    CMCON0 = 0x07u; // comparators off: their pins are digital
    ANSEL = ANSEL_BOARD;
    TRISA = TRISA_BOARD;
}

// The bridge's pins become outputs last, with no duty.
static void init_drive(void)
{
    PR2 = 0x3Fu; // 64 cycles: 31.25 kHz
    drive_off();
    CCP1CON = BRIDGE_FORWARD;
    T2CON = 0x04u; // on, 1:1
    PIR1 &= (uint8_t)~PIR1_TMR2IF;
    while ((PIR1 & PIR1_TMR2IF) == 0u) {
    }
    TRISC = TRISC_BOARD;
}

void port_init(void)
{
    OSCCON = 0x70u; // 8 MHz
    init_pins();
    init_drive();
    ADCON1 = 0x20u; // Fosc/32: 4 us a bit
    ADCON0 = ADCON0_BOARD;
    WDTCON = 0x08u;        // 512 cycles of 31 kHz: 17 ms
    PORT_CLEAR_WATCHDOG(); // as the data sheet has it before PSA
    OPTION_REG = 0x84u;    // pull-ups off, Timer0 counts 32 cycles
    INTCON = 0xA0u;        // GIE, T0IE
}

bool port_running(void)
{
    return true;
}

uint8_t port_ticks(void)
{
    const uint8_t counted = ticks_counted;
    const uint8_t ticks = (uint8_t)(counted - ticks_taken);

    ticks_taken = counted;
    if (ticks != 0u) {
        PORT_CLEAR_WATCHDOG();
    }
    return ticks;
}

uint8_t port_wait_tick(void)
{
    uint8_t ticks = 0;
    do {
        ticks = port_ticks();
    } while (ticks == 0u);
    return ticks;
}

uint16_t port_read(uint8_t channel)
{
    uint8_t turn = ACQUISITION_TURNS;

    ADCON0 = (uint8_t)(ADCON0_BOARD | (uint8_t)(channel << 2));
    do {
        PORT_NOP();
        turn--;
    } while (turn != 0u);
    ADCON0 |= ADCON0_GO;
    while ((ADCON0 & ADCON0_GO) != 0u) {
    }
    return (uint16_t)((uint16_t)((uint16_t)ADRESH << 8) | ADRESL);
}

// The data sheet's way to turn a bridge around without both of its switches on:
// no duty for a whole PWM period. The end of a period starts the one without
// duty, and the next end turns the bridge.
static void turn_around(uint8_t bridge)
{
    drive_off();
    PIR1 &= (uint8_t)~PIR1_TMR2IF;
    while ((PIR1 & PIR1_TMR2IF) == 0u) {
    }
    // Masked, or SDCC 4.2.0 may move the plain copy before the call.
    CCP1CON = (uint8_t)(bridge & BRIDGE_REVERSE);
}

void port_drive(int16_t duty)
{
    uint16_t magnitude = (uint16_t)duty;
    uint8_t bridge = BRIDGE_FORWARD;

    if ((magnitude & 0x8000u) != 0u) {
        magnitude = (uint16_t)(0u - magnitude);
        bridge = BRIDGE_REVERSE;
    }
    if (magnitude > (uint16_t)PORT_DRIVE_FULL) {
        magnitude = (uint16_t)PORT_DRIVE_FULL;
    }
    if (magnitude < (uint16_t)PORT_DRIVE_LEAST) {
        drive_off();
        return;
    }
    if (((CCP1CON ^ bridge) & CCP1CON_P1M1) != 0u) {
        turn_around(bridge);
    }
    CCPR1L = (uint8_t)(magnitude >> 2);
    CCP1CON = (uint8_t)(bridge | (uint8_t)(((uint8_t)magnitude & 3u) << 4));
}
