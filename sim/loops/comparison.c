// SPDX-License-Identifier: MIT
// Five plants: how well the loop does, beside the same law in double precision.
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#include "fixpid_pid.h"
#include "loops.h"

// fixpid_pid, or the law, as one thing in a loop.
struct loop {
    bool fixed; // fixpid_pid; else the law
    struct fixpid_pid pid;
    struct pid_double exact;
    struct motion motion;
    double output; // counts, as last given to the plant
};

// The configuration of fixpid_pid that comes closest to real gains.
static struct fixpid_pid_config loop_config(
    const struct pid_double_gains *gains, double setpoint_weight,
    double output_min, double output_max)
{
    const double kd = gains->kd / (double)(1 << gains->filter);
    return (struct fixpid_pid_config){
        .gains = {.ki_q24 = (uint32_t)lround(gains->ki * 16777216.0),
                  .kp_q8 = (uint16_t)lround(gains->kp * 256.0),
                  .kd_q8 = (uint16_t)lround(kd * 256.0),
                  .derivative_filter = (uint8_t)gains->filter},
        .output_min = (int16_t)output_min,
        .output_max = (int16_t)output_max,
        .integral_min = -32767,
        .integral_max = 32767,
        .setpoint_weight_q8 = (uint16_t)lround(setpoint_weight * 256.0),
    };
}

// Both controllers with a trial's gains, its plant at rest. The actuator takes
// whole counts, of either of them.
static void loop_start(struct loop *self, const struct trial *trial, bool fixed)
{
    const struct fixpid_pid_config config =
        loop_config(&trial->gains, trial->setpoint_weight, trial->output_min,
                    trial->output_max);

    self->fixed = fixed;
    if (!fixpid_pid_init(&self->pid, &config)) {
        (void)fprintf(stderr, "%s: refused\n", trial->plant.name);
        exit(EXIT_FAILURE);
    }
    pid_double_init(&self->exact, &trial->gains, trial->setpoint_weight,
                    trial->output_min, trial->output_max);
    motion_start(&self->motion, &trial->plant);
    self->output = 0.0;
}

// One step; self->motion.value is what it led to.
static void loop_step(struct loop *self, double setpoint)
{
    const int16_t reading = motion_read(&self->motion);
    if (self->fixed) {
        self->output = fixpid_pid_step(&self->pid, (int16_t)setpoint, reading);
    } else {
        self->output = floor(
            pid_double_step(&self->exact, setpoint, (double)reading) + 0.5);
    }
    motion_move(&self->motion, self->output);
}

struct quality {
    double overshoot; // counts, of the first setpoint
    int settled;      // steps, until it stays within 2 % of it
    double iae;       // sum of the magnitudes of the error
    double iae_after; // the same for the last one
};

static void judge(struct quality *quality, double setpoint, int step,
                  double error)
{
    quality->iae += fabs(error);
    quality->overshoot = fmax(quality->overshoot, -error);
    if (fabs(error) > 0.02 * setpoint) {
        quality->settled = step + 1;
    }
}

// Judges the first of its setpoints.
static struct quality run(const struct trial *trial, bool fixed)
{
    struct quality quality = {0.0, 0, 0.0, 0.0};
    struct loop loop;

    loop_start(&loop, trial, fixed);
    for (int step = 0; step < TRIAL_SETPOINTS * trial->steps; step++) {
        const int part = step / trial->steps;
        const double setpoint = trial->setpoints[part];
        loop_step(&loop, setpoint);
        const double error = setpoint - loop.motion.value;
        if (part == 0) {
            judge(&quality, setpoint, step, error);
        }
        if (part == TRIAL_SETPOINTS - 1) {
            quality.iae_after += fabs(error);
        }
    }
    return quality;
}

static void print_row(const struct trial *trial, bool fixed)
{
    const struct quality quality = run(trial, fixed);

    (void)printf("%s;%s;%.9g;%d;%.9g;%.9g\n", trial->plant.name,
                 fixed ? "fixpid_pid" : "double",
                 100.0 * quality.overshoot / trial->setpoints[0],
                 quality.settled, quality.iae, quality.iae_after);
}

void print_comparison(void)
{
    (void)printf("plant;controller;overshoot;settled;iae;iae_after\n");
    for (int i = 0; i < TRIALS; i++) {
        print_row(&trials[i], true);
        print_row(&trials[i], false);
    }
}

// How far fixpid_pid may be from the law: its output is whole, and so is its
// weighted setpoint; its filter drops less than 2^filter / 256 of a count.
static double allowed(const struct trial *trial)
{
    double rounding = 0.0;
    for (int i = 0; i < TRIAL_SETPOINTS; i++) {
        const double weighted = trial->setpoint_weight * trial->setpoints[i];
        rounding = fmax(rounding, fabs(weighted - floor(weighted + 0.5)));
    }
    const int filter = trial->gains.filter;
    return 0.5 + (trial->gains.kp * rounding) +
           ((filter > 0) ? (double)(1 << filter) / 256.0 : 0.0);
}

// The law looks on: it sees what fixpid_pid sees, and has no say.
static double largest_difference(const struct trial *trial)
{
    struct loop loop;
    struct pid_double exact;
    double largest = 0.0;

    loop_start(&loop, trial, true);
    exact = loop.exact;
    for (int step = 0; step < TRIAL_SETPOINTS * trial->steps; step++) {
        const double setpoint = trial->setpoints[step / trial->steps];
        const int16_t reading = motion_read(&loop.motion);
        const double output =
            fixpid_pid_step(&loop.pid, (int16_t)setpoint, reading);
        const double wanted =
            pid_double_step(&exact, setpoint, (double)reading);
        largest = fmax(largest, fabs(output - wanted));
        motion_move(&loop.motion, output);
    }
    return largest;
}

// The gains of fixpid_pid as real numbers, so that both have the same ones.
static struct trial with_kept_gains(const struct trial *trial)
{
    const struct fixpid_pid_config config =
        loop_config(&trial->gains, trial->setpoint_weight, trial->output_min,
                    trial->output_max);
    const double coarse = (config.gains.ki_q24 > 32767u) ? 256.0 : 1.0;
    struct trial same = *trial;

    same.gains.ki =
        floor(config.gains.ki_q24 / coarse + 0.5) * coarse / 16777216.0;
    same.gains.kp = config.gains.kp_q8 / 256.0;
    same.gains.kd =
        config.gains.kd_q8 / 256.0 * (double)(1 << trial->gains.filter);
    same.setpoint_weight = config.setpoint_weight_q8 / 256.0;
    return same;
}

void print_agreement(void)
{
    (void)printf("plant;difference;allowed\n");
    for (int i = 0; i < TRIALS; i++) {
        const struct trial same = with_kept_gains(&trials[i]);
        (void)printf("%s;%.9g;%.9g\n", same.plant.name,
                     largest_difference(&same), allowed(&same));
    }
}
