// SPDX-License-Identifier: MIT
// Five plants: how well the loop does, beside the same law in double precision.
#include <math.h>
#include <stdio.h>

#include "loops.h"

struct quality {
    double overshoot;    // counts, of the first setpoint
    int settled;         // steps, until it stays within 2 % of it
    double steady_error; // mean over the last fifth of it
    double iae;          // sum of the magnitudes of the error
    double iae_after;    // the same for the last one
};

static void judge_first(struct quality *quality, const struct plant *plant,
                        int step, double error)
{
    const double setpoint = plant->setpoints[0];
    const int tail = plant->steps / 5;

    quality->iae += fabs(error);
    quality->overshoot = fmax(quality->overshoot, -error);
    if (fabs(error) > 0.02 * setpoint) {
        quality->settled = step + 1;
    }
    if (step >= plant->steps - tail) {
        quality->steady_error += error / (double)tail;
    }
}

static struct quality run(const struct plant *plant, bool fixed,
                          enum law_without without)
{
    struct quality quality = {0.0, 0, 0.0, 0.0, 0.0};
    struct loop loop;

    loop_start(&loop, plant, fixed, without);
    for (int step = 0; step < PLANT_SETPOINTS * plant->steps; step++) {
        const int part = step / plant->steps;
        const double setpoint = plant->setpoints[part];
        loop_step(&loop, setpoint);
        const double error = setpoint - loop.motion.value;
        if (part == 0) {
            judge_first(&quality, plant, step, error);
        }
        if (part == PLANT_SETPOINTS - 1) {
            quality.iae_after += fabs(error);
        }
    }
    return quality;
}

static void print_row(const struct plant *plant, const char *controller,
                      const struct quality *quality)
{
    (void)printf("%s;%s;%.9g;%d;%.9g;%.9g;%.9g\n", plant->name, controller,
                 100.0 * quality->overshoot / plant->setpoints[0],
                 quality->settled, quality->steady_error, quality->iae,
                 quality->iae_after);
}

void print_five(void)
{
    static const char *const names[] = {
        "law",
        "no anti-windup",
        "sign-blind",
        "integral clamped",
    };
    static const enum law_without withouts[] = {
        LAW_WHOLE,
        LAW_NO_ANTI_WINDUP,
        LAW_SIGN_BLIND,
        LAW_INTEGRAL_CLAMPED,
    };

    (void)printf("plant;controller;overshoot;settled;steady;iae;iae_after\n");
    for (int i = 0; i < PLANTS; i++) {
        const struct quality fixed = run(&plants[i], true, LAW_WHOLE);
        print_row(&plants[i], "fixpid_pid", &fixed);
        for (size_t j = 0; j < sizeof(withouts) / sizeof(withouts[0]); j++) {
            const struct quality law = run(&plants[i], false, withouts[j]);
            print_row(&plants[i], names[j], &law);
        }
    }
}

// How far fixpid_pid may be from the law: its output is whole, and so is its
// weighted setpoint; its filter drops less than 2^filter / 256 of a count.
static double allowed(const struct plant *plant)
{
    double rounding = 0.0;
    for (int i = 0; i < PLANT_SETPOINTS; i++) {
        const double weighted = plant->setpoint_weight * plant->setpoints[i];
        rounding = fmax(rounding, fabs(weighted - floor(weighted + 0.5)));
    }
    const int filter = plant->gains.filter;
    return 0.5 + (plant->gains.kp * rounding) +
           ((filter > 0) ? (double)(1 << filter) / 256.0 : 0.0);
}

// The law looks on: it sees what fixpid_pid sees, and has no say.
static double largest_difference(const struct plant *plant)
{
    struct loop loop;
    struct law law;
    double largest = 0.0;

    loop_start(&loop, plant, true, LAW_WHOLE);
    law = loop.law;
    for (int step = 0; step < PLANT_SETPOINTS * plant->steps; step++) {
        const double setpoint = plant->setpoints[step / plant->steps];
        const int16_t reading = motion_read(&loop.motion);
        const double output =
            fixpid_pid_step(&loop.pid, (int16_t)setpoint, reading);
        const double wanted = law_step(&law, setpoint, (double)reading);
        largest = fmax(largest, fabs(output - wanted));
        motion_move(&loop.motion, output);
    }
    return largest;
}

// The gains of fixpid_pid as real numbers, so that both have the same ones.
static struct plant with_kept_gains(const struct plant *plant)
{
    const struct fixpid_pid_config config =
        loop_config(&plant->gains, plant->setpoint_weight, plant->output_min,
                    plant->output_max);
    const double coarse = (config.gains.ki_q24 > 32767u) ? 256.0 : 1.0;
    struct plant same = *plant;

    same.gains.ki =
        floor(config.gains.ki_q24 / coarse + 0.5) * coarse / 16777216.0;
    same.gains.kp = config.gains.kp_q8 / 256.0;
    same.gains.kd =
        config.gains.kd_q8 / 256.0 * (double)(1 << plant->gains.filter);
    same.setpoint_weight = config.setpoint_weight_q8 / 256.0;
    return same;
}

void print_agreement(void)
{
    (void)printf("plant;difference;allowed\n");
    for (int i = 0; i < PLANTS; i++) {
        const struct plant same = with_kept_gains(&plants[i]);
        (void)printf("%s;%.9g;%.9g\n", same.name, largest_difference(&same),
                     allowed(&same));
    }
}
