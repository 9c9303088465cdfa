// SPDX-License-Identifier: MIT
// fixpid_pid against the equations of its header. The step is proved in its
// parts, each of its static functions against its lines of the header, for
// every state that the parts before it leave; and then as a whole, in which
// what was proved of a part stands for it (`composed`).
#include "pid_config.h"

#include "fixpid_pid.h"
#include "pid/fixpid_pid_private.h"

struct fixpid_pid c; // of any bytes, where a proof begins
struct fixpid_pid nondet_pid(void);
struct fixpid_pid_gains nondet_pid_gains(void);

#include "pid/fixpid_pid.c"
#include "pid/fixpid_pid_check.c"
#include "pid/fixpid_pid_error.c"
#include "pid/fixpid_pid_more.c"
#include "pid/fixpid_pid_state.c"
#include "pid/fixpid_pid_track.c"

struct signals nondet_signals(void);

// Those of a step: a signal may have a wider word.
static struct signals any_signals(void)
{
    struct signals signals = nondet_signals();

    signals.error = nondet_int16();
    signals.derivative_input = nondet_int16();
    return signals;
}

// What the object's private bits mean. Without its feature a bit is none.
#define HAS(feature, bits)                                                     \
    ((((unsigned)FIXPID_PID_FEATURES & (feature)) != 0u) ? (bits) : 0u)
#define FINE 0x80u                                  // ki has 24 fractional bits
#define COARSE HAS(FIXPID_PID_HAS_COARSE_KI, 0x10u) // ki has 8
#define FILTERED HAS(FIXPID_PID_HAS_FILTER, 0x07u)
#define UPSIDE_DOWN HAS(FIXPID_PID_HAS_REVERSE, 0x40u)
#define BY_ERROR HAS(FIXPID_PID_HAS_DERIVATIVE_ON_ERROR, 0x20u)
#define SCALED HAS(FIXPID_PID_HAS_WEIGHT, 0x08u)
#define OF_STEP (UPSIDE_DOWN | BY_ERROR | SCALED)
#define HOLDING                                                                \
    HAS(FIXPID_PID_HAS_MANUAL, FIXPID_PID_MANUAL | FIXPID_PID_SEEDED)
#define UNSEEN ((PROOF_WORD == 16) ? 0 : 0x7FFF7FFF) // no `previous` yet

#define COUNT 65536                // an output count in `integral`
#define PART ((number)256 * COUNT) // and in 1/2^24
#define D_MAX (((number)1 << 30) - ((number)1 << 24))
#define TIMES(gain, x) times((gain), (x), (uint32_t)(gain) << 15) // |x| <= 2^15
// |P| <= 2^30 - 2^15, |D| <= 2^30 - 2^24, 256 |F| <= 2^23
#define P_D_FF_MAX (((number)1 << 31) - ((number)1 << 23) - 32768)

int32_t mul16_contract(uint16_t gain, signal_word x)
{
    pre(gain <= 32767u);
    pre(inside(x, INT16_MIN, INT16_MAX));
    return (int32_t)TIMES(gain, (number)x);
}

static bool refused(const struct fixpid_pid *x)
{
    return x->output_min == x->output_max;
}

// The integral in 1/2^24 of an output count.
static number whole(const struct fixpid_pid *x)
{
    return ((number)x->integral * 256) + x->integral_fraction;
}

static number sat16(number x)
{
    return clamp(x, INT16_MIN, INT16_MAX);
}

// Domain: the limits of the output and of the integral are in order, and gains
// and options are legal; or it was refused, and all of them are 0.
static bool pid_is_set(const struct fixpid_pid *x)
{
    if ((x->output_min > x->output_max) ||
        (x->integral_min > x->integral_max) || (x->integral_min < -INT16_MAX)) {
        return false;
    }
    if (refused(x)) {
        return (x->kp == 0u) && (x->ki == 0u) && (x->kd == 0u) &&
               (x->output_min == 0) && (x->integral_min == 0) &&
               (x->integral_max == 0) && (x->feedforward == 0);
    }
    return (x->kp <= FIXPID_PID_KP_MAX) && (x->ki <= 32767u) &&
           (x->kd <= FIXPID_PID_KD_MAX) &&
           ((x->options & (FINE | COARSE | FILTERED | OF_STEP)) ==
            x->options) &&
           (((x->options & FINE) == 0u) || ((x->options & COARSE) == 0u));
}

static bool sound_integral(const struct fixpid_pid *x)
{
    if ((x->status & HOLDING) != 0u) {
        return (((uint32_t)x->integral & 0xFFFFu) == 0u) &&
               inside(floor_by(x->integral, 16), x->output_min, x->output_max);
    }
    return inside(whole(x), x->integral_min * PART, x->integral_max * PART);
}

// Before the first step a `previous` of 32 bits says so, too.
static bool sound_previous(const struct fixpid_pid *x)
{
    if ((x->status & FIXPID_PID_FIRST) != 0u) {
        return x->previous == UNSEEN;
    }
    return inside(x->previous, INT16_MIN, INT16_MAX);
}

// What init establishes from any bytes and every function keeps.
// Domain: settings as above; the derivative's term is less than 2^30, and what
// it saw last fits in 16 bits; the integral is within its limits, or it is an
// output that is held, in whole counts and within the output's limits.
static bool pid_is_sound(const struct fixpid_pid *x)
{
    return pid_is_set(x) && inside(x->derivative, -D_MAX, D_MAX) &&
           sound_previous(x) && sound_integral(x);
}

// Domain: of a sound object, what the derivative reads.
static bool pid_may_differentiate(const struct fixpid_pid *x)
{
    return (x->kd <= FIXPID_PID_KD_MAX) &&
           inside(x->derivative, -D_MAX, D_MAX) && sound_previous(x);
}

