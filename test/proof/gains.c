// SPDX-License-Identifier: MIT
// fixpid_gains: nothing undefined, and what it gives is accepted by fixpid_pid
// or untouched. Its quotients of 64 bits are for its unit test: a solver is
// slow at them.
#include "prove.h"

#include "fixpid_gains.h"

struct fixpid_gains_milli nondet_milli(void);
struct fixpid_pid_gains nondet_pid_gains(void);

#include "fixpid_gains.c"

static bool legal_rate(number rate_milli)
{
    return inside(rate_milli, 1, FIXPID_GAINS_RATE_MAX);
}

static bool legal_gains(const struct fixpid_pid_gains *gains)
{
    return (gains->kp_q8 <= FIXPID_PID_KP_MAX) &&
           (gains->ki_q24 <= FIXPID_PID_KI_MAX) &&
           (gains->kd_q8 <= FIXPID_PID_KD_MAX) &&
           (gains->derivative_filter <= FIXPID_PID_FILTER_MAX);
}

// floor(a * b / divisor + 1 / 2) is anything here.
uint32_t scaled_contract(uint32_t a, uint32_t b, uint32_t divisor)
{
    const uint32_t quotient = nondet_uint32();

    (void)b;
    pre(inside(divisor, 1, (number)1 << 31));
    assume((a != 0u) || (quotient == 0u));
    return quotient;
}

// By contract: scaled.
void prove_from_milli(void)
{
    const struct fixpid_gains_milli milli = nondet_milli();
    const struct fixpid_pid_gains before = nondet_pid_gains();
    const uint32_t rate = nondet_uint32();
    const uint8_t filter = nondet_uint8();
    struct fixpid_pid_gains gains = before;

    if (fixpid_gains_from_milli(&gains, &milli, rate, filter)) {
        claim(legal_rate(rate) && legal_gains(&gains));
        claim((gains.kp_q8 == 0u) == (milli.kp == 0u));
        claim((gains.kd_q8 == 0u) == (milli.kd == 0u));
        claim(gains.derivative_filter == filter);
        // At least 8 / 2^24: ki / 1000 / (rate / 1000) * 2^24
        claim((milli.ki == 0u) || ((number)milli.ki << 21 >= (number)rate));
    } else {
        claim((gains.kp_q8 == before.kp_q8) &&
              (gains.ki_q24 == before.ki_q24) &&
              (gains.kd_q8 == before.kd_q8) &&
              (gains.derivative_filter == before.derivative_filter));
    }
}

// By contract: scaled.
void prove_to_milli(void)
{
    const struct fixpid_pid_gains gains = nondet_pid_gains();
    const struct fixpid_gains_milli before = nondet_milli();
    const uint32_t rate = nondet_uint32();
    struct fixpid_gains_milli milli = before;

    if (fixpid_gains_to_milli(&milli, &gains, rate)) {
        claim(legal_rate(rate) && legal_gains(&gains));
        // kp / 256 * 1000, half up
        claim(milli.kp == floor_by(((number)gains.kp_q8 * 125) + 16, 5));
    } else {
        claim((milli.kp == before.kp) && (milli.ki == before.ki) &&
              (milli.kd == before.kd));
    }
}

// Whatever it divides, it ends and does nothing undefined.
void prove_scaled(void)
{
    const uint32_t divisor = nondet_uint32();

    assume(inside(divisor, 1, (number)1 << 31));
    (void)scaled(nondet_uint32(), nondet_uint32(), divisor);
}
