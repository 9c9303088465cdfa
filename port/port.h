// SPDX-License-Identifier: MIT
// The whole hardware an application sees: a timer tick, an A/D converter and a
// drive with a sign. Seven functions, bound by the linker: one application, one
// port. Nothing here knows a controller. template/ is a port to fill in.
//
// A port's folder supplies port_board.h with what its board fixes:
//   PORT_TICKS_PER_SECOND  the nominal tick rate
//   PORT_DRIVE_FULL        the duty count of full drive
//   PORT_DRIVE_LEAST       the least one that is more than off
//   PORT_...               one A/D channel name per sensor or potentiometer, a
//                          byte that port_read understands
//   port_running()         true, where a constant saves flash
#ifndef PORT_H
#define PORT_H
#include <stdbool.h>
#include <stdint.h>

#include "port_board.h"

// Starts clock, timer and A/D converter, and leaves the drive off.
void port_init(void);

// True on a chip, always; on the host until the scenario ends.
#ifndef port_running
bool port_running(void);
#endif

// Timer ticks since the last call to this or to one that waits, saturating at
// 255; 0 if there was none. Feeds the watchdog when there was one.
uint8_t port_ticks(void);

// The same, but waits for a tick: at least 1. More than 1 says that the loop
// takes longer than a tick.
uint8_t port_wait_tick(void);

// The same, but waits until n have come since the last call to one of the
// three: n..255, saturating at 255; 0 is taken for 1. Feeds the watchdog as
// ticks come, so a wait may be longer than the watchdog's time. For a loop that
// runs once in n ticks, however long it takes. The same for every port, in
// port_wait_ticks.c: a source for those applications that call it.
uint8_t port_wait_ticks(uint8_t n);

// One conversion of a channel, 0..1023 over the converter's reference.
uint16_t port_read(uint8_t channel);

// Sets the drive: the sign is the direction and the magnitude the duty, limited
// to PORT_DRIVE_FULL; below PORT_DRIVE_LEAST it is off. Takes effect at once.
void port_drive(int16_t duty);

#endif