// Domain: settings as above, and an integral within its limits.
static bool pid_may_integrate(const struct fixpid_pid *x)
{
    return pid_is_set(x) &&
           inside(whole(x), x->integral_min * PART, x->integral_max * PART);
}

// Domain: settings as above, and a sum of the other terms that legal gains can
// make.
static bool pid_may_limit(const struct fixpid_pid *x, number p_d_ff)
{
    return pid_is_set(x) && inside(p_d_ff, -P_D_FF_MAX, P_D_FF_MAX);
}

// Domain: the same, and an output that is held, in whole counts.
static bool pid_may_take_over(const struct fixpid_pid *x, number p_d_ff)
{
    return pid_may_limit(x, p_d_ff) &&
           (((uint32_t)x->integral & 0xFFFFu) == 0u);
}

// Domain: the limits of the output and of the integral are in order.
static bool pid_may_reset(const struct fixpid_pid *x)
{
    return (x->output_min <= x->output_max) &&
           (x->integral_min <= x->integral_max);
}

static bool same_settings(const struct fixpid_pid *a,
                          const struct fixpid_pid *b)
{
    return (a->kp == b->kp) && (a->ki == b->ki) && (a->kd == b->kd) &&
           (a->output_min == b->output_min) &&
           (a->output_max == b->output_max) &&
           (a->integral_min == b->integral_min) &&
           (a->integral_max == b->integral_max) &&
           (a->setpoint_weight == b->setpoint_weight) &&
           (a->options == b->options) && (a->feedforward == b->feedforward);
}

static bool same_state(const struct fixpid_pid *a, const struct fixpid_pid *b)
{
    return (whole(a) == whole(b)) && (a->derivative == b->derivative) &&
           (a->previous == b->previous) &&
           (a->proportional_error == b->proportional_error) &&
           (a->output == b->output) && (a->status == b->status);
}

static bool same(const struct fixpid_pid *a, const struct fixpid_pid *b)
{
    return same_settings(a, b) && same_state(a, b);
}

// ---- The lines of the header ----

// sat16 of the difference, turned round in reverse.
static number error_of(const struct fixpid_pid *x, number goal, number y)
{
    return ((x->options & UPSIDE_DOWN) != 0u) ? sat16(y - goal)
                                              : sat16(goal - y);
}

static number goal_of(const struct fixpid_pid *x, number r)
{
    if ((x->options & SCALED) == 0u) {
        return r;
    }
    return floor_by(TIMES(x->setpoint_weight, r) + 128, 8);
}

// What the derivative sees, which falls with the error.
static number input_of(const struct fixpid_pid *x, number r, number y)
{
    if ((x->options & BY_ERROR) != 0u) {
        return -1 - error_of(x, r, y);
    }
    return ((x->options & UPSIDE_DOWN) != 0u) ? (-1 - y) : y;
}

static number derivative_of(const struct fixpid_pid *x, number input)
{
    const number previous =
        ((x->status & FIXPID_PID_FIRST) != 0u) ? input : x->previous;
    const number d = TIMES(x->kd, sat16(previous - input));

    if ((x->options & FILTERED) == 0u) {
        return d;
    }
    return clamp(
        d + (x->derivative - floor_by(x->derivative, x->options & FILTERED)),
        -D_MAX, D_MAX);
}

// ki * e in 1/2^24: ki has 24, 16 or 8 fractional bits.
static number change_of(const struct fixpid_pid *x, number e)
{
    const number change = TIMES(x->ki, e);

    if ((x->options & FINE) != 0u) {
        return change;
    }
    return ((x->options & COARSE) != 0u) ? (change * 65536) : (change * 256);
}

static number limited(const struct fixpid_pid *x, number integral)
{
    return clamp(integral, x->integral_min * PART, x->integral_max * PART);
}

// The integral that makes the sum equal to the output held.
static number taken_over(const struct fixpid_pid *x, number p_d_ff)
{
    return (floor_by(x->integral, 8) - p_d_ff) * COUNT;
}

// A first step that nothing is held for starts from rest: the integral takes
// over what the weight leaves of the measurement.
static bool starts(const struct fixpid_pid *x)
{
    return ((x->options & SCALED) != 0u) &&
           ((x->status & (HOLDING | FIXPID_PID_FIRST)) == FIXPID_PID_FIRST);
}

static number started(const struct fixpid_pid *x, number y)
{
    const number p = TIMES(x->kp, error_of(x, goal_of(x, y), y));

    return starts(x) ? limited(x, taken_over(x, p)) : whole(x);
}

static number sum_of(number p_d_ff, number integral)
{
    return floor_by(p_d_ff + floor_by(integral, 16) + 128, 8);
}

static bool forgets(const struct fixpid_pid *x, number u, number e)
{
    return ((u > x->output_max) && (e > 0)) || ((u < x->output_min) && (e < 0));
}

static number flags_of(const struct fixpid_pid *x, number candidate, number u)
{
    return ((u > x->output_max)   ? FIXPID_PID_AT_MAX
            : (u < x->output_min) ? FIXPID_PID_AT_MIN
                                  : 0u) |
           ((candidate != limited(x, candidate)) ? FIXPID_PID_INTEGRAL_AT_LIMIT
                                                 : 0u);
}

// ---- The parts of a step ----

static number candidate_of(const struct signals *signals)
{
    return ((number)signals->integral * 256) + signals->fraction;
}

