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
