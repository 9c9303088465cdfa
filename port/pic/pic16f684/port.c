// SPDX-License-Identifier: MIT
// port.h on a PIC16F684 with 8 MHz: 2 MHz of instruction cycles, the tick from
// Timer1 and the drive from the ECCP as a full bridge. docs/ports.md has the
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

// What the interrupt adds to Timer1, which it stops for 7 cycles: without
// suffixes, for the assembler, too. 65536 + 7 - 0xE183 are 7812 cycles.
#define TICK_SKIP_HIGH 0xE1
#define TICK_SKIP_LOW 0x83
#define T1CON_ON 0x01u // 1:1 of the instruction clock

// The interrupt writes only the first and the loop only the second, so neither
// ever waits for the other or masks it. Their difference is the ticks to tell.
// Deviation 8.9: the interrupt uses them, too.
PORT_BYTE(0x20, ticks_counted);
// Deviation 8.9: as above.
PORT_BYTE(0x21, ticks_taken);

// Timer1 has counted on since its overflow and keeps that, so the interrupt's
// latency does not enter the period. While it is written it stands still,
// always for the same time.
#if defined(__SDCC)
// The same as below, saving only what it changes.
// clang-format off
static void tick(void) __interrupt(0) __naked
{
    __asm
    movwf   WSAVE
    swapf   STATUS, W
    clrf    STATUS
    movwf   SSAVE
    bcf     _T1CON, 0               ; TMR1ON
    movlw   TICK_SKIP_LOW
    addwf   _TMR1L, F
    btfsc   STATUS, 0
    incf    _TMR1H, F
    movlw   TICK_SKIP_HIGH
    addwf   _TMR1H, F
    bsf     _T1CON, 0
    bcf     _PIR1, 0                ; TMR1IF
    incf    _ticks_counted, W
    xorwf   _ticks_taken, W
    btfss   STATUS, 2               ; 255 ahead: it stays there
    incf    _ticks_counted, F
    swapf   SSAVE, W
    movwf   STATUS
    swapf   WSAVE, F
    swapf   WSAVE, W
    retfie
    __endasm;
}
// clang-format on
#else
PORT_TICK_INTERRUPT()
{
    T1CON &= (uint8_t)~T1CON_ON;
    TMR1L = (uint8_t)(TMR1L + (uint8_t)TICK_SKIP_LOW);
    if (TMR1L < (uint8_t)TICK_SKIP_LOW) {
        TMR1H += 1u;
    }
    TMR1H = (uint8_t)(TMR1H + (uint8_t)TICK_SKIP_HIGH);
    T1CON |= T1CON_ON;
    PIR1 &= (uint8_t)~PIR1_TMR1IF;
    if ((uint8_t)(ticks_counted + 1u) != ticks_taken) {
        ticks_counted += 1u;
    }
}
#endif

// Deviation 20.1: it uses the bytes above.
#include "pic/port_common.h"

// The bridge's pins become outputs when there is no duty; else by banks, as
// each change of the bank costs a word. The tick starts last, in bank 0, in
// which a function must return to a file that knows no other.
void port_init(void)
{
    PORTA = 0u;
    PORTC = 0u;
    CMCON0 = 0x07u; // comparators off: their pins are digital
    CCPR1L = 0u;
    CCP1CON = BRIDGE_FORWARD;
    T2CON = 0x04u;  // on, 1:1
    WDTCON = 0x08u; // 512 cycles of 31 kHz: 17 ms
    TMR1L = 0u;
    TMR1H = (uint8_t)TICK_SKIP_HIGH;
    INTCON = 0xC0u;        // GIE, PEIE
    PORT_CLEAR_WATCHDOG(); // as the data sheet has it before PSA
    OPTION_REG = 0x84u;    // pull-ups off, Timer0 counts 32 cycles
    OSCCON = 0x70u;        // 8 MHz
    ANSEL = ANSEL_BOARD;
    TRISA = TRISA_BOARD;
    PR2 = 0x3Fu;    // 64 cycles: 31.25 kHz
    ADCON1 = 0x20u; // Fosc/32: 4 us a bit
    PIE1 = 0x01u;   // TMR1IE
    wait_for_end_of_period();
    TRISC = TRISC_BOARD;
    T1CON = T1CON_ON;
}

// Timer0 counts after 32 cycles: 8 us of rest after the last conversion, and
// 5 us for the input capacitor behind a potentiometer of 10 kOhm.
uint16_t port_read(uint8_t channel)
{
    ADCON0 = channel;
    TMR0 = 0u;
    while (TMR0 == 0u) {
    }
    ADCON0 |= ADCON0_GO;
    while (ADCON0bits.GO != 0u) {
    }
    const uint8_t low = ADRESL;
    return (uint16_t)(((uint16_t)ADRESH << 8) | low);
}

// No leg of the bridge has both of its switches on: one goes off with the duty
// and the other with P1M1, and their partners go on a whole PWM period later.
// The end of a period takes the duty away, the next end turns the bridge, and
// the one after it brings the new duty.
static void turn_around(uint8_t bridge)
{
    drive_off();
    wait_for_end_of_period();
    // Masked, or SDCC 4.2.0 may move the plain copy before the call.
    CCP1CON = (uint8_t)(bridge & BRIDGE_REVERSE);
    wait_for_end_of_period();
}

void port_drive(int16_t duty)
{
    uint16_t magnitude = (uint16_t)duty;
    uint8_t bridge = BRIDGE_FORWARD;

    if ((magnitude & 0x8000u) != 0u) {
        magnitude = (uint16_t)(0u - magnitude);
        bridge = BRIDGE_REVERSE;
    }
    uint8_t low = (uint8_t)magnitude;
    uint8_t quarter = (uint8_t)(low >> 2);
    if ((magnitude & 0xFF00u) != 0u) {
        low = 0;
        quarter = PORT_DRIVE_FULL / 4;
    }
    if (quarter == 0u) {
        drive_off();
        return;
    }
    if (((CCP1CON ^ bridge) & CCP1CON_P1M1) != 0u) {
        turn_around(bridge);
    }
    CCPR1L = quarter;
    CCP1CON = (uint8_t)(bridge | (uint8_t)((uint8_t)(low << 4) & CCP1CON_DC1B));
}
