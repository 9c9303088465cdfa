// SPDX-License-Identifier: MIT
#include "plants.h"

#include <math.h>

const struct plant plants[PLANTS] = {
    {
        .name = "lag 50, dead time 3",
        .kind = PLANT_ONE_LAG,
        .delay_steps = 3,
        .output_max = 255.0,
        .sensor_max = 1023.0,
        .gains = {2.0, 0.05, 0.0, 0},
        .setpoint_weight = 1.0,
        .setpoints = {700.0, 1100.0, 700.0},
        .steps = 500,
        .relay_high = 255,
        .tune_at = 700.0,
        .timeout_steps = 1000,
    },
    {
        .name = "lags 20 and 10",
        .kind = PLANT_TWO_LAGS,
        .delay_steps = 1,
        .output_max = 255.0,
        .sensor_max = 1023.0,
        .gains = {1.5, 0.04, 6.0, 2},
        .setpoint_weight = 1.0,
        .setpoints = {600.0, 1100.0, 500.0},
        .steps = 500,
        .relay_high = 255,
        .tune_at = 600.0,
        .timeout_steps = 1000,
    },
    {
        .name = "integrator, dead time 4",
        .kind = PLANT_INTEGRATOR,
        .delay_steps = 4,
        .output_min = -255.0,
        .output_max = 255.0,
        .sensor_max = 1023.0,
        .gains = {0.9, 0.006, 4.0, 1},
        .setpoint_weight = 0.6,
        .setpoints = {400.0, 900.0, 300.0},
        .steps = 500,
        .relay_low = -60,
        .relay_high = 60,
        .tune_at = 400.0,
        .timeout_steps = 1000,
    },
    {
        .name = "motor, lag 25, noise 2",
        .kind = PLANT_MOTOR,
        .delay_steps = 1,
        .noise_counts = 2,
        .output_min = -255.0,
        .output_max = 255.0,
        .sensor_max = 32767.0,
        .gains = {0.5, 0.03, 0.4, 2},
        .setpoint_weight = 1.0,
        .setpoints = {1500.0, 2500.0, 1000.0},
        .steps = 500,
        .relay_high = 200,
        .tune_at = 800.0,
        .timeout_steps = 1000,
    },
    {
        .name = "oven, lag 2000, dead time 40",
        .kind = PLANT_OVEN,
        .delay_steps = 40,
        .noise_counts = 1,
        .output_max = 255.0,
        .sensor_max = 1023.0,
        .gains = {6.0, 0.004, 0.0, 0},
        .setpoint_weight = 0.7,
        .setpoints = {600.0, 1020.0, 500.0},
        .steps = 9000,
        .relay_high = 255,
        .tune_at = 600.0,
        .timeout_steps = 6000,
    },
};

void motion_start(struct motion *self, const struct plant *plant)
{
    *self = (struct motion){.plant = plant, .noise = 1};
}

static int noise(struct motion *self)
{
    const uint32_t range = 2u * (uint32_t)self->plant->noise_counts + 1u;

    self->noise = self->noise * UINT32_C(1664525) + UINT32_C(1013904223);
    return (int)((self->noise >> 16) % range) - self->plant->noise_counts;
}

int16_t motion_read(struct motion *self)
{
    const double most = self->plant->sensor_max;
    const double reading = floor(self->value + 0.5) + noise(self);
    return (int16_t)fmin(fmax(reading, -most), most);
}

void motion_move(struct motion *self, double output)
{
    const double arrives = self->line[self->oldest];

    self->line[self->oldest] = output;
    self->oldest = (self->oldest + 1) % self->plant->delay_steps;
    switch (self->plant->kind) {
    case PLANT_ONE_LAG:
        self->value += (4.0 * arrives - self->value) / 50.0;
        break;
    case PLANT_TWO_LAGS:
        self->inner += (4.0 * arrives - self->inner) / 20.0;
        self->value += (self->inner - self->value) / 10.0;
        break;
    case PLANT_INTEGRATOR:
        self->value += 0.03 * arrives;
        break;
    case PLANT_MOTOR:
        self->value += (8.0 * arrives - self->value) / 25.0;
        break;
    default:
        self->value += (4.5 * arrives - self->value) / 2000.0;
        break;
    }
}
