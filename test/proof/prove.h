// SPDX-License-Identifier: MIT
// What the proofs are written with. A proof is a function `prove_...` without
// arguments: it takes any values, assumes what is known of them, calls the code
// and claims what must hold. CBMC then looks for values that break a claim or
// make the code do what C leaves undefined, and shows that there are none.
//
// What may be assumed is a function of its module that says in words what it
// holds of (`// Domain: ...`), the range of one value that is any, or, in a
// function `assume_...`, what is known of a product that is replaced:
// tools/lib/prove/harness_rules.rb refuses anything else.
#ifndef PROVE_H
#define PROVE_H
#include <stdbool.h>
#include <stdint.h>

#define assume(condition) __CPROVER_assume(condition)
// CBMC takes it for a function without a body, whose result is any.
#define __builtin_expect_with_probability(condition, expected, chance)         \
    (condition)

#define claim(condition) __CPROVER_assert(condition, #condition)

// Any value of a type: so CBMC takes what a function of such a name returns.
bool nondet_bool(void);
int8_t nondet_int8(void);
uint8_t nondet_uint8(void);
int16_t nondet_int16(void);
uint16_t nondet_uint16(void);
int32_t nondet_int32(void);
uint32_t nondet_uint32(void);

// A bool of a structure may be any byte to CBMC; in C it is 0 or 1.
#define any_bool ((nondet_uint8() & 1u) != 0u)

// The whole numbers of the headers' equations, which never overflow here.
typedef int64_t number;

static number clamp(number x, number low, number high)
{
    if (x < low) {
        return low;
    }
    return (x > high) ? high : x;
}

static bool inside(number x, number low, number high)
{
    return (x >= low) && (x <= high);
}

// x / 2^bits toward minus infinity and toward zero. They are shifts, because a
// division by a constant is as hard as any other to the solver.
static number floor_by(number x, unsigned bits)
{
    return x >> bits; // CBMC keeps the sign
}

static number trunc_by(number x, unsigned bits)
{
    return (x < 0) ? -(-x >> bits) : (x >> bits);
}

// A product of magnitudes, of which a proof knows only this: equal operands
// give an equal product, at most `most`, and nothing times zero is zero. Where
// code and definition agree for whatever function it is, they do so for the
// true product; that each primitive of src/ computes the true one is shown by
// trying all its operands (primitives.c), which a solver is slow at.
uint32_t __CPROVER_uninterpreted_product(uint16_t a, uint16_t b);

static uint32_t assume_product(uint16_t a, uint16_t b, uint32_t most)
{
    const uint32_t p = __CPROVER_uninterpreted_product(a, b);

    assume(p <= most);
    assume((p == 0u) == ((a == 0u) || (b == 0u)));
    return p;
}

// gain * x in that way. pre: |x| <= 65535
static number times(uint16_t gain, number x, uint32_t most)
{
    return (x < 0) ? -(number)assume_product(gain, (uint16_t)-x, most)
                   : (number)assume_product(gain, (uint16_t)x, most);
}

// The precondition of a primitive that a proof replaces by its contract.
#define pre(condition) __CPROVER_assert(condition, "pre: " #condition)

// The lowest bits.
static number ones(number bits)
{
    return ((number)1 << bits) - 1;
}

// A loop of turns is proved as one of them, from any values. Where the harness
// includes the code, it makes `for` begin each turn with its `at_turn`, which
// claims what must hold there: at the loop's beginning (begins()), or where the
// turn ends that was begun with any values. Then, once (any_turn()), any values
// of which only that is known take the place of what the loop changes. So the
// loop ends with any last turn.
static unsigned turns_seen;

// Domain: in a loop of turns, the first one that is asked for.
static bool begins(void)
{
    return turns_seen == 0u;
}

static void any_turn(void)
{
    assume(begins());
    turns_seen++;
}

#endif
