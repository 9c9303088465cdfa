// SPDX-License-Identifier: MIT
#include "reference_control.h"

#include <string.h>

#include "reference.h"

void reference_slew_init(struct reference_slew *self, int64_t rise,
                         int64_t fall)
{
    self->value = 0;
    self->rise = rise;
    self->fall = fall;
}

void reference_slew_seed(struct reference_slew *self, int64_t value)
{
    self->value = value * 65536;
}

int64_t reference_slew_step(struct reference_slew *self, int64_t target)
{
    self->value +=
        reference_clamp(target * 65536 - self->value, -self->fall, self->rise);
    return reference_floor_divide(self->value + 32768, 65536);
}

bool reference_tpo_init(struct reference_tpo *self,
                        const struct fixpid_tpo_config *config)
{
    memset(self, 0, sizeof *self);
    if (config->full < 1 || config->window < 1 || config->window > 32767 ||
        (int32_t)config->minimum_on + config->minimum_off > config->window) {
        return false;
    }
    self->full = config->full;
    self->window = config->window;
    self->minimum_on = config->minimum_on;
    self->minimum_off = config->minimum_off;
    return true;
}

void reference_tpo_reset(struct reference_tpo *self)
{
    self->carry = 0;
    self->pulse = 0;
    self->at = 0;
}

static void open_window(struct reference_tpo *self, int64_t duty)
{
    const int64_t owed =
        self->carry + reference_clamp(duty, 0, self->full) * self->window;

    self->pulse = owed < 0 ? 0 : owed / self->full;
    if (self->pulse < self->minimum_on) {
        self->pulse = 0;
    }
    if (self->pulse > self->window ||
        self->window - self->pulse < self->minimum_off) {
        self->pulse = self->window;
    }
    self->carry = owed - self->pulse * self->full;
}

bool reference_tpo_step(struct reference_tpo *self, int64_t duty)
{
    bool on;

    if (self->full == 0) {
        return false;
    }
    if (self->at == 0) {
        open_window(self, duty);
    }
    on = self->at < self->pulse;
    self->at = (self->at + 1) % self->window;
    return on;
}

// A range of which both ends are 0 is another one.
static void guard_range(int64_t *low, int64_t *high, int64_t other_low,
                        int64_t other_high)
{
    if (*low == 0 && *high == 0) {
        *low = other_low;
        *high = other_high;
    }
}

bool reference_guard_init(struct reference_guard *self,
                          const struct fixpid_guard_config *config)
{
    struct reference_guard asked = {
        .output_min = config->output_min,
        .output_max = config->output_max,
        .measurement_min = config->measurement_min,
        .measurement_max = config->measurement_max,
        .reach_min = config->reach_min,
        .reach_max = config->reach_max,
        .band = config->band,
        .patience = config->patience,
        .reverse = config->reverse,
        .noisy = config->noisy,
    };

    guard_range(&asked.measurement_min, &asked.measurement_max, INT16_MIN,
                INT16_MAX);
    guard_range(&asked.reach_min, &asked.reach_max, asked.measurement_min,
                asked.measurement_max);
    memset(self, 0, sizeof *self);
    if (asked.output_min >= asked.output_max ||
        asked.measurement_min >= asked.measurement_max ||
        asked.reach_min < asked.measurement_min ||
        asked.reach_max > asked.measurement_max || asked.band < 1 ||
        asked.band > 32767 ||
        asked.reach_max - asked.reach_min <= 2 * asked.band ||
        asked.patience < 2 || asked.patience > 32767) {
        return false;
    }
    *self = asked;
    return true;
}

void reference_guard_reset(struct reference_guard *self)
{
    self->last = self->hold = self->mark = self->anchor = 0;
    self->zone = self->end = self->outside = REFERENCE_INSIDE;
    self->flags = 0;
    reference_guard_acknowledge(self);
}

void reference_guard_acknowledge(struct reference_guard *self)
{
    self->flags &= FIXPID_GUARD_SETTLED;
    self->count = self->run = self->swings = self->strikes = 0;
}

unsigned reference_guard_flags(const struct reference_guard *self)
{
    return self->patience == 0 ? FIXPID_GUARD_REFUSED : self->flags;
}

static int64_t up(int64_t a, int64_t b)
{
    return (a + b - 1) / b;
}

static int64_t guard_band(const struct fixpid_guard_model *model)
{
    const int64_t noise = up(8 * (int64_t)model->noise_q4 + 4 * 16, 16);
    const int64_t swing =
        model->gain_q8 == UINT32_MAX ? 0 : up(2 * (int64_t)model->gain_q8, 256);

    if (model->band != 0) {
        return model->band;
    }
    return swing > noise ? swing : noise;
}

