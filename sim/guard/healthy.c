// SPDX-License-Identifier: MIT
// Whether fixpid_guard has false alarms:
//
//   healthy SEED EACH STEPS SHARE
//
// beside so many machines of each kind, of which only every day's things
// happen: setpoints, ramps, loads, off and on. Three guards are tried, with
// SHARE of the patience: with the model of fixpid_autotune, with that of
// fixpid_reaction, and by the rule of fixpid_guard.h for those who have none. A
// row for each machine, of
// semicolon-separated values: the alarms that each guard raised, or -1 where
// there is no such guard.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "experiment.h"
#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "heat_up.h"
#include "judge.h"
#include "machine_subject.h"

#define JITTER_STEPS 200
#define LONGEST 32767L

enum guards { BY_AUTOTUNE, BY_REACTION, BY_RULE, GUARDS };

struct loop {
    const struct subject *subject;
    struct machine machine;
    struct design design;
    struct fixpid_pid pid;
    struct fixpid_guard guards[GUARDS];
    int alarms[GUARDS];
    struct chance chance;
    double patience_share;
    double low, high; // the setpoints that it must hold
    double setpoint, per_step;
    long until; // something else happens
};

static double reading_at(const struct loop *self, double output)
{
    static struct machine settled;

    settled = self->machine;
    machine_settle(&settled, output * settled.output_max);
    return machine_value(&settled);
}

// A load of 8 % must leave them within what the output can do.
static void find_setpoints(struct loop *self)
{
    const double tenth = 0.1 * self->machine.sensor_max;
    const double holding = self->machine.holding;
    double one = self->subject->setpoint - tenth;
    double other = self->subject->setpoint + tenth;

    if (!self->machine.integrating) {
        const double weak = reading_at(self, 0.6 * holding);
        const double strong = reading_at(self, fmin(0.85, 1.5 * holding));
        one = fmax(one, fmin(weak, strong));
        other = fmin(other, fmax(weak, strong));
    }
    self->low = fmin(one, self->subject->setpoint);
    self->high = fmax(other, self->subject->setpoint);
}

static struct fixpid_guard_config config_for(const struct loop *self)
{
    static struct machine cold;
    const struct machine *const machine = &self->machine;
    double least;

    cold = *machine;
    machine_start(&cold, false, 1);
    least = fmin(machine_value(&cold), self->low);
    return (struct fixpid_guard_config){
        .output_min = (int16_t)machine->output_min,
        .output_max = (int16_t)machine->output_max,
        .measurement_min =
            (int16_t)((least > 8.0 + 4.0 * machine->noise) ? 1 : -1),
        .measurement_max = (int16_t)(machine->sensor_max - 1),
        .reach_min = (int16_t)fmax(ceil(self->low), 2.0),
        .reach_max = (int16_t)fmin(floor(self->high), machine->sensor_max - 2),
        .reverse = machine->reverse,
    };
}

// The jitter of the reading at rest, peak to peak.
static int jitter(const struct loop *self)
{
    static struct machine resting;
    int least = self->machine.sensor_max;
    int most = 0;

    resting = self->machine;
    machine_start(&resting, true, 31);
    for (int i = 0; i < JITTER_STEPS; i++) {
        const int reading = machine_read(&resting);
        least = (reading < least) ? reading : least;
        most = (reading > most) ? reading : most;
        machine_drive(&resting, resting.holding * resting.output_max);
    }
    return most - least;
}

// What two counts of the output move in the end.
static double two_counts(const struct loop *self)
{
    const double holding = self->machine.holding;
    const double more = holding + 2.0 / self->machine.output_max;

    return self->machine.integrating
               ? 0.0
               : fabs(reading_at(self, more) - reading_at(self, holding));
}

// How long full output takes from cold to so many counts; 0: too long.
static long steps_to_move(const struct loop *self, double counts)
{
    static struct machine cold;
    double start;

    cold = self->machine;
    machine_start(&cold, false, 37);
    start = machine_value(&cold);
    for (long steps = 0; steps < LONGEST / 2; steps++) {
        if (fabs(machine_value(&cold) - start) >= counts) {
            return steps;
        }
        machine_drive(&cold, cold.output_max);
    }
    return 0;
}

static bool without_model(const struct loop *self,
                          struct fixpid_guard_config *config)
{
    const double band = fmax(fmax(4.0, 1.5 * jitter(self)), two_counts(self));
    const long steps = steps_to_move(self, 10.0 * ceil(band));

    config->band = (uint16_t)ceil(band);
    config->patience = (uint16_t)(2 * steps);
    return steps > 0;
}

// Of a kind of guard that there is not, no alarm is told.
static void start_guard(struct loop *self, enum guards which, bool found,
                        struct fixpid_guard_config *config)
{
    bool good;

    config->patience = (uint16_t)(self->patience_share * config->patience);
    good = found && fixpid_guard_init(&self->guards[which], config);
    self->alarms[which] = good ? 0 : -1;
}

static void start_by_autotune(struct loop *self)
{
    static struct experiment experiment;
    struct fixpid_autotune_process process = {0};
    struct fixpid_guard_config config = config_for(self);
    struct fixpid_guard_model model;
    bool found;

    experiment_run(&experiment, self->subject);
    self->design = experiment_design(&experiment, DESIGN_PI_SAFE);
    found = fixpid_autotune_model(&experiment.autotune, &process);
    model = (struct fixpid_guard_model){.slope_q24 = process.slope_q24,
                                        .dead_q4 = process.dead_q4,
                                        .noise_q4 = process.noise_q4,
                                        .gain_q8 = process.gain_q8};
    found = found && fixpid_guard_from_model(&config, &model);
    start_guard(self, BY_AUTOTUNE, found, &config);
}

