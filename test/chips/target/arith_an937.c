// SPDX-License-Identifier: MIT
#include "an937/fixpid_an937_arith.h"
#include "arith.h"
#include "fixpid_an937.h"

#define TESTED an937_controller

FIXPID_DATA struct fixpid_an937 FIXPID_AN937_PLACE an937_controller;

static uint8_t flags;

// Who calls may have selected any bank, and left FSR0 anywhere.
#if defined(__SDCC_pic16)
#define SELECT_ANOTHER_BANK() __asm movlb 15 __endasm
#define POINT_ELSEWHERE() __asm lfsr 0, 0x700 __endasm
#else
#define SELECT_ANOTHER_BANK()
#define POINT_ELSEWHERE()
#endif

// The products and their sum, with its division.
static void add_sum(void)
{
    flags = 0;
    ARITH_OPERANDS(fixpid_number_value(&TESTED.error),
                   fixpid_number_value(&TESTED.accumulated_error));
    SELECT_ANOTHER_BANK();
    arith_add((uint32_t)fixpid_an937_output(&TESTED, &flags));
    arith_add(flags);
    POINT_ELSEWHERE();
    arith_add(
        (uint32_t)fixpid_number_term(TESTED.ki_q4, &TESTED.accumulated_error));
}

// Three products of one sign, and with the middle one of the other; the error
// has 16 bits, so that one beyond has the other sign.
static void add_sums(uint16_t left, uint16_t right)
{
    fixpid_number_set(&TESTED.error, (int16_t)(left - right));
    fixpid_number_difference(&TESTED.accumulated_error, left, right);
    fixpid_number_difference(&TESTED.delta, left, right);
    add_sum();
    fixpid_number_difference(&TESTED.accumulated_error, right, left);
    add_sum();
}

// Sums around -2^24 and 2^24, where they are limited: 128 * (65535 + 65533) and
// the error.
static void add_ends(void)
{
    int16_t error = 1024;

    TESTED.kp_q4 = 1;
    TESTED.ki_q4 = 128;
    TESTED.kd_q4 = 128;
    while (error != 0) {
        error--;
        fixpid_number_set(&TESTED.error, error);
        fixpid_number_difference(&TESTED.accumulated_error, 65535u, 0);
        fixpid_number_difference(&TESTED.delta, 65533u, 0);
        add_sum();
        fixpid_number_set(&TESTED.error, (int16_t)-error);
        fixpid_number_difference(&TESTED.accumulated_error, 0, 65535u);
        fixpid_number_difference(&TESTED.delta, 0, 65533u);
        add_sum();
    }
}

// Sums of which some bytes are 0: 128 * error.
static void add_round(void)
{
    int16_t error = INT16_MIN;

    TESTED.kp_q4 = 128;
    TESTED.ki_q4 = 0;
    TESTED.kd_q4 = 0;
    while (error != 0) {
        fixpid_number_set(&TESTED.error, error);
        add_sum();
        error = (int16_t)(error + 512);
    }
}

// Sums that change their sign with the second or the third product.
static void add_crossings(int16_t other)
{
    int16_t error = -512;

    TESTED.kp_q4 = 1;
    TESTED.ki_q4 = 1;
    TESTED.kd_q4 = 1;
    while (error != 512) {
        fixpid_number_set(&TESTED.error, error);
        fixpid_number_set(&TESTED.accumulated_error, other);
        fixpid_number_set(&TESTED.delta, other);
        add_sum();
        error++;
    }
}

static uint16_t state;

// Its lower bits come round soon: they are above.
static uint16_t any16(void)
{
    state = (uint16_t)(state * 25173u + 13849u);
    return (uint16_t)((state << 8) | (state >> 8));
}

// Products of which no two are alike.
static void add_mixed(uint8_t times)
{
    uint8_t count = times;
    uint16_t left;
    uint16_t right;

    state = arith_row;
    TESTED.kp_q4 = (uint8_t)arith_row;
    TESTED.ki_q4 = (uint8_t)(arith_row + 85u);
    TESTED.kd_q4 = (uint8_t)(arith_row + 170u);
    while (count != 0u) {
        count--;
        fixpid_number_set(&TESTED.error, (int16_t)any16());
        left = any16();
        right = any16();
        fixpid_number_difference(&TESTED.accumulated_error, left, right);
        left = any16();
        right = any16();
        fixpid_number_difference(&TESTED.delta, left, right);
        add_sum();
    }
}

// A number that is set, and two sums.
static void add_numbers(uint16_t magnitude, uint16_t limit)
{
    flags = 0;
    ARITH_OPERANDS(magnitude, limit);
    fixpid_number_set(&TESTED.error, (int16_t)magnitude);
    arith_add((uint32_t)fixpid_number_value(&TESTED.error));
    fixpid_number_add(&TESTED.error, &TESTED.delta, magnitude, &flags);
    arith_add((uint32_t)fixpid_number_value(&TESTED.error));
    arith_add(flags);
    flags = 0;
    fixpid_number_add(&TESTED.accumulated_error, &TESTED.delta, limit, &flags);
    arith_add((uint32_t)fixpid_number_value(&TESTED.accumulated_error));
    arith_add(flags);
}

// With 257, each byte is both bytes of a magnitude: each of the two products is
// seen with all its operands.
void an937_arith(void)
{
    const uint16_t stride = (arith_row < 256u) ? 257u : 1u;
    uint16_t magnitude = 0;

    arith_begin();
    if (arith_row == 0u) { // its gains are 0
        add_ends();
        add_round();
        add_crossings(150);
        add_crossings(-150);
        add_mixed(255); // and kp is 0
    }
    add_mixed(32);
    TESTED.kp_q4 = (uint8_t)arith_row;
    TESTED.ki_q4 = (uint8_t)arith_row;
    TESTED.kd_q4 = (uint8_t)arith_row;
    do {
        add_sums(magnitude, 0);
        add_sums(0, magnitude);
        add_numbers(magnitude, 65535u);
        magnitude = (uint16_t)(magnitude + stride);
    } while (magnitude >= stride);
}
