// SPDX-License-Identifier: MIT
// What an experiment that is over tells. It has its own file because SDCC links
// whole object files.
#include "fixpid_reaction.h"

#include "../common/fixpid_difference.h"
#include "fixpid_reaction_private.h"

#define TOO_MUCH ((uint32_t)0xFFFFFFFFu)
#define DELAY_MAX ((uint32_t)0x3FFFFFFu) // so that three of them have 28 bits
#define KD_DELAY_MAX 65535u
#define KI_MIN 8u
#define LONGEST_FILTER 7u

#define ROBUSTNESS_MIN 8u
#define ROBUSTNESS_MAX 64u
#define ONCE 256u // the factor of a height as it is

// The steepest slope, carried back to the change of the output.
struct tangent {
    uint32_t height;   // how far below the start it is there, x 4 * 2^scale
    uint32_t delay_q4; // the steps in which it rises by that
    uint16_t rise;     // in two blocks, x 2^scale
    uint16_t change;   // of the output, 1..65535
};

// floor(a * 2^places / b), or TOO_MUCH where that is not below 2^32, and for
// b = 0. pre: b <= 2^31
static uint32_t ratio(uint32_t a, uint32_t b, uint8_t places)
{
    uint32_t dividend = a;
    uint32_t rest = 0; // below b
    uint32_t quotient = 0;
    uint8_t turn;

    for (turn = (uint8_t)(32u + places); turn != 0u; turn--) {
        if ((quotient >> 31) != 0u) {
            return TOO_MUCH;
        }
        quotient <<= 1;
        rest = (rest << 1) | (dividend >> 31);
        dividend <<= 1;
        if (rest >= b) {
            rest -= b;
            quotient |= 1u;
        }
    }
    return quotient;
}

// In quarters of 2^-scale counts, below 2^20: what the tangent misses, half of
// the noise's band, and one and a half steps of slope for the hold and the
// sampling.
static uint32_t height_of(FIXPID_DATA const struct fixpid_reaction *self,
                          const struct fixpid_reaction_rises *rises)
{
    FIXPID_DATA const uint16_t *const block = &SELF.record[rises->place - 2u];
    const uint8_t blocks = (uint8_t)((rises->place << 1) - 1u); // 3..13
    int32_t base = SELF.base;
    uint32_t three_halves = (uint32_t)rises->steepest * 3u;
    int32_t height;
    uint8_t places;

    for (places = SELF.scale & SCALE; places != 0u; places--) {
        base += base; // at most 2^13 * 2^4
    }
    for (places = SELF.doubled & DOUBLED; places != 0u; places--) {
        three_halves >>= 1;
    }
    height = (int32_t)(((uint32_t)rises->steepest * blocks) +
                       ((uint32_t)fixpid_reaction_origin(self) << 2));
    height -=
        (int32_t)((uint32_t)block[0] + ((uint32_t)block[1] << 1) + block[2]);
    height += base >> 2; // Deviation 10.1: rounds down
    if (height < 0) {
        height = 0;
    }
    return (uint32_t)height + three_halves +
           ((uint32_t)fixpid_reaction_scaled(self, SELF.band) << 1);
}

// With factor / 256 of the height. False unless the experiment is done.
static bool take_tangent(FIXPID_DATA const struct fixpid_reaction *self,
                         uint16_t factor, struct tangent *tangent)
{
    struct fixpid_reaction_rises rises;

    if (SELF.state != FIXPID_REACTION_DONE) {
        return false;
    }
    fixpid_reaction_measure(self, &rises);
    tangent->rise = rises.steepest;
    tangent->height = (height_of(self, &rises) * factor) >> 8; // 1558 at most
    tangent->delay_q4 = ratio(tangent->height, tangent->rise,
                              (uint8_t)((SELF.doubled & DOUBLED) + 3u));
    tangent->change =
        (SELF.output_drive > SELF.output_rest)
            ? fixpid_difference(SELF.output_drive, SELF.output_rest)
            : fixpid_difference(SELF.output_rest, SELF.output_drive);
    return true;
}

bool fixpid_reaction_model(FIXPID_DATA const struct fixpid_reaction *self,
                           struct fixpid_reaction_process *process)
{
    struct tangent tangent;
    uint8_t places;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(process != 0);
    if (!take_tangent(self, ONCE, &tangent)) {
        return false;
    }
    places = (uint8_t)(23u - (SELF.doubled & DOUBLED) - (SELF.scale & SCALE));
    process->slope_q24 = ratio(tangent.rise, tangent.change, places);
    process->dead_q4 = tangent.delay_q4;
    process->noise_q4 = (uint16_t)(SELF.band << 2); // a band is four of them
    return true;
}

static bool is_legal(uint32_t kp_q8, uint32_t ki_q24, uint32_t kd_q8)
{
    if (kp_q8 > FIXPID_PID_KP_MAX) {
        return false;
    }
    if (ki_q24 < KI_MIN) {
        return false;
    }
    if (ki_q24 > FIXPID_PID_KI_MAX) {
        return false;
    }
    return kd_q8 <= FIXPID_PID_KD_MAX;
}

// A filter that lags a quarter of the derivative's time, or two steps: 1..7
static uint8_t filter_of(uint32_t delay_q4)
{
    uint16_t lag = (uint16_t)(delay_q4 >> 10); // at most 2^16 - 1
    uint8_t filter;

    for (filter = 1; filter < LONGEST_FILTER; filter++) {
        if (lag <= 1u) {
            break;
        }
        lag >>= 1;
    }
    return (filter > FIXPID_PID_FILTER_MAX) ? (uint8_t)FIXPID_PID_FILTER_MAX
                                            : filter;
}

static bool take_gains(struct fixpid_pid_gains *gains, uint8_t rule,
                       uint32_t kp_pi, uint32_t delay_q4)
{
    uint32_t kp = kp_pi;
    uint32_t reset = delay_q4 << 1; // below 2^28
    uint32_t ki;
    uint32_t kd = 0;
    uint8_t filter = 0;

    if (rule == FIXPID_REACTION_PI) {
        reset += delay_q4;
    } else {
        kp += kp >> 2;
        filter = filter_of(delay_q4);
        kd = delay_q4 >> filter;
        if (kd > KD_DELAY_MAX) {
            return false;
        }
        kd = (kp * kd) >> 7; // kp C / 8 / 2^filter
    }
    ki = ratio(kp, reset, 20);
    if (!is_legal(kp, ki, kd)) {
        return false;
    }
    gains->kp_q8 = (uint16_t)kp;
    gains->ki_q24 = ki;
    gains->kd_q8 = (uint16_t)kd;
    gains->derivative_filter = filter;
    return true;
}

bool fixpid_reaction_result(FIXPID_DATA const struct fixpid_reaction *self,
                            uint8_t rule, uint8_t robustness_q4,
                            struct fixpid_pid_gains *gains)
{
    struct tangent tangent;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(gains != 0);
    if (rule > FIXPID_REACTION_PID) {
        return false;
    }
    if (robustness_q4 < ROBUSTNESS_MIN) {
        return false;
    }
    if (robustness_q4 > ROBUSTNESS_MAX) {
        return false;
    }
    if (!take_tangent(self, (uint16_t)((robustness_q4 + 18u) * 19u),
                      &tangent)) {
        return false;
    }
    if (tangent.delay_q4 > DELAY_MAX) {
        return false;
    }
    return take_gains(gains, rule,
                      ratio(tangent.change, tangent.height,
                            (uint8_t)((SELF.scale & SCALE) + 10u)),
                      tangent.delay_q4);
}