// By contract: mul16.
void prove_special_errors(void)
{
    struct signals signals = any_signals();
    const number r = signals.setpoint;
    const number y = signals.derivative_input; // the measurement still
    struct fixpid_pid was;
    signal_word p_error;

    c = nondet_pid();
    assume(pid_is_set(&c));
    was = c;
    p_error = special_errors(&c, &signals);
    claim(p_error == error_of(&was, goal_of(&was, r), y));
    claim(signals.error == error_of(&was, r, y));
    claim(signals.derivative_input == input_of(&was, r, y));
    claim(whole(&c) == started(&was, y));
    was.integral = c.integral;
    was.integral_fraction = c.integral_fraction;
    claim(same(&c, &was));
}

// By contract: mul16.
void prove_differentiate(void)
{
    struct signals signals = any_signals();
    const struct signals signals_were = signals;
    struct fixpid_pid was;
    number d;

    c = nondet_pid();
    assume(pid_may_differentiate(&c));
    was = c;
    differentiate(&c, &signals);
    d = derivative_of(&was, signals_were.derivative_input);
    claim(c.derivative == d);
    claim(inside(d, -D_MAX, D_MAX));
    claim(c.previous == signals_were.derivative_input);
    was.derivative = c.derivative;
    was.previous = c.previous;
    claim(same(&c, &was));
    claim(signals.error == signals_were.error);
    claim(signals.derivative_input == signals_were.derivative_input);
}

// A candidate that saturates is beyond any limit, as the true one is. By
// contract: mul16.
void prove_integrate(void)
{
    struct signals signals = any_signals();
    const struct signals signals_were = signals;
    struct fixpid_pid was;
    number candidate;

    c = nondet_pid();
    assume(pid_may_integrate(&c));
    was = c;
    integrate(&c, &signals);
    candidate = whole(&was) + change_of(&was, signals_were.error);
    claim(limited(&was, candidate_of(&signals)) == limited(&was, candidate));
    claim((limited(&was, candidate_of(&signals)) == candidate_of(&signals)) ==
          (limited(&was, candidate) == candidate));
    claim(same(&c, &was));
    claim(signals.error == signals_were.error);
    claim(signals.p_d_ff == signals_were.p_d_ff);
}

void prove_take_over(void)
{
    struct signals signals = any_signals();
    const number p_d_ff = signals.p_d_ff;
    struct fixpid_pid was;
    number candidate;

    c = nondet_pid();
    assume(pid_may_take_over(&c, p_d_ff));
    was = c;
    take_over(&c, &signals);
    candidate = taken_over(&was, p_d_ff);
    claim(limited(&was, candidate_of(&signals)) == limited(&was, candidate));
    claim((limited(&was, candidate_of(&signals)) == candidate_of(&signals)) ==
          (limited(&was, candidate) == candidate));
    claim(signals.error == 0);
    claim(signals.p_d_ff == p_d_ff);
    claim(same(&c, &was));
}

void prove_limit(void)
{
    struct signals signals = any_signals();
    const number e = signals.error;
    const number p_d_ff = signals.p_d_ff;
    const number candidate = candidate_of(&signals);
    struct fixpid_pid was;
    number integral;
    number u;
    number out;

    c = nondet_pid();
    assume(pid_may_limit(&c, p_d_ff));
    was = c;
    out = limit_and_remember(&c, &signals);
    integral = limited(&was, candidate);
    u = sum_of(p_d_ff, integral);
    claim(out == clamp(u, was.output_min, was.output_max));
    claim(whole(&c) == (forgets(&was, u, e) ? whole(&was) : integral));
    claim(c.status == flags_of(&was, candidate, u));
    was.integral = c.integral;
    was.integral_fraction = c.integral_fraction;
    was.status = c.status;
    claim(same(&c, &was));
}

// ---- The whole step ----

signal_word special_errors_contract(struct fixpid_pid *self,
                                    struct signals *signals)
{
    const number setpoint = signals->setpoint;
    const number measurement = signals->derivative_input;
    const number integral = started(self, measurement);

    pre(pid_is_set(self));
    self->integral = (int32_t)floor_by(integral, 8);
    self->integral_fraction = (uint8_t)integral;
    signals->error = (int16_t)error_of(self, setpoint, measurement);
    signals->derivative_input = (int16_t)input_of(self, setpoint, measurement);
    return (signal_word)error_of(self, goal_of(self, setpoint), measurement);
}

// As `differentiate` claims of the derivative's term, with the product in it.
static number assume_derivative(const struct fixpid_pid *x, number input)
{
    assume(inside(derivative_of(x, input), -D_MAX, D_MAX));
    return derivative_of(x, input);
}

void differentiate_contract(struct fixpid_pid *self, struct signals *signals)
{
    const number d = assume_derivative(self, signals->derivative_input);

    pre(pid_may_differentiate(self));
    self->derivative = (int32_t)d;
    self->previous = signals->derivative_input;
}

// Of the candidate a part leaves what its limits make of it, and whether they
// changed it: nothing else was proved of it. This one is such a candidate.
static void leave(const struct fixpid_pid *self, struct signals *signals,
                  number candidate)
{
    const number inner = limited(self, candidate);
    const number left = (inner < candidate)   ? (inner + 1)
                        : (inner > candidate) ? (inner - 1)
                                              : inner;

    signals->integral = (int32_t)floor_by(left, 8);
    signals->fraction = (uint8_t)left;
}

void integrate_contract(struct fixpid_pid *self, struct signals *signals)
{
    pre(pid_may_integrate(self));
    leave(self, signals, whole(self) + change_of(self, signals->error));
}

void take_over_contract(struct fixpid_pid *self, struct signals *signals)
{
    pre(pid_may_take_over(self, signals->p_d_ff));
    leave(self, signals, taken_over(self, signals->p_d_ff));
    signals->error = 0;
}

int16_t limit_and_remember_contract(struct fixpid_pid *self,
                                    struct signals *signals)
{
    const number candidate = candidate_of(signals);
    const number integral = limited(self, candidate);
    const number u = sum_of(signals->p_d_ff, integral);

