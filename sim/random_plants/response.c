// SPDX-License-Identifier: MIT
#include "response.h"

#define TURN 6.283185307179586
#define ALIASES 4

static double complex continuous(const struct plant_lags *plant,
                                 double complex s)
{
    const double dead = lags_dead_steps(plant);
    double complex response = plant->gain * cexp(-s * dead);

    for (int i = 0; i < plant->lags; i++) {
        response /= 1.0 + (s * plant->lag_steps[i]);
    }
    return plant->integrating ? response / s : response;
}

double complex response_of(const struct plant_lags *plant, double radians)
{
    const double complex held = 1.0 - cexp(-I * radians);
    double complex response = 0.0;

    for (int alias = -ALIASES; alias <= ALIASES; alias++) {
        const double complex s = I * (radians + (TURN * alias));
        response += continuous(plant, s) * held / s;
    }
    return response;
}
