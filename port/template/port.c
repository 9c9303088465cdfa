// SPDX-License-Identifier: MIT
// A port to fill in: each function with what it promises to port.h. It compiles
// as it is, and then does nothing; test/use/port_check/filled/ is one for an
// imaginary chip, and docs/ports.md has the reasons. On a PC
//     test/use/port_check/run FOLDER
// checks each promise, once fake/ beside your port.c says how your chip
// behaves: filled/ has an example of that, too.
//
// The seventh function, port_wait_ticks, is the same for every port: compile
// ../port_wait_ticks.c too, if the application calls it. It calls
// port_wait_tick for each tick, and so feeds the watchdog while it waits.
#include "port.h"

#include "configuration.h"
#include "registers.h"

// The interrupt counts in the first, and only the interrupt writes to it; the
// loop counts in the second what it has been told. Their difference is the
// ticks to tell, so nothing is ever masked. Both are single bytes, which every
// chip reads and writes at once.
static volatile uint8_t ticks_counted;
static uint8_t ticks_taken;

// The timer's interrupt, PORT_TICKS_PER_SECOND times a second. Give it the head
// and the name of your compiler and vector.
//   * Clear its flag, and reload the timer such that the interrupt's latency
//     does not add to the period, if the timer does not reload itself.
//   * Count, up to 255 ahead of the loop, and do nothing else.
void tick(void);
void tick(void)
{
    if ((uint8_t)(ticks_counted + 1u) != ticks_taken) {
        ticks_counted++;
    }
}

static void feed_watchdog(void)
{
    // The instruction or the register that restarts the watchdog.
}

// Starts clock, timer and A/D converter, and leaves the drive off.
//   * After a reset the drive's pins are inputs: make them outputs last, when
//     the PWM runs without duty.
//   * Let the watchdog be on by the configuration, so that no program can
//     forget it.
//   * Enable the timer's interrupt; nothing else may interrupt.
//   * The duty register may hold anything after a reset.
void port_init(void)
{
}

#ifndef port_running
// True on a chip, always.
bool port_running(void) // Deviation 5.5: a constant in port_board.h
{
    return true;
}
#endif

// Ticks since the last call to this or to one that waits, saturating at 255; 0
// if there was none. Feeds the watchdog when there was one, and only then: a
// dead timer resets the chip.
// (../port_ticks.h has this function and the next, for ticks that are counted
// as here. They stand here to be read.)
uint8_t port_ticks(void)
{
    const uint8_t ticks = (uint8_t)(ticks_counted - ticks_taken);

    ticks_taken = (uint8_t)(ticks_taken + ticks);
    if (ticks != 0u) {
        feed_watchdog();
    }
    return ticks;
}

// The same, but waits for a tick: at least 1. More than 1 says that the loop
// takes longer than a tick.
//   * Ticks that came before are told at once, without waiting for another.
//   * It does not feed the watchdog while it waits: that is after the tick.
uint8_t port_wait_tick(void)
{
    while (ticks_counted == ticks_taken) {
    }
    return port_ticks();
}

// One conversion of a channel, 0..1023 over the converter's reference.
//   * Choose the channel, let the input capacitor settle, convert; wait for the
//     end, so that the result is of this conversion and not of the last.
//   * A converter of 12 bits is shifted down by 2, one of 8 bits up by 2.
uint16_t port_read(uint8_t channel)
{
    (void)channel;
    return 0;
}

// Sets the drive: the sign is the direction and the magnitude the duty, limited
// to PORT_DRIVE_FULL; below PORT_DRIVE_LEAST it is off. Takes effect at once.
//   * "At once" is by the end of the second PWM period, but for the direction.
//   * No pulse is ever shorter than PORT_DRIVE_LEAST, not even between the two
//     writes of a duty that takes two registers.
//   * INT16_MIN has no magnitude in an int16_t: take it unsigned.
//   * Before the direction changes, let a whole PWM period pass without duty,
//     and one after it, too, where a leg of the bridge turns with it: so no leg
//     has both of its switches on.
void port_drive(int16_t duty)
{
    (void)duty;
}
