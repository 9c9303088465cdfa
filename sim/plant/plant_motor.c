// SPDX-License-Identifier: MIT
#include "plant_motor.h"

#include <math.h>

#include "plant.h"

#define STANDSTILL_RAD_S 0.5 // friction is at tanh(1) of its value here

static void motor_rates(const void *plant, const double *state, double *rates)
{
    // Deviation 11.5: the integrator hands the plant back as it was given.
    const struct motor *const self = (const struct motor *)plant;
    const double speed = state[MOTOR_SPEED];
    const double friction = self->friction_n_m * tanh(speed / STANDSTILL_RAD_S);
    const double torque = (self->constant_v_s * state[MOTOR_CURRENT]) -
                          (self->viscous_n_m_s * speed) - friction -
                          self->load_n_m;

    rates[MOTOR_CURRENT] = ((self->supply_v * self->drive) -
                            (self->resistance_ohm * state[MOTOR_CURRENT]) -
                            (self->constant_v_s * speed)) /
                           self->inductance_h;
    rates[MOTOR_SPEED] = torque / self->inertia_kg_m2;
}

void motor_init(struct motor *self)
{
    *self = (struct motor){
        .supply_v = 24.0,
        .resistance_ohm = 2.4,
        .inductance_h = 0.4e-3,
        .constant_v_s = 0.05,
        .inertia_kg_m2 = 2.6e-5,
        .viscous_n_m_s = 1e-5,
        .friction_n_m = 0.004,
        .longest_step_s = 20e-6,
    };
}

void motor_advance(struct motor *self, double drive, double seconds)
{
    self->drive = plant_limit(drive, -1.0, 1.0);
    plant_integrate(motor_rates, self, self->state, MOTOR_STATES, seconds,
                    self->longest_step_s);
}
