// SPDX-License-Identifier: MIT
#include "plant_lags.h"

#include <math.h>

static int dead_parts(const struct plant_lags *plant)
{
    return (int)floor((plant->dead_steps * PLANT_LAGS_PARTS) + 0.5);
}

void lags_start(struct lags_motion *self, const struct plant_lags *plant,
                double output)
{
    *self =
        (struct lags_motion){.plant = plant, .dead_parts = dead_parts(plant)};
    for (int i = 0; i < plant->lags; i++) {
        const double parts = plant->lag_steps[i] * PLANT_LAGS_PARTS;
        self->share[i] = 1.0 - exp(-1.0 / parts);
        self->lag[i] = output;
    }
    for (int i = 0; i < self->dead_parts; i++) {
        self->line[i] = output;
    }
}

double lags_value(const struct lags_motion *self)
{
    const struct plant_lags *const plant = self->plant;

    if (plant->integrating) {
        return self->integral;
    }
    return plant->gain * self->lag[plant->lags - 1];
}

static double delayed(struct lags_motion *self, double output)
{
    double oldest = output;

    if (self->dead_parts > 0) {
        oldest = self->line[self->oldest];
        self->line[self->oldest] = output;
        self->oldest++;
        if (self->oldest == self->dead_parts) {
            self->oldest = 0;
        }
    }
    return oldest;
}

// What follows a lag sees the middle of its way.
static void move_part(struct lags_motion *self, double output)
{
    double driven = delayed(self, output);

    for (int i = 0; i < self->plant->lags; i++) {
        const double before = self->lag[i];
        self->lag[i] += (driven - before) * self->share[i];
        driven = 0.5 * (before + self->lag[i]);
    }
    self->integral += self->plant->gain * driven / (double)PLANT_LAGS_PARTS;
}

void lags_move(struct lags_motion *self, double output)
{
    for (int part = 0; part < PLANT_LAGS_PARTS; part++) {
        move_part(self, output);
    }
}

double lags_dead_steps(const struct plant_lags *plant)
{
    return (double)dead_parts(plant) / PLANT_LAGS_PARTS;
}

double lags_sum_steps(const struct plant_lags *plant)
{
    double sum = 0.0;

    for (int i = 0; i < plant->lags; i++) {
        sum += plant->lag_steps[i];
    }
    return sum;
}

double lags_scale_steps(const struct plant_lags *plant)
{
    const double once = plant->dead_steps + lags_sum_steps(plant);
    const double times = plant->integrating ? 2.0 : 1.0;

    return times * once;
}
