// SPDX-License-Identifier: MIT
#include "plant_oven.h"

#include <assert.h>
#include <math.h>

#include "plant.h"

static void oven_rates(const void *plant, const double *state, double *rates)
{
    // Deviation 11.5: the integrator hands the plant back as it was given.
    const struct oven *const self = (const struct oven *)plant;
    const double loss_w =
        (state[OVEN_BODY] - self->ambient_c) / self->thermal_resistance_k_w;

    rates[OVEN_HEAT] =
        (self->drive - state[OVEN_HEAT]) / self->element_time_constant_s;
    rates[OVEN_BODY] = ((self->full_power_w * state[OVEN_HEAT]) - loss_w) /
                       self->heat_capacity_j_k;
}

void oven_init(struct oven *self, double ambient_c)
{
    *self = (struct oven){
        .full_power_w = 160.0,
        .thermal_resistance_k_w = 2.5,
        .heat_capacity_j_k = 2.4,
        .element_time_constant_s = 1.0,
        .dead_time_s = 0.35,
        .longest_step_s = 1e-3,
        .ambient_c = ambient_c,
    };
    self->state[OVEN_BODY] = ambient_c;
}

static void send(struct oven *self, double drive)
{
    const size_t newest =
        (self->oldest + self->waiting + OVEN_DELAY_LINE - 1u) % OVEN_DELAY_LINE;
    const double last =
        (self->waiting > 0u) ? self->due_drive[newest] : self->drive;
    if (drive != last) {
        const size_t slot = (newest + 1u) % OVEN_DELAY_LINE;
        assert(self->waiting < OVEN_DELAY_LINE);
        self->due_s[slot] = self->now_s + self->dead_time_s;
        self->due_drive[slot] = drive;
        self->waiting++;
    }
}

static void receive(struct oven *self)
{
    while ((self->waiting > 0u) && (self->due_s[self->oldest] <= self->now_s)) {
        self->drive = self->due_drive[self->oldest];
        self->oldest = (self->oldest + 1u) % OVEN_DELAY_LINE;
        self->waiting--;
    }
}

void oven_advance(struct oven *self, double drive, double seconds)
{
    const double end_s = self->now_s + seconds;

    send(self, plant_limit(drive, 0.0, 1.0));
    // Deviation 14.1: simulated time decides, and it is not an integer.
    while (self->now_s < end_s) {
        receive(self);
        const double until_s = (self->waiting > 0u)
                                   ? fmin(end_s, self->due_s[self->oldest])
                                   : end_s;
        plant_integrate(oven_rates, self, self->state, OVEN_STATES,
                        until_s - self->now_s, self->longest_step_s);
        self->now_s = until_s;
    }
}