bool reference_guard_from_model(struct fixpid_guard_config *config,
                                const struct fixpid_guard_model *model)
{
    const int64_t span = (int64_t)config->output_max - config->output_min;
    const int64_t band = guard_band(model);
    const int64_t bands = model->bands == 0 ? 20 : model->bands;
    int64_t patience;

    if (span <= 0 || model->slope_q24 == 0 || band > 32767) {
        return false;
    }
    // In eighths of a step, 2 L is dead_q4, and what is rounded up is whole.
    patience = up(model->dead_q4 +
                      up(8 * bands * band * 0x1000000, model->slope_q24 * span),
                  8);
    patience = patience < 4 ? 4 : patience;
    if (patience > 32767) {
        return false;
    }
    config->band = (uint16_t)band;
    config->patience = (uint16_t)patience;
    config->noisy = model->noise_q4 >= 16 && patience >= 16;
    return true;
}

static void guard_range_step(struct reference_guard *self, int64_t y)
{
    if (y >= self->measurement_min && y <= self->measurement_max) {
        self->strikes = 0;
    } else if (++self->strikes == 4) {
        self->strikes = 0;
        self->flags |= y < self->measurement_min ? FIXPID_GUARD_SENSOR_LOW
                                                 : FIXPID_GUARD_SENSOR_HIGH;
    }
}

static int64_t distance(int64_t a, int64_t b)
{
    return a < b ? b - a : a - b;
}

static void guard_frozen_step(struct reference_guard *self, int64_t y,
                              int64_t u)
{
    const int64_t quarter = (self->output_max - self->output_min) / 4;

    if (y != self->last || y < self->reach_min || y > self->reach_max) {
        self->last = y;
        self->run = 0;
    } else if (self->run < self->patience) {
        self->run++;
        self->hold = self->run == self->patience ? u : self->hold;
    } else if (self->noisy || distance(u, self->hold) > quarter) {
        if (++self->run == 2 * self->patience) {
            self->run = 0;
            self->flags |= FIXPID_GUARD_FROZEN;
        }
    }
}

static void guard_enter(struct reference_guard *self, enum reference_zone zone,
                        int64_t r, int64_t y)
{
    self->zone = zone;
    self->mark = y;
    self->count = 0;
    if (zone == REFERENCE_INSIDE) {
        return;
    }
    self->flags &= ~(unsigned)FIXPID_GUARD_SETTLED;
    if (distance(r, self->anchor) > self->band) {
        self->anchor = r;
        self->swings = 0;
    } else if (self->outside != REFERENCE_INSIDE && self->outside != zone &&
               ++self->swings == 12) {
        self->swings = 0;
        self->flags |= FIXPID_GUARD_OSCILLATING;
    }
    self->outside = zone;
}

static void guard_alarm(struct reference_guard *self, enum reference_zone end)
{
    self->count = 0;
    self->flags |= end == REFERENCE_BELOW ? FIXPID_GUARD_NOT_RISING
                                          : FIXPID_GUARD_NOT_FALLING;
}

static void guard_outside(struct reference_guard *self, int64_t y,
                          enum reference_zone end)
{
    const int64_t nearer =
        self->zone == REFERENCE_BELOW ? y - self->mark : self->mark - y;

    if (nearer < 0 || nearer >= self->band) {
        self->mark = y;
    }
    if (nearer >= self->band) {
        self->count = 0;
    } else if (end == self->zone && ++self->count == self->patience) {
        guard_alarm(self, end);
    }
}

static void guard_inside(struct reference_guard *self, enum reference_zone end)
{
    if (end != REFERENCE_INSIDE) {
        if (self->count > 0 || end != self->end) {
            self->count = 0;
        }
        self->end = end;
        if (--self->count == -self->patience) {
            guard_alarm(self, end);
        }
    } else if (++self->count == self->patience) {
        self->count = 0;
        self->swings = 0;
        self->outside = REFERENCE_INSIDE;
        self->flags |= FIXPID_GUARD_SETTLED;
    }
}

static enum reference_zone guard_end(const struct reference_guard *self,
                                     int64_t u)
{
    if (u >= self->output_max) {
        return self->reverse ? REFERENCE_ABOVE : REFERENCE_BELOW;
    }
    if (u <= self->output_min) {
        return self->reverse ? REFERENCE_BELOW : REFERENCE_ABOVE;
    }
    return REFERENCE_INSIDE;
}

