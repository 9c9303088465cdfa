// SPDX-License-Identifier: MIT
// What an experiment that is over tells. It has its own file because SDCC links
// whole object files.
#include "fixpid_reaction.h"

#include "../common/fixpid_bits.h"
#include "fixpid_reaction_private.h"

#define TOO_MUCH ((uint32_t)0xFFFFFFFFu)
#define DELAY_MAX ((uint32_t)0x3FFFFFFu) // so that three of them have 28 bits
#define LOWER_BITS ((uint32_t)0x7FFFFFFFu)
#define KD_DELAY_MAX 65535u
#define KI_MIN 8u
#define FILTERED 1023u // of a delay x 16: a quarter of Td, or two steps

#define ROBUSTNESS_MIN 8u
#define ROBUSTNESS_MAX 64u
#define ROBUSTER_BY 18u // 19 / 256 of the robustness and 18: at most 1558 / 256
#define ROBUST_FACTOR 19u
#define ONCE 256u // the factor of a height as it is

// floor(a * 2^places / b), or TOO_MUCH where that is not below 2^32, and for
// b = 0. pre: b <= 2^31
static uint32_t ratio(uint32_t a, uint32_t b, uint8_t places)
{
    uint32_t bits = a; // those of the quotient enter as those of a leave
    uint32_t rest = 0; // below b
    uint8_t turn;

    for (turn = (uint8_t)(32u + places); turn != 0u; turn--) {
        const bool carry = (bits >> 31) != 0u;

        rest = (rest & LOWER_BITS) << 1;
        bits = (bits & LOWER_BITS) << 1;
        if (carry) {
            if (turn <= places) {
                return TOO_MUCH;
            }
            rest |= 1u;
        }
        if (rest >= b) {
            rest -= b;
            bits |= 1u;
        }
    }
    return bits;
}

// From which block on the record rises most in two, the first of equals: 0..5;
// and by how much.
static uint8_t steepest(FIXPID_DATA const struct fixpid_reaction *self,
                        uint16_t *rise)
{
    uint16_t most = 0;
    uint8_t found = 0;
    uint8_t left;

    for (left = BLOCKS - 2u; left != 0u; left--) {
        const uint16_t low = SELF.record[left - 1u];
        const uint16_t high = SELF.record[left + 1u];

        if ((uint8_t)(left + 1u) < SELF.blocks) {
            if (high > low) {
                if ((uint16_t)(high - low) >= most) {
                    most = (uint16_t)(high - low);
                    found = (uint8_t)(left - 1u);
                }
            }
        }
    }
    *rise = most;
    return found;
}

// By what the tangent misses the start at the change of the output, in quarters
// of 2^-scale counts and below 2^20, with half of the noise's band, and with
// one and a half steps of slope for the hold and the sampling. The definition's
// sum of three blocks is twice that of two, because the rise is what they
// differ by.
static uint32_t height_of(FIXPID_DATA const struct fixpid_reaction *self,
                          uint8_t from, uint16_t rise)
{
    FIXPID_DATA const uint16_t *const block = &SELF.record[from];
    uint16_t hold = (uint16_t)(rise + (rise >> 1));
    int32_t base = SELF.base;
    int32_t height = (int32_t)rise * (int32_t)(uint8_t)(from + 1u);
    uint8_t places;

    for (places = SELF.scale & SCALE; places != 0u; places--) {
        base += base; // at most 2^13 * 2^4
    }
    for (places = SELF.doubled & DOUBLED; places > 1u; places--) {
        hold >>= 1;
    }
    height += (int32_t)fixpid_reaction_origin(self) * 2;
    height -= (int32_t)block[0];
    height -= (int32_t)block[1];
    height += height;
    height += shift_right_floor(base, 2);
    if (height < 0) {
        height = 0;
    }
    height += (int32_t)fixpid_reaction_scaled(self, SELF.band) * 2;
    return (uint32_t)height + hold;
}

// The process with factor / 256 of the height, and its kp_q8. pre: it is
// STATE_DONE
static uint32_t take_tangent(FIXPID_DATA const struct fixpid_reaction *self,
                             uint16_t factor,
                             struct fixpid_reaction_process *process)
{
    const uint8_t doubled = SELF.doubled & DOUBLED;
    const uint8_t scale = SELF.scale & SCALE;
    uint16_t rise;
    const uint8_t from = steepest(self, &rise);
    const uint32_t height = (height_of(self, from, rise) * factor) >> 8;
    uint16_t change =
        (uint16_t)((uint16_t)SELF.output_drive - (uint16_t)SELF.output_rest);

    if (SELF.output_drive < SELF.output_rest) {
        change = fixpid_negated(change);
    }
    process->slope_q24 = ratio(rise, change, (uint8_t)(23u - doubled - scale));
    process->dead_q4 = ratio(height, rise, (uint8_t)(doubled + 3u));
    process->noise_q4 = (uint16_t)(SELF.band << 2); // a band is four of them
    return ratio(change, height, (uint8_t)(scale + 10u));
}

bool fixpid_reaction_model(FIXPID_DATA const struct fixpid_reaction *self,
                           struct fixpid_reaction_process *process)
{
    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(process != 0);
    if (SELF.state != STATE_DONE) {
        return false;
    }
    (void)take_tangent(self, ONCE, process);
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

static bool take_gains(struct fixpid_pid_gains *gains, uint8_t rule,
                       uint32_t kp_pi, uint32_t delay_q4)
{
    uint32_t kp = kp_pi;
    uint32_t reset = delay_q4 << 1; // below 2^28
    uint32_t ki;
    uint32_t kd = 0;
    uint8_t filter = 0;

    if (rule == (uint8_t)FIXPID_REACTION_PI) {
        reset += delay_q4;
    } else {
        kp += kp >> 2;
        kd = delay_q4;
        while (filter != FIXPID_PID_FILTER_MAX) {
            kd >>= 1;
            filter++;
            if (kd <= FILTERED) {
                break;
            }
        }
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
    struct fixpid_reaction_process tangent;
    uint32_t kp;
    uint16_t factor = robustness_q4;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(gains != 0);
    if (rule > (uint8_t)FIXPID_REACTION_PID) {
        return false;
    }
    if (robustness_q4 < ROBUSTNESS_MIN) {
        return false;
    }
    if (robustness_q4 > ROBUSTNESS_MAX) {
        return false;
    }
    if (SELF.state != STATE_DONE) {
        return false;
    }
    factor = (uint16_t)(factor + ROBUSTER_BY);
    factor = (uint16_t)(factor * ROBUST_FACTOR);
    kp = take_tangent(self, factor, &tangent);
    if (kp > FIXPID_PID_KP_MAX) {
        return false;
    }
    if (tangent.dead_q4 > DELAY_MAX) {
        return false;
    }
    return take_gains(gains, rule, kp, tangent.dead_q4);
}
