// SPDX-License-Identifier: MIT
// The numbers of fixpid_an937 and their products against 64 bits, in the form
// that the compiler's macros choose: in two's complement or in sign-magnitude.
#include "an937/fixpid_an937_arith.h"
#include "fixpid_an937.h"
#include "numbers.h"
#include "reference.h"
#include "unity.h"

#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 takes every magnitude
#endif

#define SUM_MAX INT64_C(0xFFFFFF)
#define OTHERS 0x14u // flags that must stay

// The bits of a sign's byte that mean nothing.
#if defined(FIXPID_AN937_NARROW_H)
#define BESIDE_SIGN 0xFEu
#else
#define BESIDE_SIGN 0u // two's complement has no such byte
#endif

void setUp(void)
{
}

void tearDown(void)
{
}

// Any number of 17 bits.
static union fixpid_an937_number number_of(int32_t value)
{
    union fixpid_an937_number number;

    fixpid_number_difference(&number, (uint16_t)(value > 0 ? value : 0),
                             (uint16_t)(value < 0 ? -value : 0));
    return number;
}

// A 0 as a sum leaves it, whose sign in sign-magnitude is 1.
static union fixpid_an937_number minus_zero(void)
{
    union fixpid_an937_number number = number_of(-1);
    const union fixpid_an937_number one = number_of(1);
    uint8_t flags = 0;

    fixpid_number_add(&number, &one, UINT16_MAX, &flags);
    return number;
}

void test_number_set_every_error(void)
{
    union fixpid_an937_number number = number_of(-7);

    for (int32_t error = INT16_MIN; error <= INT16_MAX; error++) {
        fixpid_number_set(&number, (int16_t)error);
        TEST_ASSERT_EQUAL_INT32(error, fixpid_number_value(&number));
    }
}

void test_number_of_zero_bytes_is_zero(void)
{
    union fixpid_an937_number number = number_of(-65535);

    number.value = 0;
    TEST_ASSERT_EQUAL_INT32(0, fixpid_number_value(&number));
}

static uint32_t wrong_difference(uint16_t left, uint16_t right)
{
    union fixpid_an937_number number = number_of(-77);

    fixpid_number_difference(&number, left, right);
    return (fixpid_number_value(&number) != (int32_t)left - (int32_t)right)
               ? 1u
               : 0u;
}

void test_number_difference_every_value_and_nasty_ones(void)
{
    uint32_t wrong = 0;

    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        const uint16_t one =
            (uint16_t)((uint16_t)nasty[i] ^ FIXPID_AN937_NO_ERROR);

        for (uint32_t other = 0; other <= UINT16_MAX; other += TEST_STRIDE) {
            wrong += wrong_difference(one, (uint16_t)other);
            wrong += wrong_difference((uint16_t)other, one);
        }
        wrong += wrong_difference(one, one);
        wrong += wrong_difference(one, UINT16_MAX);
        wrong += wrong_difference(UINT16_MAX, one);
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

static void check_add(union fixpid_an937_number number, int32_t value,
                      uint16_t limit)
{
    union fixpid_an937_number addend = number_of(value);
    const int64_t sum = (int64_t)fixpid_number_value(&number) + value;
    const int64_t expected = reference_clamp(sum, -(int64_t)limit, limit);
    uint8_t flags = OTHERS;

    if (value == (int16_t)value) {
        fixpid_number_set(&addend, (int16_t)value);
    }
    fixpid_number_add(&number, &addend, limit, &flags);
    TEST_ASSERT_EQUAL_INT32(expected, fixpid_number_value(&number));
    if (sum == expected) {
        TEST_ASSERT_EQUAL_HEX8(OTHERS, flags);
    } else {
        TEST_ASSERT_BITS_HIGH(FIXPID_AN937_ACCUMULATED_ERROR_LIMITED, flags);
    }
}

void test_number_add_nasty_numbers_and_limits_crossed(void)
{
    static const uint16_t limits[] = {1,     2,     255,   256,  4000,
                                      32767, 32768, 65534, 65535};

    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        for (unsigned j = 0; j < NASTY_COUNT; j++) {
            const uint16_t magnitude = (uint16_t)nasty[i];

            for (unsigned k = 0; k < sizeof limits / sizeof limits[0]; k++) {
                check_add(number_of(magnitude), nasty[j], limits[k]);
                check_add(number_of(-(int32_t)magnitude), nasty[j], limits[k]);
                check_add(minus_zero(), nasty[j], limits[k]);
            }
        }
    }
}

