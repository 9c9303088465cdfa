// SPDX-License-Identifier: MIT
#include "machine.h"

#include <math.h>
#include <string.h>

#define TURN 6.283185307179586
#define SETTLE_STEPS 60000L

double machine_value(const struct machine *self)
{
    return (machine_kind_value(self) - self->zero) / self->span *
           self->sensor_max;
}

// The valve follows only when it is free, and then jumps or leaves a play.
static double freed(struct machine *self, double output)
{
    const double apart = output - self->driven;

    if (self->stiction > 0.0) {
        if (fabs(apart) > self->stiction) {
            self->driven = output - copysign(self->backlash, apart);
        }
    } else if (fabs(apart) > self->backlash) {
        self->driven = output - copysign(self->backlash, apart);
    }
    return self->driven;
}

// What the actuator makes of an output.
static double actuated(struct machine *self, double counts)
{
    const double least = (self->output_min < 0) ? -1.0 : 0.0;
    double output = fmin(fmax(counts / self->output_max, least), 1.0);

    if (self->smooth) {
        return output;
    }
    if (self->levels > 0) {
        output = floor(output * self->levels + 0.5) / self->levels;
    }
    if (self->half_cycles > 0) {
        double whole;
        self->carried += output * self->half_cycles;
        whole = floor(self->carried + 0.5);
        self->carried -= whole;
        output = whole / self->half_cycles;
    }
    return freed(self, output);
}

static double this_step_s(struct machine *self)
{
    double seconds = self->step_s;

    if (self->smooth) {
        return seconds;
    }
    if (self->jitter > 0.0) {
        seconds *= 1.0 + self->jitter * chance_between(&self->chance, -1, 1);
    }
    if (self->missed > 0.0 && chance_happens(&self->chance, self->missed)) {
        seconds += self->step_s;
    }
    return seconds;
}

// After the actuator's own speed and the dead time.
static double arrives(struct machine *self, double output, double seconds)
{
    double dead = self->dead_s;
    int parts;

    if (self->rate > 0.0) {
        const double most = self->rate * seconds;
        output = fmin(fmax(output, self->moved - most), self->moved + most);
        self->moved = output;
    }
    if (!self->smooth && self->wander > 0.0) {
        dead *= 1.0 + self->wander * sin(TURN * self->time_s / self->wander_s);
    }
    parts = (int)(dead / (self->step_s / self->parts) + 0.5);
    parts = (parts < MACHINE_LINE) ? parts : MACHINE_LINE - 1;
    self->at = (self->at + 1) % MACHINE_LINE;
    self->line[self->at] = output;
    return self->line[(self->at - parts + MACHINE_LINE) % MACHINE_LINE];
}

// Heun's method.
static void move(struct machine *self, double output, double seconds)
{
    double first[MACHINE_STATES];
    double then[MACHINE_STATES];
    double ahead[MACHINE_STATES];

    machine_kind_change(self, self->state, output, first);
    for (int i = 0; i < self->states; i++) {
        ahead[i] = self->state[i] + seconds * first[i];
    }
    machine_kind_change(self, ahead, output, then);
    for (int i = 0; i < self->states; i++) {
        self->state[i] += 0.5 * seconds * (first[i] + then[i]);
    }
    self->time_s += seconds;
}

void machine_drive(struct machine *self, double output)
{
    const double driven = actuated(self, output);
    const double seconds = this_step_s(self) / self->parts;

    for (int i = 0; i < self->parts; i++) {
        move(self, arrives(self, driven, seconds) + self->load, seconds);
    }
    self->steps++;
}

// Standard deviation of the noise now.
static double loudness(struct machine *self)
{
    if (self->burst > 0.0 && self->burst_left > 0) {
        self->burst_left--;
        return self->noise * self->burst;
    }
    if (self->burst > 0.0 && chance_happens(&self->chance, 0.004)) {
        self->burst_left = 5 + chance_index(&self->chance, 15);
    }
    return self->noise;
}

