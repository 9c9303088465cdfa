// SPDX-License-Identifier: MIT
#include "loop.h"

#include <math.h>

#include "experiment.h"
#include "heat_up.h"
#include "judge.h"

#define JITTER_STEPS 200
#define LONGEST 32767L

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

// More than 20 bands if less than 5 % of the output hold the lowest setpoint.
static uint8_t bands_for(const struct loop *self)
{
    const struct machine *const machine = &self->machine;
    double cold;
    double share;

    if (machine->integrating || machine->output_min < 0) {
        return 0;
    }
    cold = reading_at(self, 0.0);
    share = machine->holding * (self->low - cold) /
            (self->subject->setpoint - cold);
    return (share > 0.0 && share < 0.05) ? (uint8_t)fmin(1.0 / share, 255.0)
                                         : 0;
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
    self->configs[which] = *config;
    good = found && fixpid_guard_init(&self->guards[which], config);
    self->alarms[which] = good ? 0 : -1;
}

// With it, and if there was none yet also with 20 bands.
static void start_by_model(struct loop *self, enum guards which, bool found,
                           struct fixpid_guard_model *model)
{
    struct fixpid_guard_config config = config_for(self);
    struct fixpid_guard_config plain = config;

    if (self->alarms[BANDS_20] < 0) {
        const bool good = found && fixpid_guard_from_model(&plain, model);
        start_guard(self, BANDS_20, good, &plain);
    }
    model->bands = bands_for(self);
    found = found && fixpid_guard_from_model(&config, model);
    start_guard(self, which, found, &config);
}

static void start_by_autotune(struct loop *self)
{
    static struct experiment experiment;
    struct fixpid_autotune_process process = {0};
    struct fixpid_guard_model model;
    bool found;

    experiment_run(&experiment, self->subject);
    self->design = experiment_design(&experiment, DESIGN_PI_SAFE);
    found = fixpid_autotune_model(&experiment.autotune, &process);
    model = (struct fixpid_guard_model){.slope_q24 = process.slope_q24,
                                        .dead_q4 = process.dead_q4,
                                        .noise_q4 = process.noise_q4,
                                        .gain_q8 = process.gain_q8};
    start_by_model(self, BY_AUTOTUNE, found, &model);
}

static void start_by_reaction(struct loop *self)
{
    static struct heat_up heat_up;
    struct subject cold = *self->subject;
    struct fixpid_reaction_process process = {0};
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
    start_by_model(self, BY_REACTION, found, &model);
}

static void start_by_rule(struct loop *self)
{
    struct fixpid_guard_config config = config_for(self);
    const bool found = without_model(self, &config);

    start_guard(self, BY_RULE, found, &config);
}

static void start_with_reach(struct loop *self)
{
    const enum guards model =
        (self->alarms[BY_AUTOTUNE] >= 0) ? BY_AUTOTUNE : BY_REACTION;
    const double top = self->machine.sensor_max;
    const bool found = self->alarms[model] >= 0;
    struct fixpid_guard_config config = self->configs[model];
    double rest = 0.02 * top;
    double full = 0.98 * top;

    if (!self->machine.integrating) {
        rest = reading_at(self, 0.0);
        full = reading_at(self, 0.8);
    }
    config.reach_min = config.reach_max = 0;
    start_guard(self, REACH_0, found, &config);
    config.reach_min = (int16_t)(fmin(rest, full) + 0.03 * top);
    config.reach_max = (int16_t)fmin(fmax(rest, full), top - 2.0);
    start_guard(self, REACH_REST, found, &config);
}

static bool is_heater(const struct machine *machine)
{
    return machine->kind == MACHINE_FURNACE ||
           machine->kind == MACHINE_QUARTER || machine->kind == MACHINE_OVEN ||
           machine->kind == MACHINE_KETTLE || machine->kind == MACHINE_HOT_END;
}

// With gains of a tuner, or of the best PI.
static bool start_pid(struct loop *self)
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
    return self->design.found && fixpid_pid_init(&self->pid, &config);
}

bool loop_start(struct loop *self, const struct subject *subject, bool at_rest,
                double patience_share)
{
    *self = (struct loop){.subject = subject,
                          .machine = *subject->machine,
                          .chance = subject->chance,
                          .patience_share = patience_share,
                          .alarms = {[BANDS_20] = -1},
                          .setpoint = subject->setpoint};
    find_setpoints(self);
    start_by_autotune(self);
    start_by_reaction(self);
    start_by_rule(self);
    start_with_reach(self);
    self->heater = is_heater(&self->machine);
    peers_start(&self->peers, self->machine.kind == MACHINE_HOT_END,
                self->machine.step_s);
    machine_start(&self->machine, at_rest, 71);
    if (!start_pid(self)) {
        return false;
    }
    if (at_rest) {
        const double holding = self->machine.holding * self->machine.output_max;
        fixpid_pid_seed(&self->pid, (int16_t)holding);
    }
    return true;
}

static double degrees(const struct loop *self, double counts)
{
    const struct machine *const machine = &self->machine;

    return machine->zero + counts / machine->sensor_max * machine->span;
}

// They take the ends of the scale for a broken sensor, and 0 degrees for off.
static unsigned ask_peers(struct loop *self, int16_t reading)
{
    const bool off = self->setpoint < self->low || self->setpoint > self->high;

    if (!self->heater) {
        return 0;
    }
    if (reading <= 0 || reading >= self->machine.sensor_max) {
        return PEER_MARLIN | PEER_KLIPPER;
    }
    return peers_step(&self->peers, off ? 0.0 : degrees(self, self->setpoint),
                      degrees(self, reading));
}

int16_t loop_step(struct loop *self, int16_t reading)
{
    const int16_t setpoint = (int16_t)floor(self->setpoint + 0.5);
    const int16_t output = fixpid_pid_step(&self->pid, setpoint, reading);

    for (int i = 0; i < GUARDS; i++) {
        if (self->alarms[i] >= 0) {
            const int flags =
                fixpid_guard_step(&self->guards[i], setpoint, reading, output);
            self->alarms[i] |= flags & (int)FIXPID_GUARD_ALARMS;
        }
    }
    self->peer_alarms |= ask_peers(self, reading);
    return output;
}
