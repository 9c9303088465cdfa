// SPDX-License-Identifier: MIT
#include "fixpid_an964_8bit.h"

#include "fixpid_arith.h"

#ifdef FIXPID_AN964_8BIT_OBJECT
#define SELF FIXPID_AN964_8BIT_OBJECT
#define VALID(self) ((self) == &SELF)
#else
#define SELF (*self)
#define VALID(self) ((self) != 0)
#endif

#define GAIN_MAX 127u
#define SUM_LIMIT ((uint16_t)FIXPID_AN964_8BIT_SUM_LIMIT)
#define TERM_LIMIT ((uint16_t)FIXPID_AN964_8BIT_TERM_LIMIT)
#define BYTE_MAX 127u // what an 8 x 8 signed product takes

bool fixpid_an964_8bit_init(FIXPID_DATA struct fixpid_an964_8bit *self,
                            const struct fixpid_an964_8bit_gains *gains)
{
    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(gains != 0);
    fixpid_an964_8bit_reset(self);
    SELF.ready = 1;
    if (!fixpid_an964_8bit_set_gains(self, gains->kp, gains->ki, gains->kd)) {
        SELF.gains.kp = 0; // it multiplies all terms
        SELF.ready = 0;
    }
    return SELF.ready != 0u;
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
    SELF.flags = 0;
}

bool fixpid_an964_8bit_set_gains(FIXPID_DATA struct fixpid_an964_8bit *self,
                                 uint8_t kp, uint8_t ki, uint8_t kd)
{
    FIXPID_ASSERT(VALID(self));
    if (SELF.ready == 0u) {
        return false;
    }
    if ((kp | ki | kd) > GAIN_MAX) { // all ones: true if one of them is above
        return false;
    }
    SELF.gains.kp = kp;
    SELF.gains.ki = ki;
    SELF.gains.kd = kd;
    return true;
}

// The sum of errors, and I = ki * sum / 512 in two divisions toward zero.
static void integrate(FIXPID_DATA struct fixpid_an964_8bit *self, int8_t error)
{
    const int16_t sum = (int16_t)(SELF.sum + error); // |sum| <= 8191 + 128
    const bool negative = sum < 0;
    uint16_t magnitude = FIXPID_MAGNITUDE(negative, sum);
    uint16_t gain = SELF.gains.ki;
    uint16_t product;
    uint8_t high;

    FIXPID_ASSERT(VALID(self));
    if (magnitude > SUM_LIMIT) {
        magnitude = SUM_LIMIT;
        SELF.flags = FIXPID_AN964_8BIT_SUM_LIMITED;
    }
    SELF.sum = FIXPID_WITH_SIGN(negative, magnitude);

    // |sum| / 64 <= 127 < 2^7, so the product is at most 127 * 127 / 8 = 2016
    high = (uint8_t)(magnitude >> 6);
    FIXPID_SCALED_PRODUCT(product, gain, high, 0u, 3u, 4u);
    if (product > BYTE_MAX) {
        product = BYTE_MAX;
    }
    SELF.integral = (int8_t)FIXPID_WITH_SIGN(negative, product);
}

// D = kd * (E(n) - E(n-3)) / 4, rounded down.
static void differentiate(FIXPID_DATA struct fixpid_an964_8bit *self,
                          int8_t error)
{
    const int16_t change = (int16_t)(error - SELF.error[2]); // within +-255
    const bool falling = change < 0;
    const uint8_t bias = falling ? 3u : 0u;
    uint16_t magnitude = FIXPID_MAGNITUDE(falling, change);
    uint16_t gain = SELF.gains.kd;
    uint16_t product;

    FIXPID_ASSERT(VALID(self));
    if (magnitude > TERM_LIMIT) {
        magnitude = TERM_LIMIT;
    }
    // at most (127 * 127 + 3) / 4 = 4033
    FIXPID_SCALED_PRODUCT(product, gain, magnitude, bias, 2u, 5u);
    if (product > TERM_LIMIT) {
        product = TERM_LIMIT;
    }
    SELF.derivative = (int8_t)FIXPID_WITH_SIGN(falling, product);
}

int16_t fixpid_an964_8bit_step(FIXPID_DATA struct fixpid_an964_8bit *self,
                               int8_t error)
{
    int16_t sum_of_terms;
    bool negative;
    uint16_t magnitude;
    uint16_t gain;
    uint16_t output;

    FIXPID_ASSERT(VALID(self));
    SELF.flags = 0;
    integrate(self, error);
    differentiate(self, error);
    SELF.error[2] = SELF.error[1];
    SELF.error[1] = SELF.error[0];
    SELF.error[0] = error;

    sum_of_terms = (int16_t)(error + SELF.integral + SELF.derivative);
    negative = sum_of_terms < 0;
    magnitude = FIXPID_MAGNITUDE(negative, sum_of_terms);
    if (magnitude > BYTE_MAX) { // at most 128 + 127 + 127
        magnitude = BYTE_MAX;
        SELF.flags |= FIXPID_AN964_8BIT_OUTPUT_LIMITED;
    }
    gain = SELF.gains.kp;
    FIXPID_SCALED_PRODUCT(output, magnitude, gain, 0u, 5u, 2u); // <= 504
    return FIXPID_WITH_SIGN(negative, output);
}

int16_t fixpid_an964_8bit_proportional(
    FIXPID_DATA struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.error[0];
}

int16_t fixpid_an964_8bit_integral(FIXPID_DATA struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.integral;
}

int16_t fixpid_an964_8bit_derivative(FIXPID_DATA struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.derivative;
}

uint8_t fixpid_an964_8bit_flags(FIXPID_DATA struct fixpid_an964_8bit *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.flags;
}