    pre(pid_may_limit(self, signals->p_d_ff));
    self->status = (uint8_t)flags_of(self, candidate, u);
    if (!forgets(self, u, signals->error)) {
        self->integral = (int32_t)floor_by(integral, 8);
        self->integral_fraction = (uint8_t)integral;
    }
    return (int16_t)clamp(u, self->output_min, self->output_max);
}

// By contract: mul16, special_errors, differentiate, integrate, take_over,
// limit_and_remember.
void prove_composed(void)
{
    const int16_t setpoint = nondet_int16();
    const int16_t measurement = nondet_int16();
    struct fixpid_pid was;
    number e;
    number p_error;
    number input;
    number d;
    number p_d_ff;
    number begin;
    number candidate;
    number integral;
    number u;
    number out;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    out = fixpid_pid_step(&c, setpoint, measurement);

    begin = started(&was, measurement);
    e = error_of(&was, setpoint, measurement);
    p_error = error_of(&was, goal_of(&was, setpoint), measurement);
    input = input_of(&was, setpoint, measurement);
    d = derivative_of(&was, input);
    // In the order of the step: a solver is slow at the associative law.
    p_d_ff = (TIMES(was.kp, p_error) + (HAS(FIXPID_PID_HAS_FEEDFORWARD, 1u)
                                            ? (number)was.feedforward * 256
                                            : 0)) +
             d;
    claim(c.proportional_error == p_error);
    claim(c.previous == input);
    claim(c.derivative == d);
    claim(c.output == (HAS(FIXPID_PID_HAS_TRACK, 1u) ? out : was.output));
    claim(inside(out, c.output_min, c.output_max));
    claim(same_settings(&c, &was));
    claim(pid_is_sound(&c));
    if ((was.status & HOLDING & FIXPID_PID_MANUAL) != 0u) {
        claim(out == floor_by(was.integral, 16));
        claim(whole(&c) == whole(&was));
        claim(c.status == FIXPID_PID_MANUAL);
        return;
    }
    if ((was.status & HOLDING) != 0u) {
        candidate = taken_over(&was, p_d_ff);
        e = 0;
    } else {
        candidate = begin + change_of(&was, e);
    }
    integral = limited(&was, candidate);
    u = sum_of(p_d_ff, integral);
    claim(out == clamp(u, was.output_min, was.output_max));
    claim(whole(&c) == (forgets(&was, u, e) ? begin : integral));
    claim(c.status == flags_of(&was, candidate, u));
}

// ---- What rises with the setpoint, and in `reverse` as it falls ----

// Of the true product is assumed what it does: it rises with x.
static void assume_rises(uint16_t gain, number x, number higher)
{
    pre(x <= higher);
    assume(TIMES(gain, x) <= TIMES(gain, higher));
}

// Domain: the second setpoint has no lower error, with the same measurement.
static bool pid_is_in_order(const struct fixpid_pid *x, number setpoint,
                            number other)
{
    return ((x->options & UPSIDE_DOWN) != 0u) ? (setpoint >= other)
                                              : (setpoint <= other);
}

// Domain: the second step has no lower error, and no higher input of its
// derivative.
static bool pid_errors_rise(const struct signals *lower,
                            const struct signals *higher)
{
    return (higher->error >= lower->error) &&
           (higher->derivative_input <= lower->derivative_input);
}

// Domain: the second step has no lower integral before its limits.
static bool pid_candidates_rise(const struct fixpid_pid *x,
                                const struct signals *lower,
                                const struct signals *higher)
{
    return limited(x, candidate_of(higher)) >= limited(x, candidate_of(lower));
}

// Domain: the second step has no lower sum of the other terms, and legal gains
// can make both.
static bool pid_sums_rise(const struct signals *lower,
                          const struct signals *higher)
{
    return inside(lower->p_d_ff, -P_D_FF_MAX, P_D_FF_MAX) &&
           inside(higher->p_d_ff, lower->p_d_ff, P_D_FF_MAX);
}

// By contract: mul16.
void prove_errors_rise(void)
{
    struct signals lower = any_signals();
    struct signals higher = lower;
    signal_word p_error;

    higher.setpoint = nondet_int16();
    c = nondet_pid();
    assume(pid_is_set(&c));
    assume(pid_is_in_order(&c, lower.setpoint, higher.setpoint));
    if (lower.setpoint <= higher.setpoint) {
        assume_rises(c.setpoint_weight, lower.setpoint, higher.setpoint);
    } else {
        assume_rises(c.setpoint_weight, higher.setpoint, lower.setpoint);
    }
    p_error = special_errors(&c, &lower);
    claim(special_errors(&c, &higher) >= p_error);
    claim(pid_errors_rise(&lower, &higher));
}

// By contract: mul16.
void prove_derivative_rises(void)
{
    struct signals lower = any_signals();
    struct signals higher = any_signals();
    struct fixpid_pid other;
    number previous;

    c = nondet_pid();
    assume(pid_may_differentiate(&c));
    assume(pid_errors_rise(&lower, &higher));
    other = c;
    if ((c.status & FIXPID_PID_FIRST) == 0u) {
        previous = c.previous;
        assume_rises(c.kd, sat16(previous - lower.derivative_input),
                     sat16(previous - higher.derivative_input));
    }
    differentiate(&c, &lower);
    differentiate(&other, &higher);
    claim(other.derivative >= c.derivative);
}

