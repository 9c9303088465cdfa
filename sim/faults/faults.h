// SPDX-License-Identifier: MIT
// A closed loop broken on purpose, many times, and what came of it.
//
// A program runs its loop once up to where it is in control. From there on it
// is copied, by fork, once for each fault, so that each starts from the same
// moment; the copy breaks the loop, watches it for a while and prints a row of
// what it saw. The program is the host's, main.c, or one with a simulated chip.
#ifndef FAULTS_H
#define FAULTS_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum fault_kind {
    FAULT_NONE,       // to see what the loop does by itself
    FAULT_FLIP,       // a bit of the controller's object
    FAULT_RESET,      // the chip's
    FAULT_BROWN_OUT,  // the same, longer, and the RAM is random after it
    FAULT_HANG,       // the loop goes no further
    FAULT_HANGS,      // again and again, and each time the watchdog is late
    FAULT_DEAD_TIMER, // no tick comes any more until a reset
    FAULT_STUCK,      // the sensor reads what it read
    FAULT_SHORTED,    // it reads 0
    FAULT_OPEN,       // it reads full scale
    FAULT_NOISY,      // noise is added to it
    FAULT_CLIPPED,    // it does not reach its ends
    FAULT_INPUT_LOW,  // a potentiometer of a gain, or the set point, is at 0
    FAULT_INPUT_HIGH, // it is at its other end
    FAULT_INPUT_MOVED,
    FAULT_TICKS_LOST, // about every second tick
    FAULT_TICKS_DOUBLED,
    FAULT_TICKS_LATE,
    FAULT_PASSING, // so many pass; the others stay, and are tried if named only
    FAULT_STAYS_STUCK = FAULT_PASSING, // the sensor reads what it read
    FAULT_STAYS_LEVEL,                 // it reads a level around the set point
    FAULT_STAYS_OFF,                   // the drive is off, whatever is asked
    FAULT_STAYS_ON,                    // it is full
    FAULT_STAYS_TURNED, // it is least for most and most for least
    FAULT_FLIP_PLACE,   // a bit elsewhere in a chip, if named only; it passes
    FAULT_KINDS
};

struct fault_setting {
    const char *name; // of the world
    double value;
};

#define FAULT_SETTINGS 6u
#define FAULT_INPUTS 3u

// A loop, and where it is in control.
struct fault_loop {
    struct fault_setting settings[FAULT_SETTINGS];
    const char *value;  // a column of the world's trace
    const char *target; // another one, or NULL: 0
    double band;        // in control, the value is within this of the target
    double fallen;      // beyond this it can not come back by itself; 0: it can
    double start_s;     // faults begin from here
    double spread_s;    // to there
    double watch_s;     // and are watched for so long after their end
    double longest_s;   // the most that a fault with an end takes
    double watchdog_s;  // typical, as the data sheet has it
    uint8_t sensor;     // channels
    uint8_t inputs[FAULT_INPUTS]; // with a guard, the first is the set point
    size_t input_count;
    int low; // what the application may ask of its drive
    int high;
};

// Bound by the linker: loop_*.c.
extern const struct fault_loop fault_loop;

// What the program does to the chip that it simulates, before time goes on.
enum fault_deed {
    FAULT_GO_ON,
    FAULT_FLIP_BIT,
    FAULT_FLIP_BIT_OF_PLACE, // of as many as the place has
    FAULT_RESET_CHIP,        // without drive for `seconds`
    FAULT_HANG_LOOP, // until the watchdog comes, typically after `seconds`
    FAULT_STOP_TIMER,
    FAULT_BLIND_GUARD, // it says nothing any more
    FAULT_SHIFT_TICKS  // the same as host_shift_ticks
};

struct fault_order {
    enum fault_deed deed;
    unsigned bit; // of the object
    double seconds;
    double share; // of a pass of the loop, after which a reset comes, or of a
                  // tick, after which a bit of a place flips
    double ticks;
    bool random_ram;
};

// The faults with these numbers will be tried on an object of so many bits;
// each number is a fault by itself, kinds by turns or only one of them
// (FAULT_KINDS: all that pass).
void faults_plan(const char *name, unsigned object_bits, long first, long count,
                 int kind);

// From here on an alarm cuts the drive's supply. Else nobody hears one of a
// fault that stays. The faults are the same.
void faults_cut_at_alarm(void);

// False: there is no such kind.
bool faults_kind(const char *name, int *kind);

void faults_heading(void);

// To be called whenever time has passed, at least four times a tick: `drive` is
// what the pins command, `asked` what the application wanted and `alarms` what
// the guard says. Returns what is to be done to the chip, and not at all when
// the last fault has been watched.
struct fault_order faults_watch(int drive, int asked, unsigned alarms);

// To be called after a reset that was not ordered.
void faults_was_reset(void);

// A random number of 32 bits.
uint32_t faults_random(void);

#endif