void test_number_with_bits_beside_its_sign_is_the_same(void)
{
    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        for (unsigned bit = 0; bit < 8u; bit++) {
            union fixpid_an937_number number = number_of(nasty[i]);
            const int32_t term = fixpid_number_term(255, &number);

            number.parts.negative ^= (uint8_t)((1u << bit) & BESIDE_SIGN);
            TEST_ASSERT_EQUAL_INT32(nasty[i], fixpid_number_value(&number));
            TEST_ASSERT_EQUAL_INT32(term, fixpid_number_term(255, &number));
            for (unsigned j = 0; j < NASTY_COUNT; j++) {
                check_add(number, nasty[j], UINT16_MAX);
            }
        }
    }
}

void test_number_add_random_numbers_of_17_bits(void)
{
    numbers_seed(17);
    for (uint32_t i = 0; i < UINT32_C(300000) / TEST_STRIDE; i++) {
        const int32_t number = (int32_t)numbers_below(131071) - 65535;
        const int32_t addend = (int32_t)numbers_below(131071) - 65535;

        check_add(number_of(number), addend,
                  (uint16_t)(1u + numbers_below(65535)));
    }
}

void test_number_add_of_nothing_beyond_the_limit_is_limited(void)
{
    check_add(number_of(65535), 0, 4000);
    check_add(number_of(-65535), 0, 4000);
    check_add(number_of(65535), 65535, 65535);
    check_add(number_of(-65535), -65535, 65535);
}

static uint32_t wrong_term(uint8_t gain, uint16_t magnitude)
{
    const int32_t product = (int32_t)gain * magnitude;
    const union fixpid_an937_number plus = number_of(magnitude);
    const union fixpid_an937_number minus = number_of(-(int32_t)magnitude);

    return ((fixpid_number_term(gain, &plus) != product) ? 1u : 0u) +
           ((fixpid_number_term(gain, &minus) != -product) ? 1u : 0u);
}

