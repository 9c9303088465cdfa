// SPDX-License-Identifier: MIT
#include "guarded.h"

#include <math.h>
#include <string.h>

#include "rule.h"

double guarded_chance(struct guarded *self)
{
    self->chance ^= self->chance << 13;
    self->chance ^= self->chance >> 7;
    self->chance ^= self->chance << 17;
    return (double)(self->chance >> 11) / 9007199254740992.0;
}

double guarded_between(struct guarded *self, double low, double high)
{
    return low + (high - low) * guarded_chance(self);
}

static bool integrates(const struct guarded *self)
{
    return self->task.plant.integrating;
}

double guarded_scale(const struct guarded *self)
{
    return integrates(self) ? 4.0 * self->dead : self->lag + self->dead;
}

// The half rule: half of the second lag counts as lag, half as dead time. So
// does half a step of the controller.
static void find_model(struct guarded *self)
{
    const struct plant_lags *const plant = &self->task.plant;
    double largest = 0.0;
    double second = 0.0;

    for (int i = 0; i < plant->lags; i++) {
        second = fmax(second, fmin(largest, plant->lag_steps[i]));
        largest = fmax(largest, plant->lag_steps[i]);
    }
    self->gain = plant->gain;
    self->dead = plant->dead_steps + 0.5;
    for (int i = 0; i < plant->lags; i++) {
        self->dead += plant->lag_steps[i];
    }
    if (plant->integrating) {
        self->lag = 1e9;
        self->slope = plant->gain;
        return;
    }
    self->lag = largest + second / 2.0;
    self->dead -= self->lag;
    self->slope = self->gain / self->lag;
}

struct rule {
    double kp, ti, td;
};

static struct rule simc_pi(const struct guarded *self)
{
    const double dead = self->dead;

    return (struct rule){
        .kp = 1.0 / (self->slope * 2.0 * dead),
        .ti = fmin(integrates(self) ? 8.0 * dead : self->lag, 8.0 * dead),
    };
}

static struct rule amigo_pi(const struct guarded *self)
{
    const double dead = self->dead;
    const double lag = self->lag;
    const double both = (lag + dead) * (lag + dead);
    const double sum = lag * lag + 12.0 * lag * dead + 7.0 * dead * dead;

    if (integrates(self)) {
        return (struct rule){.kp = 0.35 / (self->slope * dead),
                             .ti = 13.4 * dead};
    }
    return (struct rule){
        .kp = 0.15 / self->gain +
              (0.35 - dead * lag / both) * lag / (self->gain * dead),
        .ti = 0.35 * dead + 13.0 * dead * lag * lag / sum,
    };
}

static struct rule amigo_pid(const struct guarded *self)
{
    const double dead = self->dead;
    const double lag = self->lag;

    if (integrates(self)) {
        return (struct rule){.kp = 0.45 / (self->slope * dead),
                             .ti = 8.0 * dead,
                             .td = 0.5 * dead};
    }
    return (struct rule){
        .kp = (0.2 + 0.45 * lag / dead) / self->gain,
        .ti = (0.4 * dead + 0.8 * lag) / (dead + 0.1 * lag) * dead,
        .td = 0.5 * dead * lag / (0.3 * dead + lag),
    };
}

static void start_pid(struct guarded *self)
{
    static struct rule (*const rules[])(const struct guarded *) = {
        simc_pi, amigo_pi, amigo_pid};
    const struct rule rule = rules[(int)(3.0 * guarded_chance(self))](self);
    const double ki = rule.kp / rule.ti * 16777216.0;
    struct fixpid_pid_config config = {
        .output_max = (int16_t)self->span,
        .reverse = self->task.reverse,
    };
    int filter = 0;

    while (filter < 7 && (1 << (filter + 1)) <= rule.td / 5.0) {
        filter++;
    }
    config.gains.kp_q8 =
        (uint16_t)fmin(fmax(rule.kp * 256.0 + 0.5, 1.0), 32767.0);
    config.gains.ki_q24 = (uint32_t)fmin(fmax(ki, 8.0), 2e9);
    config.gains.kd_q8 = (uint16_t)fmin(
        rule.kp * rule.td / (1 << filter) * 256.0 + 0.5, 32255.0);
    config.gains.derivative_filter = (uint8_t)filter;
    (void)fixpid_pid_init(&self->pid, &config);
}

// What the ends of the output bring the reading to, with a margin and at a low
// supply. Of an integrating plant, most of the scale.
static void set_reach(struct guarded *self)
{
    const double way = self->gain * self->span;
    double low =
        integrates(self) ? 0.15 * self->top : self->task.zero + 0.05 * way;
    double high = integrates(self) ? 0.98 * self->top
                                   : self->task.zero + 0.92 * 0.8 * way;

    if (self->task.reverse) {
        const double other = self->top - low;

        low = self->top - high;
        high = other;
    }
    self->config.reach_min = (int16_t)low;
    self->config.reach_max = (int16_t)high;
}

