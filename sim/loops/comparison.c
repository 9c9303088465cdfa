// SPDX-License-Identifier: MIT
// Five plants: how well the loop does, beside the same law in double precision.
#include <math.h>
#include <stdio.h>

#include "loops.h"

struct quality {
    double overshoot;    // counts, of the setpoint that is judged
    int settled;         // steps, until it stays within 2 % of it
    double steady_error; // mean over the last fifth of it
    double iae;          // sum of the magnitudes of the error
    double iae_after;    // the same for the last one
};

static void judge(struct quality *quality, const struct trial *trial,
                  double setpoint, int step, double error)
{
    const int tail = trial->steps / 5;

    quality->iae += fabs(error);
    quality->overshoot = fmax(quality->overshoot, -error);
    if (fabs(error) > 0.02 * setpoint) {
        quality->settled = step + 1;
    }
    if (step >= trial->steps - tail) {
        quality->steady_error += error / (double)tail;
    }
}

// Judges the setpoint of that number, from 0.
static struct quality run(const struct trial *trial, bool fixed,
                          enum pid_double_without without, int judged)
{
    struct quality quality = {0.0, 0, 0.0, 0.0, 0.0};
    struct loop loop;

    loop_start(&loop, trial, fixed, without);
    for (int step = 0; step < TRIAL_SETPOINTS * trial->steps; step++) {
        const int part = step / trial->steps;
        const double setpoint = trial->setpoints[part];
        loop_step(&loop, setpoint);
        const double error = setpoint - loop.motion.value;
        if (part == judged) {
            judge(&quality, trial, setpoint, step % trial->steps, error);
        }
        if (part == TRIAL_SETPOINTS - 1) {
            quality.iae_after += fabs(error);
        }
    }
    return quality;
}

static void print_row(const struct trial *trial, const char *controller,
                      const struct quality *quality)
{
    (void)printf("%s;%s;%.9g;%d;%.9g;%.9g;%.9g\n", trial->plant.name,
                 controller, 100.0 * quality->overshoot / trial->setpoints[0],
                 quality->settled, quality->steady_error, quality->iae,
                 quality->iae_after);
}

// fixpid_pid, the law, and the law without a feature.
static const struct {
    const char *name;
    bool fixed;
    enum pid_double_without without;
} controllers[] = {
    {"fixpid_pid", true, PID_DOUBLE_WHOLE},
    {"double", false, PID_DOUBLE_WHOLE},
    {"no anti-windup", false, PID_DOUBLE_NO_ANTI_WINDUP},
    {"sign-blind", false, PID_DOUBLE_SIGN_BLIND},
    {"integral clamped", false, PID_DOUBLE_INTEGRAL_CLAMPED},
};
#define CONTROLLERS (sizeof(controllers) / sizeof(controllers[0]))

static void print_all(const struct trial *trial)
{
    for (size_t i = 0; i < CONTROLLERS; i++) {
        const struct quality quality =
            run(trial, controllers[i].fixed, controllers[i].without, 0);
        print_row(trial, controllers[i].name, &quality);
    }
}

static void print_head(void)
{
    (void)printf("plant;controller;overshoot;settled;steady;iae;iae_after\n");
}

void print_comparison(void)
{
    print_head();
    for (int i = 0; i < TRIALS; i++) {
        print_all(&trials[i]);
    }
}

// A reset time kp / ki of three lags and more, and one that is right.
void print_slow(void)
{
    static const struct {
        const char *name;
        double ki;
    } cases[] = {{"lag 3000, reset time 10000", 0.0001},
                 {"lag 3000, reset time 3000", 1.0 / 3000.0}};
    struct trial trial = trials[0];

    print_head();
    trial.plant.lag_steps = 3000.0;
    trial.gains.kp = 1.0;
    trial.steps = 40000;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        trial.plant.name = cases[i].name;
        trial.gains.ki = cases[i].ki;
        print_all(&trial);
    }
}

// After a setpoint out of reach: steps until the loop stays within 2 % of the
// next one, and the sum of the magnitudes of its error.
void print_recovery(void)
{
    static const double backs[] = {300.0, 700.0, 900.0, 1000.0};
    const int last = TRIAL_SETPOINTS - 1;
    struct trial trial = trials[0];

    (void)printf("controller;back;settled;iae\n");
    trial.steps = 1500;
    for (size_t i = 0; i < CONTROLLERS; i++) {
        for (size_t k = 0; k < sizeof(backs) / sizeof(backs[0]); k++) {
            trial.setpoints[last] = backs[k];
            const struct quality quality =
                run(&trial, controllers[i].fixed, controllers[i].without, last);
            (void)printf("%s;%.9g;%d;%.9g\n", controllers[i].name, backs[k],
                         quality.settled, quality.iae);
        }
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

    loop_start(&loop, trial, true, PID_DOUBLE_WHOLE);
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
