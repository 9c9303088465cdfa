// SPDX-License-Identifier: MIT
// A subject that moves: its actuator, its load and its sensor.
#ifndef BENCH_H
#define BENCH_H
#include "families.h"

struct bench {
    const struct subject *subject;
    struct sampled plant;
    struct sampled cooling; // the plant where it falls
    struct motion motion;
    struct machine machine; // the subject's
    struct chance chance;
    double offset; // counts, where an integrator starts
    double driven; // what backlash leaves of the output
    long steps;
};

void bench_start(struct bench *self, const struct subject *subject);

// What the sensor reads: with noise, in whole counts of its range.
int bench_read(struct bench *self);

// The same as an exact sensor reads it.
double bench_value(const struct bench *self);

// One step with this output.
void bench_drive(struct bench *self, double output);

#endif