// As the header of fixpid_guard says.
static void start_guard(struct guarded *self)
{
    const struct model model = {integrates(self) ? 0.0 : self->gain, self->dead,
                                self->slope, self->task.noise};

    self->config = (struct fixpid_guard_config){
        .output_max = (int16_t)self->span,
        .measurement_min = 1,
        .measurement_max = (int16_t)(self->top - 1.0),
        .reverse = self->task.reverse,
    };
    rule_for(&self->config, &model);
    set_reach(self);
    (void)fixpid_guard_init(&self->guard, &self->config);
}

void guarded_start(struct guarded *self, const struct task *task,
                   unsigned number)
{
    memset(self, 0, sizeof *self);
    self->task = *task;
    self->task.drift = integrates(self) ? task->holding : 0.0;
    self->chance = (number + UINT64_C(77)) * UINT64_C(0x9E3779B97F4A7C15);
    for (int i = 0; i < 20; i++) {
        (void)guarded_chance(self);
    }
    self->span = task->output_max;
    self->top = task->sensor_max;
    find_model(self);
    self->goal = integrates(self)
                     ? guarded_between(self, 0.2, 0.7) * self->top
                     : task->zero + guarded_between(self, 0.1, 0.7) *
                                        self->gain * self->span;
    if (integrates(self)) {
        self->task.zero = 0.1 * self->top;
    }
    lags_start(&self->motion, &self->task.plant, 0.0);
    start_pid(self);
    start_guard(self);
}

// Where a stuck sensor stays.
static double stuck_at(const struct guarded *self, enum fault fault)
{
    const double setpoint = floor(self->goal + 0.5);

    switch (fault) {
    case FAULT_STUCK_LOW:
        return floor(self->goal - 0.1 * self->top);
    case FAULT_STUCK_HIGH:
        return floor(self->goal + 0.03 * self->top);
    case FAULT_STUCK_2:
        return setpoint - 2.0;
    case FAULT_STUCK_NOISY:
        return self->goal - 0.005 * self->top;
    default:
        return setpoint;
    }
}

void guarded_break(struct guarded *self, enum fault fault)
{
    self->fault = fault;
    self->limit = fmax(self->goal, self->value);
    self->stuck = fmin(fmax(stuck_at(self, fault), 2.0), self->top - 2.0);
    self->fallen = self->value;
}

// By a lag of a quarter of the plant's, as a sensor in free air.
static double fallen(struct guarded *self)
{
    const double lag =
        4.0 + (integrates(self) ? guarded_scale(self) : self->lag);

    self->fallen += (self->task.zero - self->fallen) * 4.0 / lag;
    return self->fallen;
}

static double drifted(struct guarded *self)
{
    const double way = 0.01 * self->top / guarded_scale(self);

    self->drifted = fmin(self->drifted + way, 0.3 * self->top);
    return self->value - self->drifted;
}

static double sensed(struct guarded *self)
{
    const double noise = self->task.noise * draw_noise(&self->task.noise_state);
    double reading = self->value;

    switch (self->fault) {
    case FAULT_STUCK_LOW:
    case FAULT_STUCK_HIGH:
    case FAULT_STUCK_2:
    case FAULT_STUCK_AT:
        return self->stuck;
    case FAULT_STUCK_NOISY:
        reading = self->stuck;
        break;
    case FAULT_DRIFT:
        reading = drifted(self);
        break;
    case FAULT_OPEN:
        return self->top;
    case FAULT_SHORT:
        return 0.0;
    case FAULT_FALLEN:
        reading = fallen(self);
        break;
    default:
        break;
    }
    return fmin(fmax(floor(reading + noise + 0.5), 0.0), self->top);
}

static double driven(const struct guarded *self, double output)
{
    if (self->cut) {
        return 0.0;
    }
    switch (self->fault) {
    case FAULT_DRIVE_ON:
        return self->span;
    case FAULT_DRIVE_OFF:
        return 0.0;
    case FAULT_SIGN:
        return self->span - output;
    case FAULT_HALF:
        return 0.5 * output;
    default:
        return output;
    }
}

// Counts of the sensor, which a reversed one turns round.
static int16_t turned(const struct guarded *self, double counts)
{
    return (int16_t)(self->task.reverse ? self->top - counts : counts);
}

static void move_plant(struct guarded *self, int16_t output)
{
    lags_move(&self->motion, driven(self, output) - self->task.drift);
    if (integrates(self)) {
        self->motion.integral = fmax(self->motion.integral, 0.0); // empty
    }
}

uint8_t guarded_step(struct guarded *self)
{
    int16_t setpoint;
    int16_t measurement;
    int16_t output;
    uint8_t flags;

    self->value = lags_value(&self->motion) + self->task.zero;
    measurement = turned(self, sensed(self));
    setpoint = turned(self, floor(self->goal + 0.5));
    output = fixpid_pid_step(&self->pid, setpoint, measurement);
    flags = fixpid_guard_step(&self->guard, setpoint, measurement, output);
    move_plant(self, output);
    self->now++;
    return flags;
}
