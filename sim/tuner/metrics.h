// SPDX-License-Identifier: MIT
// What a run is worth: tuner_metrics of tuner.h.
#ifndef TUNER_METRICS_H
#define TUNER_METRICS_H

// Of the series of a run of so many steps, one or more.
void metrics_of_run(int n);

#endif