unsigned reference_guard_step(struct reference_guard *self, int64_t setpoint,
                              int64_t measurement, int64_t output)
{
    const int64_t goal =
        reference_clamp(setpoint, self->reach_min, self->reach_max);
    const int64_t band =
        self->zone == REFERENCE_INSIDE ? self->band : self->band / 2;
    const enum reference_zone end = guard_end(self, output);
    enum reference_zone zone = REFERENCE_INSIDE;

    if (self->patience == 0) {
        return FIXPID_GUARD_REFUSED;
    }
    guard_range_step(self, measurement);
    guard_frozen_step(self, measurement, output);
    if (goal - measurement > band) {
        zone = REFERENCE_BELOW;
    } else if (measurement - goal > band) {
        zone = REFERENCE_ABOVE;
    }
    if (zone != self->zone) {
        guard_enter(self, zone, setpoint, measurement);
    }
    if (zone != REFERENCE_INSIDE) {
        guard_outside(self, measurement, end);
    } else if (goal == setpoint && goal != measurement) {
        guard_inside(self, end);
    } else {
        guard_inside(self, REFERENCE_INSIDE);
    }
    return self->flags;
}

// floor(a / b + 1 / 2) of numbers that are not negative, below 2^63
static uint64_t half_up(uint64_t a, uint64_t b)
{
    return a / b + (a % b >= b - a % b ? 1u : 0u);
}

static bool are_legal(uint64_t kp, uint64_t ki, uint64_t kd, int64_t filter)
{
    return kp <= 32767 && ki <= 0x7FFF0000 && kd <= 32255 && filter <= 7;
}

static bool is_rate(int64_t rate_milli)
{
    return rate_milli >= 1 && rate_milli <= 500000000;
}

bool reference_gains_from_milli(struct fixpid_pid_gains *gains,
                                const struct fixpid_gains_milli *milli,
                                int64_t rate_milli, int64_t filter)
{
    const uint64_t rate = (uint64_t)rate_milli;
    uint64_t kp, ki, kd;

    if (!is_rate(rate_milli) || filter > 7) {
        return false;
    }
    kp = half_up((uint64_t)milli->kp * 256, 1000);
    ki = half_up((uint64_t)milli->ki << 24, rate);
    // kd * rate * 256 / 10^6 in lowest terms: below 2^32 * 2^31
    kd = half_up(milli->kd * (rate * 4), UINT64_C(15625) << filter);
    if (!are_legal(kp, ki, kd, filter) || (milli->kp != 0 && kp == 0) ||
        (milli->kd != 0 && kd == 0) ||
        (milli->ki != 0 && (uint64_t)milli->ki << 21 < rate)) {
        return false;
    }
    gains->kp_q8 = (uint16_t)kp;
    gains->ki_q24 = (uint32_t)ki;
    gains->kd_q8 = (uint16_t)kd;
    gains->derivative_filter = (uint8_t)filter;
    return true;
}

bool reference_gains_to_milli(struct fixpid_gains_milli *milli,
                              const struct fixpid_pid_gains *gains,
                              int64_t rate_milli)
{
    const uint64_t rate = (uint64_t)rate_milli;
    uint64_t ki, kd;

    if (!is_rate(rate_milli) ||
        !are_legal(gains->kp_q8, gains->ki_q24, gains->kd_q8,
                   gains->derivative_filter)) {
        return false;
    }
    ki = half_up(gains->ki_q24 * rate, UINT64_C(1) << 24);
    kd = half_up((UINT64_C(15625) * gains->kd_q8) << gains->derivative_filter,
                 rate * 4);
    if (ki > 4294967294 || kd > 4294967294) {
        return false;
    }
    milli->kp = (uint32_t)half_up(UINT64_C(1000) * gains->kp_q8, 256);
    milli->ki = (uint32_t)ki;
    milli->kd = (uint32_t)kd;
    return true;
}

bool reference_table_valid(const struct fixpid_table *self)
{
    for (int i = 1; i < self->count; i++) {
        if (self->points[i].x <= self->points[i - 1].x) {
            return false;
        }
    }
    return self->count >= 2;
}

static int64_t floor_of(int64_t dividend, int64_t divisor)
{
    const int64_t quotient = dividend / divisor;

    return quotient * divisor > dividend ? quotient - 1 : quotient;
}

int64_t reference_table_at(const struct fixpid_table *self, int64_t x)
{
    const struct fixpid_table_point *const p = self->points;
    int i = 0;

    while (i < self->count && p[i].x <= x) {
        i++;
    }
    if (self->count == 0) {
        return 0;
    }
    if (i == 0 || i == self->count) {
        return p[i == 0 ? 0 : i - 1].y;
    }
    // floor(a / b + 1/2) = floor((2 a + b) / (2 b))
    {
        const int64_t run = (int64_t)p[i].x - p[i - 1].x;
        const int64_t rise = (int64_t)p[i].y - p[i - 1].y;

        return p[i - 1].y +
               floor_of(2 * rise * (x - p[i - 1].x) + run, 2 * run);
    }
}
