// SPDX-License-Identifier: MIT
// What one world supplies to world.c, which owns time, options and noise.
#ifndef SCENE_H
#define SCENE_H
#include <stddef.h>
#include <stdint.h>

#include "world.h"

// Deviation 8.11: each world has its own number of them.
extern struct world_option scene_options[];
extern const size_t scene_option_count;
// Deviation 8.11: each world has its own number of them.
extern const char *const scene_trace_names[];
extern const size_t scene_trace_count;

// The plant at rest, from the options.
void scene_start(void);

// What happens at `time_s`; called each millisecond, before the plant moves on.
void scene_update(double time_s);

// Moves the plant at a constant drive, -1..1.
void scene_advance(double drive, double seconds);

// A sensor's voltage without noise, as a fraction of the reference, and the
// standard deviation of the noise on it.
double scene_voltage(uint8_t channel, double *noise);

void scene_trace(double *values);

#endif
