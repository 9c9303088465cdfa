// SPDX-License-Identifier: MIT
// The numbers of fixpid_autotune's result: mantissa * 2^exponent, with a
// mantissa of 32768..65535, or 0, whose exponent is below all others.
#include "prove.h"

#include "fixpid_autotune.h"

#include "autotune/fixpid_autotune_arith.h"

struct number16 nondet_number16(void);

#define FAR 120     // what an experiment comes to is within it
#define NONE (-128) // the exponent of 0

static struct number16 result;

// Domain: the mantissa is 32768 to 65535 and the exponent -120 to 120; or the
// number is 0, and the exponent -128.
static bool autotune_is_number(struct number16 x)
{
    return (x.mantissa == 0u)
               ? (x.exponent == NONE)
               : ((x.mantissa >= 32768u) && inside(x.exponent, -FAR, FAR));
}

static struct number16 any_number(void)
{
    const struct number16 x = nondet_number16();

    assume(autotune_is_number(x));
    return x;
}

// Whether the result is value * 2^exponent without the lower bits, and without
// the upper ones of an exponent. pre: 0 <= value < 2^32
static void claim_result(number value, number exponent)
{
    const number places = (int8_t)(result.exponent - exponent);

    if (value == 0) {
        claim((result.mantissa == 0u) && (result.exponent == NONE));
        return;
    }
    claim((result.mantissa >= 32768u) && inside(places, -15, 16));
    claim(result.mantissa == ((places < 0)
                                  ? (value << -places)
                                  : floor_by(value, (unsigned)places)));
}

void prove_make(void)
{
    const uint32_t value = nondet_uint32();
    const int16_t exponent = nondet_int16();

    assume(inside(exponent, -2 * FAR, 2 * FAR));
    make(&result, value, exponent);
    claim_result(value, exponent);
}

// What is left of a, with 15 bits more, at an exponent.
static number at_exponent(struct number16 a, number exponent)
{
    const number places = exponent - a.exponent;

    return (places >= 48)
               ? 0
               : floor_by((number)a.mantissa << 15, (unsigned)places);
}

void prove_plus(void)
{
    const struct number16 a = any_number();
    const struct number16 b = any_number();
    const number exponent = (a.exponent < b.exponent) ? b.exponent : a.exponent;

    result = a;
    add(&result, &b);
    claim_result(at_exponent(a, exponent) + at_exponent(b, exponent),
                 exponent - 15);
}

// Or 0 unless a is the greater one.
void prove_minus(void)
{
    const struct number16 a = any_number();
    const struct number16 b = any_number();
    number rest = 0;

    if (a.exponent >= b.exponent) {
        rest = at_exponent(a, a.exponent) - at_exponent(b, a.exponent);
    }
    result = a;
    subtract(&result, &b);
    claim_result((rest < 0) ? 0 : rest, (number)a.exponent - 15);
    claim(greater(&a, &b) == (result.mantissa != 0u));
}
