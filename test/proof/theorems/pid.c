// SPDX-License-Identifier: MIT
// What a user may rely on of fixpid_pid, each in one sentence. The parts of a
// step stand here for what test/proof/pid.c proves of them.
#include "../pid.c"

// Where the integral is one, and not an output held.
static bool within_limits(const struct fixpid_pid *x)
{
    return inside(whole(x), x->integral_min * PART, x->integral_max * PART);
}

static bool is_held(const struct fixpid_pid *x)
{
    return (fixpid_pid_flags(x) & (FIXPID_PID_SEEDED | FIXPID_PID_MANUAL)) !=
           0u;
}

// Theorem: After fixpid_pid_seed, and after fixpid_pid_set_auto in manual, the
// next step returns exactly the output held, if the integral that this takes is
// within its limits.
// By contract: mul16, special_errors, differentiate, integrate, take_over,
// limit_and_remember.
void prove_bumpless(void)
{
    const int16_t value = nondet_int16();
    number held;
    number needed;
    number out;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    if ((c.status & FIXPID_PID_MANUAL) == 0u) {
        held = clamp(value, c.output_min, c.output_max);
        fixpid_pid_seed(&c, value);
    } else {
        held = floor_by(fixpid_pid_integral(&c), 16);
        fixpid_pid_set_auto(&c);
    }
    out = fixpid_pid_step(&c, nondet_int16(), nondet_int16());
    // In the order of the step: a solver is slow at the associative law.
    needed = (held * 256) -
             ((fixpid_pid_proportional(&c) + ((number)c.feedforward * 256)) +
              fixpid_pid_derivative(&c));
    if (inside(needed, c.integral_min * (number)256,
               c.integral_max * (number)256)) {
        claim(out == held);
        claim((fixpid_pid_flags(&c) & 7u) == 0u);
    }
}

// Theorem: In automatic, but for the step that takes over an output held and
// the first one with a setpoint weight, the integral does not rise in a step
// that is limited at output_max, and does not fall in one that is limited at
// output_min. By contract: mul16, special_errors, differentiate, integrate,
// take_over.
void prove_windup(void)
{
    struct fixpid_pid was;
    uint8_t flags;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    was = c;
    (void)fixpid_pid_step(&c, nondet_int16(), nondet_int16());
    flags = (is_held(&was) || starts(&was)) ? 0 : fixpid_pid_flags(&c);
    if ((flags & FIXPID_PID_AT_MAX) != 0u) {
        claim(whole(&c) <= whole(&was));
    }
    if ((flags & FIXPID_PID_AT_MIN) != 0u) {
        claim(whole(&c) >= whole(&was));
    }
}

// Theorem: Whatever is called, in any order, the integral stays within its
// limits, unless an output is held in its place. By contract: mul16,
// special_errors, differentiate, integrate, take_over, limit_and_remember.
void prove_integral_inside(void)
{
    const struct fixpid_pid_config config = any_config();
    const struct fixpid_pid_gains gains = nondet_pid_gains();
    const struct state state = nondet_state();
    const int16_t a = nondet_int16();
    const int16_t b = nondet_int16();

    c = nondet_pid();
    if (nondet_bool()) {
        (void)fixpid_pid_init(&c, &config);
    } else {
        assume(pid_is_sound(&c));
        switch (nondet_uint8()) {
        case 0:
            (void)fixpid_pid_step(&c, a, b);
            break;
        case 1:
            (void)fixpid_pid_step_error(&c, nondet_int32(), nondet_int32());
            break;
        case 2:
            (void)fixpid_pid_set_gains(&c, &gains);
            break;
        case 3:
            (void)fixpid_pid_set_limits(&c, a, b);
            break;
        case 4:
            (void)fixpid_pid_set_integral_limits(&c, a, b);
            break;
        case 5:
            fixpid_pid_set_feedforward(&c, a);
            break;
        case 6:
            fixpid_pid_set_manual(&c, a);
            break;
        case 7:
            fixpid_pid_set_auto(&c);
            break;
        case 8:
            fixpid_pid_seed(&c, a);
            break;
        case 9:
            fixpid_pid_track(&c, a, nondet_uint8());
            break;
        case 10:
            (void)fixpid_pid_restore(&c, state.bytes);
            break;
        default:
            fixpid_pid_reset(&c);
            break;
        }
    }
    claim(pid_is_sound(&c));
    if (!is_held(&c)) {
        claim(within_limits(&c));
    }
}

static int16_t mirrored(int16_t x)
{
    return (int16_t)(-1 - x);
}

