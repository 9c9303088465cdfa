// SPDX-License-Identifier: MIT
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "loops.h"

struct fixpid_pid_config loop_config(const struct pid_double_gains *gains,
                                     double setpoint_weight, double output_min,
                                     double output_max)
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

void loop_start(struct loop *self, const struct trial *trial, bool fixed)
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

void loop_step(struct loop *self, double setpoint)
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
