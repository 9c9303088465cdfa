// SPDX-License-Identifier: MIT
// fixpid_slew against the equation of its header.
#include "prove.h"

#include "fixpid_slew.h"

struct fixpid_slew c; // of any bytes, where a proof begins
struct fixpid_slew nondet_slew(void);

#include "slew/fixpid_slew.c"

#define ONE ((number)65536) // a count

// What init establishes from any bytes and every function keeps.
// Domain: the value lies within the counts.
static bool slew_is_sound(const struct fixpid_slew *x)
{
    return inside(x->value, INT16_MIN * ONE, INT16_MAX * ONE);
}

// value += clamp(target - value, -fall, rise)
void prove_step(void)
{
    const int16_t target = nondet_int16();
    struct fixpid_slew was;
    number value;
    number out;

    c = nondet_slew();
    assume(slew_is_sound(&c));
    was = c;
    out = fixpid_slew_step(&c, target);
    value = was.value + clamp((target * ONE) - was.value, -(number)was.fall_q16,
                              was.rise_q16);
    claim(c.value == value);
    claim(fixpid_slew_value(&c) == value);
    claim(out == floor_by(value + (ONE / 2), 16));
    claim((c.rise_q16 == was.rise_q16) && (c.fall_q16 == was.fall_q16));
    claim(slew_is_sound(&c));
}

void prove_setters(void)
{
    const uint32_t rise = nondet_uint32();
    const uint32_t fall = nondet_uint32();
    const int16_t value = nondet_int16();
    struct fixpid_slew was;

    c = nondet_slew(); // also of what is not sound
    was = c;
    if (nondet_bool()) {
        fixpid_slew_init(&c, rise, fall);
        claim((c.value == 0) && (c.rise_q16 == rise) && (c.fall_q16 == fall));
        claim(slew_is_sound(&c));
    } else if (nondet_bool()) {
        fixpid_slew_reset(&c);
        claim((c.value == 0) && (c.rise_q16 == was.rise_q16) &&
              (c.fall_q16 == was.fall_q16));
        claim(slew_is_sound(&c));
    } else if (nondet_bool()) {
        fixpid_slew_set_rates(&c, rise, fall);
        claim((c.value == was.value) && (c.rise_q16 == rise) &&
              (c.fall_q16 == fall));
    } else {
        fixpid_slew_seed(&c, value);
        claim((c.value == value * ONE) && (c.rise_q16 == was.rise_q16) &&
              (c.fall_q16 == was.fall_q16));
        claim(slew_is_sound(&c));
    }
}

// Of any bytes: nothing undefined. Any int16_t is within its limits.
void prove_total(void)
{
    c = nondet_slew();
    (void)fixpid_slew_step(&c, nondet_int16());
    (void)fixpid_slew_value(&c);
}
