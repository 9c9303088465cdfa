// SPDX-License-Identifier: MIT
#include "rule.h"

#include <math.h>

void rule_for(struct fixpid_guard_config *config, const struct model *model)
{
    const struct fixpid_guard_model found = {
        .slope_q24 = (uint32_t)lrint(model->slope * 16777216.0),
        .dead_q4 = (uint32_t)lrint(model->dead * 16.0),
        .noise_q4 = (uint16_t)lrint(model->noise * 16.0),
        .gain_q8 = (uint32_t)lrint(model->gain * 256.0)};

    (void)fixpid_guard_from_model(config, &found);
}
