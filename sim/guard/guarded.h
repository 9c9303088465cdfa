// SPDX-License-Identifier: MIT
// A plant of random_plants/draw.h under fixpid_pid, with fixpid_guard beside
// it: what breaks for good.
#ifndef GUARDED_H
#define GUARDED_H
#include <stdbool.h>
#include <stdint.h>

#include "draw.h"
#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "plant_lags.h"

// What breaks for good. The first eight burn something or leave the loop
// without control, and a guard must see each of them; the others are those of
// which it sees a part, or none.
enum fault {
    FAULT_NONE,
    FAULT_OPEN,      // the sensor reads full scale
    FAULT_SHORT,     // it reads 0
    FAULT_FALLEN,    // it falls off: to the cold plant, by a quarter of the lag
    FAULT_STUCK_LOW, // it stays a tenth of the scale below the setpoint
    FAULT_STUCK_HIGH,  // it stays 3 % of the scale above the setpoint
    FAULT_DRIVE_ON,    // full drive, whatever the output
    FAULT_DRIVE_OFF,   // no drive
    FAULT_SIGN,        // the drive is full less the output
    FAULT_STUCK_2,     // the sensor stays 2 counts below the setpoint
    FAULT_STUCK_AT,    // it stays at the setpoint itself
    FAULT_STUCK_NOISY, // it stays 0.5 % of the scale below, and its noise stays
    FAULT_DRIFT, // it drifts to 30 % of the scale below, in 30 of guarded_scale
    FAULT_HALF,  // the drive is half of the output
    FAULTS
};

struct guarded {
    struct task task;
    struct lags_motion motion;
    struct fixpid_pid pid;
    struct fixpid_guard guard;
    struct fixpid_guard_config config;

    // The plant as fixpid_autotune would know it: counts and steps.
    double gain, lag, dead, slope;
    double span, top; // of the output and of the sensor

    double goal; // the setpoint
    long now;
    uint64_t chance;

    enum fault fault;
    double stuck, fallen, drifted;
    double limit; // the higher of value and setpoint when it broke
    double value; // what the sensor should read
    bool cut;     // no drive, as somebody has cut the supply
};

// The plant is cold, and the gains are those of one of three rules.
void guarded_start(struct guarded *self, const struct task *task,
                   unsigned number);

// T + L in steps, of an integrating plant 4 L.
double guarded_scale(const struct guarded *self);

// From 0 to below 1.
double guarded_chance(struct guarded *self);
double guarded_between(struct guarded *self, double low, double high);

// From now on.
void guarded_break(struct guarded *self, enum fault fault);

// One step. Returns the guard's flags.
uint8_t guarded_step(struct guarded *self);

#endif
