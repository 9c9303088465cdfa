// SPDX-License-Identifier: MIT
// fixpid_gains against its header. Its conversions are proved whatever their
// quotients are, a quotient turn by turn, and the product that it divides with
// a power of two on either side: a solver is slow at others.
#include "prove.h"

#include "fixpid_gains.h"

struct fixpid_gains_milli nondet_milli(void);
struct fixpid_pid_gains nondet_pid_gains(void);

struct wide;
static bool at_turn(struct wide *rest, uint8_t *turn, uint32_t divisor);

// clang-format would make another macro of it.
// clang-format off
#define for(head) for (head) if (at_turn(&rest, &turn, divisor))
// clang-format on
#include "gains/fixpid_gains.c"
#undef for

struct wide nondet_wide(void);

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

static uint32_t assume_quotient(uint32_t a, uint32_t b, uint32_t divisor)
{
    const uint32_t q = __CPROVER_uninterpreted_quotient(a, b, divisor);

    assume((a != 0u) || (q == 0u));
    return q;
}

uint32_t scaled_contract(uint32_t a, uint32_t b, uint32_t divisor)
{
    pre(inside(divisor, 1, (number)1 << 31));
    return assume_quotient(a, b, divisor);
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
        const number kp = assume_quotient(milli.kp, 32, 125);
        const number ki = assume_quotient(milli.ki, (uint32_t)1 << 24, rate);
        const number kd =
            assume_quotient(milli.kd, rate * 4u, (uint32_t)15625 << filter);

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
        const uint32_t ki =
            assume_quotient(gains.ki_q24, rate, (uint32_t)1 << 24);
        const uint32_t kd = assume_quotient(
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

static struct wide dividend;

void multiply_wide_contract(struct wide *product, uint32_t a, uint32_t b)
{
    (void)a;
    (void)b;
    dividend = nondet_wide();
    *product = dividend;
}

// Where the turn began that is proved.
static struct {
    number turns; // to go
    number rest;
    number quotient;
    number next; // bit of the dividend
} began;

// Of the quotient there are 32 - turns bits, of the dividend's lower half the
// others.
static bool is_divided(const struct wide *rest, number turns, number divisor)
{
    return inside(turns, 0, 32) && (rest->high < divisor) &&
           (floor_by(rest->low, (unsigned)(32 - turns)) ==
            (dividend.low & ones(turns)));
}

// Domain: a turn of a division by hand: the rest is below the divisor, and the
// lower bits are those of the dividend.
static bool gains_may_divide(const struct wide *rest, number turns,
                             number divisor)
{
    return (turns != 0) && is_divided(rest, turns, divisor);
}

// Long division: the rest and the next bit of the dividend are the next rest,
// and the divisor if it goes into them.
static bool is_next(const struct wide *rest, number turns, number divisor)
{
    const number quotient = rest->low & ones(32 - turns);
    const number taken = ((quotient & 1) != 0) ? divisor : 0;

    return (turns == began.turns - 1) &&
           (floor_by(quotient, 1) == began.quotient) &&
           (rest->high == (began.rest * 2) + began.next - taken);
}

static bool at_turn(struct wide *rest, uint8_t *turn, uint32_t divisor)
{
    claim(is_divided(rest, *turn, divisor) &&
          (begins() ? ((*turn == 32u) && (rest->high == dividend.high))
                    : is_next(rest, *turn, divisor)));
    any_turn();
    *rest = nondet_wide();
    *turn = nondet_uint8();
    assume(gains_may_divide(rest, *turn, divisor));
    began.turns = *turn;
    began.rest = rest->high;
    began.quotient = rest->low & ones(32 - (number)*turn);
    began.next = floor_by(dividend.low, *turn - 1u) & 1;
    return true;
}

// To the nearest, half up, and at most 2^32 - 1. By contract: multiply_wide.
void prove_scaled(void)
{
    const uint32_t divisor = nondet_uint32();
    number rest;
    number quotient;
    number found;

    assume(inside(divisor, 1, (number)1 << 31));
    found = scaled(nondet_uint32(), nondet_uint32(), divisor);
    rest = (began.rest * 2) + began.next;
    quotient = began.quotient * 2;
    if (rest >= divisor) {
        rest -= divisor;
        quotient++;
    }
    if (rest * 2 >= divisor) {
        quotient++;
    }
    claim((dividend.high >= divisor)
              ? (found == UINT32_MAX)
              : ((began.turns == 1) &&
                 (found == clamp(quotient, 0, UINT32_MAX))));
}

static void claim_shifted(const struct wide *product, uint32_t x, unsigned bits)
{
    claim(product->low == (uint32_t)(x << bits));
    claim(product->high == floor_by(x, 32u - bits));
}

// Of a power of two and any number, either way round.
void prove_product(void)
{
    const uint32_t x = nondet_uint32();

    for (unsigned bits = 0; bits < 32u; bits++) {
        struct wide product = nondet_wide();

        multiply_wide(&product, x, (uint32_t)1 << bits);
        claim_shifted(&product, x, bits);
        product = nondet_wide();
        multiply_wide(&product, (uint32_t)1 << bits, x);
        claim_shifted(&product, x, bits);
    }
}
