// SPDX-License-Identifier: MIT
#include "reference_pid.h"

#include <string.h>

#include "reference.h"

#define ONE (INT64_C(1) << 24) // of the integral
#define DERIVATIVE_LIMIT ((INT64_C(1) << 30) - (INT64_C(1) << 24))

static int64_t int16_of(int64_t value)
{
    return reference_clamp(value, -32768, 32767);
}

static unsigned lacking(unsigned features)
{
    return features & ~(unsigned)FIXPID_PID_FEATURES;
}

unsigned reference_pid_gains_lack(const struct fixpid_pid_gains *gains)
{
    return lacking(
        (gains->derivative_filter != 0 ? 0x01u : 0u) |
        ((gains->ki_q24 + UINT64_C(128)) / 256 > 32767 ? 0x40u : 0u));
}

unsigned reference_pid_lacks(const struct fixpid_pid_config *config)
{
    const bool weighted =
        config->proportional_on_measurement ||
        (config->setpoint_weight_q8 != 0 && config->setpoint_weight_q8 != 256);

    return reference_pid_gains_lack(&config->gains) |
           lacking((weighted ? 0x02u : 0u) | (config->reverse ? 0x04u : 0u) |
                   (config->derivative_on_error ? 0x08u : 0u));
}

static bool gains_are_legal(const struct fixpid_pid_gains *gains)
{
    return gains->kp_q8 <= 32767 && gains->kd_q8 <= 32255 &&
           gains->ki_q24 <= 0x7FFF0000u && gains->derivative_filter <= 7 &&
           reference_pid_gains_lack(gains) == 0;
}

static void take_gains(struct reference_pid *self,
                       const struct fixpid_pid_gains *gains)
{
    const int64_t ki = gains->ki_q24;

    self->kp = gains->kp_q8;
    self->kd = gains->kd_q8;
    self->filter = gains->derivative_filter;
    if (ki <= 32767) {
        self->ki = ki;
        self->ki_divisor = ONE;
    } else if ((ki + 128) / 256 <= 32767) {
        self->ki = (ki + 128) / 256;
        self->ki_divisor = ONE / 256;
    } else {
        self->ki = (ki + 32768) / 65536;
        self->ki_divisor = ONE / 65536;
    }
}

// Both 0: no range of its own.
static void take_integral_limits(struct reference_pid *self, int64_t low,
                                 int64_t high)
{
    self->integral_min = low == 0 && high == 0 ? -32767 : low;
    self->integral_max = low == 0 && high == 0 ? 32767 : high;
}

bool reference_pid_init(struct reference_pid *self,
                        const struct fixpid_pid_config *config)
{
    memset(self, 0, sizeof *self);
    self->accepted = gains_are_legal(&config->gains) &&
                     reference_pid_lacks(config) == 0 &&
                     config->output_min < config->output_max &&
                     config->integral_min >= -32767 &&
                     config->integral_min <= config->integral_max &&
                     config->setpoint_weight_q8 <= 256 &&
                     (!config->proportional_on_measurement ||
                      config->setpoint_weight_q8 == 0);
    if (self->accepted) {
        take_gains(self, &config->gains);
        self->output_min = config->output_min;
        self->output_max = config->output_max;
        take_integral_limits(self, config->integral_min, config->integral_max);
        self->weight = config->setpoint_weight_q8;
        if (self->weight == 0 && !config->proportional_on_measurement) {
            self->weight = 256;
        }
        self->reverse = config->reverse;
        self->on_error = config->derivative_on_error;
    }
    reference_pid_reset(self);
    return self->accepted;
}

static void limit_integral(struct reference_pid *self)
{
    self->integral = reference_clamp(self->integral, ONE * self->integral_min,
                                     ONE * self->integral_max);
}

static bool is_held(const struct reference_pid *self)
{
    return self->manual || self->seeded;
}

// At rest, before the first step, the output would be the feed-forward, or what
// the output's range has nearest to it.
static void rest(struct reference_pid *self)
{
    self->integral = ONE * (reference_clamp(self->feedforward, self->output_min,
                                            self->output_max) -
                            self->feedforward);
    limit_integral(self);
}

void reference_pid_reset(struct reference_pid *self)
{
    self->derivative = 0;
    self->proportional_error = 0;
    self->previous = 0;
    self->feedforward = 0;
    self->held = 0;
    self->output = 0;
    self->seen = false;
    self->seeded = false;
    self->manual = false;
    self->at_max = false;
    self->at_min = false;
    self->integral_at_limit = false;
    rest(self);
}

bool reference_pid_set_gains(struct reference_pid *self,
                             const struct fixpid_pid_gains *gains)
{
    if (!self->accepted || !gains_are_legal(gains)) {
        return false;
    }
    take_gains(self, gains);
    return true;
}

bool reference_pid_set_limits(struct reference_pid *self, int64_t low,
                              int64_t high)
{
    const int64_t terms =
        self->kp * self->proportional_error + self->derivative;
    const int64_t forward = 256 * self->feedforward;

    if (!self->accepted || low >= high) {
        return false;
    }
    self->output_min = low;
    self->output_max = high;
    if (is_held(self)) {
        self->held = reference_clamp(self->held, low, high);
        return true;
    }
    if (!self->seen) {
        rest(self);
        return true;
    }
    self->integral = reference_clamp(
        self->integral, 65536 * (256 * low - forward - (terms > 0 ? terms : 0)),
        65536 * (256 * high - forward - (terms < 0 ? terms : 0)));
    limit_integral(self);
    return true;
}

