// SPDX-License-Identifier: MIT
#include "answer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HALF_TURN 3.141592653589793
#define POINTS 320 // at which a period is searched

// Half of what a step of the output by `change` counts adds to the answer.
static void add_step(struct answer *self, const struct machine *machine,
                     double change)
{
    static struct machine moved;
    const double output = machine->holding * machine->output_max + change;
    double before;

    moved = *machine;
    machine_start(&moved, true, 1);
    moved.smooth = true;
    before = machine_value(&moved);
    for (int i = 0; i < self->count; i++) {
        double now;
        machine_drive(&moved, output);
        now = machine_value(&moved);
        self->change[i] += 0.5 * (now - before) / change;
        before = now;
    }
}

// By the second half of it.
static double fading(const struct answer *self)
{
    const double last = self->change[self->count - 1];
    const double middle = self->change[self->count / 2];
    const int apart = self->count - 1 - self->count / 2;
    double sum = 0.0;

    for (int i = 0; i < self->count; i++) {
        sum += self->change[i];
    }
    if (fabs(last) < 1e-9 * fabs(sum) || last / middle <= 0.0) {
        return 0.0;
    }
    return fmin(pow(last / middle, 1.0 / apart), 1.0);
}

void answer_of(struct answer *self, const struct machine *machine)
{
    const double slowest = machine->slowest_s / machine->step_s;
    const double dead = machine->dead_s / machine->step_s;
    const double change = fmax(1.0, 0.01 * machine->output_max);
    const double sign = machine->reverse ? -1.0 : 1.0;

    memset(self, 0, sizeof *self);
    self->count = (int)fmin(6.0 * (slowest + dead) + 60.0, ANSWER_STEPS);
    add_step(self, machine, change);
    add_step(self, machine, -change);
    for (int i = 0; i < self->count; i++) {
        self->change[i] *= sign;
    }
    self->fades = machine->integrating ? 1.0 : fading(self);
    self->least = 0.02 / fmax(slowest, 1.0 + dead);
    if (self->fades > 0.0 && self->fades < 1.0) {
        self->least = fmin(self->least, 0.05 * (1.0 - self->fades));
    }
}

double complex answer_response(const struct answer *self, double radians)
{
    const double complex before = cexp(-I * radians);
    const double tail = self->change[self->count - 1] * self->fades;
    double complex power = before;
    double complex sum = 0.0;

    for (int i = 0; i < self->count; i++) {
        sum += self->change[i] * power;
        power *= before;
    }
    return sum + tail * power / (1.0 - self->fades * before);
}

double answer_period(const struct answer *self)
{
    double phase = 0.0;
    double last = 0.0;

    for (int i = 0; i < POINTS; i++) {
        const double share = (double)i / (POINTS - 1);
        const double radians =
            self->least * pow(HALF_TURN / self->least, share);
        const double now = carg(answer_response(self, radians));
        phase += (i == 0) ? now : remainder(now - last, 2.0 * HALF_TURN);
        last = now;
        if (phase < -HALF_TURN) {
            return 2.0 * HALF_TURN / radians;
        }
    }
    return 0.0;
}
