// SPDX-License-Identifier: MIT
#include "reference.h"

#include <string.h>

#include "fixpid_an964.h"
#include "fixpid_an964_8bit.h"

int64_t reference_clamp(int64_t value, int64_t low, int64_t high)
{
    return value < low ? low : value > high ? high : value;
}

int64_t reference_floor_divide(int64_t dividend, int64_t divisor)
{
    const int64_t remainder = dividend % divisor;
    return dividend / divisor - (remainder < 0 ? 1 : 0);
}

void reference_an937_init(struct reference_an937 *self, int64_t kp, int64_t ki,
                          int64_t kd, int64_t limit, int64_t period)
{
    memset(self, 0, sizeof *self);
    self->countdown = 1;
    self->kp = kp;
    self->ki = ki;
    self->kd = kd;
    self->limit = limit;
    self->period = period;
}

void reference_an937_tick(struct reference_an937 *self)
{
    self->overrun = self->overrun || self->pending;
    self->pending = true;
}

int64_t reference_an937_step(struct reference_an937 *self, int64_t error)
{
    const int64_t most = (INT64_C(1) << 24) - 1;
    int64_t total;

    self->error = error;
    self->limited = false;
    if (self->pending) {
        const int64_t accumulated = self->accumulated + error;
        self->pending = false;
        self->accumulated =
            reference_clamp(accumulated, -self->limit, self->limit);
        self->limited = self->accumulated != accumulated;
        self->countdown--;
        if (self->countdown == 0) {
            self->countdown = self->period;
            self->delta = error - self->previous;
            self->previous = error;
        }
    }
    self->proportional = self->kp * error;
    self->integral = self->ki * self->accumulated;
    self->derivative = self->kd * self->delta;
    total = self->proportional + self->integral + self->derivative;
    self->sum = reference_clamp(total, -most, most);
    self->saturated = self->sum != total;
    return self->sum / 16;
}

uint8_t reference_an937_stat1(const struct reference_an937 *self)
{
    return (uint8_t)((self->sum >= 0 ? 0x80 : 0) |
                     (self->derivative >= 0 ? 0x40 : 0) |
                     (self->previous >= 0 ? 0x10 : 0) |
                     (self->accumulated >= 0 ? 0x08 : 0) |
                     (self->error >= 0 ? 0x04 : 0) |
                     (self->accumulated == 0 ? 0x02 : 0) |
                     (self->error == 0 ? 0x01 : 0));
}

struct reference_an964_form reference_an964_10bit(void)
{
    const struct reference_an964_form form = {
        .error_limit = 1023,
        .sum_low = 1 - FIXPID_AN964_SUM_LIMIT,
        .sum_high = FIXPID_AN964_SUM_LIMIT,
        .sum_divisor = 256,
        .ki_divisor = 16,
        .kd_divisor = 32,
        .kp_divisor = 1024,
        .integral_limit = INT32_MAX,
        .term_limit = FIXPID_AN964_TERM_LIMIT,
        .total_limit = INT32_MAX,
        .output_limit = FIXPID_AN964_OUTPUT_LIMIT,
    };
    return form;
}

struct reference_an964_form reference_an964_8bit(void)
{
    const struct reference_an964_form form = {
        .error_limit = INT32_MAX,
        .sum_low = -FIXPID_AN964_8BIT_SUM_LIMIT,
        .sum_high = FIXPID_AN964_8BIT_SUM_LIMIT,
        .sum_divisor = 64,
        .ki_divisor = 8,
        .kd_divisor = 4,
        .kp_divisor = 32,
        .integral_limit = 127,
        .term_limit = FIXPID_AN964_8BIT_TERM_LIMIT,
        .total_limit = 127,
        .output_limit = INT32_MAX,
    };
    return form;
}

int64_t reference_an964_step(struct reference_an964 *self, int64_t error)
{
    const struct reference_an964_form *const form = &self->form;
    const int64_t e =
        reference_clamp(error, -form->error_limit, form->error_limit);
    const int64_t sum = self->sum + e;
    int64_t change, total, limited_total, output, limited_output;

    self->sum = reference_clamp(sum, form->sum_low, form->sum_high);
    self->integral = reference_clamp(
        self->sum / form->sum_divisor * self->ki / form->ki_divisor,
        -form->integral_limit, form->integral_limit);
    change = reference_clamp(e - self->history[2], -form->term_limit,
                             form->term_limit);
    self->derivative = reference_clamp(
        reference_floor_divide(change * self->kd, form->kd_divisor),
        -form->term_limit, form->term_limit);
    self->history[2] = self->history[1];
    self->history[1] = self->history[0];
    self->history[0] = e;
    self->proportional = e;
    total = e + self->integral + self->derivative;
    limited_total =
        reference_clamp(total, -form->total_limit, form->total_limit);
    output = limited_total * self->kp / form->kp_divisor;
    limited_output =
        reference_clamp(output, -form->output_limit, form->output_limit);
    self->sum_limited = self->sum != sum;
    self->output_limited = limited_total != total || limited_output != output;
    return limited_output;
}
