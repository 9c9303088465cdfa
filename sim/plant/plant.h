// SPDX-License-Identifier: MIT
// The integrator that the three plants share: classical Runge-Kutta of fourth
// order in equal steps.
//
// A plant is a model in SI units and double arithmetic. It knows neither a port
// nor another plant, so it serves the host, a simulated chip and the tests.
// All is inline, as most of a simulated loop's time is a plant's: a compiler
// makes one loop of the integrator and the equations of a plant.
#ifndef PLANT_H
#define PLANT_H
#include <assert.h>
#include <math.h>
#include <stddef.h>

#define PLANT_STATES_MAX 6u

// Writes the time derivatives of `state`, in units per second. The plant's
// inputs are constant during a step.
typedef void plant_rates(const void *plant, const double *state, double *rates);

// `value` within low..high; low if it is not a number.
static inline double plant_limit(double value, double low, double high)
{
    return (value > low) ? ((value < high) ? value : high) : low;
}

static inline void plant_along(double *result, const double *state,
                               const double *slope, size_t count,
                               double seconds)
{
    for (size_t i = 0; i < count; i++) {
        result[i] = state[i] + (seconds * slope[i]);
    }
}

static inline void plant_runge_kutta_step(plant_rates *rates, const void *plant,
                                          double *state, size_t count,
                                          double step_s)
{
    double k1[PLANT_STATES_MAX];
    double k2[PLANT_STATES_MAX];
    double k3[PLANT_STATES_MAX];
    double k4[PLANT_STATES_MAX];
    double there[PLANT_STATES_MAX];

    rates(plant, state, k1);
    plant_along(there, state, k1, count, step_s / 2.0);
    rates(plant, there, k2);
    plant_along(there, state, k2, count, step_s / 2.0);
    rates(plant, there, k3);
    plant_along(there, state, k3, count, step_s);
    rates(plant, there, k4);
    for (size_t i = 0; i < count; i++) {
        state[i] += (step_s / 6.0) * (k1[i] + (2.0 * (k2[i] + k3[i])) + k4[i]);
    }
}

// Advances `state`, of `count` values, by `seconds` in equal steps, none longer
// than `longest_step_s`. pre: count <= PLANT_STATES_MAX, longest_step_s > 0.
static inline void plant_integrate(plant_rates *rates, const void *plant,
                                   double *state, size_t count, double seconds,
                                   double longest_step_s)
{
    assert(count <= PLANT_STATES_MAX);
    assert(longest_step_s > 0.0);
    // The small allowance keeps a rounding error from costing a whole step.
    const double steps = ceil((seconds / longest_step_s) - 1e-9);
    const size_t whole_steps = (steps > 0.0) ? (size_t)steps : 0u;
    for (size_t done = 0; done < whole_steps; done++) {
        plant_runge_kutta_step(rates, plant, state, count, seconds / steps);
    }
}

#endif
