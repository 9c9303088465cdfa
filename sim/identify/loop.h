// SPDX-License-Identifier: MIT
// A sampled loop near its setpoint: a linear plant behind a hold and its dead
// time, and a controller with the integers that it has. Its margins, and
// whether it is stable.
//
// Doubles only. It uses no heap, and of the system sqrt, exp, log, sin, cos,
// atan2, fabs and floor.
#ifndef LOOP_H
#define LOOP_H
#include <stdbool.h>

#define LOOP_STATES 5
#define LOOP_POINTS 480
#define LOOP_OFF 0.2 // the part by which off_ms has the plant's gain wrong

struct identify_plant;

// x' = a x + b u(t - dead) and y = c x, with u in counts of the output and y in
// counts of the measurement.
struct loop_plant {
    int states; // 1..LOOP_STATES
    double a[LOOP_STATES][LOOP_STATES];
    double b[LOOP_STATES];
    double c[LOOP_STATES];
    double dead;  // seconds
    double scale; // the seconds that matter to a controller: dead time and lags
};

enum loop_derivative {
    LOOP_FILTERED, // of each step: fixpid_pid
    LOOP_PERIODIC, // of each `period` steps: fixpid_an937
    LOOP_THREE     // over three steps: fixpid_an964
};

// Counts of output for a count of measurement; all gains are negative where the
// controller is reverse acting.
struct loop_controller {
    double kp;
    double ki;      // each step
    double kd;      // for a change of 1 from one sample to the next
    int derivative; // enum loop_derivative
    double keep;    // what a filter keeps of its value each step; 0: no filter
    int period;     // steps, 1 or more
};

// A margin is -1 where there is none: no gain and no dead time makes such a
// loop swing. Angles are in radians per step.
struct loop_margins {
    bool stable;
    double ms; // the largest |1 / (1 + loop)|; says nothing of an unstable one
    double phase_degrees;
    double delay_s;    // further dead time
    double gain;       // the factor, 1 or more, at which the loop swings
    double lower_gain; // the same below 1
    double crossover;  // where phase_degrees is
    double turnover;   // where `gain` is
    double off_ms;     // the largest with a gain that is up to LOOP_OFF off
    bool off_stable;
    int dead_steps; // whole steps of dead time, which the curve has

    // The loop at some angles up to pi.
    double angles[LOOP_POINTS];
    double re[LOOP_POINTS];
    double im[LOOP_POINTS];
};

// a[2] y'' + a[1] y' + a[0] y = gain u, of a plant of zeros. With a[2] = 0 it
// is of the first order.
void loop_plant_second_order(struct loop_plant *to, const double a[3],
                             double gain);

// The plant of a recording between a converter and an actuator: a count is so
// many units of the measurement, and so many of the recording's drive.
void loop_plant_of(struct loop_plant *to, const struct identify_plant *from,
                   double unit_per_count, double drive_per_count);

void loop_margins(const struct loop_plant *plant,
                  const struct loop_controller *controller, double step_s,
                  struct loop_margins *to);

#endif
