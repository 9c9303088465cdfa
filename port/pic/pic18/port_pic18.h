// SPDX-License-Identifier: MIT
// port.h on a PIC18 with CCP modules at 40 MHz: 10 MHz of instruction cycles,
// the tick from Timer1 with CCP2 as its comparator, the drive from CCP1 (RC2)
// and a direction on RC0. docs/ports.md has the measured period and the
// reasons.
//
// For the port.c of a chip, which includes it once, after its registers.h and
// its own
//   init_pins()             all pins, but those of port C: as inputs
//   T1CON_ON                on, 16-bit access, 1:1 of the instruction clock
//   CCP2_COUNTS_TIMER1()    the time base of CCP2, where a chip has others
//   ACCESS_RAM_END          the last byte that needs no bank
// With -DPORT_UART, for firmware with port_uart.c, the interrupt is that one's,
// too: a tick is two cycles later.
#ifndef PORT_PIC_PORT_PIC18_H
#define PORT_PIC_PORT_PIC18_H

#define LATC_REVERSE 0x01u

// 10000 instruction cycles; without suffixes, for the assembler, too.
#define TICK_HIGH 0x27
#define TICK_LOW 0x10

// Where the first tick is, so that none is at 0, which gpsim misses.
#define FIRST_LOW 0x18u

#define CCP1CON_PWM 0x0Cu

// The interrupt writes only the first and the loop only the second, so neither
// ever waits for the other or masks it. Their difference is the ticks to tell.
// Deviation 8.9: the interrupt uses them, too.
PORT_BYTE(ACCESS_RAM_END - 4, ticks_counted);
// Deviation 8.9: as above.
PORT_BYTE(ACCESS_RAM_END - 3, ticks_taken);

// Of the next tick's Timer1 count. The low half is CCPR2L; CCPR2H itself will
// not do, as gpsim 0.31 overwrites it.
// Deviation 8.9: as above.
PORT_BYTE(ACCESS_RAM_END - 2, match_high);

// Timer1 is never written: whatever the interrupt's latency was, the next match
// is 10000 cycles after this one. The flag is cleared last, as a match with
// only the low half moved on, 16 cycles after this one, is not a tick.
#if defined(__SDCC)
PORT_BYTE(ACCESS_RAM_END - 1, w_saved);
PORT_BYTE(ACCESS_RAM_END, status_saved);

// The same as below, saving only what it changes.
// clang-format off
#define STATUS 0xFD8
#if defined(PORT_UART)
// It goes on to the tick, which is behind it.
#pragma code first 0x0008
static void first(void) __naked
{
    __asm
    extern  _port_uart_interrupt
    btfss   _PIR2, 0, 0             ; CCP2IF
    goto    _port_uart_interrupt
    __endasm;
}
#pragma code tick 0x000E
#else
#pragma code tick 0x0008
#endif
static void tick(void) __naked
{
    __asm
    movwf   _w_saved, 0
    movff   STATUS, _status_saved
    movlw   TICK_LOW
    addwf   _CCPR2L, 1, 0
    movlw   TICK_HIGH
    addwfc  _match_high, 0, 0
    movwf   _match_high, 0
    movwf   _CCPR2H, 0
    incf    _ticks_counted, 0, 0
    cpfseq  _ticks_taken, 0         ; 255 ahead: it stays there
    movwf   _ticks_counted, 0
    bcf     _PIR2, 0, 0             ; CCP2IF
    movf    _w_saved, 0, 0
    movff   _status_saved, STATUS
    retfie  0
    __endasm;
}
// clang-format on
#else
#if defined(PORT_UART)
void port_uart_interrupt(void);
#define IS_TICK() ((PIR2 & PIR2_CCP2IF) != 0u)
#else
#define port_uart_interrupt() ((void)0)
#define IS_TICK() true
#endif

static void count_tick(void)
{
    CCPR2L = (uint8_t)(CCPR2L + (uint8_t)TICK_LOW);
    if (CCPR2L < (uint8_t)TICK_LOW) {
        match_high += 1u;
    }
    match_high += (uint8_t)TICK_HIGH;
    CCPR2H = match_high;
    if ((uint8_t)(ticks_counted + 1u) != ticks_taken) {
        ticks_counted += 1u;
    }
    PIR2 &= (uint8_t)~PIR2_CCP2IF;
}

PORT_TICK_INTERRUPT()
{
    if (IS_TICK()) {
        count_tick();
    }
    port_uart_interrupt();
}
#endif

// Deviation 20.1: it uses the bytes above.
#include "pic/port_common.h"

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
    T1CON = T1CON_ON;
    CCP2_COUNTS_TIMER1();
    CCP2CON = 0x0Au; // compare, interrupt only
    match_high = TICK_HIGH;
    CCPR2L = FIRST_LOW;
    CCPR2H = TICK_HIGH;
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

bool port_running(void) // Deviation 5.5: a constant on a PIC16
{
    return true;
}

uint16_t port_read(uint8_t channel)
{
    ADCON0 = channel;
    ADCON0 |= ADCON0_GO;
    while (ADCON0bits.GO != 0u) {
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

#endif
