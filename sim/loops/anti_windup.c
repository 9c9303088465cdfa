// SPDX-License-Identifier: MIT
// The loop of README.md and docs/cost.md: a step to 700, then a setpoint that
// is out of reach, then 700 again. With fixpid_pid, and with its law without an
// anti-windup.
//
//   anti_windup          the run as CSV
//   anti_windup figures  overshoot in counts, steps until it is back
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define WANTED 700
#define OUT_OF_REACH 1100
#define LIMITED 500 // from this step on
#define BACK 2000   // to this one
#define STEPS 2700
#define FULL 255
#define NEAR (0.02 * WANTED) // a loop has settled within it

static const struct plant_counts lag = {
    .gain = 4.0, .lag_steps = 50.0, .delay_steps = 3, .sensor_max = 1023.0};

static int setpoint(int step)
{
    return (step >= LIMITED && step < BACK) ? OUT_OF_REACH : WANTED;
}

struct law {
    double integral;
    int last;
};

static double without(struct law *self, int wanted, int measured)
{
    const int change = measured - self->last;

    self->last = measured;
    self->integral += 0.05 * (wanted - measured);
    return fmin(fmax(floor(2.0 * (wanted - measured) + self->integral -
                           4.0 * change + 0.5),
                     0.0),
                FULL);
}

static void run(double value[2][STEPS], double output[2][STEPS])
{
    const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(2, 0.05, 4, 1, 0),
        .output_min = 0,
        .output_max = FULL};
    struct fixpid_pid pid;
    struct law law = {0.0, 0};
    struct motion motion[2];

    (void)fixpid_pid_init(&pid, &config);
    motion_start(&motion[0], &lag);
    motion_start(&motion[1], &lag);
    for (int k = 0; k < STEPS; k++) {
        output[0][k] = fixpid_pid_step(&pid, (int16_t)setpoint(k),
                                       motion_read(&motion[0]));
        output[1][k] = without(&law, setpoint(k), motion_read(&motion[1]));
        for (int i = 0; i < 2; i++) {
            motion_move(&motion[i], output[i][k]);
            value[i][k] = motion[i].value;
        }
    }
}

static void print_figures(const char *name, const double *value)
{
    double overshoot = 0.0;
    int back = 0;

    for (int k = 0; k < LIMITED; k++) {
        overshoot = fmax(overshoot, value[k] - WANTED);
    }
    for (int k = BACK; k < STEPS; k++) {
        back = (fabs(value[k] - WANTED) > NEAR) ? k + 1 - BACK : back;
    }
    (void)printf("%s;%.1f;%d\n", name, overshoot, back);
}

int main(int count, char **arguments)
{
    static double value[2][STEPS];
    static double output[2][STEPS];

    run(value, output);
    if (count == 2 && strcmp(arguments[1], "figures") == 0) {
        (void)printf("controller;overshoot;back\n");
        print_figures("with", value[0]);
        print_figures("without", value[1]);
        return 0;
    }
    (void)printf("time_s,setpoint,with,output,without,output_without\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%d,%d,%.6g,%g,%.6g,%g\n", k, setpoint(k), value[0][k],
                     output[0][k], value[1][k], output[1][k]);
    }
    return 0;
}
