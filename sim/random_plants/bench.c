// SPDX-License-Identifier: MIT
#include "bench.h"

#include <math.h>
#include <stddef.h>

#define INTEGRATOR_OFF 0.3 // of the scale, below the setpoint at power-on
#define DRIFT_LASTS 30.0   // times dead time and lags

static double holding(const struct subject *subject)
{
    return subject->holding * subject->output_max;
}

static void start_plant(struct bench *self)
{
    const struct subject *const subject = self->subject;
    struct linear slow = subject->plant;

    sampled_start(&self->plant, &subject->plant);
    motion_start(&self->motion, &self->plant);
    if (subject->cooling > 1.0) {
        slow.sections[0].denominator[1] *= subject->cooling;
        sampled_start(&self->cooling, &slow);
        self->motion.falling = &self->cooling;
    }
    self->driven = holding(subject);
    if (subject->at_rest) {
        return;
    }
    if (subject->plant.integrating) {
        self->offset = -INTEGRATOR_OFF * subject->sensor_max;
    } else {
        motion_rest(&self->motion, -holding(subject));
        self->driven = 0.0;
    }
}

void bench_start(struct bench *self, const struct subject *subject)
{
    self->subject = subject;
    self->chance = subject->chance;
    self->offset = 0.0;
    self->steps = 0;
    if (subject->machine != NULL) {
        self->machine = *subject->machine;
        machine_start(&self->machine, subject->at_rest, subject->chance.state);
    } else {
        start_plant(self);
    }
}

double bench_value(const struct bench *self)
{
    if (self->subject->machine != NULL) {
        return machine_value(&self->machine);
    }
    return self->subject->setpoint + self->offset + motion_value(&self->motion);
}

static int read_plant(struct bench *self)
{
    const double noise = self->subject->noise * chance_noise(&self->chance);
    const double counts = floor(bench_value(self) + noise + 0.5);

    return (int)fmin(fmax(counts, 0.0), self->subject->sensor_max);
}

int bench_read(struct bench *self)
{
    return (self->subject->machine != NULL) ? machine_read(&self->machine)
                                            : read_plant(self);
}

// What moves the plant: the actuator follows only when the backlash is taken
// up.
static void take_up(struct bench *self, double output)
{
    const double backlash = self->subject->backlash;

    self->driven = fmin(self->driven, output + backlash);
    self->driven = fmax(self->driven, output - backlash);
}

static void drive_plant(struct bench *self, double output)
{
    const struct subject *const subject = self->subject;
    const double time = linear_steps(&subject->plant) * DRIFT_LASTS;
    double input;

    self->steps++;
    take_up(self, output);
    input = self->driven - holding(subject);
    if (subject->load_at >= 0 && self->steps > subject->load_at) {
        input += subject->load;
    }
    input += subject->drift * fmin(1.0, (double)self->steps / time);
    motion_move(&self->motion, input);
}

void bench_drive(struct bench *self, double output)
{
    if (self->subject->machine != NULL) {
        machine_drive(&self->machine, output);
    } else {
        drive_plant(self, output);
    }
}
