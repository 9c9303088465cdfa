// SPDX-License-Identifier: MIT
// What a sampled plant does to a sine.
#ifndef RESPONSE_H
#define RESPONSE_H
#include <complex.h>

#include "plant_lags.h"

// From the held output to the sampled value at so many radians per step,
// 0 < radians <= pi: with the four aliases on each side.
double complex response_of(const struct plant_lags *plant, double radians);

#endif
