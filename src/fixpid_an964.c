// SPDX-License-Identifier: MIT
#include "fixpid_an964.h"

#include "fixpid_arith.h"

#ifdef FIXPID_AN964_OBJECT
#define SELF FIXPID_AN964_OBJECT
#define VALID(self) ((self) == &SELF)
#else
#define SELF (*self)
#define VALID(self) ((self) != 0)
#endif

#define ERROR_LIMIT 1023
#define GAIN_MAX 1023u
#define TERM_LIMIT ((uint16_t)FIXPID_AN964_TERM_LIMIT)
#define OUTPUT_LIMIT ((uint16_t)FIXPID_AN964_OUTPUT_LIMIT)

// A term limit below 128 fits 7 bits, and each bit costs a PIC16 one turn.
#if FIXPID_AN964_TERM_LIMIT < 128
#define TERM_BITS 7u
#else
#define TERM_BITS 8u
#endif

bool fixpid_an964_init(FIXPID_DATA struct fixpid_an964 *self,
                       const struct fixpid_an964_gains *gains)
{
    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(gains != 0);
    fixpid_an964_reset(self);
    SELF.ready = 1;
    if (!fixpid_an964_set_gains(self, gains->kp, gains->ki, gains->kd)) {
        SELF.gains.kp = 0; // it multiplies all terms
        SELF.ready = 0;
    }
    return SELF.ready != 0u;
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
    SELF.flags = 0;
}

bool fixpid_an964_set_gains(FIXPID_DATA struct fixpid_an964 *self, uint16_t kp,
                            uint16_t ki, uint16_t kd)
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

// The sum of errors, and I = ki * sum / 4096 in two divisions toward zero.
static void integrate(FIXPID_DATA struct fixpid_an964 *self, int16_t error)
{
    int16_t sum = (int16_t)(SELF.sum + error); // |sum| <= 30000 + 1023 < 2^15
    uint16_t gain = SELF.gains.ki;
    uint16_t product;
    uint8_t high;
    bool negative;

    FIXPID_ASSERT(VALID(self));
    if (sum > FIXPID_AN964_SUM_LIMIT) {
        sum = FIXPID_AN964_SUM_LIMIT;
        SELF.flags = FIXPID_AN964_SUM_LIMITED;
    }
    if (sum < (1 - FIXPID_AN964_SUM_LIMIT)) {
        sum = 1 - FIXPID_AN964_SUM_LIMIT;
        SELF.flags = FIXPID_AN964_SUM_LIMITED;
    }
    SELF.sum = sum;

    // |sum| / 256 <= 117 < 2^7, so |I| <= 117 * 1023 / 16 = 7480
    negative = sum < 0;
    high = (uint8_t)(FIXPID_MAGNITUDE(negative, sum) >> 8);
    FIXPID_SCALED_PRODUCT(product, gain, high, 0u, 4u, 3u);
    SELF.integral = FIXPID_WITH_SIGN(negative, product);
}

// D = kd * (E(n) - E(n-3)) / 32, rounded down as the note's shift does.
static void differentiate(FIXPID_DATA struct fixpid_an964 *self, int16_t error)
{
    const int16_t change = (int16_t)(error - SELF.error[2]); // within +-2046
    const bool falling = change < 0;
    const uint8_t bias = falling ? 31u : 0u;
    uint16_t gain = SELF.gains.kd;
    uint16_t magnitude = FIXPID_MAGNITUDE(falling, change);
    uint16_t product;

    FIXPID_ASSERT(VALID(self));
    if (magnitude > TERM_LIMIT) {
        magnitude = TERM_LIMIT;
    }
    // at most (255 * 1023 + 31) / 32 = 8153
    FIXPID_SCALED_PRODUCT(product, gain, magnitude, bias, 5u, TERM_BITS - 5u);
    if (product > TERM_LIMIT) {
        product = TERM_LIMIT;
    }
    SELF.derivative = FIXPID_WITH_SIGN(falling, product);
}

int16_t fixpid_an964_step(FIXPID_DATA struct fixpid_an964 *self, int16_t error)
{
    int16_t e = error;
    int16_t sum_of_terms;
    bool negative;
    uint16_t magnitude;
    uint16_t gain;
    uint16_t output;

    FIXPID_ASSERT(VALID(self));
    if (e > ERROR_LIMIT) {
        e = ERROR_LIMIT;
    }
    if (e < -ERROR_LIMIT) {
        e = -ERROR_LIMIT;
    }
    SELF.flags = 0;
    integrate(self, e);
    differentiate(self, e);
    SELF.error[2] = SELF.error[1];
    SELF.error[1] = SELF.error[0];
    SELF.error[0] = e;

    // |e + I + D| <= 1023 + 7480 + 255 = 8758 < 2^14
    sum_of_terms = (int16_t)(e + SELF.integral + SELF.derivative);
    negative = sum_of_terms < 0;
    magnitude = FIXPID_MAGNITUDE(negative, sum_of_terms);
    gain = SELF.gains.kp;
    FIXPID_SCALED_PRODUCT(output, magnitude, gain, 0u, 10u, 0u);
    if (output > OUTPUT_LIMIT) {
        output = OUTPUT_LIMIT;
        SELF.flags |= FIXPID_AN964_OUTPUT_LIMITED;
    }
    return FIXPID_WITH_SIGN(negative, output);
}

int16_t fixpid_an964_proportional(FIXPID_DATA struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.error[0];
}

int16_t fixpid_an964_integral(FIXPID_DATA struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.integral;
}

int16_t fixpid_an964_derivative(FIXPID_DATA struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.derivative;
}

uint8_t fixpid_an964_flags(FIXPID_DATA struct fixpid_an964 *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.flags;
}
