// SPDX-License-Identifier: MIT
// Whether fixpid_guard has false alarms:
//
//   healthy SEED EACH STEPS SHARE
//
// beside so many machines of each kind, of which only every day's things
// happen: setpoints, ramps, loads, off and on, with SHARE of the patience. A
// row for each machine, of semicolon-separated values: the alarms that each
// guard raised, or -1 where there is no such guard; and whether Marlin and
// Klipper would switch off, or -1 where it is no heater.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "loop.h"
#include "machine_subject.h"

struct day {
    struct loop loop;
    double per_step; // of the setpoint
    long until;      // something else happens
};

static bool is_off(const struct day *self)
{
    return self->loop.setpoint < self->loop.low ||
           self->loop.setpoint > self->loop.high;
}

// One that cools would bring a machine that is off below the room.
static void take_load(struct day *self, double load)
{
    self->loop.machine.load = is_off(self) ? fmax(load, 0.0) : load;
}

static void begin_load(struct day *self)
{
    const double part = self->loop.machine.integrating
                            ? 1.0
                            : fmin(1.0, self->loop.machine.holding / 0.2);

    take_load(self, part * chance_between(&self->loop.chance, -0.08, 0.08));
}

// Beyond all readings, so that the output goes to its end.
static void switch_off(struct day *self)
{
    self->loop.setpoint =
        self->loop.machine.reverse ? self->loop.machine.sensor_max : 0.0;
    take_load(self, self->loop.machine.load);
}

static void begin(struct day *self)
{
    const double period = self->loop.subject->period_steps;
    const double slow =
        self->loop.machine.slowest_s / self->loop.machine.step_s;
    const double length =
        chance_between(&self->loop.chance, 4.0, 40.0) * period +
        chance_share(&self->loop.chance) * fmin(slow, 2000.0);
    const double what = chance_share(&self->loop.chance);
    const double goal =
        chance_between(&self->loop.chance, self->loop.low, self->loop.high);

    self->until += (long)length;
    self->per_step = 0.0;
    if (what < 0.35) {
        self->loop.setpoint = goal;
    } else if (what < 0.5) {
        self->loop.setpoint =
            fmin(fmax(self->loop.setpoint, self->loop.low), self->loop.high);
        self->per_step = (goal - self->loop.setpoint) / length;
    } else if (what < 0.75) {
        begin_load(self);
    } else if (what < 0.85) {
        self->loop.machine.load = 0.0;
    } else if (what < 0.92 && !self->loop.machine.integrating) {
        switch_off(self);
    } else {
        self->loop.setpoint = self->loop.subject->setpoint;
    }
}

static void run(const struct subject *subject, long number, long steps,
                double patience_share)
{
    static struct day day;
    struct loop *const loop = &day.loop;
    const double slow = subject->machine->slowest_s / subject->machine->step_s;

    if (!loop_start(loop, subject, false, patience_share)) {
        steps = 0;
    }
    day.per_step = 0.0;
    day.until = (long)(30.0 * subject->period_steps + 3.0 * slow);
    for (long i = 0; i < steps; i++) {
        if (i >= day.until) {
            begin(&day);
        }
        loop->setpoint += day.per_step;
        machine_drive(&loop->machine,
                      loop_step(loop, (int16_t)machine_read(&loop->machine)));
    }
    printf("%ld;%s", number, subject->name);
    for (int i = 0; i < GUARDS; i++) {
        printf(";%d", loop->alarms[i]);
    }
    printf(";%d;%d\n",
           loop->heater ? (int)(loop->peer_alarms & PEER_MARLIN) : -1,
           loop->heater ? (int)(loop->peer_alarms & PEER_KLIPPER) : -1);
}

int main(int count, char *arguments[])
{
    static struct machine machine;

    if (count != 5) {
        fprintf(stderr, "usage: healthy SEED EACH STEPS SHARE\n");
        return 2;
    }
    const unsigned long seed = strtoul(arguments[1], NULL, 10);
    printf("plant;kind;autotune;reaction;rule;twenty;reach_0;"
           "reach_rest;marlin;klipper\n");
    for (int kind = 0; kind < MACHINES; kind++) {
        for (long i = 0; kind != MACHINE_UNSTABLE && i < atol(arguments[2]);
             i++) {
            const struct subject subject = draw_machine_subject(
                &machine, (enum machine_kind)kind, seed, i);
            run(&subject, i, atol(arguments[3]), atof(arguments[4]));
        }
    }
    return 0;
}
