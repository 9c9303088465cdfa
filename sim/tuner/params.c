// SPDX-License-Identifier: MIT
#include "params.h"

#include <math.h>

static double params[TUNER_PARAMS];

double *tuner_params(void)
{
    return params;
}

double param(int which)
{
    return params[which];
}

double sensor_top(void)
{
    return (double)((1 << (int)param(PARAM_SENSOR_BITS)) - 1);
}

double unit_per_count(void)
{
    return param(PARAM_SENSOR_RANGE) / sensor_top();
}

double highest_output(void)
{
    return fmax(param(PARAM_OUTPUT_MAX), -param(PARAM_OUTPUT_MIN));
}
