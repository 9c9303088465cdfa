// SPDX-License-Identifier: MIT
#include "fixpid_an964.h"

#include "fixpid_an964_self.h"
#include "fixpid_arith.h"

#define ERROR_HIGHEST FIXPID_WORD(1023)
#define ERROR_LOWEST FIXPID_WORD(UINT32_C(0x10000) - ERROR_HIGHEST)
#define ABOVE_GAIN_MAX 0xFC00u // the bits that no legal gain has
#define TERM_LIMIT ((uint16_t)FIXPID_AN964_TERM_LIMIT)
#define OUTPUT_LIMIT ((uint16_t)FIXPID_AN964_OUTPUT_LIMIT)
#define SUM_HIGHEST FIXPID_WORD(FIXPID_AN964_SUM_LIMIT)
#define SUM_LOWEST FIXPID_WORD(UINT32_C(0x10001) - SUM_HIGHEST)

// Of a negative sum. Every one is below a lowest sum of 0.
#if FIXPID_AN964_SUM_LIMIT > 1
#define BELOW_LOWEST(sum) ((sum) < SUM_LOWEST)
#else
#define BELOW_LOWEST(sum) FIXPID_NEGATIVE(sum)
#endif

// Bits of the term limit beyond five: each costs a PIC16 one turn.
#if FIXPID_AN964_TERM_LIMIT < 128
#define TERM_MORE 2
#else
#define TERM_MORE 3
#endif

bool fixpid_an964_init(FIXPID_DATA struct fixpid_an964 *self,
                       const struct fixpid_an964_gains *gains)
{
    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(gains != 0);
    fixpid_an964_reset(self);
    SELF.ready = 1;
    if (fixpid_an964_set_gains(self, gains->kp, gains->ki, gains->kd)) {
        return true;
    }
    SELF.gains.kp = 0;
    SELF.gains.ki = 0;
    SELF.gains.kd = 0;
    SELF.ready = 0;
    return false;
}

void fixpid_an964_reset(FIXPID_DATA struct fixpid_an964 *self)
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

bool fixpid_an964_set_gains(FIXPID_DATA struct fixpid_an964 *self, uint16_t kp,
                            uint16_t ki, uint16_t kd)
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

// The sum of errors, and I = ki * sum / 4096 in two divisions toward zero.
FIXPID_INLINE uint16_t integrate(FIXPID_DATA struct fixpid_an964 *self,
                                 uint16_t e)
{
    uint16_t sum = (uint16_t)(SELF.sum + e); // |sum| <= 30000 + 1023 < 2^15
    uint16_t integral;
    uint8_t negative = 0;

    FIXPID_ASSERT(VALID(self));
    if (FIXPID_NEGATIVE(sum)) {
        if (BELOW_LOWEST(sum)) {
            sum = SUM_LOWEST;
            SELF.sum_limited = FIXPID_AN964_SUM_LIMITED;
        }
        SELF.sum = sum;
        FIXPID_NEGATE(sum);
        negative = 1;
    } else {
        if (sum > SUM_HIGHEST) {
            sum = SUM_HIGHEST;
            SELF.sum_limited = FIXPID_AN964_SUM_LIMITED;
        }
        SELF.sum = sum;
    }
    // |sum| / 256 <= 117 < 2^7, so |I| <= 117 * 1023 / 16 = 7480
    sum >>= 8;
    FIXPID_PRODUCT_10X8(integral, SELF.gains.ki, sum, 4, 3);
    if (FIXPID_SAYS_SO(negative)) {
        FIXPID_NEGATE(integral);
    }
    SELF.integral = integral;
    return integral;
}

// D = kd * (E(n) - E(n-3)) / 32, rounded down as the note's shift does.
FIXPID_INLINE uint16_t differentiate(FIXPID_DATA struct fixpid_an964 *self,
                                     uint16_t e)
{
    uint16_t change = (uint16_t)(e - SELF.error[2]); // within +-2046
    uint16_t derivative;
    uint8_t negative = 0;

    FIXPID_ASSERT(VALID(self));
    if (FIXPID_NEGATIVE(change)) {
        FIXPID_NEGATE(change);
        negative = 0xFFu;
    }
    if (change > TERM_LIMIT) {
        change = TERM_LIMIT;
    }
    FIXPID_LIMITED_10X8(derivative, SELF.gains.kd, change, negative, 5,
                        TERM_MORE, TERM_LIMIT);
    if (FIXPID_SAYS_SO(negative)) {
        FIXPID_NEGATE(derivative);
    }
    SELF.derivative = derivative;
    return derivative;
}

int16_t fixpid_an964_step(FIXPID_DATA struct fixpid_an964 *self, int16_t error)
{
    uint16_t e = (uint16_t)error;
    uint16_t sum_of_terms;
    uint16_t output;
    uint8_t negative;

    FIXPID_ASSERT(VALID(self));
    SELF.sum_limited = 0;
    SELF.output_limited = 0;
    if (FIXPID_NEGATIVE(e)) {
        if (e < ERROR_LOWEST) {
            e = ERROR_LOWEST;
        }
    } else {
        if (e > ERROR_HIGHEST) {
            e = ERROR_HIGHEST;
        }
    }
    // |e + I + D| <= 1023 + 7480 + 255 = 8758 < 2^14
    sum_of_terms = (uint16_t)(e + integrate(self, e) + differentiate(self, e));
    SELF.error[2] = SELF.error[1];
    SELF.error[1] = SELF.error[0];
    SELF.error[0] = e;

    negative = 0;
    if (FIXPID_NEGATIVE(sum_of_terms)) {
        FIXPID_NEGATE(sum_of_terms);
        negative = 1;
    }
    FIXPID_PRODUCT_14X10(output, sum_of_terms, SELF.gains.kp);
    if (output > OUTPUT_LIMIT) {
        output = OUTPUT_LIMIT;
        SELF.output_limited = FIXPID_AN964_OUTPUT_LIMITED;
    }
    if (FIXPID_SAYS_SO(negative)) {
        FIXPID_NEGATE(output);
    }
    return FIXPID_SIGNED(output);
}
