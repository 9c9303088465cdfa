// SPDX-License-Identifier: MIT
// fixpid_an964_8bit against the equations of its header.
#include "prove.h"

#include "an964_8bit/fixpid_an964_8bit_arith.h"
#include "fixpid_an964_8bit.h"

struct fixpid_an964_8bit c; // of any bytes, where a proof begins
struct fixpid_an964_8bit nondet_an964_8bit(void);
struct fixpid_an964_8bit_gains nondet_an964_8bit_gains(void);

#include "an964_8bit/fixpid_an964_8bit.c"
#include "an964_8bit/fixpid_an964_8bit_more.c"

#define GAIN_MAX 127
#define SUM FIXPID_AN964_8BIT_SUM_LIMIT
#define TERM FIXPID_AN964_8BIT_TERM_LIMIT
#define OUTPUT_MAX 504

#define TIMES(gain, x) times((gain), (x), 127u * 127u)

// A quotient that is limited to a byte.
#ifdef FIXPID_AN964_8BIT_NARROW_H
typedef uint8_t quotient;
#else
typedef uint16_t quotient;
#endif

// What stands for the primitives in the proof of a step.
quotient fixpid_7x7_div4_contract(uint8_t gain, uint8_t magnitude,
                                  uint8_t round_up, uint8_t limit)
{
    pre((gain <= GAIN_MAX) && (magnitude <= 127u) && (magnitude <= limit));
    pre((round_up == 0u) || (round_up == 0xFFu));
    return (quotient)clamp(
        floor_by(TIMES(gain, (number)magnitude) + (round_up & 3u), 2), 0,
        limit);
}

quotient fixpid_7x7_div8_contract(uint8_t gain, uint8_t magnitude)
{
    pre((gain <= GAIN_MAX) && (magnitude <= 127u));
    return (quotient)clamp(floor_by(TIMES(gain, (number)magnitude), 3), 0, 127);
}

uint16_t fixpid_7x7_div32_contract(uint8_t gain, uint8_t magnitude)
{
    pre((gain <= GAIN_MAX) && (magnitude <= 127u));
    return (uint16_t)floor_by(TIMES(gain, (number)magnitude), 5);
}

typedef struct fixpid_an964_8bit controller;
typedef struct fixpid_an964_8bit_gains controller_gains;
#include "an964.h"

// What init establishes from any bytes and every function keeps.
// Domain: the gains are legal, or 0 if it was refused; the sum and the terms
// are within their limits, and only flags that exist are set.
static bool an964_8bit_is_sound(const struct fixpid_an964_8bit *x)
{
    if ((x->ready == 0u) && ((x->gains.kp | x->gains.ki | x->gains.kd) != 0u)) {
        return false;
    }
    return legal_gains(&x->gains) && inside((int16_t)x->sum, -SUM, SUM) &&
           inside((int8_t)x->integral, -127, 127) &&
           inside((int8_t)x->derivative, -TERM, TERM) &&
           ((x->sum_limited | FIXPID_AN964_8BIT_SUM_LIMITED) ==
            FIXPID_AN964_8BIT_SUM_LIMITED) &&
           ((x->output_limited | FIXPID_AN964_8BIT_OUTPUT_LIMITED) ==
            FIXPID_AN964_8BIT_OUTPUT_LIMITED);
}

