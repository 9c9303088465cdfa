// SPDX-License-Identifier: MIT
// A process as a textbook has it, to be given any shape:
//
//   a2 value'' + a1 value' + a0 value = gain drive(t - dead time)
//
// With a2 = 0 it is a lag, or with a0 = 0, too, an integrator; with a2 two
// lags, what oscillates, or an integrator with a lag. It moves in equal parts
// of a controller's step, and its dead time is a whole number of them.
#ifndef PLANT_PROCESS_H
#define PLANT_PROCESS_H

#define PROCESS_LINE 4096 // parts of dead time, at most

enum process_state { PROCESS_VALUE, PROCESS_RATE, PROCESS_STATES };

struct process {
    double a2; // s^2; 0: of the first order
    double a1; // s; above 0 where a2 is 0
    double a0;
    double gain;
    double dead_time_s;

    double part_s;
    int parts;      // of a step
    int dead_parts; // 0..PROCESS_LINE - 1

    double state[PROCESS_STATES];
    double drive; // as it reaches the process
    double line[PROCESS_LINE];
    int newest;
};

// At rest at 0, undriven, to be moved in steps of `step_s`: a part of one is at
// most a twentieth of `fastest_s`, a time constant, while there are no more
// than 64 of them. pre: the five coefficients are set.
void process_start(struct process *self, double step_s, double fastest_s);

// The dead time in whole parts, as it is simulated.
double process_dead_s(const struct process *self);

// One step at a constant drive.
void process_move(struct process *self, double drive);

#endif
