// SPDX-License-Identifier: MIT
#include "evaluation.h"

#include <math.h>

#include "pid_double.h"

#define HALF_TURN 3.141592653589793
#define STEPS_MAX 60000
#define OUTPUT_MOST 32767.0

// The load is as large as keeps the error and the output below these, so that
// whole counts are fine enough to judge by.
#define ERROR_COUNTS 8000.0
#define LOAD_COUNTS 10000.0

// Skogestad's rules for PI with tau_c equal to the dead time: the largest lag
// is the lag, half of the next one is added to it and half to the dead time,
// and so are the others. plant_lags has the largest lag first.
static struct pid_double_gains simc(const struct plant_lags *plant)
{
    struct pid_double_gains gains = {0.0, 0.0, 0.0, 0};
    double dead = plant->dead_steps + 0.5; // of the held output
    double lag = plant->lag_steps[0];
    double reset;

    if (plant->integrating) {
        dead += lags_sum_steps(plant);
        gains.kp = 1.0 / (plant->gain * 2.0 * dead);
        reset = 8.0 * dead;
    } else {
        if (plant->lags > 1) {
            lag += plant->lag_steps[1] / 2.0;
            dead += plant->lag_steps[1] / 2.0;
        }
        for (int i = 2; i < plant->lags; i++) {
            dead += plant->lag_steps[i];
        }
        gains.kp = lag / (plant->gain * 2.0 * dead);
        reset = fmin(lag, 8.0 * dead);
    }
    gains.ki = gains.kp / reset;
    return gains;
}

// Error and output of this loop with a load of 1 say how large it may be.
static void run_best(struct evaluation *self)
{
    const struct pid_double_gains gains = simc(self->plant);
    struct lags_motion motion;
    struct pid_double exact;
    double peak = 0.0;
    double sum = 0.0;

    pid_double_init(&exact, PID_DOUBLE_WHOLE, &gains, 1.0, -OUTPUT_MOST,
                    OUTPUT_MOST);
    lags_start(&motion, self->plant, 0.0);
    for (int step = 0; step < self->steps; step++) {
        const double value = lags_value(&motion);
        lags_move(&motion, pid_double_step(&exact, 0.0, value) + 1.0);
        sum += fabs(value);
        peak = fmax(peak, fabs(value));
    }
    self->load = fmin(LOAD_COUNTS, ERROR_COUNTS / peak);
    self->best = sum * self->load;
}

void evaluation_start(struct evaluation *self, const struct plant_lags *plant)
{
    const double scale = lags_scale_steps(plant);
    const double least = 1e-3 / (scale + 1.0);

    self->plant = plant;
    self->steps = (int)fmin((60.0 * scale) + 400.0, STEPS_MAX);
    for (int i = 0; i < JUDGE_POINTS; i++) {
        const double share = (double)i / (JUDGE_POINTS - 1);
        self->radians[i] = least * pow(HALF_TURN / least, share);
        self->response[i] = response_of(plant, self->radians[i]);
    }
    run_best(self);
}

// The controller's response at z: see fixpid_pid_step.
static double complex controller(const struct fixpid_pid_gains *gains,
                                 double radians)
{
    const double complex before = cexp(-I * radians); // 1 / z
    const double kept = 1.0 - (1.0 / (double)(1u << gains->derivative_filter));

    return (gains->kp_q8 / 256.0) +
           (gains->ki_q24 / 16777216.0 / (1.0 - before)) +
           (gains->kd_q8 / 256.0 * (1.0 - before) / (1.0 - (kept * before)));
}

double evaluation_sensitivity(const struct evaluation *self,
                              const struct fixpid_pid_gains *gains)
{
    double largest = 0.0;

    for (int i = 0; i < JUDGE_POINTS; i++) {
        const double complex loop =
            controller(gains, self->radians[i]) * self->response[i];
        largest = fmax(largest, cabs(1.0 / (1.0 + loop)));
    }
    return largest;
}

static int16_t counts(double value)
{
    return (int16_t)fmin(fmax(floor(value + 0.5), -OUTPUT_MOST), OUTPUT_MOST);
}

// The last fifth of a loop that comes to rest is far below its peak.
double evaluation_load(const struct evaluation *self,
                       const struct fixpid_pid_gains *gains)
{
    const struct fixpid_pid_config config = {
        .gains = *gains, .output_min = -32767, .output_max = 32767};
    struct fixpid_pid pid;
    struct lags_motion motion;
    double sum = 0.0;
    double peak = 0.0;
    double last = 0.0;

    if (!fixpid_pid_init(&pid, &config)) {
        return -1.0;
    }
    lags_start(&motion, self->plant, 0.0);
    for (int step = 0; step < self->steps; step++) {
        const double value = lags_value(&motion);
        const double output = fixpid_pid_step(&pid, 0, counts(value));
        lags_move(&motion, output + self->load);
        sum += fabs(value);
        peak = fmax(peak, fabs(value));
        if (step > 0.8 * self->steps) {
            last = fmax(last, fabs(value));
        }
    }
    return (last > 0.3 * peak) ? -1.0 : sum / self->best;
}