void test_number_term_every_gain_and_magnitude(void)
{
    const union fixpid_an937_number zero = minus_zero();
    uint32_t wrong = 0;

    for (unsigned gain = 0; gain <= 255u; gain++) {
        for (uint32_t magnitude = 0; magnitude <= UINT16_MAX;
             magnitude += TEST_STRIDE) {
            wrong += wrong_term((uint8_t)gain, (uint16_t)magnitude);
        }
        wrong += wrong_term((uint8_t)gain, UINT16_MAX);
        TEST_ASSERT_EQUAL_INT32(0, fixpid_number_term((uint8_t)gain, &zero));
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

// Sums from which a carry or a borrow goes far, and that of two largest terms.
void test_sum_with_term_every_gain_and_nasty_sums_and_numbers(void)
{
    static const int32_t sums[] = {0,          1,        -1,       255,
                                   -256,       65535,    -65536,   0xFFFFFF,
                                   -0x1000000, 33422850, -33422850};
    static const int32_t values[] = {0,      1,     -1,     255,   -255,
                                     256,    -256,  257,    32767, -32768,
                                     -65281, 65280, -65280, 65535, -65535};
    uint32_t wrong = 0;

    for (unsigned gain = 0; gain <= 255u; gain++) {
        for (unsigned i = 0; i < sizeof sums / sizeof sums[0]; i++) {
            for (unsigned j = 0; j < sizeof values / sizeof values[0]; j++) {
                const union fixpid_an937_number number = number_of(values[j]);

                wrong +=
                    (fixpid_sum_with_term(sums[i], (uint8_t)gain, &number) !=
                     sums[i] + (int32_t)gain * values[j])
                        ? 1u
                        : 0u;
            }
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_sixteenth_every_sum(void)
{
    const uint32_t most = UINT32_C(0xFFFFFF);
    uint32_t wrong = 0;

    for (uint32_t sum = 0; sum <= most; sum += TEST_STRIDE) {
        wrong += (fixpid_sixteenth(sum) != sum / 16u) ? 1u : 0u;
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
    TEST_ASSERT_EQUAL_UINT32(most / 16u, fixpid_sixteenth(most));
}

static void check_output(const struct fixpid_an937 *self)
{
    const int64_t sum =
        (int64_t)self->kp_q4 * fixpid_number_value(&self->error) +
        (int64_t)self->ki_q4 * fixpid_number_value(&self->accumulated_error) +
        (int64_t)self->kd_q4 * fixpid_number_value(&self->delta);
    const int64_t limited = reference_clamp(sum, -SUM_MAX, SUM_MAX);
    uint8_t flags = OTHERS;

    TEST_ASSERT_EQUAL_INT32(limited / 16, fixpid_an937_output(self, &flags));
    TEST_ASSERT_EQUAL_HEX8(
        OTHERS | (sum < 0 ? FIXPID_AN937_SUM_NEGATIVE : 0u) |
            (sum != limited ? FIXPID_AN937_SUM_SATURATED : 0u),
        flags);
}

// sum = kp * error + 255 * (accumulated + delta)
static void check_outputs_of(uint8_t kp_q4, int32_t error, int32_t accumulated,
                             int32_t delta)
{
    struct fixpid_an937 both = {.kp_q4 = kp_q4,
                                .ki_q4 = 255,
                                .kd_q4 = 255,
                                .error = number_of(error),
                                .accumulated_error = number_of(accumulated),
                                .delta = number_of(delta)};

    check_output(&both);
    both.error = number_of(-error);
    both.accumulated_error = number_of(-accumulated);
    both.delta = number_of(-delta);
    check_output(&both);
}

void test_output_at_the_limit_of_the_sum_and_one_beyond(void)
{
    TEST_ASSERT_EQUAL_INT64(SUM_MAX, INT64_C(255) * (65535 + 258));
    for (int32_t error = -40; error <= 40; error++) {
        check_outputs_of(1, error, 65535, 258);
    }
    check_outputs_of(255, 32767, 65535, 65535); // the largest sum
    check_outputs_of(255, -32768, -65535, -65535);
}

void test_output_small_sums_are_divided_toward_zero(void)
{
    for (int32_t error = -300; error <= 300; error++) {
        check_outputs_of(1, error, 0, 0);
    }
}

void test_output_of_zeros_of_both_signs_is_not_negative(void)
{
    struct fixpid_an937 self = {.kp_q4 = 255, .ki_q4 = 255, .kd_q4 = 255};

    self.error = minus_zero();
    self.accumulated_error = minus_zero();
    self.delta = number_of(0);
    check_output(&self);
}

void test_output_random_numbers(void)
{
    numbers_seed(4);
    for (uint32_t i = 0; i < UINT32_C(300000) / TEST_STRIDE; i++) {
        struct fixpid_an937 self = {.kp_q4 = (uint8_t)numbers_below(256),
                                    .ki_q4 = (uint8_t)numbers_below(256),
                                    .kd_q4 = (uint8_t)numbers_below(256)};

        self.error = number_of(numbers_int16());
        self.accumulated_error =
            number_of((int32_t)numbers_below(131071) - 65535);
        self.delta = number_of((int32_t)numbers_below(131071) - 65535);
        check_output(&self);
    }
}
