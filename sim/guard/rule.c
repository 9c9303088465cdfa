// SPDX-License-Identifier: MIT
#include "rule.h"

#include <math.h>

void rule_for(struct fixpid_guard_config *config, const struct model *model,
              double share)
{
    const double span = (double)config->output_max - config->output_min;
    const double band = ceil(fmax(8.0 * model->noise + 4.0, 2.0 * model->gain));
    const double patience =
        share * (2.0 * model->dead + 20.0 * band / (model->slope * span));

    config->band = (uint16_t)band;
    config->patience = (uint16_t)fmin(fmax(ceil(patience), 4.0), 32767.0);
    config->noisy = model->noise >= 1.0 && patience >= 16.0;
}
