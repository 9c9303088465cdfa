// SPDX-License-Identifier: MIT
#include "plain_c_an937.h"

#define SUM_MAX INT32_C(0xFFFFFF)

void plain_c_an937_init(struct plain_c_an937 *self,
                        const struct fixpid_an937_config *config)
{
    self->config = *config;
    self->accumulated_error = 0;
    self->delta = 0;
    self->sum = 0;
    self->error = 0;
    self->previous_error = 0;
    self->derivative_countdown = 1;
    self->tick_pending = false;
    self->tick_overrun = false;
    self->sum_saturated = false;
    self->accumulated_error_limited = false;
}

void plain_c_an937_tick(struct plain_c_an937 *self)
{
    if (self->tick_pending) {
        self->tick_overrun = true;
    }
    self->tick_pending = true;
}

static void accumulate(struct plain_c_an937 *self, int16_t error)
{
    const int32_t limit = self->config.accumulated_error_limit;
    int32_t accumulated = self->accumulated_error + error;

    if (accumulated > limit) {
        accumulated = limit;
        self->accumulated_error_limited = true;
    } else if (accumulated < -limit) {
        accumulated = -limit;
        self->accumulated_error_limited = true;
    }
    self->accumulated_error = accumulated;
}

static void differentiate(struct plain_c_an937 *self, int16_t error)
{
    self->derivative_countdown--;
    if (self->derivative_countdown == 0) {
        self->derivative_countdown = self->config.derivative_period_ticks;
        self->delta = (int32_t)error - self->previous_error;
        self->previous_error = error;
    }
}

int32_t plain_c_an937_step(struct plain_c_an937 *self, int16_t error)
{
    int32_t sum;

    self->error = error;
    self->accumulated_error_limited = false;
    self->sum_saturated = false;
    if (self->tick_pending) {
        self->tick_pending = false;
        accumulate(self, error);
        differentiate(self, error);
    }
    sum = (int32_t)self->config.kp_q4 * error +
          (int32_t)self->config.ki_q4 * self->accumulated_error +
          (int32_t)self->config.kd_q4 * self->delta;
    if (sum > SUM_MAX) {
        sum = SUM_MAX;
        self->sum_saturated = true;
    } else if (sum < -SUM_MAX) {
        sum = -SUM_MAX;
        self->sum_saturated = true;
    }
    self->sum = sum;
    return sum / 16;
}
