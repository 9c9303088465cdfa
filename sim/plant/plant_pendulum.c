// SPDX-License-Identifier: MIT
#include "plant_pendulum.h"

#include <math.h>

#include "plant.h"

#define PI 3.14159265358979323846
#define FLOOR_RAD (PI / 2.0)
#define BESSEL_FREQUENCY 1.2736

double pendulum_filter_rad_s(const struct pendulum *self)
{
    return BESSEL_FREQUENCY * 2.0 * PI * self->filter_corner_hz;
}

static void pendulum_rates(const void *plant, const double *state,
                           double *rates)
{
    // Deviation 11.5: the integrator hands the plant back as it was given.
    const struct pendulum *const self = (const struct pendulum *)plant;
    const double angle = state[PENDULUM_ANGLE];
    const double no_load_speed =
        self->full_speed_m_s * self->supply * self->drive;
    const double acceleration =
        (no_load_speed - state[PENDULUM_SPEED]) / self->motor_time_constant_s;
    const double filter = pendulum_filter_rad_s(self);

    rates[PENDULUM_ANGLE] = state[PENDULUM_RATE];
    rates[PENDULUM_RATE] =
        (((PENDULUM_GRAVITY_M_S2 * sin(angle)) - (acceleration * cos(angle))) /
         self->rod_m) +
        self->shove_rad_s2;
    rates[PENDULUM_SPEED] = acceleration;
    rates[PENDULUM_POSITION] = state[PENDULUM_SPEED];
    rates[PENDULUM_SENSED] = state[PENDULUM_SENSED_RATE];
    rates[PENDULUM_SENSED_RATE] =
        (filter * filter * (angle - state[PENDULUM_SENSED])) -
        ((filter / PENDULUM_FILTER_QUALITY) * state[PENDULUM_SENSED_RATE]);
}

void pendulum_init(struct pendulum *self, double angle_rad)
{
    *self = (struct pendulum){
        .rod_m = 0.5,
        .full_speed_m_s = 6.0,
        .motor_time_constant_s = 0.15,
        .filter_corner_hz = 60.0,
        .longest_step_s = 0.25e-3,
        .supply = 1.0,
    };
    self->state[PENDULUM_ANGLE] = angle_rad;
    self->state[PENDULUM_SENSED] = angle_rad;
}

void pendulum_advance(struct pendulum *self, double drive, double seconds)
{
    self->drive = plant_limit(drive, -1.0, 1.0);
    plant_integrate(pendulum_rates, self, self->state, PENDULUM_STATES, seconds,
                    self->longest_step_s);
    if (fabs(self->state[PENDULUM_ANGLE]) > FLOOR_RAD) {
        self->state[PENDULUM_ANGLE] =
            plant_limit(self->state[PENDULUM_ANGLE], -FLOOR_RAD, FLOOR_RAD);
        self->state[PENDULUM_RATE] = 0.0;
    }
}
