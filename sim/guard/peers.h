// SPDX-License-Identifier: MIT
// What fixpid_guard is compared with: how the firmware of 3D printers watches a
// heater, with the limits of a bed or of a hot end as they are delivered.
//
// Marlin: once it was reached, the temperature must not be below the target by
// more than a hysteresis for a period; before, it must rise by 2 degrees in
// each period. Klipper, verify_heater: the sum of the degrees below the target
// less 5 must stay below 120, but for a heat-up of 2 degrees in each period.
// Both see a sensor that reads an end of its range at once.
#ifndef PEERS_H
#define PEERS_H
#include <stdbool.h>

#define PEER_MARLIN 1u
#define PEER_KLIPPER 2u

struct peers {
    double step_s;
    double period_s, hysteresis, watch_s; // Marlin's
    double gain_s;                        // Klipper's

    double target;
    bool reached, watches, approaches;
    double below_s, left_s, goal;
    double error, rise_left_s, rise_goal;
    double since_s; // Klipper looks once a second
};

void peers_start(struct peers *self, bool hot_end, double step_s);

// One step, in degrees; which of them switch off now. Then that one begins
// anew.
unsigned peers_step(struct peers *self, double target, double temperature);

#endif
