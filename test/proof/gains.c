// SPDX-License-Identifier: MIT
// fixpid_gains against its header, whatever its quotients are: those of 64 bits
// are for its unit test, because a solver is slow at them.
#include "prove.h"

#include "fixpid_gains.h"

struct fixpid_gains_milli nondet_milli(void);
struct fixpid_pid_gains nondet_pid_gains(void);

#include "gains/fixpid_gains.c"

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

// floor(a * b / divisor + 1 / 2), of which is known here only that it is one
// function, and 0 of 0.
uint32_t __CPROVER_uninterpreted_quotient(uint32_t a, uint32_t b,
                                          uint32_t divisor);

static uint32_t quotient(uint32_t a, uint32_t b, uint32_t divisor)
{
    const uint32_t q = __CPROVER_uninterpreted_quotient(a, b, divisor);

    assume((a != 0u) || (q == 0u));
    return q;
}

uint32_t scaled_contract(uint32_t a, uint32_t b, uint32_t divisor)
{
    pre(inside(divisor, 1, (number)1 << 31));
    return quotient(a, b, divisor);
}

static bool in_range(number gain, number milli, number most)
{
    return (gain <= most) && ((gain != 0) || (milli == 0));
}

static bool same_gains(const struct fixpid_pid_gains *a,
                       const struct fixpid_pid_gains *b)
{
    return (a->kp_q8 == b->kp_q8) && (a->ki_q24 == b->ki_q24) &&
           (a->kd_q8 == b->kd_q8) &&
           (a->derivative_filter == b->derivative_filter);
}

// What is legal is converted, and nothing else. By contract: scaled.
void prove_from_milli(void)
{
    const struct fixpid_gains_milli milli = nondet_milli();
    const struct fixpid_pid_gains before = nondet_pid_gains();
    const uint32_t rate = nondet_uint32();
    const uint8_t filter = nondet_uint8();
    struct fixpid_pid_gains gains = before;
    const bool accepted = fixpid_gains_from_milli(&gains, &milli, rate, filter);

    if (!legal_rate(rate) || (filter > FIXPID_PID_FILTER_MAX)) {
        claim(!accepted);
    } else {
        // kp / 1000 * 256, ki / 1000 / (rate / 1000) * 2^24, and
        // kd / 1000 * (rate / 1000) / 2^filter * 256
        const number kp = quotient(milli.kp, 32, 125);
        const number ki = quotient(milli.ki, (uint32_t)1 << 24, rate);
        const number kd =
            quotient(milli.kd, rate * 4u, (uint32_t)15625 << filter);

        claim(accepted ==
              (in_range(kp, milli.kp, FIXPID_PID_KP_MAX) &&
               in_range(kd, milli.kd, FIXPID_PID_KD_MAX) &&
               (ki <= FIXPID_PID_KI_MAX) &&
               // at least 8 / 2^24
               ((milli.ki == 0u) || ((number)milli.ki << 21 >= (number)rate))));
        if (accepted) {
            claim(legal_gains(&gains));
            claim((gains.kp_q8 == kp) && (gains.ki_q24 == ki) &&
                  (gains.kd_q8 == kd) && (gains.derivative_filter == filter));
        }
    }
    if (!accepted) {
        claim(same_gains(&gains, &before));
    }
}

// The other way round: kp, ki * (rate / 1000) and kd / (rate / 1000) * 2^filter
// in thousandths. By contract: scaled.
void prove_to_milli(void)
{
    const struct fixpid_pid_gains gains = nondet_pid_gains();
    const struct fixpid_gains_milli before = nondet_milli();
    const uint32_t rate = nondet_uint32();
    struct fixpid_gains_milli milli = before;
    const bool accepted = fixpid_gains_to_milli(&milli, &gains, rate);

    if (!legal_rate(rate) || !legal_gains(&gains)) {
        claim(!accepted);
    } else {
        const uint32_t ki = quotient(gains.ki_q24, rate, (uint32_t)1 << 24);
        const uint32_t kd = quotient(
            gains.kd_q8, (uint32_t)15625 << gains.derivative_filter, rate * 4u);

        claim(accepted == ((ki != UINT32_MAX) && (kd != UINT32_MAX)));
        if (accepted) {
            // kp / 256 * 1000, half up
            claim(milli.kp == floor_by(((number)gains.kp_q8 * 125) + 16, 5));
            claim((milli.ki == ki) && (milli.kd == kd));
        }
    }
    if (!accepted) {
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
