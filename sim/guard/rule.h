// SPDX-License-Identifier: MIT
// The rule of fixpid_guard.h, of a plant that is known.
#ifndef RULE_H
#define RULE_H
#include "fixpid_guard.h"

// A plant as fixpid_autotune would know it, in counts and steps.
struct model {
    double gain; // 0: it integrates
    double dead;
    double slope;
    double noise;
};

// Band, patience and `noisy` of a configuration that has its output's range.
void rule_for(struct fixpid_guard_config *config, const struct model *model);

#endif
