// SPDX-License-Identifier: MIT
#include "params.h"

static double params[TUNER_PARAMS];

double *tuner_params(void)
{
    return params;
}

double param(int which)
{
    return params[which];
}
