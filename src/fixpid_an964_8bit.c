// SPDX-License-Identifier: MIT
#include "fixpid_an964_8bit.h"

#include "fixpid_an964_8bit_self.h"
#include "fixpid_arith.h"

#define ABOVE_GAIN_MAX 0x80u // the bits that no legal gain has
#define SUM_HIGHEST FIXPID_WORD(FIXPID_AN964_8BIT_SUM_LIMIT)
#define SUM_LOWEST FIXPID_WORD(UINT32_C(0x10000) - SUM_HIGHEST)
#define TERM_LIMIT ((uint8_t)FIXPID_AN964_8BIT_TERM_LIMIT)
#define BYTE_MAX FIXPID_WORD(127) // what an 8 x 8 signed product takes

// Bits of the term limit beyond three: each costs a PIC16 some cycles.
#if FIXPID_AN964_8BIT_TERM_LIMIT < 32
#define TERM_MORE 2
#else
#define TERM_MORE 4
#endif

bool fixpid_an964_8bit_init(FIXPID_DATA struct fixpid_an964_8bit *self,
                            const struct fixpid_an964_8bit_gains *gains)
{
    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(gains != 0);
    fixpid_an964_8bit_reset(self);
    SELF.ready = 1;
    if (fixpid_an964_8bit_set_gains(self, gains->kp, gains->ki, gains->kd)) {
        return true;
    }
    SELF.gains.kp = 0;
    SELF.gains.ki = 0;
    SELF.gains.kd = 0;
    SELF.ready = 0;
    return false;
}

void fixpid_an964_8bit_reset(FIXPID_DATA struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID(self));
    SELF.sum = 0;
    SELF.error[0] = 0;
    SELF.error[1] = 0;
    SELF.error[2] = 0;
    SELF.integral = 0;
    SELF.derivative = 0;
    SELF.sum_limited = 0;
    SELF.output_limited = 0;
}

bool fixpid_an964_8bit_set_gains(FIXPID_DATA struct fixpid_an964_8bit *self,
                                 uint8_t kp, uint8_t ki, uint8_t kd)
{
    FIXPID_ASSERT(VALID(self));
    if (SELF.ready == 0u) {
        return false;
    }
    if (((kp | ki | kd) & ABOVE_GAIN_MAX) != 0u) {
        return false;
    }
    SELF.gains.kp = kp;
    SELF.gains.ki = ki;
    SELF.gains.kd = kd;
    return true;
}

// The sum of errors, and I = ki * sum / 512 in two divisions toward zero.
FIXPID_INLINE uint16_t integrate(FIXPID_DATA struct fixpid_an964_8bit *self,
                                 uint16_t e)
{
    uint16_t sum = (uint16_t)(SELF.sum + e); // |sum| <= 8191 + 128
    uint16_t integral;
    uint8_t negative = 0;

    FIXPID_ASSERT(VALID(self));
    if (FIXPID_NEGATIVE(sum)) {
        if (sum < SUM_LOWEST) {
            sum = SUM_LOWEST;
            SELF.sum_limited = FIXPID_AN964_8BIT_SUM_LIMITED;
        }
        SELF.sum = sum;
        FIXPID_NEGATE(sum);
        negative = 1;
    } else {
        if (sum > SUM_HIGHEST) {
            sum = SUM_HIGHEST;
            SELF.sum_limited = FIXPID_AN964_8BIT_SUM_LIMITED;
        }
        SELF.sum = sum;
    }
    // |sum| / 64 <= 127 < 2^7, so the product is at most 127 * 127 / 8 = 2016
    sum = (uint16_t)(sum << 2) >> 8;
    FIXPID_BYTE_7X7(integral, SELF.gains.ki, sum, 3, 3);
    if (FIXPID_SAYS_SO(negative)) {
        FIXPID_NEGATE(integral);
    }
    SELF.integral = (uint8_t)integral;
    return integral;
}

// D = kd * (E(n) - E(n-3)) / 4, rounded down.
FIXPID_INLINE uint16_t differentiate(FIXPID_DATA struct fixpid_an964_8bit *self,
                                     uint8_t e)
{
    uint8_t now = (uint8_t)(e ^ 0x80u);
    uint8_t change = (uint8_t)(SELF.error[2] ^ 0x80u);
    uint8_t negative = 0;
    uint16_t derivative;

    FIXPID_ASSERT(VALID(self));
    if (now >= change) {
        change = (uint8_t)(now - change);
    } else {
        change = (uint8_t)(change - now);
        negative = 0xFFu;
    }
    if (change > TERM_LIMIT) {
        change = TERM_LIMIT;
    }
    FIXPID_LIMITED_7X7(derivative, SELF.gains.kd, change, negative, 2,
                       TERM_MORE, FIXPID_WORD(TERM_LIMIT));
    if (FIXPID_SAYS_SO(negative)) {
        FIXPID_NEGATE(derivative);
    }
    SELF.derivative = (uint8_t)derivative;
    return derivative;
}

int16_t fixpid_an964_8bit_step(FIXPID_DATA struct fixpid_an964_8bit *self,
                               int8_t error)
{
    uint8_t e_byte = (uint8_t)error;
    uint16_t e = (uint16_t)(int16_t)error;
    uint16_t sum_of_terms;
    uint16_t output;
    uint8_t negative = 0;

    FIXPID_ASSERT(VALID(self));
    SELF.sum_limited = 0;
    SELF.output_limited = 0;
    sum_of_terms =
        (uint16_t)(e + integrate(self, e) + differentiate(self, e_byte));
    SELF.error[2] = SELF.error[1];
    SELF.error[1] = SELF.error[0];
    SELF.error[0] = e_byte;

    if (FIXPID_NEGATIVE(sum_of_terms)) {
        FIXPID_NEGATE(sum_of_terms);
        negative = 1;
    }
    if (sum_of_terms > BYTE_MAX) { // at most 128 + 127 + 127
        sum_of_terms = BYTE_MAX;
        SELF.output_limited = FIXPID_AN964_8BIT_OUTPUT_LIMITED;
    }
    // at most 127 * 127 / 32 = 504
    FIXPID_PRODUCT_7X7(output, SELF.gains.kp, sum_of_terms, 5, 1);
    if (FIXPID_SAYS_SO(negative)) {
        FIXPID_NEGATE(output);
    }
    return FIXPID_SIGNED(output);
}
