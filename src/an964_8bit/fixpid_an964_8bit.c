// SPDX-License-Identifier: MIT
#include "fixpid_an964_8bit.h"

#include "fixpid_an964_8bit_arith.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_AN964_8BIT_SELF
#define VALID_SELF FIXPID_AN964_8BIT_VALID_SELF

// Values with a sign are two's complement patterns in unsigned words, as
// fixpid_bits.h says: a PIC16 would spend most of the step on signed compares.
// The names have a prefix that fixpid_an964.c does not use, because the single
// headers of both may stand in one source.
//
// Whether a value was negative is one bit of `negative`, because SDCC tests one
// bit best. In the derivative it is 0xFF, which is also the `round_up` of the
// division.
#define BYTE_GAIN_MAX 0x7Fu
#define BYTE_ABOVE_GAIN_MAX (0xFFu ^ BYTE_GAIN_MAX) // what no legal gain has
#define BYTE_SUM_MAX ((uint16_t)FIXPID_AN964_8BIT_SUM_LIMIT)
#define BYTE_SUM_MIN ((uint16_t)(UINT32_C(0x10000) - BYTE_SUM_MAX))
#define BYTE_TERM_LIMIT ((uint8_t)FIXPID_AN964_8BIT_TERM_LIMIT)
#define BYTE_TERMS_MAX 127u          // what an 8 x 8 signed product takes
#define BYTE_ABOVE_TERMS_MAX 0xFF80u // the bits that it does not have

bool fixpid_an964_8bit_init(FIXPID_DATA struct fixpid_an964_8bit *self,
                            const struct fixpid_an964_8bit_gains *gains)
{
    FIXPID_ASSERT(VALID_SELF);
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

bool fixpid_an964_8bit_set_gains(FIXPID_DATA struct fixpid_an964_8bit *self,
                                 uint8_t kp, uint8_t ki, uint8_t kd)
{
    FIXPID_ASSERT(VALID_SELF);
    if (SELF.ready == 0u) {
        return false;
    }
    if (((kp | ki | kd) & BYTE_ABOVE_GAIN_MAX) != 0u) {
        return false;
    }
    SELF.gains.kp = kp;
    SELF.gains.ki = ki;
    SELF.gains.kd = kd;
    return true;
}

// The sum of errors, and I = ki * sum / 512 in two divisions toward zero.
FIXPID_INLINE uint16_t integral_byte(FIXPID_DATA struct fixpid_an964_8bit *self,
                                     uint16_t e)
{
    uint16_t sum = (uint16_t)(SELF.sum + e); // |sum| <= 8191 + 128
    uint16_t integral;
    uint8_t negative;

    if ((sum & FIXPID_SIGN_BIT) != 0u) {
        if (sum < BYTE_SUM_MIN) {
            sum = BYTE_SUM_MIN;
            SELF.sum_limited = FIXPID_AN964_8BIT_SUM_LIMITED;
        }
        SELF.sum = sum;
        sum = fixpid_negated(sum);
        negative = 1;
    } else {
        negative = 0;
        if (sum > BYTE_SUM_MAX) {
            sum = BYTE_SUM_MAX;
            SELF.sum_limited = FIXPID_AN964_8BIT_SUM_LIMITED;
        }
        SELF.sum = sum;
    }
    sum <<= 2; // |sum| / 64 <= 127 < 2^7 is now in its upper byte
    integral = fixpid_7x7_div8(SELF.gains.ki, (uint8_t)(sum >> 8));
    // Bit 0 alone, because SDCC tests a single bit best.
    if ((negative & 1u) != 0u) {
        integral = fixpid_negated(integral);
    }
    SELF.integral = (uint8_t)integral;
    return integral;
}

// D = kd * (E(n) - E(n-3)) / 4, rounded down. In offset binary, a byte
// with its highest bit turned over, errors compare without a sign.
FIXPID_INLINE uint16_t
derivative_byte(FIXPID_DATA struct fixpid_an964_8bit *self, uint8_t e)
{
    uint8_t now = (uint8_t)(e ^ 0x80u);
    uint8_t change = (uint8_t)(SELF.error[2] ^ 0x80u);
    uint8_t negative;
    uint16_t derivative;

    if (now >= change) {
        change = (uint8_t)(now - change);
        negative = 0;
    } else {
        change = (uint8_t)(change - now);
        // 0xFF and not 1, because the quotient takes it as a mask, `round_up`.
        negative = 0xFFu;
    }
    if (change > BYTE_TERM_LIMIT) {
        change = BYTE_TERM_LIMIT;
    }
    derivative =
        fixpid_7x7_div4(SELF.gains.kd, change, negative, BYTE_TERM_LIMIT);
    if ((negative & 1u) != 0u) {
        derivative = fixpid_negated(derivative);
    }
    SELF.derivative = (uint8_t)derivative;
    return derivative;
}

int16_t fixpid_an964_8bit_step(FIXPID_DATA struct fixpid_an964_8bit *self,
                               int8_t error)
{
    const uint8_t e_byte = (uint8_t)error;
    const uint16_t e = (uint16_t)error;
    uint16_t sum_of_terms;
    uint16_t output;
    uint16_t result;
    uint8_t negative = 0;

    FIXPID_ASSERT(VALID_SELF);
    SELF.sum_limited = 0;
    SELF.output_limited = 0;
    sum_of_terms =
        (uint16_t)(e + integral_byte(self, e) + derivative_byte(self, e_byte));
    SELF.error[2] = SELF.error[1];
    SELF.error[1] = SELF.error[0];
    SELF.error[0] = e_byte;

    if ((sum_of_terms & FIXPID_SIGN_BIT) != 0u) {
        sum_of_terms = fixpid_negated(sum_of_terms);
        negative = 1;
    }
    // |sum_of_terms| <= 128 + 127 + 127
    if ((sum_of_terms & BYTE_ABOVE_TERMS_MAX) != 0u) {
        sum_of_terms = BYTE_TERMS_MAX;
        SELF.output_limited = FIXPID_AN964_8BIT_OUTPUT_LIMITED;
    }
    // The mask keeps the output within its limits if a bit of kp was flipped.
    output =
        fixpid_7x7_div32(SELF.gains.kp & BYTE_GAIN_MAX, (uint8_t)sum_of_terms);
    // It is negated in any case, because SDCC copies a variable that is changed
    // under an if.
    result = fixpid_negated(output);
    if ((negative & 1u) == 0u) {
        result = output;
    }
    return (int16_t)result;
}
