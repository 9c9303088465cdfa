// SPDX-License-Identifier: MIT
// fixpid_relay against the machine that its header describes, and what its
// result relies on.
#include "prove.h"

#include "fixpid_relay.h"

struct fixpid_relay c; // of any bytes, where a proof begins
struct fixpid_relay nondet_relay(void);
struct fixpid_relay_config nondet_relay_config(void);
struct fixpid_pid_gains nondet_pid_gains(void);

#include "relay/fixpid_relay.c"

static bool legal_config(const struct fixpid_relay_config *k)
{
    return (k->output_min < k->output_max) &&
           (k->measurement_min < k->measurement_max) &&
           inside(k->hysteresis, 1, 8191) &&
           inside(k->timeout_steps, 2, 32767) && inside(k->cycles, 1, 8) &&
           ((k->options & 0x7Fu) == 0u);
}

static bool before_the_first_step(const struct fixpid_relay *x)
{
    return (x->elapsed == 0u) && (x->high_steps == 0u) && (x->seen == 0u) &&
           (x->averaged == 0u) && (x->error_sum == 0u);
}

static bool sound_cycles(const struct fixpid_relay *x)
{
    const bool running = x->status == FIXPID_RELAY_RUNNING;

    if ((x->averaged > x->config.cycles) || (x->averaged > x->seen) ||
        (x->seen > CYCLES_SEEN_MAX)) {
        return false;
    }
    if (running &&
        ((x->averaged == x->config.cycles) || (x->seen == CYCLES_SEEN_MAX))) {
        return false;
    }
    return (x->averaged == 0u) ||
           (inside(x->period_sum, 2 * (number)x->averaged,
                   (number)x->averaged * PERIOD_MAX) &&
            (x->swing_sum <= (uint32_t)x->averaged * 65535u) &&
            inside(x->last_period, 2, PERIOD_MAX));
}

// What init establishes from any bytes and every function keeps. The sum of the
// errors is that of the steps of this cycle.
static bool sound(const struct fixpid_relay *x)
{
    const number timeout = x->config.timeout_steps;
    const bool done = x->status == FIXPID_RELAY_DONE;

    if (x->config.cycles == 0u) {
        return (x->status == FIXPID_RELAY_REFUSED) &&
               (x->config.output_rest == 0);
    }
    if (!legal_config(&x->config) || (x->status == FIXPID_RELAY_REFUSED) ||
        (x->status > FIXPID_RELAY_TOO_SMALL) || (x->side > SIDE_LOW)) {
        return false;
    }
    if (x->side == SIDE_UNKNOWN) {
        return before_the_first_step(x) && !done;
    }
    if (!inside(x->elapsed, 1, timeout) ||
        !inside(x->high_steps, 0, timeout - 1) || (x->lowest > x->highest) ||
        !sound_cycles(x)) {
        return false;
    }
    if ((x->side == SIDE_LOW) && (x->seen != 0u) && (x->high_steps == 0u)) {
        return false;
    }
    return !done || ((x->averaged == x->config.cycles) &&
                     (x->period_sum >= 6u * (uint32_t)x->averaged) &&
                     (x->swing_sum >=
                      4u * (uint32_t)x->averaged * x->config.hysteresis));
}

static bool same_config(const struct fixpid_relay_config *a,
                        const struct fixpid_relay_config *b)
{
    return (a->output_min == b->output_min) &&
           (a->output_max == b->output_max) &&
           (a->output_rest == b->output_rest) &&
           (a->measurement_min == b->measurement_min) &&
           (a->measurement_max == b->measurement_max) &&
           (a->hysteresis == b->hysteresis) &&
           (a->timeout_steps == b->timeout_steps) && (a->cycles == b->cycles) &&
           (a->options == b->options);
}

void prove_init(void)
{
    const struct fixpid_relay_config config = nondet_relay_config();
    const bool legal = legal_config(&config);

    c = nondet_relay();
    claim(fixpid_relay_init(&c, &config) == legal);
    claim(fixpid_relay_status(&c) ==
          (legal ? FIXPID_RELAY_RUNNING : FIXPID_RELAY_REFUSED));
    claim(!legal || same_config(&c.config, &config));
    claim(sound(&c));
    fixpid_relay_reset(&c);
    claim(fixpid_relay_status(&c) ==
          (legal ? FIXPID_RELAY_RUNNING : FIXPID_RELAY_REFUSED));
    claim(sound(&c));
}

static bool alike_as_defined(number now, number before) // a quarter and 2
{
    return inside(now - before, -floor_by(now, 2) - 2, floor_by(now, 2) + 2);
}

// A cycle ends with this step: what is averaged, and what it came to.
static void claim_cycle(const struct fixpid_relay *was, number measurement)
{
    const number highest =
        (measurement > was->highest) ? measurement : was->highest;
    const number lowest =
        (measurement < was->lowest) ? measurement : was->lowest;
    const number period = (number)was->high_steps + was->elapsed;
    const number swing = highest - lowest;
    const bool alike_both = alike_as_defined(period, was->last_period) &&
                            alike_as_defined(swing, was->last_swing);
    const number averaged = (was->seen == 0u)
                                ? was->averaged
                                : ((alike_both ? was->averaged : 0) + 1);

    claim(c.seen == was->seen + 1);
    claim(c.averaged == averaged);
    if (was->seen != 0u) {
        claim((c.last_period == period) && (c.last_swing == swing));
        claim(c.period_sum == ((averaged == 1) ? 0 : was->period_sum) + period);
        claim(c.swing_sum == ((averaged == 1) ? 0 : was->swing_sum) + swing);
    }
    if (averaged != was->config.cycles) {
        claim(c.status == ((c.seen == CYCLES_SEEN_MAX) ? FIXPID_RELAY_IRREGULAR
                                                       : FIXPID_RELAY_RUNNING));
    } else if ((was->high_steps > 4 * (number)was->elapsed) ||
               (was->elapsed > 4 * (number)was->high_steps)) {
        claim(c.status == FIXPID_RELAY_IRREGULAR);
    } else if (c.period_sum < 6 * averaged) {
        claim(c.status == FIXPID_RELAY_TOO_FAST);
    } else if (c.swing_sum < 4 * averaged * was->config.hysteresis) {
        claim(c.status == FIXPID_RELAY_TOO_SMALL);
    } else {
        claim(c.status == FIXPID_RELAY_DONE);
    }
    if (c.status == FIXPID_RELAY_RUNNING) {
        claim((c.highest == measurement) && (c.lowest == measurement));
        claim((c.elapsed == 1u) && (c.error_sum == 0u));
    }
}

