// SPDX-License-Identifier: MIT
// Whether fixpid_guard sees what burns things:
//
//   broken SEED EACH
//
// A row for each machine that has a guard, of semicolon-separated values: for
// each fault, the steps until the alarm of a guard with a tuner's model, or -1,
// how far the machine got beyond its setpoint, in percent of the sensor's
// range, if nobody acts and if the alarm cuts the supply, and the steps until
// Marlin and Klipper switch off, or -1.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "loop.h"
#include "machine_subject.h"

#define HORIZON_MOST 30000.0
#define CALM_PERIODS 20.0

// The first eight burn something or leave the loop without control, and a guard
// must see them; the others are those of which it sees a part, or none.
enum fault {
    OPEN,       // the sensor reads full scale
    SHORT,      // it reads 0
    FALLEN,     // it falls off: to the cold machine, by half a period
    STUCK_LOW,  // it stays a tenth of the scale below the setpoint
    STUCK_HIGH, // it stays 3 % of the scale above the setpoint
    DRIVE_ON,   // full drive, whatever the output
    DRIVE_OFF,  // no drive
    SIGN,       // the drive is the range's other end less the output
    STUCK_2,    // the sensor stays 2 counts below the setpoint
    STUCK_AT,   // it stays at the setpoint itself
    NOISY,      // it stays 0.5 % of the scale below, and its noise stays
    DRIFT,      // it drifts to 30 % of the scale below, in 200 periods
    HALF,       // the drive is half of the output
    FAULTS
};

static const char *const names[FAULTS] = {
    "open",        "short",     "fallen", "stuck_low", "stuck_high",
    "drive_on",    "drive_off", "sign",   "stuck_2",   "stuck_at",
    "stuck_noisy", "drift",     "half"};

struct broken {
    struct loop loop;
    enum fault fault;
    double cold;   // what a sensor that fell off comes to
    double sensed; // what it reads, before its noise
    bool cut;      // no drive, as somebody has cut the supply
};

static double limited(const struct broken *self, double counts)
{
    return fmin(fmax(floor(counts + 0.5), 0.0), self->loop.machine.sensor_max);
}

// A reading with the sensor's own noise about another value.
static double noisy(struct broken *self, double value)
{
    struct machine *const machine = &self->loop.machine;
    const double noise = machine_read(machine) - machine_value(machine);

    return limited(self, value + noise);
}

// So much of the scale warmer than the setpoint.
static double beside(const struct broken *self, double counts)
{
    const double sign = self->loop.machine.reverse ? -1.0 : 1.0;

    return fmin(fmax(self->loop.setpoint + sign * counts, 2.0),
                self->loop.machine.sensor_max - 2.0);
}

static double fallen(struct broken *self)
{
    const double period = self->loop.subject->period_steps;

    self->sensed += (self->cold - self->sensed) / (1.0 + period / 2.0);
    return noisy(self, self->sensed);
}

static double drifted(struct broken *self)
{
    const double top = self->loop.machine.sensor_max;
    const double way = 0.3 * top / (200.0 * self->loop.subject->period_steps);
    const double sign = self->loop.machine.reverse ? 1.0 : -1.0;

    self->sensed = fmin(self->sensed + way, 0.3 * top);
    return noisy(self,
                 machine_value(&self->loop.machine) + sign * self->sensed);
}

static double reading_of(struct broken *self)
{
    const double top = self->loop.machine.sensor_max;

    switch (self->fault) {
    case OPEN:
        return top;
    case SHORT:
        return 0.0;
    case FALLEN:
        return fallen(self);
    case STUCK_LOW:
        return limited(self, beside(self, -0.1 * top));
    case STUCK_HIGH:
        return limited(self, beside(self, 0.03 * top));
    case STUCK_2:
        return limited(self, beside(self, -2.0));
    case STUCK_AT:
        return self->loop.setpoint;
    default:
        return machine_read(&self->loop.machine);
    }
}

static double sensed(struct broken *self)
{
    if (self->fault == NOISY) {
        return noisy(self,
                     beside(self, -0.005 * self->loop.machine.sensor_max));
    }
    return (self->fault == DRIFT) ? drifted(self) : reading_of(self);
}

static double driven(const struct broken *self, double output)
{
    const struct machine *const machine = &self->loop.machine;

    if (self->cut) {
        return 0.0;
    }
    switch (self->fault) {
    case DRIVE_ON:
        return machine->output_max;
    case DRIVE_OFF:
        return 0.0;
    case SIGN:
        return machine->output_max + machine->output_min - output;
    case HALF:
        return 0.5 * output;
    default:
        return output;
    }
}

