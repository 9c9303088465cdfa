// SPDX-License-Identifier: MIT
#include "reference_reaction.h"

#include <string.h>

#define LISTEN_STEPS 32

static int64_t at_most(int64_t value, int64_t limit)
{
    return value < limit ? value : limit;
}

static int64_t at_least(int64_t value, int64_t limit)
{
    return value > limit ? value : limit;
}

// Counts from the start, the way of the heat-up.
static int64_t forward(const struct reference_reaction *self, int64_t y)
{
    const bool up = (self->config.output_drive > self->config.output_rest) !=
                    self->config.reverse;

    return up ? y - self->start : self->start - y;
}

bool reference_reaction_init(struct reference_reaction *self,
                             const struct fixpid_reaction_config *config)
{
    memset(self, 0, sizeof *self);
    if (config->output_rest == config->output_drive ||
        config->timeout_steps > 32767) {
        return false;
    }
    self->config = *config;
    if (config->timeout_steps == 0) {
        self->config.timeout_steps = 1000;
    }
    self->status = FIXPID_REACTION_RUNNING;
    return true;
}

void reference_reaction_reset(struct reference_reaction *self)
{
    const struct fixpid_reaction_config config = self->config;

    if (self->status != FIXPID_REACTION_REFUSED) {
        (void)reference_reaction_init(self, &config);
    }
}

static void listen(struct reference_reaction *self, int64_t y)
{
    int64_t x;

    if (self->listened == 0) {
        self->start = y;
    }
    x = forward(self, y);
    if (x > 511 || x < -511) {
        self->status = FIXPID_REACTION_MOVING;
        return;
    }
    self->low = at_most(self->low, x);
    self->high = at_least(self->high, x);
    *(self->listened < LISTEN_STEPS / 2 ? &self->first : &self->base) += x;
    if (++self->listened < LISTEN_STEPS) {
        return;
    }
    self->band = self->high - self->low;
    self->reach = at_least(
        at_most(forward(self, self->config.measurement_stop), 16384), 0);
    if (self->base - self->first > 5 * self->band + 16) {
        self->status = FIXPID_REACTION_MOVING;
    } else if (self->reach == 0) {
        self->status = FIXPID_REACTION_LIMIT;
    } else {
        self->scale = 1;
        while (self->scale < 16 && self->reach * self->scale * 2 <= 16384) {
            self->scale *= 2;
        }
        self->left = 1;
    }
}

static int64_t across(const struct reference_reaction *self, int64_t j)
{
    return at_least(self->m[j] - self->m[j - 2], 0);
}

// The largest of the rises that end in the first n blocks; and where.
static int64_t steepest(const struct reference_reaction *self, int64_t n,
                        int64_t *at)
{
    int64_t most = 0;

    for (int64_t j = 2; j < n; j++) {
        if (across(self, j) > most) {
            most = across(self, j);
            *at = j;
        }
    }
    return most;
}

static int64_t needed(const struct reference_reaction *self)
{
    return 4 * (self->band + 1) * self->scale;
}

static int64_t judge(const struct reference_reaction *self)
{
    const int64_t n = self->n;
    const int64_t newest = self->m[n - 1];
    const int64_t start = self->reach * self->scale;
    const int64_t need = needed(self);
    const int64_t rise = at_least(newest - start, 0);
    int64_t at = 0;
    const int64_t steep = steepest(self, n, &at);
    const int64_t before = steepest(self, n - 2, &at);
    const int64_t last = n < 3 ? 0 : across(self, n - 1);
    int64_t coming = steep / 16;

    if (start - newest > at_least(start / 4, need)) {
        return FIXPID_REACTION_WRONG_WAY;
    }
    if (n >= 6 && self->b >= 1 && last <= steep / 2 && rise / 2 >= need) {
        return FIXPID_REACTION_LEVELS_OFF;
    }
    if (n >= 6 && self->b >= 1 && last > steep / 2 && steep >= need &&
        last <= before + before / 8 && newest - self->m[n - 2] > steep / 4) {
        return FIXPID_REACTION_DONE;
    }
    if (n >= 5 && last > before) {
        coming += (last - before) / 16;
    }
    if (coming * (n + 1) >= start / 8) {
        return FIXPID_REACTION_LIMIT;
    }
    if (n == 8 && self->b == 12) {
        return FIXPID_REACTION_TOO_SLOW;
    }
    if (rise / 2 < need && n * (1 << self->b) >= self->config.timeout_steps) {
        return FIXPID_REACTION_NO_MOVEMENT;
    }
    return FIXPID_REACTION_RUNNING;
}

static void heat(struct reference_reaction *self, int64_t y)
{
    int64_t x = forward(self, y);

    if (self->n == 8) {
        for (int i = 0; i < 4; i++) {
            self->m[i] = (self->m[2 * i] + self->m[2 * i + 1]) / 2;
        }
        self->n = 4;
        self->b++;
        self->left *= 2;
    }
    if (x >= self->reach) {
        self->status = FIXPID_REACTION_LIMIT;
        return;
    }
    x = at_least(x, -self->reach);
    if (self->band == 0) {
        self->band = at_most(x < 0 ? -x : x, 1022);
    }
    self->sum += (x + self->reach) * self->scale;
    if (--self->left == 0) {
        self->m[self->n++] = self->sum >> self->b;
        self->sum = 0;
        self->left = 1 << self->b;
        self->status = judge(self);
    }
}

