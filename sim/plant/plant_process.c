// SPDX-License-Identifier: MIT
#include "plant_process.h"

#include <math.h>

#include "plant.h"

#define PARTS_MAX 64
#define PARTS_OF_FASTEST 20.0
#define DEAD_PARTS_MAX ((double)PROCESS_LINE - 1.0)

static void process_rates(const void *plant, const double *state, double *rates)
{
    // Deviation 11.5: the integrator hands the plant back as it was given.
    const struct process *const self = (const struct process *)plant;
    const double pushed =
        (self->gain * self->drive) - (self->a0 * state[PROCESS_VALUE]);

    if (self->a2 > 0.0) {
        rates[PROCESS_VALUE] = state[PROCESS_RATE];
        rates[PROCESS_RATE] =
            (pushed - (self->a1 * state[PROCESS_RATE])) / self->a2;
    } else {
        rates[PROCESS_VALUE] = pushed / self->a1;
        rates[PROCESS_RATE] = 0.0;
    }
}

void process_start(struct process *self, double step_s, double fastest_s)
{
    self->parts = 1;
    while ((self->parts < PARTS_MAX) &&
           ((step_s / (double)self->parts) > (fastest_s / PARTS_OF_FASTEST))) {
        self->parts *= 2;
    }
    self->part_s = step_s / (double)self->parts;
    const double dead = floor((self->dead_time_s / self->part_s) + 0.5);
    self->dead_parts = (int)plant_limit(dead, 0.0, DEAD_PARTS_MAX);
    self->newest = 0;
    self->drive = 0.0;
    self->state[PROCESS_VALUE] = 0.0;
    self->state[PROCESS_RATE] = 0.0;
    for (int i = 0; i < PROCESS_LINE; i++) {
        self->line[i] = 0.0;
    }
}

double process_dead_s(const struct process *self)
{
    return (double)self->dead_parts * self->part_s;
}

void process_move(struct process *self, double drive)
{
    for (int part = 0; part < self->parts; part++) {
        self->line[self->newest] = drive;
        const int due =
            (self->newest + PROCESS_LINE - self->dead_parts) % PROCESS_LINE;
        self->drive = self->line[due];
        self->newest = (self->newest + 1) % PROCESS_LINE;
        plant_integrate(process_rates, self, self->state, PROCESS_STATES,
                        self->part_s, self->part_s);
    }
}
