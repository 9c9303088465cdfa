// SPDX-License-Identifier: MIT
// What a person has set, for all files of the tuner: tuner_params of tuner.h.
#ifndef TUNER_PARAMS_H
#define TUNER_PARAMS_H
#include "tuner.h"

// `which` is of enum tuner_param.
double param(int which);

// The converter's largest count, and units for one.
double sensor_top(void);
double unit_per_count(void);

// Of either sign.
double highest_output(void);

#endif