int64_t reference_reaction_step(struct reference_reaction *self,
                                int64_t measurement)
{
    if (self->status == FIXPID_REACTION_RUNNING) {
        if (self->listened < LISTEN_STEPS) {
            listen(self, measurement);
        } else {
            heat(self, measurement);
        }
    }
    if (self->status == FIXPID_REACTION_REFUSED) {
        return 0;
    }
    return self->status == FIXPID_REACTION_RUNNING &&
                   self->listened == LISTEN_STEPS
               ? self->config.output_drive
               : self->config.output_rest;
}

int64_t reference_reaction_progress(const struct reference_reaction *self)
{
    const int64_t start = self->reach * self->scale;

    if (self->status != FIXPID_REACTION_RUNNING) {
        return 100;
    }
    if (self->listened < LISTEN_STEPS) {
        return self->listened / 4;
    }
    if (self->n == 0) {
        return 8;
    }
    return at_most(98, 8 + 90 *
                               (at_least(self->m[self->n - 1] - start, 0) / 2) /
                               needed(self));
}

// a * 2^places / b; UINT32_MAX at most, and for b = 0.
static int64_t ratio(int64_t a, int64_t b, int64_t places)
{
    if (b == 0 || (a << places) / b > UINT32_MAX) {
        return UINT32_MAX;
    }
    return (a << places) / b;
}

// The rise d of the steepest two blocks; its tangent's height above the
// output's change, in quarters of 1 / scale counts.
static int64_t tangent(const struct reference_reaction *self, int64_t *height)
{
    int64_t at = 2;
    const int64_t d = steepest(self, self->n, &at);
    const int64_t start = self->reach * self->scale;
    const int64_t *const m = &self->m[at];
    const int64_t missed = d * (2 * at - 1) - (m[0] + 2 * m[-1] + m[-2]) +
                           4 * start + (self->base * self->scale >> 2);

    *height =
        at_least(missed, 0) + 2 * self->band * self->scale + (3 * d >> self->b);
    return d;
}

static int64_t change(const struct reference_reaction *self)
{
    const int64_t du =
        (int64_t)self->config.output_drive - self->config.output_rest;

    return du < 0 ? -du : du;
}

static int64_t scale_bits(const struct reference_reaction *self)
{
    int64_t bits = 0;

    while (self->scale >> bits > 1) {
        bits++;
    }
    return bits;
}

bool reference_reaction_model(const struct reference_reaction *self,
                              struct fixpid_reaction_process *process)
{
    int64_t height;
    int64_t d;

    if (self->status != FIXPID_REACTION_DONE) {
        return false;
    }
    d = tangent(self, &height);
    process->slope_q24 =
        (uint32_t)ratio(d, change(self), 23 - self->b - scale_bits(self));
    process->dead_q4 = (uint32_t)ratio(height, d, self->b + 3);
    process->noise_q4 = (uint16_t)(4 * self->band);
    return true;
}

static bool take_gains(struct fixpid_pid_gains *gains, int64_t kp, int64_t ki,
                       int64_t kd, int64_t filter)
{
    if (kp > 32767 || ki < 8 || ki > 0x7FFF0000 || kd > 32255) {
        return false;
    }
    gains->kp_q8 = (uint16_t)kp;
    gains->ki_q24 = (uint32_t)ki;
    gains->kd_q8 = (uint16_t)kd;
    gains->derivative_filter = (uint8_t)filter;
    return true;
}

bool reference_reaction_result(const struct reference_reaction *self,
                               int64_t rule, int64_t robustness_q4,
                               struct fixpid_pid_gains *gains)
{
    int64_t height;
    int64_t d;
    int64_t kp;
    int64_t c;
    int64_t filter = 1;

    if (self->status != FIXPID_REACTION_DONE || rule < 0 || rule > 1 ||
        robustness_q4 < 8 || robustness_q4 > 64) {
        return false;
    }
    d = tangent(self, &height);
    height = height * (robustness_q4 + 18) * 19 / 256;
    kp = ratio(change(self), height, scale_bits(self) + 10);
    c = ratio(height, d, self->b + 3);
    if (kp > 32767 || c > (INT64_C(1) << 26) - 1) {
        return false;
    }
    if (rule == FIXPID_REACTION_PI) {
        return take_gains(gains, kp, ratio(kp, 3 * c, 20), 0, 0);
    }
    kp += kp / 4;
    for (int64_t lag = c >> 10; lag > 1 && filter < 7; lag /= 2) {
        filter++;
    }
    return c >> filter <= 65535 && take_gains(gains, kp, ratio(kp, 2 * c, 20),
                                              kp * (c >> filter) >> 7, filter);
}
