// SPDX-License-Identifier: MIT
// fixpid_an937 against the equations of its header, with numbers in two's
// complement (wide) and in sign-magnitude (narrow).
#include "prove.h"

#include "an937/fixpid_an937_arith.h"
#include "fixpid_an937.h"

struct fixpid_an937 c; // of any bytes, where a proof begins
struct fixpid_an937 nondet_an937(void);
struct fixpid_an937_config nondet_an937_config(void);

#include "an937/fixpid_an937.c"
#include "an937/fixpid_an937_more.c"

#define SUM_MAX 0xFFFFFF
#define FLAGS                                                                  \
    (FIXPID_AN937_SUM_SATURATED | FIXPID_AN937_ACCUMULATED_ERROR_LIMITED)
#define BELOW_0 0x80u     // of `step_flags`: the sum was negative
#define TERM_MAX 16711425 // 255 * 65535
#define TIMES(gain, x) times((gain), (x), TERM_MAX)

static number value_of(const union fixpid_an937_number *n)
{
    return fixpid_number_value(n);
}

// What stands for fixpid_number_term in the proofs of a whole step.
int32_t fixpid_number_term_contract(uint8_t gain,
                                    const union fixpid_an937_number *n)
{
    pre(inside(value_of(n), -65535, 65535));
    return (int32_t)TIMES(gain, value_of(n));
}

// And for fixpid_sum_with_term: sum + gain * n.
int32_t fixpid_sum_with_term_contract(int32_t sum, uint8_t gain,
                                      const union fixpid_an937_number *n)
{
    pre(inside(value_of(n), -65535, 65535));
    pre(inside(sum, -2 * TERM_MAX, 2 * TERM_MAX));
    return (int32_t)(sum + TIMES(gain, value_of(n)));
}

static bool sound_number(const union fixpid_an937_number *n, number most)
{
    return inside(value_of(n), -most - 1, most);
}

// What init establishes from any bytes and every function keeps.
// Domain: the error fits in 16 bits, the accumulated error and the delta are at
// most 65535 either way, only flags that exist are set, and the derivative has
// a period; or it was refused, and its gains are 0. The accumulated error may
// lie beyond a new limit until the next tick.
static bool an937_is_sound(const struct fixpid_an937 *x)
{
    if (!sound_number(&x->error, INT16_MAX)) {
        return false;
    }
    if (!inside(value_of(&x->accumulated_error), -65535, 65535) ||
        !sound_number(&x->accumulated_error, 65535)) {
        return false;
    }
    if (!inside(value_of(&x->delta), -65535, 65535) ||
        !sound_number(&x->delta, 65535)) {
        return false;
    }
    if ((x->step_flags & (uint8_t) ~(BELOW_0 | FLAGS)) != 0u) {
        return false;
    }
    if (x->accumulated_error_limit == 0u) { // refused
        return (x->kp_q4 == 0u) && (x->ki_q4 == 0u) && (x->kd_q4 == 0u);
    }
    return x->derivative_period_ticks != 0u;
}

static bool same_settings(const struct fixpid_an937 *a,
                          const struct fixpid_an937 *b)
{
    return (a->kp_q4 == b->kp_q4) && (a->ki_q4 == b->ki_q4) &&
           (a->kd_q4 == b->kd_q4) &&
           (a->accumulated_error_limit == b->accumulated_error_limit) &&
           (a->derivative_period_ticks == b->derivative_period_ticks);
}

static bool same_state(const struct fixpid_an937 *a,
                       const struct fixpid_an937 *b)
{
    return (value_of(&a->error) == value_of(&b->error)) &&
           (value_of(&a->accumulated_error) ==
            value_of(&b->accumulated_error)) &&
           (value_of(&a->delta) == value_of(&b->delta)) &&
           (a->previous_error == b->previous_error) &&
           (a->derivative_countdown == b->derivative_countdown);
}

static bool same_flags(const struct fixpid_an937 *a,
                       const struct fixpid_an937 *b)
{
    return (a->step_flags == b->step_flags) &&
           (a->tick_pending == b->tick_pending) &&
           (a->tick_overrun == b->tick_overrun);
}

static bool same(const struct fixpid_an937 *a, const struct fixpid_an937 *b)
{
    return same_settings(a, b) && same_state(a, b) && same_flags(a, b);
}

static bool at_rest(const struct fixpid_an937 *x)
{
    return (value_of(&x->error) == 0) &&
           (value_of(&x->accumulated_error) == 0) &&
           (value_of(&x->delta) == 0) && (x->previous_error == 0x8000u) &&
           (x->derivative_countdown <= 1u) && (x->tick_pending == 0u) &&
           (x->tick_overrun == 0u) && (x->step_flags == 0u);
}

