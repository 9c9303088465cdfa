// SPDX-License-Identifier: MIT
// What a claim about assembly is written with, in claims.txt: the portable C of
// src/, which the assembly must equal. tools/lib/prove/assembly.rb makes a
// program of each claim, with the functions that it made of the assembly.
#ifndef CLAIM_H
#define CLAIM_H
#include <stdbool.h>
#include <stdint.h>

#ifdef PROOF_WORD // CBMC
#define must(condition, what) __CPROVER_assert(condition, what)
#else
#define must(condition, what) ((void)0)
#endif

// A product of two bytes. A solver is slow at products; where assembly and C
// both make theirs of products of bytes, they agree for whatever function that
// is, if it is the same one for both. Then they do so for the true product.
#ifdef PRODUCTS_SHARED
uint16_t __CPROVER_uninterpreted_product(uint8_t smaller, uint8_t larger);

static uint16_t assume_product(uint8_t smaller, uint8_t larger)
{
    const uint16_t product = __CPROVER_uninterpreted_product(smaller, larger);

    __CPROVER_assume(product <= 255u * (unsigned)smaller);
    __CPROVER_assume(product <= 255u * (unsigned)larger);
    return product;
}

static uint16_t bytes_product(uint8_t a, uint8_t b)
{
    return (a < b) ? assume_product(a, b) : assume_product(b, a);
}

#define fixpid_8x8 fixpid_8x8_of_src
#include "common/fixpid_bits.h"
#undef fixpid_8x8
#define fixpid_8x8(a, b) bytes_product((a), (b))
#else
static uint16_t bytes_product(uint8_t a, uint8_t b)
{
    return (uint16_t)((uint32_t)a * b);
}
#endif

#include "an937/fixpid_an937_arith.h"
#include "an964/fixpid_an964_arith.h"
#include "an964_8bit/fixpid_an964_8bit_arith.h"
#include "common/fixpid_signed.h"

// The numbers of AN937, which the assembly for an AVR has in two's complement.
static union fixpid_an937_number number_of(int32_t value)
{
    union fixpid_an937_number number;

#if FIXPID_MULTIPLIER_BITS >= 16
    number.value = value;
#else
    number.parts.negative = (value < 0);
    number.parts.magnitude = (uint16_t)((value < 0) ? -value : value);
#endif
    return number;
}

static int32_t sum_with_term(int32_t sum, uint8_t gain, int32_t value)
{
    const union fixpid_an937_number number = number_of(value);

    return fixpid_sum_with_term(sum, gain, &number);
}

static int32_t term(uint8_t gain, int32_t value)
{
    const union fixpid_an937_number number = number_of(value);

    return fixpid_number_term(gain, &number);
}

// On a PIC18 they are in sign-magnitude.
#if FIXPID_MULTIPLIER_BITS < 16
static union fixpid_an937_number parts_of(uint16_t magnitude, uint8_t negative)
{
    union fixpid_an937_number number;

    number.parts.magnitude = magnitude;
    number.parts.negative = negative;
    return number;
}

static int32_t term_of_parts(uint8_t gain, uint16_t magnitude, uint8_t negative)
{
    const union fixpid_an937_number number = parts_of(magnitude, negative);

    return fixpid_number_term(gain, &number);
}

// Equation 4 of the numbers e, a and d, and the flags with it.
static struct fixpid_an937 controller(uint8_t kp, uint16_t e, uint8_t e_sign,
                                      uint8_t ki, uint16_t a, uint8_t a_sign,
                                      uint8_t kd, uint16_t d, uint8_t d_sign)
{
    struct fixpid_an937 self;

    self.error = parts_of(e, e_sign);
    self.accumulated_error = parts_of(a, a_sign);
    self.delta = parts_of(d, d_sign);
    self.kp_q4 = kp;
    self.ki_q4 = ki;
    self.kd_q4 = kd;
    return self;
}

static int32_t output_of(struct fixpid_an937 self)
{
    uint8_t flags = 0;

    return fixpid_an937_output(&self, &flags);
}

static uint8_t flags_of(struct fixpid_an937 self)
{
    uint8_t flags = 0;

    (void)fixpid_an937_output(&self, &flags);
    return flags;
}
#endif

// Called where the assembly goes back; CBMC finds by itself what does not end,
// and no example on a machine without an operating system goes back.
#if defined(PROOF_WORD) || (__STDC_HOSTED__ == 0)
static void turned(void)
{
}
#else
#include <stdio.h>
#include <stdlib.h>

enum { TURNS_MOST = 1000 };
static unsigned turns; // of one call

static void turned(void)
{
    if (++turns > TURNS_MOST) {
        printf("a loop does not end\n");
        exit(1);
    }
}
#endif

#endif
