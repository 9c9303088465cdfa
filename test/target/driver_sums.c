// SPDX-License-Identifier: MIT
// AN937's leaves on a chip: numbers with one gain in three sums. The harness
// sets the gain and the stride; the sums' digests, which sums.cc computes as
// well, are the answer.
#include "compiler.h"
#include "exchange.h"
#include "fixpid_an937.h"
#include "fixpid_an937_arith.h"

#define TESTED an937_controller

FIXPID_DATA struct fixpid_an937 FIXPID_AN937_PLACE an937_controller;

uint8_t sums_gain;
uint16_t sums_stride; // between magnitudes: 1 for all
uint32_t sums_digest;
uint32_t sums_digest_of_digests;

static void digest(int32_t sum)
{
    sums_digest += (uint32_t)sum;
    sums_digest_of_digests += sums_digest;
}

// kp * error + ki * accumulated + kd * delta, and a sixteenth of it.
static void sum_up(void)
{
    int32_t sum;
    uint8_t flags = 0;

    FIXPID_SUM_OF_PRODUCTS(sum, TESTED.kp_q4, TESTED.error, TESTED.ki_q4,
                           TESTED.accumulated_error, TESTED.kd_q4, TESTED.delta,
                           TESTED.room);
    digest(FIXPID_SUM_RESULT(sum));
    FIXPID_SUM_SIXTEENTH(sum, flags);
    digest(FIXPID_SUM_RESULT(sum));
    digest(flags);
}

// Three products of one sign, and with the middle one of the other.
static void sum_up_both(uint16_t magnitude, uint8_t negative)
{
    TESTED.error.parts.magnitude = magnitude;
    TESTED.error.parts.negative = negative;
    TESTED.accumulated_error.parts.magnitude = magnitude;
    TESTED.accumulated_error.parts.negative = negative;
    TESTED.delta.parts.magnitude = magnitude;
    TESTED.delta.parts.negative = negative;
    sum_up();
    TESTED.accumulated_error.parts.magnitude = (uint16_t)~magnitude;
    TESTED.accumulated_error.parts.negative = negative ^ 1u;
    sum_up();
}

void sums_reply(void)
{
    uint16_t magnitude = 0;

    sums_digest = 0;
    sums_digest_of_digests = 0;
    TESTED.kp_q4 = sums_gain;
    TESTED.ki_q4 = sums_gain;
    TESTED.kd_q4 = sums_gain;
    do {
        sum_up_both(magnitude, 0);
        sum_up_both(magnitude, 1);
        PORT_CLEAR_WATCHDOG();
        magnitude = (uint16_t)(magnitude + sums_stride);
    } while (magnitude >= sums_stride);
}
