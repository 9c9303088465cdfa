// SPDX-License-Identifier: MIT
// A step of fixpid_autotune, part by part and as the whole that the parts make:
// what it does is what autotune.h says in whole numbers, and that keeps what an
// experiment can be.
#include "autotune.h"

#include "autotune/fixpid_autotune.c"
#include "autotune/fixpid_autotune_cycle.c"
#include "autotune/fixpid_autotune_relay.c"

void prove_noise(void)
{
    const int16_t deviation = nondet_int16();
    struct fixpid_autotune defined;

    c = nondet_autotune();
    assume(autotune_may_listen(&c, deviation));
    defined = c;
    noise_as_defined(&defined, deviation);
    measure_noise(&c, deviation);
    claim_same(&c, &defined);
    claim((c.state == IN_NOISE) || inside(c.edge, 1, 1536));
}

void prove_sum(void)
{
    const int16_t deviation = nondet_int16();
    struct fixpid_autotune defined;

    c = nondet_autotune();
    assume(autotune_may_sum(&c, deviation));
    defined = c;
    sum_as_defined(&defined, deviation);
    add_deviation(&c, deviation);
    claim_same(&c, &defined);
}

void fixpid_autotune_end_cycle_contract(struct fixpid_autotune *self,
                                        int16_t deviation)
{
    pre(autotune_may_end(self, deviation));
    take_part(&end_part, self, deviation);
}

// By contract: fixpid_autotune_end_cycle.
void prove_turn(void)
{
    const int16_t deviation = nondet_int16();
    struct fixpid_autotune defined;

    c = nondet_autotune();
    assume(autotune_may_turn(&c, deviation));
    defined = c;
    turn_as_defined(&defined, deviation);
    turn_relay(&c, deviation);
    claim_same(&c, &defined);
    claim(!end_part.due);
}

void add_deviation_contract(struct fixpid_autotune *self, int16_t deviation)
{
    pre(autotune_may_sum(self, deviation));
    take_part(&sum_part, self, deviation);
}

void turn_relay_contract(struct fixpid_autotune *self, int16_t deviation)
{
    pre(autotune_may_turn(self, deviation));
    take_part(&turn_part, self, deviation);
}

void fixpid_autotune_lose_cycle_contract(struct fixpid_autotune *self)
{
    take_part(&lost_part, self, 0);
}

// By contract: add_deviation, turn_relay, fixpid_autotune_lose_cycle.
void prove_relay(void)
{
    const int16_t deviation = nondet_int16();
    struct fixpid_autotune defined;

    c = nondet_autotune();
    assume(autotune_may_switch(&c, deviation));
    defined = c;
    turn_part.open = true;
    relay_as_defined(&defined, deviation);
    step_relay(&c, deviation);
    claim_same(&c, &defined);
    claim(!sum_part.due && !turn_part.due && !lost_part.due);
}

void measure_noise_contract(struct fixpid_autotune *self, int16_t deviation)
{
    pre(autotune_may_listen(self, deviation));
    take_part(&noise_part, self, deviation);
}

void step_relay_contract(struct fixpid_autotune *self, int16_t deviation)
{
    pre(autotune_may_switch(self, deviation));
    take_part(&relay_part, self, deviation);
}

// By contract: measure_noise, step_relay.
void prove_step(void)
{
    const int16_t setpoint = nondet_int16();
    const int16_t measurement = nondet_int16();
    struct fixpid_autotune defined;
    number out;

    c = nondet_autotune();
    assume(autotune_is_sound(&c));
    defined = c;
    noise_part.open = true;
    relay_part.open = true;
    if (defined.state >= IN_NOISE) {
        step_as_defined(&defined, setpoint, measurement);
    }
    out = fixpid_autotune_step(&c, setpoint, measurement);
    claim_same(&c, &defined);
    claim(!noise_part.due && !relay_part.due);
    claim(out == clamp(c.output, c.config.output_min, c.config.output_max));
}

// An experiment stays one. By contract: measure_noise, step_relay.
void prove_kept(void)
{
    const int16_t setpoint = nondet_int16();
    const int16_t measurement = nondet_int16();
    struct fixpid_autotune defined;

    c = nondet_autotune();
    assume(autotune_is_running(&c));
    defined = c;
    step_as_defined(&defined, setpoint, measurement);
    (void)fixpid_autotune_step(&c, setpoint, measurement);
    claim(autotune_is_sound(&c));
}

// The halves of cycles that are left. A relay that is lost costs four cycles.
static number halves_left(const struct fixpid_autotune *x)
{
    return (2 * (48 - (number)x->seen)) -
           (((x->state != IN_NOISE) && (x->side == LOW_SIDE)) ? 1 : 0);
}

// It ends within 34 + 97 timeout_steps steps: after the noise there are 96
// halves at most, and each step of a half is one of timeout_steps. By contract:
// measure_noise, step_relay.
void prove_ends(void)
{
    const int16_t setpoint = nondet_int16();
    const int16_t measurement = nondet_int16();
    struct fixpid_autotune was;
    struct fixpid_autotune defined;

    c = nondet_autotune();
    assume(autotune_is_running(&c));
    was = c;
    defined = c;
    step_as_defined(&defined, setpoint, measurement);
    (void)fixpid_autotune_step(&c, setpoint, measurement);
    claim(inside(halves_left(&was), 1, 96));
    if ((c.state >= IN_NOISE) && (halves_left(&c) == halves_left(&was)) &&
        (c.state == was.state)) {
        claim(c.elapsed == (number)was.elapsed + 1);
        claim(c.elapsed <= c.config.timeout_steps);
    } else if ((c.state >= IN_NOISE) && (was.state != IN_NOISE)) {
        claim(halves_left(&c) < halves_left(&was));
        claim(c.elapsed == 1u);
    }
}