// A step; the farthest beyond the setpoint, `over` until now, in percent.
static double further(struct broken *self, double over)
{
    struct loop *const loop = &self->loop;
    const double sign = loop->machine.reverse ? -100.0 : 100.0;
    const double output = loop_step(loop, (int16_t)sensed(self));
    const double beyond = machine_value(&loop->machine) - loop->setpoint;

    machine_drive(&loop->machine, driven(self, output));
    return fmax(over, sign * beyond / loop->machine.sensor_max);
}

// As far as it comes when it is cut off now.
static double coasts(const struct broken *self, double over)
{
    static struct broken cut;
    const long steps = 200 + (long)(3.0 * self->loop.subject->period_steps);

    cut = *self;
    cut.cut = true;
    for (long i = 0; i < steps; i++) {
        over = further(&cut, over);
    }
    return over;
}

// The first step at which it is true, or -1.
static void notice(long *first, bool now, long step)
{
    if (*first < 0 && now) {
        *first = step;
    }
}

static void print_fault(struct broken *self, int guard, double horizon)
{
    double without = 0.0;
    double with = 0.0;
    long alarm = -1;
    long marlin = -1;
    long klipper = -1;

    for (long i = 0; i < (long)horizon; i++) {
        without = further(self, without);
        if (alarm < 0 && self->loop.alarms[guard] > 0) {
            alarm = i;
            with = coasts(self, without);
        }
        notice(&marlin, (self->loop.peer_alarms & PEER_MARLIN) != 0u, i);
        notice(&klipper, (self->loop.peer_alarms & PEER_KLIPPER) != 0u, i);
    }
    printf(";%ld;%.1f;%.1f;%ld;%ld", alarm, without,
           (alarm < 0) ? without : with, marlin, klipper);
}

// Of a tuner, or the one without a model; -1: none.
static int guard_of(const struct loop *self)
{
    for (int i = 0; i <= BY_RULE; i++) {
        if (self->alarms[i] >= 0) {
            return i;
        }
    }
    return -1;
}

static void forget_alarms(struct loop *self)
{
    for (int i = 0; i < GUARDS; i++) {
        fixpid_guard_acknowledge(&self->guards[i]);
        self->alarms[i] = (self->alarms[i] < 0) ? -1 : 0;
    }
    self->peer_alarms = 0;
}

static void print_faults(struct broken *whole, int guard, double slow)
{
    static struct broken copy;
    const double period = whole->loop.subject->period_steps;
    const double horizon =
        60.0 * period + 6.0 * slow + 10.0 * whole->loop.configs[guard].patience;

    for (int fault = 0; fault < FAULTS; fault++) {
        copy = *whole;
        copy.fault = (enum fault)fault;
        copy.sensed =
            (fault == FALLEN) ? machine_value(&copy.loop.machine) : 0.0;
        print_fault(&copy, guard, fmin(HORIZON_MOST, horizon));
    }
}

// Without a guard, or gains, there is no row.
static void run(const struct subject *subject, long number)
{
    static struct broken whole;
    const double period = subject->period_steps;
    const double slow = subject->machine->slowest_s / subject->machine->step_s;
    const double dead = period / 4.0;
    int guard;

    whole = (struct broken){.fault = FAULTS};
    whole.loop.machine = *subject->machine;
    machine_start(&whole.loop.machine, false, 1);
    whole.cold = machine_value(&whole.loop.machine);
    if (!loop_start(&whole.loop, subject, true, 1.0)) {
        return;
    }
    guard = guard_of(&whole.loop);
    if (guard < 0) {
        return;
    }
    for (long i = 0; i < (long)(CALM_PERIODS * period); i++) {
        (void)further(&whole, 0.0);
    }
    forget_alarms(&whole.loop);
    printf("%ld;%s;%d", number, subject->name, whole.loop.heater);
    print_faults(&whole, guard, slow);
    printf(";%.1f;%.3f\n", dead + slow / 1.3, dead / slow * 1.3);
}

int main(int argc, char *argv[])
{
    static struct machine machine;

    if (argc != 3) {
        fprintf(stderr, "usage: broken SEED EACH\n");
        return 2;
    }
    printf("plant;kind;heater");
    for (int fault = 0; fault < FAULTS; fault++) {
        const char *const name = names[fault];
        printf(";%s;%s_without;%s_with;%s_marlin;%s_klipper", name, name, name,
               name, name);
    }
    printf(";scale;dead\n");
    for (int kind = 0; kind < MACHINES; kind++) {
        for (long i = 0; kind != MACHINE_UNSTABLE && i < atol(argv[2]); i++) {
            const struct subject subject =
                draw_machine_subject(&machine, (enum machine_kind)kind,
                                     strtoul(argv[1], NULL, 10), i);
            run(&subject, i);
        }
    }
    return 0;
}
