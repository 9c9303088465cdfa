// SPDX-License-Identifier: MIT
#include "plant.h"

#include <assert.h>
#include <math.h>

static void along(double *result, const double *state, const double *slope,
                  size_t count, double seconds)
{
    for (size_t i = 0; i < count; i++) {
        result[i] = state[i] + (seconds * slope[i]);
    }
}

static void runge_kutta_step(plant_rates *rates, const void *plant,
                             double *state, size_t count, double step_s)
{
    double k1[PLANT_STATES_MAX];
    double k2[PLANT_STATES_MAX];
    double k3[PLANT_STATES_MAX];
    double k4[PLANT_STATES_MAX];
    double there[PLANT_STATES_MAX];

    rates(plant, state, k1);
    along(there, state, k1, count, step_s / 2.0);
    rates(plant, there, k2);
    along(there, state, k2, count, step_s / 2.0);
    rates(plant, there, k3);
    along(there, state, k3, count, step_s);
    rates(plant, there, k4);
    for (size_t i = 0; i < count; i++) {
        state[i] += (step_s / 6.0) * (k1[i] + (2.0 * (k2[i] + k3[i])) + k4[i]);
    }
}

void plant_integrate(plant_rates *rates, const void *plant, double *state,
                     size_t count, double seconds, double longest_step_s)
{
    assert(count <= PLANT_STATES_MAX);
    assert(longest_step_s > 0.0);
    // The small allowance keeps a rounding error from costing a whole step.
    const double steps = ceil((seconds / longest_step_s) - 1e-9);
    const size_t whole_steps = (steps > 0.0) ? (size_t)steps : 0u;
    for (size_t done = 0; done < whole_steps; done++) {
        runge_kutta_step(rates, plant, state, count, seconds / steps);
    }
}

double plant_limit(double value, double low, double high)
{
    return fmin(fmax(value, low), high);
}
