// SPDX-License-Identifier: MIT
// What a person is told of a fit, and of a loop with gains from it: what to do
// about a recording that is refused, and the range of Ms over the plants that
// the recording allows. Page and Python say the same, because both take it
// here.
#ifndef VERDICT_H
#define VERDICT_H
#include "identify.h"
#include "loop.h"

#define VERDICT_MOST_MS 2.2
#define VERDICT_UNSTABLE 1e9

// Ms of one controller with each plant. The tenth of the plants with the
// largest Ms is left out.
struct verdict {
    double low;  // the least Ms of nine of ten plants
    double high; // the largest; VERDICT_UNSTABLE: they are not all stable
    int above;   // plants with Ms above VERDICT_MOST_MS, of IDENTIFY_PLANTS
};

// Of SIMC's PI for a model, with a loop `calm` times as slow as the rule has
// it, in continuous time. Returns its Ms with the model itself.
double verdict_of_simc(const struct identify_plant *model, double calm,
                       const struct identify_plant plants[IDENTIFY_PLANTS],
                       struct verdict *to);

// Of the integers of a controller, in its sampled loop. The arguments between
// are those of loop_plant_of. VERDICT_MOST_MS < high: say so, with the
// sentence.
void verdict_of_loop(const struct identify_plant plants[IDENTIFY_PLANTS],
                     double unit_per_count, double drive_per_count,
                     const struct loop_controller *controller, double step_s,
                     struct verdict *to);

// What is wrong with a recording that is refused for this reason (of enum
// identify_reason), and what to do about it; "" for IDENTIFY_USABLE.
const char *verdict_sentence(int reason);

#endif