// Equations 2 to 4. By contract: fixpid_number_term, fixpid_sum_with_term.
void prove_step(void)
{
    const int16_t error = nondet_int16();
    struct fixpid_an937 was;
    number limit;
    number accumulated;
    number delta;
    number previous;
    number countdown;
    number sum;
    number out;
    bool limited = false;
    uint8_t flags;

    c = nondet_an937();
    assume(an937_is_sound(&c));
    was = c;
    out = fixpid_an937_step(&c, error);

    limit = was.accumulated_error_limit;
    accumulated = value_of(&was.accumulated_error);
    delta = value_of(&was.delta);
    previous = (number)was.previous_error - 32768;
    countdown = was.derivative_countdown;
    if (was.tick_pending != 0u) {
        limited = !inside(accumulated + error, -limit, limit);
        accumulated = clamp(accumulated + error, -limit, limit);
        countdown--;
        if (countdown <= 0) {
            countdown = was.derivative_period_ticks;
            delta = error - previous;
            previous = error;
        }
    }
    sum = TIMES(was.kp_q4, (number)error) + TIMES(was.ki_q4, accumulated) +
          TIMES(was.kd_q4, delta);
    claim(out == trunc_by(clamp(sum, -SUM_MAX, SUM_MAX), 4));
    claim(inside(out, -1048575, 1048575));
    claim(fixpid_an937_accumulated_error(&c) == accumulated);
    claim(value_of(&c.error) == error);
    claim(value_of(&c.delta) == delta);
    claim((number)c.previous_error - 32768 == previous);
    claim(c.derivative_countdown == countdown);
    claim(c.tick_pending == 0u);
    claim(c.tick_overrun == was.tick_overrun);
    claim(same_settings(&c, &was));
    flags = fixpid_an937_flags(&c);
    claim(((flags & FIXPID_AN937_SUM_SATURATED) != 0u) ==
          !inside(sum, -SUM_MAX, SUM_MAX));
    claim(((flags & FIXPID_AN937_ACCUMULATED_ERROR_LIMITED) != 0u) == limited);
    claim(((flags & FIXPID_AN937_TICK_OVERRUN) != 0u) ==
          (was.tick_overrun != 0u));
    claim(((fixpid_an937_stat1(&c) & FIXPID_AN937_PID_SIGN) != 0u) ==
          (sum >= 0));
    claim(an937_is_sound(&c));
}

// What can be read at any time; reading changes nothing. By contract:
// fixpid_number_term.
void prove_read(void)
{
    struct fixpid_an937 was;
    number error;
    number accumulated;
    number delta;
    number derivative;
    uint8_t stat1;

    c = nondet_an937();
    assume(an937_is_sound(&c));
    was = c;
    error = value_of(&c.error);
    accumulated = value_of(&c.accumulated_error);
    delta = value_of(&c.delta);
    derivative = TIMES(c.kd_q4, delta);
    claim(fixpid_an937_proportional(&c) == TIMES(c.kp_q4, error));
    claim(fixpid_an937_integral(&c) == TIMES(c.ki_q4, accumulated));
    claim(fixpid_an937_derivative(&c) == derivative);
    stat1 = fixpid_an937_stat1(&c);
    claim(((stat1 & FIXPID_AN937_D_ERR_SIGN) != 0u) == (derivative >= 0));
    claim(((stat1 & FIXPID_AN937_P_ERR_SIGN) != 0u) ==
          (c.previous_error >= 0x8000u));
    claim(((stat1 & FIXPID_AN937_A_ERR_SIGN) != 0u) == (accumulated >= 0));
    claim(((stat1 & FIXPID_AN937_ERR_SIGN) != 0u) == (error >= 0));
    claim(((stat1 & FIXPID_AN937_A_ERR_ZERO) != 0u) == (accumulated == 0));
    claim(((stat1 & FIXPID_AN937_ERR_ZERO) != 0u) == (error == 0));
    claim((stat1 & 0x20u) == 0u);
    claim(fixpid_an937_stat2(&c) == ((delta == 0) ? FIXPID_AN937_D_ERR_Z : 0u));
    claim((fixpid_an937_flags(&c) & 0xF8u) == 0u);
    claim(same(&c, &was));
}