// By contract: mul16.
void prove_candidate_rises(void)
{
    struct signals lower = any_signals();
    struct signals higher = any_signals();

    c = nondet_pid();
    assume(pid_may_integrate(&c));
    assume(pid_errors_rise(&lower, &higher));
    assume_rises(c.ki, lower.error, higher.error);
    integrate(&c, &lower);
    integrate(&c, &higher);
    claim(pid_candidates_rise(&c, &lower, &higher));
}

// Where either the sum or the candidate is the same: what rises with each
// rises with both.
void prove_limit_rises(void)
{
    struct signals lower = any_signals();
    struct signals higher = any_signals();
    struct fixpid_pid other;
    number out;

    c = nondet_pid();
    assume(pid_is_set(&c));
    if (nondet_bool()) {
        higher.p_d_ff = lower.p_d_ff;
    } else {
        higher.integral = lower.integral;
        higher.fraction = lower.fraction;
    }
    assume(pid_candidates_rise(&c, &lower, &higher));
    assume(pid_sums_rise(&lower, &higher));
    other = c;
    out = limit_and_remember(&c, &lower);
    claim(limit_and_remember(&other, &higher) >= out);
}

// The integral that is taken over falls by as much as the sum rises.
void prove_held_rises(void)
{
    struct signals lower = any_signals();
    struct signals higher = any_signals();
    struct fixpid_pid other;
    number out;

    c = nondet_pid();
    assume(pid_may_take_over(&c, lower.p_d_ff));
    assume(pid_sums_rise(&lower, &higher));
    other = c;
    take_over(&c, &lower);
    take_over(&other, &higher);
    out = limit_and_remember(&c, &lower);
    claim(limit_and_remember(&other, &higher) >= out);
}

// ---- The other functions ----

static bool legal_gains(const struct fixpid_pid_gains *gains)
{
    return (gains->kp_q8 <= FIXPID_PID_KP_MAX) &&
           (gains->ki_q24 <= FIXPID_PID_KI_MAX) &&
           (gains->kd_q8 <= FIXPID_PID_KD_MAX) &&
           (gains->derivative_filter <= FIXPID_PID_FILTER_MAX);
}

// 0 and 0 are no range of its own.
static bool legal_range(number low, number high)
{
    return (low <= high) && (low >= -INT16_MAX);
}

static number range_low(number low, number high)
{
    return ((low == 0) && (high == 0)) ? -INT16_MAX : low;
}

static number range_high(number low, number high)
{
    return ((low == 0) && (high == 0)) ? INT16_MAX : high;
}

static bool legal_config(const struct fixpid_pid_config *config)
{
    const uint16_t b = config->setpoint_weight_q8;

    if (config->proportional_on_measurement) {
        if ((b != 0u) || (SCALED == 0u)) {
            return false;
        }
    }
    if ((config->reverse && (UPSIDE_DOWN == 0u)) ||
        (config->derivative_on_error && (BY_ERROR == 0u)) ||
        ((b != 0u) && (b != 256u) && (SCALED == 0u))) {
        return false;
    }
    return legal_gains(&config->gains) &&
           (config->output_min < config->output_max) &&
           legal_range(config->integral_min, config->integral_max) &&
           (b <= 256u);
}

// 15 bits of ki are kept: with 24 fractional bits, with 16 up to what rounds to
// 32767 of them, or with 8; to the nearest, half up. That is within 0.4 % of
// it.
static void claim_gains(const struct fixpid_pid_gains *gains)
{
    const number given = gains->ki_q24;
    const bool fine = given <= 32767;
    const bool coarse = given >= ((number)32767 * 256) + 128;
    const number kept = (number)c.ki << (fine ? 0 : coarse ? 16 : 8);

    claim(c.kp == gains->kp_q8);
    claim(c.kd == gains->kd_q8);
    claim((c.options & FILTERED) == gains->derivative_filter);
    claim(((c.options & FINE) != 0u) == fine);
    claim(((c.options & COARSE) != 0u) == coarse);
    claim(c.ki == (fine     ? given
                   : coarse ? floor_by(given + 32768, 16)
                            : floor_by(given + 128, 8)));
    claim(inside((kept - given) * 250, -given, given));
}

// The integral is as set_limits and set_feedforward leave it: of what it was,
// they drop what would be wind-up, and before the first step all of it.
static number settled(const struct fixpid_pid *x)
{
    const bool first = (x->status & FIXPID_PID_FIRST) != 0u;
    const number p_d =
        TIMES(x->kp, (number)x->proportional_error) + x->derivative;
    const number most = (((number)x->output_max - x->feedforward) * 256) -
                        ((p_d < 0) ? p_d : 0);
    const number least = (((number)x->output_min - x->feedforward) * 256) -
                         ((p_d > 0) ? p_d : 0);

    return limited(x, clamp(first ? 0 : whole(x), least * COUNT, most * COUNT));
}

// The feed-forward is 0: the output at rest is what its range has nearest to 0.
static bool at_rest(const struct fixpid_pid *x)
{
    return (whole(x) ==
            limited(x, clamp(0, x->output_min, x->output_max) * PART)) &&
           (x->derivative == 0) && (x->previous == UNSEEN) &&
           (x->proportional_error == 0) && (x->feedforward == 0) &&
           (x->output == 0) && (x->status == FIXPID_PID_FIRST);
}