bool reference_pid_set_integral_limits(struct reference_pid *self, int64_t low,
                                       int64_t high)
{
    if (!self->accepted || low < -32767 || low > high) {
        return false;
    }
    take_integral_limits(self, low, high);
    if (!is_held(self)) {
        limit_integral(self);
    }
    return true;
}

void reference_pid_set_feedforward(struct reference_pid *self, int64_t value)
{
    if (self->accepted) {
        self->feedforward = value;
        if (!self->seen && !is_held(self)) {
            rest(self);
        }
    }
}

void reference_pid_set_manual(struct reference_pid *self, int64_t output)
{
    self->manual = true;
    self->seeded = false;
    self->held = reference_clamp(output, self->output_min, self->output_max);
}

void reference_pid_set_auto(struct reference_pid *self)
{
    if (self->manual) {
        self->manual = false;
        self->seeded = true;
    }
}

void reference_pid_seed(struct reference_pid *self, int64_t output)
{
    self->held = reference_clamp(output, self->output_min, self->output_max);
    self->seeded = !self->manual;
}

// D, from the fall of what rises against the error, and what that is now.
static void differentiate(struct reference_pid *self, int64_t change,
                          int64_t input)
{
    const int64_t fall = self->seen ? int16_of(change) : 0;
    const int64_t leak =
        reference_floor_divide(self->derivative, INT64_C(1) << self->filter);

    self->seen = true;
    self->previous = input;
    self->derivative =
        reference_clamp(self->derivative - leak + self->kd * fall,
                        -DERIVATIVE_LIMIT, DERIVATIVE_LIMIT);
}

// P's and D's error and fall are known: the rest of a step.
static int64_t finish(struct reference_pid *self, int64_t error)
{
    int64_t others, integral, output;
    bool deeper;

    others = self->kp * self->proportional_error + self->derivative +
             256 * self->feedforward;
    self->at_max = false;
    self->at_min = false;
    self->integral_at_limit = false;
    if (self->manual) {
        self->output = self->held;
        return self->output;
    }
    integral = self->integral;
    if (self->seeded) {
        integral = 65536 * (256 * self->held - others);
    } else if (self->ki != 0) {
        integral += self->ki * error * (ONE / self->ki_divisor);
    }
    self->integral_at_limit = integral > ONE * self->integral_max ||
                              integral < ONE * self->integral_min;
    integral = reference_clamp(integral, ONE * self->integral_min,
                               ONE * self->integral_max);
    output = reference_floor_divide(
        others + reference_floor_divide(integral, 65536) + 128, 256);
    self->at_max = output > self->output_max;
    self->at_min = output < self->output_min;
    deeper = (self->at_max && error > 0) || (self->at_min && error < 0);
    if (self->seeded || !deeper) {
        self->integral = integral;
    }
    self->seeded = false;
    self->output = reference_clamp(output, self->output_min, self->output_max);
    return self->output;
}

// What a setpoint weight makes of the setpoint.
static int64_t weighted(const struct reference_pid *self, int64_t setpoint)
{
    return self->weight == 256
               ? setpoint
               : reference_floor_divide(self->weight * setpoint + 128, 256);
}

int64_t reference_pid_step(struct reference_pid *self, int64_t setpoint,
                           int64_t measurement)
{
    const int64_t sign = self->reverse ? -1 : 1;
    const int64_t error = int16_of(sign * (setpoint - measurement));
    const int64_t input = self->on_error ? -error : sign * measurement;

    if (!self->seen && !is_held(self)) {
        // The integral takes over what the weight leaves of the measurement.
        self->integral -=
            65536 * self->kp *
            int16_of(sign * (weighted(self, measurement) - measurement));
        limit_integral(self);
    }
    self->proportional_error =
        int16_of(sign * (weighted(self, setpoint) - measurement));
    differentiate(self, self->previous - input, input);
    return finish(self, error);
}

// value modulo 2^16, as a number of two's complement
static int64_t wrapped(int64_t value)
{
    return value - 65536 * reference_floor_divide(value + 32768, 65536);
}

int64_t reference_pid_step_error(struct reference_pid *self, int64_t error,
                                 int64_t rise)
{
    const int64_t sign = self->reverse ? -1 : 1;
    const int64_t counts = int16_of(sign * error);

    self->proportional_error = counts;
    if (self->on_error) {
        differentiate(self, self->previous + counts, -counts);
    } else {
        // sign * previous is the measurement
        differentiate(self, -sign * rise,
                      sign * wrapped(sign * self->previous + rise));
    }
    return finish(self, counts);
}

void reference_pid_track(struct reference_pid *self, int64_t applied,
                         int64_t shift)
{
    const int64_t missing = int16_of(applied - self->output);
    const int64_t divisor = INT64_C(1) << reference_clamp(shift, 0, 15);

    if (!self->accepted || !self->seen) {
        return;
    }
    self->output = applied;
    if (!is_held(self)) {
        self->integral += missing * (ONE / divisor);
        limit_integral(self);
    }
}

int64_t reference_pid_proportional(const struct reference_pid *self)
{
    return self->kp * self->proportional_error;
}

int64_t reference_pid_integral(const struct reference_pid *self)
{
    return is_held(self) ? 65536 * self->held
                         : reference_floor_divide(self->integral, 256);
}

uint8_t reference_pid_flags(const struct reference_pid *self)
{
    return (uint8_t)((self->at_max ? 0x01 : 0) | (self->at_min ? 0x02 : 0) |
                     (self->integral_at_limit ? 0x04 : 0) |
                     (self->accepted ? 0 : 0x80) | (self->seen ? 0 : 0x10) |
                     (self->seeded ? 0x20 : 0) | (self->manual ? 0x40 : 0));
}