void prove_init(void)
{
    const struct fixpid_an937_config config = nondet_an937_config();
    bool accepted;

    c = nondet_an937();
    accepted = fixpid_an937_init(&c, &config);
    claim(accepted == ((config.accumulated_error_limit != 0u) &&
                       (config.derivative_period_ticks != 0u)));
    claim(at_rest(&c));
    claim(an937_is_sound(&c));
    if (accepted) {
        claim(c.kp_q4 == config.kp_q4);
        claim(c.ki_q4 == config.ki_q4);
        claim(c.kd_q4 == config.kd_q4);
        claim(c.accumulated_error_limit == config.accumulated_error_limit);
        claim(c.derivative_period_ticks == config.derivative_period_ticks);
    } else {
        claim(c.accumulated_error_limit == 0u);
        claim(c.kp_q4 + c.ki_q4 + c.kd_q4 == 0);
    }
}

void prove_setters(void)
{
    const uint8_t byte = nondet_uint8();
    const uint8_t ki = nondet_uint8();
    const uint8_t kd = nondet_uint8();
    const uint16_t limit = nondet_uint16();
    struct fixpid_an937 was;
    bool ready;

    c = nondet_an937();
    assume(an937_is_sound(&c));
    was = c;
    ready = was.accumulated_error_limit != 0u;
    if (nondet_bool()) {
        claim(fixpid_an937_set_gains(&c, byte, ki, kd) == ready);
        if (ready) {
            was.kp_q4 = byte;
            was.ki_q4 = ki;
            was.kd_q4 = kd;
        }
    } else if (nondet_bool()) {
        const bool legal = ready && (limit != 0u);

        claim(fixpid_an937_set_accumulated_error_limit(&c, limit) == legal);
        if (legal) {
            was.accumulated_error_limit = limit;
        }
    } else if (nondet_bool()) {
        const bool legal = ready && (byte != 0u);

        claim(fixpid_an937_set_derivative_period(&c, byte) == legal);
        if (legal) {
            was.derivative_period_ticks = byte;
        }
    } else if (nondet_bool()) {
        fixpid_an937_clear_flags(&c);
        claim(fixpid_an937_flags(&c) == 0u);
        was.step_flags &= BELOW_0;
        was.tick_overrun = 0;
    } else {
        fixpid_an937_tick(&c);
        claim(c.tick_pending != 0u);
        claim((c.tick_overrun != 0u) ==
              ((was.tick_overrun != 0u) || (was.tick_pending != 0u)));
        was.tick_pending = c.tick_pending;
        was.tick_overrun = c.tick_overrun;
    }
    claim(same(&c, &was));
    claim(an937_is_sound(&c));
}

void prove_reset(void)
{
    struct fixpid_an937 was;

    c = nondet_an937(); // also of what is not sound
    was = c;
    fixpid_an937_reset(&c);
    claim(at_rest(&c));
    claim(same_settings(&c, &was));
    claim(!an937_is_sound(&was) || an937_is_sound(&c));
}

// Refused, the output is 0 whatever the error.
void prove_refused(void)
{
    c = nondet_an937();
    c.accumulated_error_limit = 0;
    assume(an937_is_sound(&c));
    claim(fixpid_an937_step(&c, nondet_int16()) == 0);
    claim(an937_is_sound(&c));
}

// The note's 8-bit mode: what it makes of a step.
int32_t asked;
int32_t answered;

int32_t fixpid_an937_step_contract(struct fixpid_an937 *self, int16_t error)
{
    (void)self;
    asked = error;
    answered = nondet_int32();
    assume(inside(answered, -1048575, 1048575));
    return answered;
}

// By contract: fixpid_an937_step.
void prove_percent(void)
{
    const int8_t percent = nondet_int8();
    const number out = fixpid_an937_step_percent(&c, percent);

    claim(asked == clamp(percent, -100, 100) * 40);
    claim(out == clamp(answered / INT32_C(1600), -100, 100));
}

// Of any bytes: nothing undefined, and the output within its limits. After it
// all is sound again but for a refused controller's gains.
void prove_total(void)
{
    c = nondet_an937();
    claim(inside(fixpid_an937_step(&c, nondet_int16()), -1048575, 1048575));
    claim(inside(fixpid_an937_step_percent(&c, nondet_int8()), -100, 100));
    (void)fixpid_an937_proportional(&c);
    (void)fixpid_an937_integral(&c);
    (void)fixpid_an937_derivative(&c);
    (void)fixpid_an937_stat1(&c);
    (void)fixpid_an937_stat2(&c);
    fixpid_an937_tick(&c);
    fixpid_an937_clear_flags(&c);
}
