/* SPDX-License-Identifier: MIT */
#include "fixpid.h"
// fixpid_table: a curve from points, with straight lines between them: the
// degrees of an NTC or a thermocouple, a schedule of gains, a feed-forward, the
// characteristic of a valve, the two halves of a split range.
//
//   static const struct fixpid_table_point ntc_points[] = {
//       {20, 14848}, {30, 13082}, {500, 2511}, {1003, -3210}};
//   static const struct fixpid_table ntc = FIXPID_TABLE(ntc_points);
//   temperature = fixpid_table_at(&ntc, counts);
//
// x and y are any int16_t, in the application's units: counts, hundredths of a
// degree. x rises strictly from point to point; y is arbitrary. At x, between
// two neighbours with x0 <= x < x1, the curve is
//   y0 + floor((y1 - y0) * (x - x0) / (x1 - x0) + 1/2)
// exactly: the line, rounded to the nearest, half up. So
//   - at each point it is that point's y;
//   - between two points it lies between their y, both included, and moves in
//     one direction;
//   - at or before the first point it is the first y, and at or after the last
//     point the last y;
//   - a half is also rounded up on a falling line: both (0, 0), (2, -1) and
//     (0, -1), (2, 0) are 0 at 1.
// A jump is two points whose x are one apart. The inverse of a curve that
// rises or falls everywhere is its table with x and y swapped, and sorted.
//
// There is no state and no rate. A lookup may come at any time, except, where
// fixpid.h forbids it, from an interrupt that interrupts another lookup.
//
// Where the points lie. Make them `const` and static. Then they stay in flash
// and are read there with SDCC (PIC, 8051, STM8), on every ARM, RISC-V and
// MSP430, and on the AVRs tinyAVR 0 to 2 and AVR Dx. An ATmega, or an older
// ATtiny, copies them to its RAM at start, 4 bytes a point: there, write
// PROGMEM after the array's name, and call the functions with _P:
//   #include <avr/pgmspace.h>
//   static const struct fixpid_table_point ntc_points[] PROGMEM = {...};
//   static const struct fixpid_table ntc = FIXPID_TABLE(ntc_points);
//   temperature = fixpid_table_at_P(&ntc, counts);
// They read the lower 64 KiB of flash; a value from there takes one cycle more
// than from RAM. The functions without _P would read garbage from such points,
// and those with _P from points in RAM. A PIC reads each byte through a pointer
// that may point to RAM or flash, which takes more than half of a lookup's
// time: in a fast loop, look a gain up only every tenth step. docs/cost.md has
// the times.
#ifndef FIXPID_TABLE_H
#define FIXPID_TABLE_H
#include <stdbool.h>
#include <stdint.h>

FIXPID_C_BEGIN

struct fixpid_table_point {
    int16_t x;
    int16_t y;
};

struct fixpid_table {
    const struct fixpid_table_point *points;
    uint8_t count; // of points: 2..255
};

// The initialiser of a struct fixpid_table from an array of 2..255 points. It
// does not compile for fewer or more, and a pointer counts as fewer. It is
// itself constant, so that the struct may be static and const.
#define FIXPID_TABLE(array)                                                    \
    {                                                                          \
        (array),                                                               \
            FIXPID_CAST(uint8_t, FIXPID_CHECKED(                               \
                                     FIXPID_TABLE_COUNT(array),                \
                                     (FIXPID_TABLE_COUNT(array) >= 2u) &&      \
                                         (FIXPID_TABLE_COUNT(array) <= 255u))) \
    }

// Private: a part of the macro above.
#define FIXPID_TABLE_COUNT(array) (sizeof(array) / sizeof((array)[0]))

// True for 2 points or more, each with an x above the one before. Call it once
// for points that come from an EEPROM, a menu or a bus: fixpid_table_at does
// not check them.
bool fixpid_table_valid(const struct fixpid_table *self);

// The curve at x. Without points it is 0 everywhere, and with a single point it
// is constant, although fixpid_table_valid refuses both. If the points are not
// in order, the result is some y between those of two neighbours; it reads only
// the `count` points, and never divides by 0.
int16_t fixpid_table_at(const struct fixpid_table *self, int16_t x);

#if defined(__AVR__)
// The same for points in PROGMEM, as strlen_P is for text there. The struct
// fixpid_table itself lies in RAM.
bool fixpid_table_valid_P(const struct fixpid_table *self);
int16_t fixpid_table_at_P(const struct fixpid_table *self, int16_t x);
#endif

FIXPID_C_END

#endif
