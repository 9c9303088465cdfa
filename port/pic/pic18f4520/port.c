// SPDX-License-Identifier: MIT
// port.h on a PIC18F4520 with 40 MHz: 10 MHz of instruction cycles, the tick
// from Timer1 with CCP2 as its comparator, the drive from CCP1 and a direction
// pin. docs/ports.md has the pins, the measured period and the reasons.
#include "port.h"

#include "configuration.h"
#include "registers.h"

// RA0 to RA2 are AN0 to AN2, RA6 and RA7 the crystal. RC0 is the direction and
// RC2 CCP1. Pins without a use are outputs at 0.
#define TRISA_BOARD 0xC7u
#define LATC_REVERSE 0x01u

// 10000 instruction cycles.
#define TICK_HIGH 0x27u
#define TICK_LOW 0x10u

// Where the first tick is, so that none is at 0, which gpsim misses.
#define FIRST_LOW 0x18u

#define CCP1CON_PWM 0x0Cu
#define TICKS_MAX 255u

// The interrupt writes only the first and the loop only the second, so neither
// ever waits for the other or masks it. Their difference is the ticks to tell.
// Deviation 8.9: the interrupt uses them, too.
static volatile uint8_t ticks_counted;
// Deviation 8.9: as above.
static volatile uint8_t ticks_taken;

// The Timer1 count of the next tick, in halves, which an interrupt of SDCC adds
// to without temporaries that it would have to save.
// Deviation 8.9: the interrupt uses them, too.
static uint8_t match_low;
// Deviation 8.9: as above.
static uint8_t match_high;

// Timer1 is never written: whatever the interrupt's latency was, the next match
// is 10000 cycles after this one. While only a half of it is written, it is far
// away, for Timer1 may be about to reach the one half with the other old.
PORT_TICK_INTERRUPT()
{
    PIR2 &= (uint8_t)~PIR2_CCP2IF;
    match_high += TICK_HIGH;
    if (match_low >= (uint8_t)(256u - TICK_LOW)) {
        match_high += 1u;
    }
    match_low += TICK_LOW;
    CCPR2H = match_high ^ 0x80u;
    CCPR2L = match_low;
    CCPR2H = match_high;
    if ((uint8_t)(ticks_counted - ticks_taken) != TICKS_MAX) {
        ticks_counted += 1u;
    }
}

// Full drive off, at the end of the PWM period at the latest. The low bits go
// first: CCPR1L = 0 with low bits would be one of the pulses never made.
static void drive_off(void)
{
    CCP1CON &= (uint8_t)~CCP1CON_DC1B;
    CCPR1L = 0u;
}

static void wait_for_end_of_period(void)
{
    PIR1 &= (uint8_t)~PIR1_TMR2IF;
    while ((PIR1 & PIR1_TMR2IF) == 0u) {
    }
}

static void init_pins(void)
{
    ADCON1 = 0x0Cu; // AN0 to AN2 analog, reference VDD and VSS
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

// The drive's pins become outputs last, with no duty.
static void init_drive(void)
{
    PR2 = 0xFFu; // 256 cycles: 39 kHz
    CCPR1L = 0u;
    CCP1CON = CCP1CON_PWM;
    T2CON = 0x04u; // on, 1:1
    wait_for_end_of_period();
    TRISC = 0u;
}

static void init_tick(void)
{
    T1CON = 0x81u;   // on, 16-bit access, 1:1 of the instruction clock
    T3CON = 0x00u;   // Timer1 is CCP2's time base
    CCP2CON = 0x0Au; // compare, interrupt only
    match_low = FIRST_LOW;
    match_high = TICK_HIGH;
    CCPR2L = match_low;
    CCPR2H = match_high;
    PIR2 &= (uint8_t)~PIR2_CCP2IF;
    PIE2 = 0x01u; // CCP2IE
    IPR2 = 0x01u; // CCP2IP
    RCON |= 0x80u;
    INTCON = 0x80u; // GIEH: high priority only
}

void port_init(void)
{
    init_pins();
    init_drive();
    ADCON2 = 0x92u; // right justified, 4 TAD acquisition, Fosc/32: 0.8 us a bit
    init_tick();
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
    ADCON0 = (uint8_t)((uint8_t)(channel << 2) | 0x01u); // ADON
    ADCON0 |= ADCON0_GO;
    while ((ADCON0 & ADCON0_GO) != 0u) {
    }
    return (uint16_t)((uint16_t)((uint16_t)ADRESH << 8) | ADRESL);
}

// No duty for a whole PWM period before the direction changes.
static void turn_around(uint8_t direction)
{
    drive_off();
    wait_for_end_of_period();
    wait_for_end_of_period();
    // Masked, or SDCC 4.2.0 moves the plain copy before the calls.
    LATC = (uint8_t)(direction & LATC_REVERSE);
}

void port_drive(int16_t duty)
{
    uint16_t magnitude = (uint16_t)duty;
    uint8_t direction = 0;

    if ((magnitude & 0x8000u) != 0u) {
        magnitude = (uint16_t)(0u - magnitude);
        direction = LATC_REVERSE;
    }
    if (magnitude > (uint16_t)PORT_DRIVE_FULL) {
        magnitude = (uint16_t)PORT_DRIVE_FULL;
    }
    if (magnitude < (uint16_t)PORT_DRIVE_LEAST) {
        drive_off();
        return;
    }
    if (LATC != direction) {
        turn_around(direction);
    }
    CCPR1L = (uint8_t)(magnitude >> 2);
    CCP1CON =
        (uint8_t)(CCP1CON_PWM | (uint8_t)(((uint8_t)magnitude & 3u) << 4));
}
