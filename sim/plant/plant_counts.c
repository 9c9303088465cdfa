// SPDX-License-Identifier: MIT
#include "plant_counts.h"

#include <math.h>

void motion_start(struct motion *self, const struct plant_counts *plant)
{
    *self = (struct motion){.plant = plant, .noise = 1};
}

static int noise(struct motion *self)
{
    const uint32_t range = 2u * (uint32_t)self->plant->noise_counts + 1u;

    self->noise = self->noise * UINT32_C(1664525) + UINT32_C(1013904223);
    const uint32_t drawn = (self->noise >> 16) % range;
    return (int)drawn - self->plant->noise_counts;
}

int16_t motion_read(struct motion *self)
{
    const double most = self->plant->sensor_max;
    const double reading = floor(self->value + 0.5) + noise(self);
    return (int16_t)fmin(fmax(reading, -most), most);
}

void motion_move(struct motion *self, double output)
{
    const struct plant_counts *const plant = self->plant;
    const double driven = plant->gain * self->line[self->oldest];

    self->line[self->oldest] = output;
    self->oldest = (self->oldest + 1) % plant->delay_steps;
    if ((plant->lag_steps <= 0.0) && (plant->second_lag_steps <= 0.0)) {
        self->value += driven;
    } else if (plant->lag_steps <= 0.0) {
        self->inner += (driven - self->inner) / plant->second_lag_steps;
        self->value += self->inner;
    } else if (plant->second_lag_steps <= 0.0) {
        self->value += (driven - self->value) / plant->lag_steps;
    } else {
        self->inner += (driven - self->inner) / plant->lag_steps;
        self->value += (self->inner - self->value) / plant->second_lag_steps;
    }
}