static void claim_output(const struct fixpid_relay *was, number error,
                         number out)
{
    const number hysteresis = was->config.hysteresis;
    bool high = was->side == SIDE_HIGH;

    if (c.status != FIXPID_RELAY_RUNNING) {
        claim(out == was->config.output_rest);
        return;
    }
    if (was->side == SIDE_UNKNOWN) {
        high = error >= 0;
    }
    if (error > hysteresis) {
        high = true;
    }
    if (error < -hysteresis) {
        high = false;
    }
    claim(out == (high ? was->config.output_max : was->config.output_min));
}

void prove_step(void)
{
    const int16_t setpoint = nondet_int16();
    const int16_t measurement = nondet_int16();
    struct fixpid_relay was;
    number error = (number)setpoint - measurement;
    number out;

    c = nondet_relay();
    assume(sound(&c));
    was = c;
    out = fixpid_relay_step(&c, setpoint, measurement);
    claim(sound(&c));
    claim(same_config(&c.config, &was.config));
    if ((was.config.options & FIXPID_RELAY_REVERSE) != 0u) {
        error = -error;
    }
    claim_output(&was, error, out);
    if (was.status != FIXPID_RELAY_RUNNING) { // it is final
        claim(c.status == was.status);
    } else if ((measurement <= was.config.measurement_min) ||
               (measurement >= was.config.measurement_max)) {
        claim(c.status == FIXPID_RELAY_SATURATED);
    } else if (was.elapsed >= was.config.timeout_steps) {
        claim(c.status == FIXPID_RELAY_NO_OSCILLATION);
    } else if ((was.side == SIDE_LOW) && (error > was.config.hysteresis)) {
        claim_cycle(&was, measurement);
    } else {
        const bool turned =
            (was.side == SIDE_HIGH) && (error < -(number)was.config.hysteresis);
        const bool first = was.side == SIDE_UNKNOWN;

        claim(c.status == FIXPID_RELAY_RUNNING);
        if (!first) {
            claim((c.seen == was.seen) && (c.averaged == was.averaged));
            claim(c.elapsed == (turned ? 1 : (was.elapsed + 1)));
            claim(c.high_steps == (turned ? was.elapsed : was.high_steps));
        }
        claim(c.highest == ((first || (measurement > was.highest))
                                ? measurement
                                : was.highest));
        claim(c.lowest == ((first || (measurement < was.lowest)) ? measurement
                                                                 : was.lowest));
    }
}

// It ends: a step of a running experiment moves (cycles seen, side, elapsed) on
// in the order of a dictionary, and each of the three has a largest value.
void prove_end(void)
{
    struct fixpid_relay was;

    c = nondet_relay();
    assume(sound(&c));
    assume(c.status == FIXPID_RELAY_RUNNING);
    was = c;
    (void)fixpid_relay_step(&c, nondet_int16(), nondet_int16());
    claim(inside(c.seen, was.seen, CYCLES_SEEN_MAX));
    claim(inside(c.elapsed, 0, c.config.timeout_steps));
    if ((c.status == FIXPID_RELAY_RUNNING) && (c.seen == was.seen)) {
        claim((c.side == was.side) || (was.side == SIDE_UNKNOWN) ||
              ((was.side == SIDE_HIGH) && (c.side == SIDE_LOW)));
        claim((c.side != was.side) || (c.elapsed > was.elapsed));
    }
}

// Of any bytes: nothing undefined and no division by zero, the output is one of
// the three configured, and a result is accepted by fixpid_pid or untouched.
void prove_total(void)
{
    struct fixpid_relay was;
    number out;

    c = nondet_relay();
    was = c;
    out = fixpid_relay_step(&c, nondet_int16(), nondet_int16());
    claim((out == was.config.output_min) || (out == was.config.output_max) ||
          (out == was.config.output_rest));
}

void prove_result(void)
{
    const struct fixpid_pid_gains before = nondet_pid_gains();
    struct fixpid_pid_gains gains = before;

    c = nondet_relay();
    if (fixpid_relay_result(&c, nondet_uint8(), &gains)) {
        claim(c.status == FIXPID_RELAY_DONE);
        claim(inside(gains.kp_q8, 1, FIXPID_PID_KP_MAX));
        claim(inside(gains.ki_q24, 8, FIXPID_PID_KI_MAX));
        claim(gains.kd_q8 <= FIXPID_PID_KD_MAX);
        claim(gains.derivative_filter <= FIXPID_PID_FILTER_MAX);
    } else {
        claim((gains.kp_q8 == before.kp_q8) &&
              (gains.ki_q24 == before.ki_q24) &&
              (gains.kd_q8 == before.kd_q8) &&
              (gains.derivative_filter == before.derivative_filter));
    }
}
