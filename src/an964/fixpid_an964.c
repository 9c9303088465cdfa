// SPDX-License-Identifier: MIT
#include "fixpid_an964.h"

#include "fixpid_an964_arith.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_AN964_SELF
#define VALID_SELF FIXPID_AN964_VALID_SELF

// Values with a sign are two's complement patterns in unsigned words, as
// fixpid_bits.h says, because a PIC16 would spend most of the step on signed
// comparisons. The names have a prefix that fixpid_an964_8bit.c does not use,
// because the single headers of both may stand in one source.
//
// Whether a value was negative is one bit of `negative`, because SDCC tests one
// bit best. In the derivative it is 0xFF, which is also the `round_up` of the
// division.
#define AN964_ERROR_MAX ((uint16_t)1023)
#define AN964_ERROR_MIN ((uint16_t)(UINT32_C(0x10000) - AN964_ERROR_MAX))
#define AN964_ABOVE_10_BITS 0xFC00u // bits that 0..1023 do not have
#define AN964_TERM_LIMIT ((uint8_t)FIXPID_AN964_TERM_LIMIT)
#define AN964_OUTPUT_LIMIT ((uint16_t)FIXPID_AN964_OUTPUT_LIMIT)
#define AN964_SUM_MAX ((uint16_t)FIXPID_AN964_SUM_LIMIT)
#define AN964_SUM_MIN ((uint16_t)(UINT32_C(0x10001) - AN964_SUM_MAX))

// True if a negative sum is below AN964_SUM_MIN. With a limit of 1,
// AN964_SUM_MIN is 0 and every negative sum is.
#if FIXPID_AN964_SUM_LIMIT > 1
#define AN964_BELOW_SUM_MIN(sum) ((sum) < AN964_SUM_MIN)
#else
#define AN964_BELOW_SUM_MIN(sum) true
#endif

bool fixpid_an964_init(FIXPID_DATA struct fixpid_an964 *self,
                       const struct fixpid_an964_gains *gains)
{
    FIXPID_ASSERT(VALID_SELF);
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
    FIXPID_ASSERT(VALID_SELF);
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
    FIXPID_ASSERT(VALID_SELF);
    if (SELF.ready == 0u) {
        return false;
    }
    if (((kp | ki | kd) & AN964_ABOVE_10_BITS) != 0u) {
        return false;
    }
    SELF.gains.kp = kp;
    SELF.gains.ki = ki;
    SELF.gains.kd = kd;
    return true;
}

// The sum of errors, and I = ki * sum / 4096 in two divisions toward zero.
FIXPID_INLINE uint16_t integral_term(FIXPID_DATA struct fixpid_an964 *self,
                                     uint16_t e)
{
    uint16_t sum = (uint16_t)(SELF.sum + e); // |sum| <= 30000 + 1023 < 2^15
    uint16_t integral;
    uint8_t negative = 0;

    if ((sum & FIXPID_SIGN_BIT) != 0u) {
        if (AN964_BELOW_SUM_MIN(sum)) {
            sum = AN964_SUM_MIN;
            SELF.sum_limited = FIXPID_AN964_SUM_LIMITED;
        }
        SELF.sum = sum;
        sum = fixpid_negated(sum);
        negative = 1;
    } else {
        if (sum > AN964_SUM_MAX) {
            sum = AN964_SUM_MAX;
            SELF.sum_limited = FIXPID_AN964_SUM_LIMITED;
        }
        SELF.sum = sum;
    }
    // |sum| / 256 <= 117 < 2^7, so |I| <= 117 * 1023 / 16 = 7480
    integral = fixpid_10x7_div16(SELF.gains.ki, (uint8_t)(sum >> 8));
    // Bit 0 alone, because SDCC tests a single bit best.
    if ((negative & 1u) != 0u) {
        integral = fixpid_negated(integral);
    }
    SELF.integral = integral;
    return integral;
}

// D = kd * (E(n) - E(n-3)) / 32, rounded down as the note's shift does.
FIXPID_INLINE uint16_t derivative_term(FIXPID_DATA struct fixpid_an964 *self,
                                       uint16_t e)
{
    uint16_t change = (uint16_t)(e - SELF.error[2]); // within +-2046
    uint16_t derivative;
    uint8_t negative = 0;

    if ((change & FIXPID_SIGN_BIT) != 0u) {
        change = fixpid_negated(change);
        // 0xFF and not 1, because the quotient takes it as a mask, `round_up`.
        negative = 0xFFu;
    }
    if (change > AN964_TERM_LIMIT) {
        change = AN964_TERM_LIMIT;
    }
    derivative = fixpid_10x8_div32(SELF.gains.kd, (uint8_t)change, negative,
                                   AN964_TERM_LIMIT);
    if ((negative & 1u) != 0u) {
        derivative = fixpid_negated(derivative);
    }
    SELF.derivative = derivative;
    return derivative;
}

int16_t fixpid_an964_step(FIXPID_DATA struct fixpid_an964 *self, int16_t error)
{
    uint16_t e = (uint16_t)error;
    uint16_t sum_of_terms;
    uint16_t output;
    uint8_t negative = 0;

    FIXPID_ASSERT(VALID_SELF);
    SELF.sum_limited = 0;
    SELF.output_limited = 0;
    if ((e & FIXPID_SIGN_BIT) != 0u) {
        if (e < AN964_ERROR_MIN) {
            e = AN964_ERROR_MIN;
        }
    } else {
        if ((e & AN964_ABOVE_10_BITS) != 0u) {
            e = AN964_ERROR_MAX;
        }
    }
    // |e + I + D| <= 1023 + 7480 + 255 = 8758 < 2^14
    sum_of_terms =
        (uint16_t)(e + integral_term(self, e) + derivative_term(self, e));
    SELF.error[2] = SELF.error[1];
    SELF.error[1] = SELF.error[0];
    SELF.error[0] = e;

    if ((sum_of_terms & FIXPID_SIGN_BIT) != 0u) {
        sum_of_terms = fixpid_negated(sum_of_terms);
        negative = 1;
    }
    output = fixpid_10x14_div1024(SELF.gains.kp, sum_of_terms);
    if (output > AN964_OUTPUT_LIMIT) {
        output = AN964_OUTPUT_LIMIT;
        SELF.output_limited = FIXPID_AN964_OUTPUT_LIMITED;
    }
    if ((negative & 1u) != 0u) {
        output = fixpid_negated(output);
    }
    return (int16_t)output;
}
