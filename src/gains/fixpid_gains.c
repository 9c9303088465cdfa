// SPDX-License-Identifier: MIT
#include "fixpid_gains.h"

// Stands for a quotient that 32 bits do not hold, and for the largest one that
// they do: no gain is as large.
#define TOO_MUCH ((uint32_t)0xFFFFFFFFu)

// 64 bits, in two words.
struct wide {
    uint32_t high;
    uint32_t low;
};

// a * b, from products of 16 bits.
static void multiply_wide(struct wide *product, uint32_t a, uint32_t b)
{
    const uint32_t a_low = a & 0xFFFFu;
    const uint32_t a_high = a >> 16;
    const uint32_t b_low = b & 0xFFFFu;
    const uint32_t b_high = b >> 16;
    const uint32_t low = a_low * b_low; // each at most (2^16 - 1)^2
    const uint32_t cross = a_high * b_low;
    // (2^16 - 1)^2 + 2 * (2^16 - 1) = 2^32 - 1 at most
    const uint32_t middle = (a_low * b_high) + (low >> 16) + (cross & 0xFFFFu);

    product->low = ((middle & 0xFFFFu) << 16) | (low & 0xFFFFu);
    product->high = (a_high * b_high) + (cross >> 16) + (middle >> 16);
}

// floor(a * b / divisor + 1 / 2), or TOO_MUCH. pre: 1 <= divisor <= 2^31
static uint32_t scaled(uint32_t a, uint32_t b, uint32_t divisor)
{
    struct wide rest; // the quotient's bits enter `low` as the dividend's leave
    uint8_t turn;

    multiply_wide(&rest, a, b);
    if (rest.high >= divisor) {
        return TOO_MUCH;
    }
    for (turn = 32; turn != 0u; turn--) {
        // high < divisor <= 2^31 before and after each turn
        rest.high = (rest.high << 1) | (rest.low >> 31);
        rest.low = (rest.low & UINT32_C(0x7FFFFFFF)) << 1;
        if (rest.high >= divisor) {
            rest.high -= divisor;
            rest.low |= 1u;
        }
    }
    if (rest.low == TOO_MUCH) {
        return TOO_MUCH;
    }
    return (rest.high >= (divisor - rest.high)) ? (rest.low + 1u) : rest.low;
}

static bool is_rate(uint32_t rate_milli)
{
    if (rate_milli == 0u) {
        return false;
    }
    return rate_milli <= FIXPID_GAINS_RATE_MAX;
}

// True if the gain that `milli` became is at most `most`, and is 0 only if
// `milli` is.
static bool is_gain(uint32_t gain, uint32_t milli, uint32_t most)
{
    if (gain > most) {
        return false;
    }
    if (milli == 0u) {
        return true;
    }
    return gain != 0u;
}

// True if ki is 0 or at least 8 / 2^24 per step: ki * 2^21 >= rate_milli.
static bool is_ki(uint32_t milli, uint32_t rate_milli)
{
    if (milli == 0u) {
        return true;
    }
    // 5 * 10^8 + 2^21 < 2^32
    return milli >= ((rate_milli + UINT32_C(0x1FFFFF)) >> 21);
}

bool fixpid_gains_from_milli(struct fixpid_pid_gains *gains,
                             const struct fixpid_gains_milli *milli,
                             uint32_t rate_milli, uint8_t filter)
{
    uint32_t kp;
    uint32_t ki;
    uint32_t kd;

    FIXPID_ASSERT(gains != 0);
    FIXPID_ASSERT(milli != 0);
    if (!is_rate(rate_milli)) {
        return false;
    }
    if (filter > FIXPID_PID_FILTER_MAX) {
        return false;
    }
    kp = scaled(milli->kp, 32u, 125u); // 256 / 1000
    if (!is_gain(kp, milli->kp, FIXPID_PID_KP_MAX)) {
        return false;
    }
    if (!is_ki(milli->ki, rate_milli)) {
        return false;
    }
    ki = scaled(milli->ki, UINT32_C(1) << 24, rate_milli);
    if (ki > FIXPID_PID_KI_MAX) {
        return false;
    }
    // 256 / 10^6 = 4 / 15625; 4 * 5 * 10^8 < 2^31, 15625 * 2^7 = 2000000
    kd = scaled(milli->kd, rate_milli * 4u, UINT32_C(15625) << filter);
    if (!is_gain(kd, milli->kd, FIXPID_PID_KD_MAX)) {
        return false;
    }
    gains->kp_q8 = (uint16_t)kp;
    gains->ki_q24 = ki;
    gains->kd_q8 = (uint16_t)kd;
    gains->derivative_filter = filter;
    return true;
}

static bool gains_legal(const struct fixpid_pid_gains *gains)
{
    if (gains->kp_q8 > FIXPID_PID_KP_MAX) {
        return false;
    }
    if (gains->ki_q24 > FIXPID_PID_KI_MAX) {
        return false;
    }
    if (gains->kd_q8 > FIXPID_PID_KD_MAX) {
        return false;
    }
    return gains->derivative_filter <= FIXPID_PID_FILTER_MAX;
}

bool fixpid_gains_to_milli(struct fixpid_gains_milli *milli,
                           const struct fixpid_pid_gains *gains,
                           uint32_t rate_milli)
{
    uint32_t ki;
    uint32_t kd;

    FIXPID_ASSERT(milli != 0);
    FIXPID_ASSERT(gains != 0);
    if (!is_rate(rate_milli)) {
        return false;
    }
    if (!gains_legal(gains)) {
        return false;
    }
    ki = scaled(gains->ki_q24, rate_milli, UINT32_C(1) << 24);
    if (ki == TOO_MUCH) {
        return false;
    }
    kd = scaled(gains->kd_q8, UINT32_C(15625) << gains->derivative_filter,
                rate_milli * 4u);
    if (kd == TOO_MUCH) {
        return false;
    }
    // 32767 * 125 + 16 = 4095891 < 2^32
    milli->kp = (((uint32_t)gains->kp_q8 * 125u) + 16u) >> 5;
    milli->ki = ki;
    milli->kd = kd;
    return true;
}
