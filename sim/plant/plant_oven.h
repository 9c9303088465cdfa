// SPDX-License-Identifier: MIT
// A small heater: an element that warms a body, which loses heat to the air,
// and a sensor that sees the body late.
//
//   element_time_constant heat' = drive(t - dead_time) - heat
//   C body'                     = full_power heat - (body - ambient) / Rth
//
// heat is the fraction of full power that reaches the body. The body's time
// constant is Rth C, and full power warms it by Rth full_power above the air.
#ifndef PLANT_OVEN_H
#define PLANT_OVEN_H
#include <stddef.h>

#define OVEN_DELAY_LINE 4096u

enum oven_state {
    OVEN_HEAT, // 0..1
    OVEN_BODY, // degrees Celsius
    OVEN_STATES
};

struct oven {
    double full_power_w;
    double thermal_resistance_k_w; // Rth, body to air
    double heat_capacity_j_k;      // C
    double element_time_constant_s;
    double dead_time_s;
    double longest_step_s; // of the integrator

    double ambient_c;

    double state[OVEN_STATES];
    double drive; // 0..1, as it reaches the element

    // The dead time: a drive takes effect when its time has come.
    double now_s;
    double due_s[OVEN_DELAY_LINE];
    double due_drive[OVEN_DELAY_LINE];
    size_t oldest;
    size_t waiting;
};

// An oven of 6 s with an element of 1 s and 0.35 s of dead time, at ambient
// temperature. Full power is 400 degrees above it.
void oven_init(struct oven *self, double ambient_c);

// Advances by `seconds` at a constant drive, 0..1 (limited: it cannot cool).
// pre: the drive changes at most OVEN_DELAY_LINE times per dead time.
void oven_advance(struct oven *self, double drive, double seconds);

#endif