void prove_init(void)
{
    const struct fixpid_pid_config config = any_config();
    const bool legal = legal_config(&config);

    c = nondet_pid();
    claim(fixpid_pid_init(&c, &config) == legal);
    claim(refused(&c) == !legal);
    claim(((fixpid_pid_flags(&c) & FIXPID_PID_REFUSED) != 0u) == !legal);
    claim(at_rest(&c));
    claim(pid_is_sound(&c));
    if (legal) {
        const uint16_t b = config.setpoint_weight_q8;

        claim_gains(&config.gains);
        claim(c.output_min == config.output_min);
        claim(c.output_max == config.output_max);
        claim(c.integral_min ==
              range_low(config.integral_min, config.integral_max));
        claim(c.integral_max ==
              range_high(config.integral_min, config.integral_max));
        claim(((c.options & UPSIDE_DOWN) != 0u) == config.reverse);
        claim(((c.options & BY_ERROR) != 0u) == config.derivative_on_error);
        // b = 1 needs no product, and 0 is said by the bool.
        claim(((c.options & SCALED) != 0u) ==
              (config.proportional_on_measurement || ((b & 0xFFu) != 0u)));
        claim(((c.options & SCALED) == 0u) || (c.setpoint_weight == b));
    }
}

// The fields that are legal, up to the one that check names.
void prove_check(void)
{
    const struct fixpid_pid_config config = any_config();
    const struct fixpid_pid_gains *const gains = &config.gains;
    const unsigned b_most = config.proportional_on_measurement ? 0u : 256u;
    const unsigned problem = (unsigned)fixpid_pid_check(&config);
    const bool good[] = {true,
                         gains->kp_q8 <= FIXPID_PID_KP_MAX,
                         gains->ki_q24 <= FIXPID_PID_KI_MAX,
                         gains->kd_q8 <= FIXPID_PID_KD_MAX,
                         gains->derivative_filter <= 7u,
                         config.output_min < config.output_max,
                         config.integral_min >= -INT16_MAX,
                         config.integral_min <= config.integral_max,
                         config.setpoint_weight_q8 <= b_most};

    c = nondet_pid();
    claim(fixpid_pid_init(&c, &config) == (problem == FIXPID_PID_OK));
    claim(problem <= FIXPID_PID_BAD_SETPOINT_WEIGHT_Q8);
    for (unsigned field = 1; field < sizeof good; field++) {
        claim(good[field] || ((problem != 0u) && (problem <= field)));
        claim((problem != field) || !good[field]);
    }
}

void prove_set_gains(void)
{
    const struct fixpid_pid_gains gains = nondet_pid_gains();
    struct fixpid_pid was;
    bool legal;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    legal = !refused(&was) && legal_gains(&gains);
    claim(fixpid_pid_set_gains(&c, &gains) == legal);
    if (legal) {
        claim_gains(&gains);
        was.kp = c.kp;
        was.ki = c.ki;
        was.kd = c.kd;
        claim((c.options & OF_STEP) == (was.options & OF_STEP));
        was.options = c.options;
    }
    claim(same(&c, &was));
    claim(pid_is_sound(&c));
}

// By contract: mul16.
void prove_set_limits(void)
{
    const int16_t low = nondet_int16();
    const int16_t high = nondet_int16();
    struct fixpid_pid was;
    bool legal;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    legal = !refused(&was) && (low < high);
    claim(fixpid_pid_set_limits(&c, low, high) == legal);
    if (legal) {
        was.output_min = low;
        was.output_max = high;
        if ((was.status & HOLDING) != 0u) {
            claim(c.integral ==
                  clamp(floor_by(was.integral, 16), low, high) * COUNT);
        } else {
            claim(whole(&c) == settled(&was));
        }
        was.integral = c.integral;
        was.integral_fraction = c.integral_fraction;
    }
    claim(same(&c, &was));
    claim(pid_is_sound(&c));
}

void prove_set_integral_limits(void)
{
    const int16_t low = nondet_int16();
    const int16_t high = nondet_int16();
    struct fixpid_pid was;
    bool legal;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    legal = !refused(&was) && legal_range(low, high);
    claim(fixpid_pid_set_integral_limits(&c, low, high) == legal);
    if (legal) {
        was.integral_min = (int16_t)range_low(low, high);
        was.integral_max = (int16_t)range_high(low, high);
        if ((was.status & HOLDING) == 0u) {
            claim(whole(&c) == limited(&was, whole(&was)));
            was.integral = c.integral;
            was.integral_fraction = c.integral_fraction;
        }
    }
    claim(same(&c, &was));
    claim(pid_is_sound(&c));
}

#if FIXPID_PID_FEATURES == FIXPID_PID_ALL // it calls what others lack
// By contract: mul16.
void prove_modes(void)
{
    const int16_t value = nondet_int16();
    struct fixpid_pid was;
    number held;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    held = clamp(value, was.output_min, was.output_max);
    if (nondet_bool()) {
        fixpid_pid_set_feedforward(&c, value);
        if (!refused(&was)) {
            was.feedforward = value;
            claim(whole(&c) == (((was.status & (HOLDING | FIXPID_PID_FIRST)) ==
                                 FIXPID_PID_FIRST)
                                    ? settled(&was)
                                    : whole(&was)));
        }
    } else if (nondet_bool()) {
        fixpid_pid_set_manual(&c, value);
        claim(c.integral == held * COUNT);
        claim(c.status == ((was.status & 0x9Fu) | FIXPID_PID_MANUAL));
    } else if (nondet_bool()) {
        fixpid_pid_set_auto(&c);
        if ((was.status & FIXPID_PID_MANUAL) != 0u) {
            was.status = (was.status & 0x9Fu) | FIXPID_PID_SEEDED;
        }
        claim(same(&c, &was));
    } else {
        fixpid_pid_seed(&c, value);
        claim(c.integral == held * COUNT);
        claim(((c.status & FIXPID_PID_MANUAL) != 0u)
                  ? (c.status == was.status)
                  : (c.status == (was.status | FIXPID_PID_SEEDED)));
    }
    was.integral = c.integral;
    was.integral_fraction = c.integral_fraction;
    was.status = c.status;
    claim(same(&c, &was));
    claim(pid_is_sound(&c));
}
#endif

