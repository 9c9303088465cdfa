// SPDX-License-Identifier: MIT
// fixpid_an964 against the equations of its header.
#include "prove.h"

#include "an964/fixpid_an964_arith.h"
#include "fixpid_an964.h"

struct fixpid_an964 c; // of any bytes, where a proof begins
struct fixpid_an964 nondet_an964(void);
struct fixpid_an964_gains nondet_an964_gains(void);

#include "an964/fixpid_an964.c"
#include "an964/fixpid_an964_more.c"

#define GAIN_MAX 1023
#define ERROR_MAX 1023
#define SUM FIXPID_AN964_SUM_LIMIT
#define TERM FIXPID_AN964_TERM_LIMIT
#define OUTPUT FIXPID_AN964_OUTPUT_LIMIT
#define INTEGRAL_MAX 7480
#define TERMS_MAX 16383

// A gain times a byte and times the sum of the terms.
#define TIMES_BYTE(gain, x)                                                    \
    times((gain), (x), (uint32_t)(((x) < 0) ? -(x) : (x)) * GAIN_MAX)
#define TIMES_TERMS(gain, x) times((gain), (x), UINT32_C(1023) * TERMS_MAX)

// What stands for the primitives in the proof of a step.
uint16_t fixpid_10x7_div16_contract(uint16_t gain, uint8_t magnitude)
{
    pre((gain <= GAIN_MAX) && (magnitude <= 127u));
    return (uint16_t)floor_by(TIMES_BYTE(gain, (number)magnitude), 4);
}

uint16_t fixpid_10x8_div32_contract(uint16_t gain, uint8_t magnitude,
                                    uint8_t round_up, uint8_t limit)
{
    pre((gain <= GAIN_MAX) && (magnitude <= limit));
    pre((round_up == 0u) || (round_up == 0xFFu));
    return (uint16_t)clamp(
        floor_by(TIMES_BYTE(gain, (number)magnitude) + (round_up & 31u), 5), 0,
        limit);
}

uint16_t fixpid_10x14_div1024_contract(uint16_t gain, uint16_t magnitude)
{
    pre((gain <= GAIN_MAX) && (magnitude <= TERMS_MAX));
    return (uint16_t)floor_by(TIMES_TERMS(gain, (number)magnitude), 10);
}

typedef struct fixpid_an964 controller;
typedef struct fixpid_an964_gains controller_gains;
#include "an964.h"

// What init establishes from any bytes and every function keeps.
// Domain: the gains are legal, or 0 if it was refused; the sum, the errors and
// the terms are within their limits, and only flags that exist are set.
static bool an964_is_sound(const struct fixpid_an964 *x)
{
    if ((x->ready == 0u) && ((x->gains.kp | x->gains.ki | x->gains.kd) != 0u)) {
        return false;
    }
    return legal_gains(&x->gains) && inside((int16_t)x->sum, 1 - SUM, SUM) &&
           inside((int16_t)x->error[0], -ERROR_MAX, ERROR_MAX) &&
           inside((int16_t)x->error[1], -ERROR_MAX, ERROR_MAX) &&
           inside((int16_t)x->error[2], -ERROR_MAX, ERROR_MAX) &&
           inside((int16_t)x->integral, -INTEGRAL_MAX, INTEGRAL_MAX) &&
           inside((int16_t)x->derivative, -TERM, TERM) &&
           ((x->sum_limited | FIXPID_AN964_SUM_LIMITED) ==
            FIXPID_AN964_SUM_LIMITED) &&
           ((x->output_limited | FIXPID_AN964_OUTPUT_LIMITED) ==
            FIXPID_AN964_OUTPUT_LIMITED);
}