// By contract: fixpid_7x7_div4, fixpid_7x7_div8, fixpid_7x7_div32.
void prove_step(void)
{
    const int8_t e = nondet_int8();
    struct fixpid_an964_8bit was;
    number sum;
    number integral;
    number change;
    number derivative;
    number terms;
    number out;
    uint8_t flags;

    c = nondet_an964_8bit();
    assume(an964_8bit_is_sound(&c));
    was = c;
    out = fixpid_an964_8bit_step(&c, e);

    sum = clamp((number)(int16_t)was.sum + e, -SUM, SUM);
    integral =
        clamp(trunc_by(TIMES(was.gains.ki, trunc_by(sum, 6)), 3), -127, 127);
    change = clamp((number)e - (int8_t)was.error[2], -TERM, TERM);
    derivative = clamp(floor_by(TIMES(was.gains.kd, change), 2), -TERM, TERM);
    terms = clamp(e + integral + derivative, -127, 127);
    claim(out == trunc_by(TIMES(was.gains.kp, terms), 5));
    claim(inside(out, -OUTPUT_MAX, OUTPUT_MAX));
    claim((int16_t)c.sum == sum);
    claim((int8_t)c.error[0] == e);
    claim(c.error[1] == was.error[0]);
    claim(c.error[2] == was.error[1]);
    claim(fixpid_an964_8bit_proportional(&c) == e);
    claim(fixpid_an964_8bit_integral(&c) == integral);
    claim(fixpid_an964_8bit_derivative(&c) == derivative);
    flags = fixpid_an964_8bit_flags(&c);
    claim(((flags & FIXPID_AN964_8BIT_SUM_LIMITED) != 0u) ==
          !inside((number)(int16_t)was.sum + e, -SUM, SUM));
    claim(((flags & FIXPID_AN964_8BIT_OUTPUT_LIMITED) != 0u) ==
          !inside(e + integral + derivative, -127, 127));
    claim((flags & 0xFCu) == 0u);
    claim(same_gains(&c, &was));
    claim(an964_8bit_is_sound(&c));
}

void prove_init(void)
{
    const struct fixpid_an964_8bit_gains gains = nondet_an964_8bit_gains();
    const bool legal = legal_gains(&gains);

    c = nondet_an964_8bit();
    claim(fixpid_an964_8bit_init(&c, &gains) == legal);
    claim(at_rest(&c));
    claim((c.ready != 0u) == legal);
    claim(c.gains.kp == (legal ? gains.kp : 0u));
    claim(c.gains.ki == (legal ? gains.ki : 0u));
    claim(c.gains.kd == (legal ? gains.kd : 0u));
    claim(an964_8bit_is_sound(&c));
}

void prove_setters(void)
{
    const struct fixpid_an964_8bit_gains gains = nondet_an964_8bit_gains();
    struct fixpid_an964_8bit was;
    bool accepted;

    c = nondet_an964_8bit();
    assume(an964_8bit_is_sound(&c));
    was = c;
    accepted = (was.ready != 0u) && legal_gains(&gains);
    claim(fixpid_an964_8bit_set_gains(&c, gains.kp, gains.ki, gains.kd) ==
          accepted);
    if (accepted) {
        was.gains = gains;
    }
    claim(same_gains(&c, &was));
    claim(same_state(&c, &was));
    claim(an964_8bit_is_sound(&c));
}

void prove_reset(void)
{
    struct fixpid_an964_8bit was;

    c = nondet_an964_8bit(); // also of what is not sound
    was = c;
    fixpid_an964_8bit_reset(&c);
    claim(at_rest(&c));
    claim(same_gains(&c, &was));
    claim(!an964_8bit_is_sound(&was) || an964_8bit_is_sound(&c));
}

// Refused, the output is 0 whatever the error.
void prove_refused(void)
{
    c = nondet_an964_8bit();
    c.ready = 0;
    assume(an964_8bit_is_sound(&c));
    claim(fixpid_an964_8bit_step(&c, nondet_int8()) == 0);
    claim(an964_8bit_is_sound(&c));
}

// Of any bytes: nothing undefined, and the output within its limits.
void prove_total(void)
{
    c = nondet_an964_8bit();
    claim(inside(fixpid_an964_8bit_step(&c, nondet_int8()), -OUTPUT_MAX,
                 OUTPUT_MAX));
    (void)fixpid_an964_8bit_proportional(&c);
    (void)fixpid_an964_8bit_integral(&c);
    (void)fixpid_an964_8bit_derivative(&c);
    (void)fixpid_an964_8bit_flags(&c);
}