void prove_reset(void)
{
    struct fixpid_pid was;

    c = nondet_pid(); // also of what is not sound
    was = c;
    assume(pid_may_reset(&was));
    fixpid_pid_reset(&c);
    claim(at_rest(&c));
    was.feedforward = 0;
    claim(same_settings(&c, &was));
    claim(!pid_is_set(&was) || pid_is_sound(&c));
}

#if FIXPID_PID_FEATURES == FIXPID_PID_ALL // it calls what others lack
// (applied - output) / 2^shift counts, toward minus infinity in 1/2^16.
void prove_track(void)
{
    const int16_t applied = nondet_int16();
    const uint8_t shift = nondet_uint8();
    struct fixpid_pid was;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    fixpid_pid_track(&c, applied, shift);
    if (!refused(&was) && ((was.status & FIXPID_PID_FIRST) == 0u)) {
        const number apart = sat16((number)applied - was.output);

        was.output = applied;
        if ((was.status & HOLDING) == 0u) {
            claim(whole(&c) ==
                  limited(&was,
                          whole(&was) + (floor_by(apart * COUNT,
                                                  (shift > 15u) ? 15u : shift) *
                                         256)));
            was.integral = c.integral;
            was.integral_fraction = c.integral_fraction;
        }
    }
    claim(fixpid_pid_output(&c) == was.output);
    claim(same(&c, &was));
    claim(pid_is_sound(&c));
}
#endif

// What the step is given in the place of setpoint and measurement, and what the
// object holds then.
static struct given {
    struct fixpid_pid object;
    int16_t setpoint;
    int16_t measurement;
} given;

int16_t fixpid_pid_step_contract(struct fixpid_pid *self, int16_t setpoint,
                                 int16_t measurement)
{
    given.object = *self;
    given.setpoint = setpoint;
    given.measurement = measurement;
    self->status &= (uint8_t)~FIXPID_PID_FIRST;
    self->previous = (int16_t)input_of(self, setpoint, measurement);
    return nondet_int16();
}

static number wrap16(number x)
{
    return x - (floor_by(x + 32768, 16) * COUNT);
}

// What the derivative saw before, as a measurement.
static number seen_by(const struct fixpid_pid *x)
{
    if ((x->status & FIXPID_PID_FIRST) != 0u) {
        return 0;
    }
    return ((x->options & UPSIDE_DOWN) != 0u) ? (-1 - x->previous)
                                              : x->previous;
}

// The derivative's input in the step, and where it falls from.
static number fall_of(const struct fixpid_pid *x, number input)
{
    return ((x->status & FIXPID_PID_FIRST) != 0u) ? 0
                                                  : sat16(x->previous - input);
}

// Any differences: the step sees the error, without a weight, and the fall. By
// contract: fixpid_pid_step.
void prove_step_error(void)
{
    const int32_t error = nondet_int32();
    const int32_t rise = nondet_int32();
    struct fixpid_pid was;
    number e;
    number input;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    (void)fixpid_pid_step_error(&c, error, rise);
    e = error_of(&was, error, 0);
    input = input_of(&given.object, given.setpoint, given.measurement);
    claim(error_of(&given.object, given.setpoint, given.measurement) == e);
    claim((given.object.options & (UPSIDE_DOWN | SCALED)) == 0u);
    claim((given.object.options | UPSIDE_DOWN | SCALED) ==
          (was.options | UPSIDE_DOWN | SCALED));
    claim(sound_previous(&given.object));
    if ((was.options & BY_ERROR) != 0u) {
        claim(fall_of(&given.object, input) == fall_of(&was, -1 - e));
        was.previous = (int16_t)(-1 - e);
    } else {
        const number sees = wrap16(seen_by(&was) + rise);

        claim(((was.status & FIXPID_PID_FIRST) != 0u) ||
              (fall_of(&given.object, input) == error_of(&was, 0, rise)));
        was.previous =
            (int16_t)(((was.options & UPSIDE_DOWN) != 0u) ? (-1 - sees) : sees);
    }
    was.status &= (uint8_t)~FIXPID_PID_FIRST;
    claim(same(&c, &was));
    given.object.options = was.options;
    given.object.previous = was.previous;
    given.object.status = was.status;
    claim(same(&given.object, &was));
}

// Exact differences: the step sees what it would see of r and y, and afterwards
// `previous` is as after step(r, y). By contract: fixpid_pid_step.
void prove_step_exact(void)
{
    const int16_t r = nondet_int16();
    const int16_t y = nondet_int16();
    struct fixpid_pid was;
    number input;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    (void)fixpid_pid_step_error(&c, (int32_t)r - y,
                                (int32_t)((number)y - seen_by(&was)));
    input = input_of(&given.object, given.setpoint, given.measurement);
    claim(error_of(&given.object, given.setpoint, given.measurement) ==
          error_of(&was, r, y));
    claim(fall_of(&given.object, input) == fall_of(&was, input_of(&was, r, y)));
    claim(c.previous == input_of(&was, r, y));
    claim(c.options == was.options);
}

#if FIXPID_PID_FEATURES == FIXPID_PID_ALL // it calls what others lack
// By contract: mul16.
void prove_read(void)
{
    struct fixpid_pid was;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    claim(fixpid_pid_proportional(&c) ==
          TIMES(c.kp, (number)c.proportional_error));
    claim(fixpid_pid_integral(&c) == c.integral);
    claim(fixpid_pid_derivative(&c) == c.derivative);
    claim(fixpid_pid_output(&c) == c.output);
    claim(fixpid_pid_flags(&c) ==
          (refused(&c) ? (c.status | FIXPID_PID_REFUSED) : c.status));
    claim(same(&c, &was));
}
#endif