// By contract: fixpid_10x7_div16, fixpid_10x8_div32, fixpid_10x14_div1024.
void prove_step(void)
{
    const int16_t error = nondet_int16();
    const number e = clamp(error, -ERROR_MAX, ERROR_MAX);
    struct fixpid_an964 was;
    number sum;
    number integral;
    number change;
    number derivative;
    number full;
    number out;
    uint8_t flags;

    c = nondet_an964();
    assume(an964_is_sound(&c));
    was = c;
    out = fixpid_an964_step(&c, error);

    sum = clamp((int16_t)was.sum + e, 1 - SUM, SUM);
    integral = trunc_by(TIMES_BYTE(was.gains.ki, trunc_by(sum, 8)), 4);
    change = clamp(e - (int16_t)was.error[2], -TERM, TERM);
    derivative =
        clamp(floor_by(TIMES_BYTE(was.gains.kd, change), 5), -TERM, TERM);
    full = trunc_by(TIMES_TERMS(was.gains.kp, e + integral + derivative), 10);
    claim(out == clamp(full, -OUTPUT, OUTPUT));
    claim((int16_t)c.sum == sum);
    claim((int16_t)c.error[0] == e);
    claim(c.error[1] == was.error[0]);
    claim(c.error[2] == was.error[1]);
    claim(fixpid_an964_proportional(&c) == e);
    claim(fixpid_an964_integral(&c) == integral);
    claim(fixpid_an964_derivative(&c) == derivative);
    flags = fixpid_an964_flags(&c);
    claim(((flags & FIXPID_AN964_SUM_LIMITED) != 0u) ==
          !inside((int16_t)was.sum + e, 1 - SUM, SUM));
    claim(((flags & FIXPID_AN964_OUTPUT_LIMITED) != 0u) ==
          !inside(full, -OUTPUT, OUTPUT));
    claim((flags & 0xFCu) == 0u);
    claim(same_gains(&c, &was));
    claim(an964_is_sound(&c));
}

void prove_init(void)
{
    const struct fixpid_an964_gains gains = nondet_an964_gains();
    const bool legal = legal_gains(&gains);

    c = nondet_an964();
    claim(fixpid_an964_init(&c, &gains) == legal);
    claim(at_rest(&c));
    claim((c.ready != 0u) == legal);
    claim(c.gains.kp == (legal ? gains.kp : 0u));
    claim(c.gains.ki == (legal ? gains.ki : 0u));
    claim(c.gains.kd == (legal ? gains.kd : 0u));
    claim(an964_is_sound(&c));
}

void prove_setters(void)
{
    const struct fixpid_an964_gains gains = nondet_an964_gains();
    struct fixpid_an964 was;
    bool accepted;

    c = nondet_an964();
    assume(an964_is_sound(&c));
    was = c;
    accepted = (was.ready != 0u) && legal_gains(&gains);
    claim(fixpid_an964_set_gains(&c, gains.kp, gains.ki, gains.kd) == accepted);
    if (accepted) {
        was.gains = gains;
    }
    claim(same_gains(&c, &was));
    claim(same_state(&c, &was));
    claim(an964_is_sound(&c));
}

void prove_reset(void)
{
    struct fixpid_an964 was;

    c = nondet_an964(); // also of what is not sound
    was = c;
    fixpid_an964_reset(&c);
    claim(at_rest(&c));
    claim(same_gains(&c, &was));
    claim(!an964_is_sound(&was) || an964_is_sound(&c));
}

// Refused, the output is 0 whatever the error.
void prove_refused(void)
{
    c = nondet_an964();
    c.ready = 0;
    assume(an964_is_sound(&c));
    claim(fixpid_an964_step(&c, nondet_int16()) == 0);
    claim(an964_is_sound(&c));
}

// Of any bytes: nothing undefined, and the output within its limits.
void prove_total(void)
{
    c = nondet_an964();
    claim(inside(fixpid_an964_step(&c, nondet_int16()), -OUTPUT, OUTPUT));
    (void)fixpid_an964_proportional(&c);
    (void)fixpid_an964_integral(&c);
    (void)fixpid_an964_derivative(&c);
    (void)fixpid_an964_flags(&c);
}