static double disturbance(struct machine *self)
{
    double sum = loudness(self) * chance_noise(&self->chance);

    if (self->hum > 0.0) {
        sum += self->hum * sin(TURN * (double)self->steps / self->hum_steps);
    }
    if (self->outliers > 0.0 && chance_happens(&self->chance, self->outliers)) {
        const double sign = chance_happens(&self->chance, 0.5) ? -1.0 : 1.0;
        sum +=
            sign * self->sensor_max * chance_between(&self->chance, 0.03, 0.3);
    }
    return sum;
}

int machine_read(struct machine *self)
{
    const double counts = machine_value(self) + disturbance(self);

    return (int)fmin(fmax(floor(counts + 0.5), 0.0), self->sensor_max);
}

// As if this output had been there for ever.
static void held(struct machine *self, double output)
{
    for (int i = 0; i < MACHINE_LINE; i++) {
        self->line[i] = output;
    }
    self->driven = output;
    self->moved = output;
}

// Only the slowest mode is left: where three states of equal distance lead.
static double limit_of(double before, double then, double now)
{
    const double bend = (now - then) - (then - before);

    if (fabs(bend) <= 1e-9 * (1.0 + fabs(now))) {
        return now;
    }
    return now - (now - then) * (now - then) / bend;
}

void machine_settle(struct machine *self, double output)
{
    const double wanted = 6.0 * self->slowest_s / self->step_s;
    const long third = (long)fmin(wanted, SETTLE_STEPS) / 3 + 20;
    double before[3][MACHINE_STATES];

    self->smooth = true;
    self->load = 0.0;
    held(self, output / self->output_max);
    for (int part = 0; part < 3; part++) {
        for (long i = 0; i < third; i++) {
            machine_drive(self, output);
        }
        memcpy(before[part], self->state, sizeof self->state);
    }
    for (int i = 0; i < self->states; i++) {
        self->state[i] = limit_of(before[0][i], before[1][i], before[2][i]);
    }
}

// Neither a position nor what is unstable settles anywhere.
static bool settles(const struct machine *self)
{
    return !self->integrating && self->kind != MACHINE_UNSTABLE;
}

// In whole counts of the output.
static void place_setpoint(struct machine *self)
{
    const double output = floor(self->holding * self->output_max + 0.5);

    self->holding = output / self->output_max;
    machine_kind_cold(self);
    if (settles(self)) {
        machine_settle(self, output);
    }
    memcpy(self->rest, self->state, sizeof self->rest);
    self->setpoint = (int)floor(machine_value(self) + 0.5);
    self->smooth = false;
}

void machine_draw(struct machine *self, enum machine_kind kind,
                  unsigned long seed, long number)
{
    static const double noises[] = {0.0, 0.3, 0.5, 1.0, 2.0, 3.0};
    struct chance *const chance = &self->chance;

    *self = (struct machine){.kind = kind, .parts = 8, .span = 1.0};
    chance->state = (uint64_t)seed * 1000003u + (uint64_t)kind * 1037389u +
                    (uint64_t)number * 104729u;
    (void)chance_bits(chance);
    self->output_max = chance_happens(chance, 0.5) ? 255 : 1000;
    self->sensor_max = chance_happens(chance, 0.5) ? 1023 : 4095;
    self->noise = noises[chance_index(chance, 6)];
    self->holding = chance_between(chance, 0.15, 0.8);
    machine_kind_draw(self);
    place_setpoint(self);
}

void machine_start(struct machine *self, bool at_rest, uint64_t seed)
{
    const bool held_there = at_rest || !settles(self);

    self->chance = (struct chance){seed};
    self->load = 0.0;
    self->smooth = false;
    self->time_s = chance_between(&self->chance, 0.0, 1e4);
    self->steps = 0;
    self->carried = 0.0;
    self->burst_left = 0;
    held(self, held_there ? self->holding : 0.0);
    machine_kind_cold(self);
    if (held_there) {
        memcpy(self->state, self->rest, sizeof self->state);
    }
    if (self->integrating && !at_rest) {
        self->state[2] -= 0.15 * self->span;
    }
}