struct state {
    uint8_t bytes[FIXPID_PID_STATE_SIZE];
};
struct state nondet_state(void);

// The signed number of `size` bytes, the lowest first.
static number number_at(const struct state *state, unsigned at, unsigned size)
{
    number value = (int8_t)state->bytes[at + size - 1u];

    for (unsigned i = size - 1u; i > 0u; i--) {
        value = (value * 256) + state->bytes[at + i - 1u];
    }
    return value;
}

// What no controller has: a flag that is none, and what needs a feature.
static bool known(uint8_t flags, number feedforward)
{
    return ((flags & (0x17u | HOLDING)) == flags) &&
           (HAS(FIXPID_PID_HAS_FEEDFORWARD, true) || (feedforward == 0));
}

// Domain: a sound object that was accepted, with flags that exist and nothing
// of a feature that is left out.
static bool pid_is_known(const struct fixpid_pid *x)
{
    return pid_is_sound(x) && !refused(x) && known(x->status, x->feedforward);
}

// Domain: a sound object with the settings of another.
static bool pid_is_of(const struct fixpid_pid *x,
                      const struct fixpid_pid *other)
{
    return pid_is_sound(x) && same_settings(x, other);
}

void prove_state(void)
{
    struct state state = nondet_state();
    struct fixpid_pid was;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    fixpid_pid_state(&c, state.bytes);
    claim(number_at(&state, 0, 2) == c.output);
    claim(state.bytes[2] ==
          (refused(&c) ? (c.status | FIXPID_PID_REFUSED) : c.status));
    claim(number_at(&state, 3, 4) == c.integral);
    claim(state.bytes[7] == c.integral_fraction);
    claim(number_at(&state, 8, 4) == c.derivative);
    claim(number_at(&state, 12, 2) == c.feedforward);
    claim(number_at(&state, 14, 2) ==
          (((c.status & FIXPID_PID_FIRST) != 0u) ? 0 : c.previous));
    claim(number_at(&state, 16, 2) == c.proportional_error);
    claim(same(&c, &was));
}

// Of any bytes.
void prove_restore(void)
{
    const struct state state = nondet_state();
    const uint8_t flags = state.bytes[2];
    const number integral = number_at(&state, 3, 4);
    const number derivative = number_at(&state, 8, 4);
    const number feedforward = number_at(&state, 12, 2);
    struct fixpid_pid was;
    bool possible;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    if ((flags & HOLDING) != 0u) {
        possible = ((integral & 0xFFFF) == 0) &&
                   inside(floor_by(integral, 16), c.output_min, c.output_max);
    } else {
        possible = inside((integral * 256) + state.bytes[7],
                          c.integral_min * PART, c.integral_max * PART);
    }
    possible = possible && !refused(&c) && known(flags, feedforward) &&
               inside(derivative, -D_MAX, D_MAX);
    claim(fixpid_pid_restore(&c, state.bytes) == possible);
    if (possible) {
        was.output = (int16_t)number_at(&state, 0, 2);
        was.status = flags;
        was.integral = (int32_t)integral;
        was.integral_fraction = state.bytes[7];
        was.derivative = (int32_t)derivative;
        was.feedforward = (int16_t)feedforward;
        was.previous = ((flags & FIXPID_PID_FIRST) != 0u)
                           ? UNSEEN
                           : (int)number_at(&state, 14, 2);
        was.proportional_error = (int16_t)number_at(&state, 16, 2);
    }
    claim(same(&c, &was));
    claim(pid_is_sound(&c));
}

// A controller of the same settings, in any state, is the same afterwards.
void prove_going_on(void)
{
    struct state state = nondet_state();
    struct fixpid_pid was;

    c = nondet_pid();
    assume(pid_is_known(&c));
    was = c;
    fixpid_pid_state(&c, state.bytes);
    c = nondet_pid();
    c.feedforward = was.feedforward;
    assume(pid_is_of(&c, &was));
    c.feedforward = nondet_int16();
    claim(fixpid_pid_restore(&c, state.bytes));
    claim(same(&c, &was));
}

void prove_refused(void)
{
    c = nondet_pid();
    c.output_max = c.output_min;
    assume(pid_is_sound(&c));
    claim(fixpid_pid_step(&c, nondet_int16(), nondet_int16()) == 0);
    claim(pid_is_sound(&c));
}

static void claim_output(int16_t out)
{
    if (c.output_min <= c.output_max) {
        claim(inside(out, c.output_min, c.output_max));
    } else {
        claim((out == c.output_min) || (out == c.output_max));
    }
}

// Of any bytes: nothing undefined, and the output within its limits.
void prove_total(void)
{
    c = nondet_pid();
    claim_output(fixpid_pid_step(&c, nondet_int16(), nondet_int16()));
}

void prove_total_error(void)
{
    c = nondet_pid();
    claim_output(fixpid_pid_step_error(&c, nondet_int32(), nondet_int32()));
}

#if FIXPID_PID_FEATURES == FIXPID_PID_ALL // it calls what others lack
void prove_total_rest(void)
{
    const struct fixpid_pid_gains gains = nondet_pid_gains();
    const int16_t a = nondet_int16();
    const int16_t b = nondet_int16();

    c = nondet_pid();
    (void)fixpid_pid_set_gains(&c, &gains);
    (void)fixpid_pid_set_limits(&c, a, b);
    (void)fixpid_pid_set_integral_limits(&c, a, b);
    fixpid_pid_set_feedforward(&c, a);
    fixpid_pid_track(&c, a, nondet_uint8());
    fixpid_pid_set_manual(&c, b);
    fixpid_pid_set_auto(&c);
    fixpid_pid_seed(&c, a);
    (void)fixpid_pid_proportional(&c);
    fixpid_pid_reset(&c);
}
#endif
