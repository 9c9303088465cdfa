// SPDX-License-Identifier: MIT
#include "heat_up.h"

#include <math.h>

#include "experiment.h"

#define COASTS_PERIODS 6.0

void heat_up_run(struct heat_up *self, const struct subject *subject, int part)
{
    static struct bench bench;
    const struct fixpid_reaction_config config = {
        .output_rest =
            (int16_t)(subject->plant.integrating || subject->plant.unstable
                          ? subject->holding * subject->output_max
                          : 0.0),
        .output_drive = (int16_t)(subject->output_max / part),
        .measurement_stop = (int16_t)subject->setpoint,
        .reverse = subject->reverse};
    const double sign = subject->reverse ? -100.0 : 100.0;
    long left = (long)(COASTS_PERIODS * subject->period_steps);

    *self = (struct heat_up){.beyond = -100.0};
    (void)fixpid_reaction_init(&self->reaction, &config);
    bench_start(&bench, subject);
    while (left > 0) {
        const int16_t output =
            fixpid_reaction_step(&self->reaction, (int16_t)bench_read(&bench));
        const double beyond = bench_value(&bench) - subject->setpoint;
        bench_drive(&bench, output);
        self->beyond = fmax(self->beyond, sign * beyond / subject->sensor_max);
        self->status = fixpid_reaction_status(&self->reaction);
        if (self->status == FIXPID_REACTION_RUNNING) {
            self->steps++;
        } else {
            left--;
        }
    }
}

struct design heat_up_design(const struct heat_up *self, int number)
{
    struct fixpid_pid_gains gains;

    if (!fixpid_reaction_result(&self->reaction, design_rule(number),
                                design_robustness(number), &gains)) {
        return (struct design){.found = false};
    }
    return design_of(&gains);
}