// Theorem: Without a setpoint weight, a step with `reverse` sees of r and y
// exactly the errors and the derivative's input that a direct one sees of -1 -
// r and -1 - y.
void prove_mirror(void)
{
    struct signals of_reverse = any_signals();
    struct signals of_direct = of_reverse;
    signal_word error;

    of_direct.setpoint = mirrored(of_reverse.setpoint);
    of_direct.derivative_input = mirrored((int16_t)of_reverse.derivative_input);
    c = nondet_pid();
    c.options &= (uint8_t) ~(UPSIDE_DOWN | SCALED);
    error = special_errors(&c, &of_direct);
    c.options |= UPSIDE_DOWN;
    claim(special_errors(&c, &of_reverse) == error);
    claim(of_reverse.error == of_direct.error);
    claim(of_reverse.derivative_input == of_direct.derivative_input);
}

// What the proofs named `..._rises` show of the parts of two steps from the
// same state, of which the second has a setpoint with a higher error.
static struct {
    struct signals given;
    struct signals signals;
    number p_error;
    number derivative;
    number out;
    bool held;
    bool over;
} first;

signal_word special_errors_rise(struct fixpid_pid *self,
                                struct signals *signals)
{
    number p_error = nondet_int16();

    if (!first.over) {
        first.given = *signals;
    }
    pre(pid_is_in_order(self, first.given.setpoint, signals->setpoint));
    pre(signals->derivative_input == first.given.derivative_input);
    signals->error = nondet_int16();
    signals->derivative_input = nondet_int16();
    if (first.over) {
        assume(pid_errors_rise(&first.signals, signals));
        p_error = clamp(p_error, first.p_error, INT16_MAX);
    }
    return (signal_word)p_error;
}

// As the true product does.
int32_t mul16_rise(uint16_t gain, signal_word x)
{
    pre(gain <= 32767u);
    pre(inside(x, INT16_MIN, INT16_MAX));
    if (!first.over) {
        first.p_error = x;
    }
    assume_rises(gain, first.p_error, x);
    return (int32_t)TIMES(gain, (number)x);
}

void differentiate_rise(struct fixpid_pid *self, struct signals *signals)
{
    const number least = first.over ? first.derivative : -D_MAX;

    if (!first.over) {
        first.signals = *signals;
    }
    pre(pid_may_differentiate(self));
    pre(pid_errors_rise(&first.signals, signals));
    self->previous = signals->derivative_input;
    first.derivative = clamp(nondet_int32(), least, D_MAX);
    self->derivative = (int32_t)first.derivative;
}

void integrate_rise(struct fixpid_pid *self, struct signals *signals)
{
    pre(pid_may_integrate(self));
    pre(pid_errors_rise(&first.signals, signals));
    signals->integral = nondet_int32();
    signals->fraction = nondet_uint8();
    if (first.over) {
        assume(pid_candidates_rise(self, &first.signals, signals));
    }
}

// What it leaves is asked for together with limit_and_remember.
void take_over_rise(struct fixpid_pid *self, struct signals *signals)
{
    pre(pid_may_take_over(self, signals->p_d_ff));
    first.held = true;
}

int16_t limit_and_remember_rise(struct fixpid_pid *self,
                                struct signals *signals)
{
    const number least = first.over ? first.out : INT16_MIN;

    pre(pid_may_limit(self, signals->p_d_ff));
    if (!first.over) {
        first.signals = *signals;
    }
    pre(pid_sums_rise(&first.signals, signals));
    pre(first.held || pid_candidates_rise(self, &first.signals, signals));
    first.out = clamp(nondet_int16(), least, INT16_MAX);
    return (int16_t)first.out;
}

// Theorem: From the same state and with the same measurement, a step with a
// higher setpoint never returns less; with `reverse` it never returns more. By
// contract: mul16 (mul16_rise), special_errors (special_errors_rise),
// differentiate (differentiate_rise), integrate (integrate_rise), take_over
// (take_over_rise), limit_and_remember (limit_and_remember_rise).
void prove_monotone(void)
{
    const int16_t setpoint = nondet_int16();
    const int16_t other_setpoint = nondet_int16();
    const int16_t measurement = nondet_int16();
    struct fixpid_pid other;
    number out;

    c = nondet_pid();
    assume(pid_is_sound(&c));
    assume(pid_is_in_order(&c, setpoint, other_setpoint));
    other = c;
    out = fixpid_pid_step(&c, setpoint, measurement);
    first.over = true;
    claim(fixpid_pid_step(&other, other_setpoint, measurement) >= out);
}
