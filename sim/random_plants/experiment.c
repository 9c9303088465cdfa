// SPDX-License-Identifier: MIT
#include "experiment.h"

#include <math.h>

#define STEPS_MAX 2000000L
#define CYCLES 2
#define ROBUSTNESS_Q4 16
#define RUNNING 1

static int16_t holding_counts(const struct task *task)
{
    return (int16_t)(task->power_on ? 0.0 : task->holding + 0.5);
}

static void start_autotune(struct experiment *self, const struct task *task)
{
    const struct fixpid_autotune_config config = {
        .output_min = 0,
        .output_max = (int16_t)task->output_max,
        .output_rest = holding_counts(task),
        .measurement_min = -1,
        .measurement_max = (int16_t)(task->sensor_max + 1.0),
        .swing = (uint16_t)(task->sensor_max / 12.0),
        .timeout_steps = (uint16_t)task->timeout_steps,
        .cycles = CYCLES,
        .options = task->reverse ? FIXPID_AUTOTUNE_REVERSE : 0u,
    };
    (void)fixpid_autotune_init(&self->autotune, &config);
}

// One step of the tuner; its sensor is upside down on a plant that acts so.
static int16_t step(struct experiment *self, const struct task *task,
                    double reading)
{
    const int16_t top = (int16_t)task->sensor_max;
    int16_t measurement = (int16_t)fmin(fmax(reading, 0.0), task->sensor_max);
    int16_t setpoint = (int16_t)task->setpoint;
    int16_t output;

    if (task->reverse) {
        measurement = (int16_t)(top - measurement);
        setpoint = (int16_t)(top - setpoint);
    }
    output = fixpid_autotune_step(&self->autotune, setpoint, measurement);
    self->status = fixpid_autotune_status(&self->autotune);
    if (output < 0 || output > task->output_max) {
        self->outside++;
    }
    self->steps++;
    return output;
}

void experiment_run(struct experiment *self, const struct task *task)
{
    const double rest = task->plant.integrating ? 0.0 : holding_counts(task);
    uint64_t noise_state = task->noise_state;
    struct lags_motion motion;

    *self = (struct experiment){.status = RUNNING};
    start_autotune(self, task);
    lags_start(&motion, &task->plant, rest);
    while (self->status == RUNNING && self->steps < STEPS_MAX) {
        const bool loaded = task->load_at >= 0 && self->steps >= task->load_at;
        const double noise = task->noise * draw_noise(&noise_state);
        const double value = lags_value(&motion) + task->zero;
        const double output = step(self, task, floor(value + noise + 0.5));
        lags_move(&motion, output - task->drift + (loaded ? task->load : 0.0));
    }
}

const char *const *experiment_rules(int *count)
{
    static const char *const of_autotune[] = {"SIMC_PI",
                                              "AMIGO_PI",
                                              "AMIGO_PID",
                                              "TYREUS_LUYBEN_PI",
                                              "TYREUS_LUYBEN_PID",
                                              "ZIEGLER_NICHOLS_PI",
                                              "ZIEGLER_NICHOLS_PID"};

    *count = 7;
    return of_autotune;
}

bool experiment_result(const struct experiment *self, int rule,
                       struct fixpid_pid_gains *gains)
{
    struct fixpid_pid_config config = {.output_min = -32767,
                                       .output_max = 32767};
    bool found;

    found = fixpid_autotune_result(&self->autotune, (uint8_t)rule,
                                   ROBUSTNESS_Q4, &config);
    *gains = config.gains;
    return found;
}