static void start_by_reaction(struct loop *self)
{
    static struct heat_up heat_up;
    struct subject cold = *self->subject;
    struct fixpid_reaction_process process = {0};
    struct fixpid_guard_config config = config_for(self);
    struct fixpid_guard_model model;
    bool found;

    cold.at_rest = false;
    heat_up_run(&heat_up, &cold, 1);
    if (!self->design.found) {
        self->design = heat_up_design(&heat_up, DESIGN_PI_SAFE);
    }
    found = fixpid_reaction_model(&heat_up.reaction, &process);
    model = (struct fixpid_guard_model){.slope_q24 = process.slope_q24,
                                        .dead_q4 = process.dead_q4,
                                        .noise_q4 = process.noise_q4};
    found = found && fixpid_guard_from_model(&config, &model);
    start_guard(self, BY_REACTION, found, &config);
}

static void start_by_rule(struct loop *self)
{
    struct fixpid_guard_config config = config_for(self);
    const bool found = without_model(self, &config);

    start_guard(self, BY_RULE, found, &config);
}

// With gains of a tuner, or of the best PI. It is cold.
static bool start_loop(struct loop *self)
{
    static struct judge judge;
    struct fixpid_pid_config config = {
        .output_min = (int16_t)self->machine.output_min,
        .output_max = (int16_t)self->machine.output_max,
        .reverse = self->machine.reverse};

    if (!self->design.found) {
        judge_start(&judge, self->subject, JUDGE_COARSE);
        self->design = judge_best(&judge, self->subject->period_steps, 1.5);
    }
    config.gains.kp_q8 = (uint16_t)fmin(self->design.kp * 256.0, 32767.0);
    config.gains.ki_q24 =
        (uint32_t)fmin(fmax(self->design.ki * 16777216.0, 8.0), 2147418112.0);
    machine_start(&self->machine, false, 71);
    return self->design.found && fixpid_pid_init(&self->pid, &config);
}

static bool is_off(const struct loop *self)
{
    return self->setpoint < self->low || self->setpoint > self->high;
}

// One that cools would bring a machine that is off below the room.
static void begin_load(struct loop *self)
{
    const double part = self->machine.integrating
                            ? 1.0
                            : fmin(1.0, self->machine.holding / 0.2);

    if (!is_off(self)) {
        self->machine.load = part * chance_between(&self->chance, -0.08, 0.08);
    }
}

// Beyond all readings, so that the output goes to its end.
static void switch_off(struct loop *self)
{
    self->machine.load = 0.0;
    self->setpoint = self->machine.reverse ? self->machine.sensor_max : 0.0;
}

static void begin(struct loop *self)
{
    const double period = self->subject->period_steps;
    const double slow = self->machine.slowest_s / self->machine.step_s;
    const double length = chance_between(&self->chance, 4.0, 40.0) * period +
                          chance_share(&self->chance) * fmin(slow, 2000.0);
    const double what = chance_share(&self->chance);
    const double goal = chance_between(&self->chance, self->low, self->high);

    self->until += (long)length;
    self->per_step = 0.0;
    if (what < 0.35) {
        self->setpoint = goal;
    } else if (what < 0.5) {
        self->setpoint = fmin(fmax(self->setpoint, self->low), self->high);
        self->per_step = (goal - self->setpoint) / length;
    } else if (what < 0.75) {
        begin_load(self);
    } else if (what < 0.85) {
        self->machine.load = 0.0;
    } else if (what < 0.92 && !self->machine.integrating) {
        switch_off(self);
    } else {
        self->setpoint = self->subject->setpoint;
    }
}

static void step(struct loop *self)
{
    const int16_t reading = (int16_t)machine_read(&self->machine);
    int16_t setpoint;
    int16_t output;

    self->setpoint += self->per_step;
    setpoint = (int16_t)floor(self->setpoint + 0.5);
    output = fixpid_pid_step(&self->pid, setpoint, reading);
    for (int i = 0; i < GUARDS; i++) {
        if (self->alarms[i] >= 0) {
            const int flags =
                fixpid_guard_step(&self->guards[i], setpoint, reading, output) &
                FIXPID_GUARD_ALARMS;
            self->alarms[i] |= flags;
        }
    }
    machine_drive(&self->machine, output);
}

static void run(const struct subject *subject, long number, long steps,
                double patience_share)
{
    static struct loop loop;

    loop = (struct loop){.subject = subject,
                         .machine = *subject->machine,
                         .chance = subject->chance,
                         .patience_share = patience_share,
                         .setpoint = subject->setpoint};
    find_setpoints(&loop);
    start_by_autotune(&loop);
    start_by_reaction(&loop);
    start_by_rule(&loop);
    if (!start_loop(&loop)) {
        steps = 0;
    }
    loop.until = (long)(30.0 * subject->period_steps +
                        3.0 * loop.machine.slowest_s / loop.machine.step_s);
    for (long i = 0; i < steps; i++) {
        if (i >= loop.until) {
            begin(&loop);
        }
        step(&loop);
    }
    printf("%ld;%s;%d;%d;%d\n", number, subject->name, loop.alarms[BY_AUTOTUNE],
           loop.alarms[BY_REACTION], loop.alarms[BY_RULE]);
}

int main(int count, char *arguments[])
{
    static struct machine machine;

    if (count != 5) {
        fprintf(stderr, "usage: healthy SEED EACH STEPS SHARE\n");
        return 2;
    }
    const unsigned long seed = strtoul(arguments[1], NULL, 10);
    printf("plant;kind;autotune;reaction;rule\n");
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
