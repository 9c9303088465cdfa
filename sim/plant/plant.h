// SPDX-License-Identifier: MIT
// The integrator that the three plants share: classical Runge-Kutta of fourth
// order in equal steps.
//
// A plant is a model in SI units and double arithmetic. It knows neither a port
// nor another plant, so it serves the host, a simulated chip and the tests.
#ifndef PLANT_H
#define PLANT_H
#include <stddef.h>

#define PLANT_STATES_MAX 6u

// Writes the time derivatives of `state`, in units per second. The plant's
// inputs are constant during a step.
typedef void plant_rates(const void *plant, const double *state, double *rates);

// Advances `state`, of `count` values, by `seconds` in equal steps, none longer
// than `longest_step_s`. pre: count <= PLANT_STATES_MAX, longest_step_s > 0.
void plant_integrate(plant_rates *rates, const void *plant, double *state,
                     size_t count, double seconds, double longest_step_s);

// `value` within low..high.
double plant_limit(double value, double low, double high);

#endif
