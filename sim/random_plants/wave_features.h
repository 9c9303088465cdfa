// SPDX-License-Identifier: MIT
// What the refit of the delay's constants fits: the features of an experiment
// from which fixpid_autotune computes the delay, in floating point, and the
// delay that would have been right.
#ifndef WAVE_FEATURES_H
#define WAVE_FEATURES_H
#include "experiment.h"
#include "judge.h"

struct features {
    bool refused;     // no gains: the rules do not serve it
    bool lag;         // else it integrates
    double middle;    // M: what the delay is a multiple of, steps
    double ratio;     // r, of the two holding outputs
    double roundness; // of the swing
    double skew;      // chi
    double quarrel;   // q: how far two slopes are apart
    double noise;     // hysteresis that the noise asks for over the swing
    double wanted;    // delay / M with which PI has exactly the wanted Ms
};

// Of an experiment that is DONE.
struct features features_of(const struct experiment *experiment,
                            const struct judge *judge, double wanted_ms);

#endif
