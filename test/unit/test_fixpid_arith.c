// SPDX-License-Identifier: MIT
// Every form of the leaves, over its whole domain or, with 16 x 16 bits and
// more, over every value of one operand.
#include "fixpid_an937_pic18.h"
#include "fixpid_arith.h"
#include "numbers.h"
#include "reference.h"
#include "unity.h"

TEST_SOURCE_FILE("src/fixpid_an937_pic18.c")

#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 walks a whole domain
#endif

void setUp(void)
{
}

void tearDown(void)
{
}

// All three forms of one product with a word and, where it fits, a byte as the
// short operand. Plain comparisons, because there are a hundred million.
#define CHECK_SCALED(x, k, bias, n, more, k_type)                              \
    do {                                                                       \
        const uint16_t expected_ =                                             \
            (uint16_t)(((uint64_t)(x) * (k) + (bias)) / (1u << (n)));          \
        uint16_t result_, x_ = (uint16_t)(x);                                  \
        k_type k_ = (k_type)(k);                                               \
        FIXPID_SCALED_MULTIPLY(result_, x_, k_, bias, n, more);                \
        wrong += result_ != expected_;                                         \
        FIXPID_SCALED_BYTES(result_, x_, k_, bias, n, more);                   \
        wrong += result_ != expected_;                                         \
        FIXPID_SCALED_SHIFT(result_, x_, k_, bias, n, more);                   \
        wrong += result_ != expected_;                                         \
    } while (0)

#define WALK_SCALED(x_max, k_max, bias, n, more, k_type)                       \
    do {                                                                       \
        uint32_t wrong = 0;                                                    \
        for (uint32_t x = 0; x <= (x_max); x += TEST_STRIDE) {                 \
            for (uint32_t k = 0; k <= (k_max); k++) {                          \
                CHECK_SCALED(x, k, bias, n, more, k_type);                     \
            }                                                                  \
        }                                                                      \
        for (uint32_t k = 0; k <= (k_max); k++) {                              \
            CHECK_SCALED(x_max, k, bias, n, more, k_type);                     \
        }                                                                      \
        TEST_ASSERT_EQUAL_UINT32(0, wrong);                                    \
    } while (0)

void test_scaled_product_of_an964_integral_whole_domain(void)
{
    WALK_SCALED(1023u, 127u, 0u, 4u, 3u, uint8_t);
}

void test_scaled_product_of_an964_derivative_seven_turns_whole_domain(void)
{
    WALK_SCALED(1023u, 127u, 0u, 5u, 2u, uint8_t);
    WALK_SCALED(1023u, 127u, 31u, 5u, 2u, uint16_t);
}

void test_scaled_product_of_an964_derivative_eight_turns_whole_domain(void)
{
    WALK_SCALED(1023u, 255u, 0u, 5u, 3u, uint8_t);
    WALK_SCALED(1023u, 255u, 31u, 5u, 3u, uint16_t);
}

void test_scaled_product_of_an964_output_whole_domain(void)
{
    WALK_SCALED(8758u, 1023u, 0u, 10u, 0u, uint16_t);
}

void test_scaled_product_at_its_precondition_whole_row(void)
{
    WALK_SCALED(16383u, 1023u, 1023u, 10u, 0u, uint16_t);
}

void test_scaled_product_of_8bit_terms_whole_domain(void)
{
    WALK_SCALED(127u, 127u, 0u, 3u, 4u, uint8_t);
    WALK_SCALED(127u, 127u, 0u, 2u, 5u, uint16_t);
    WALK_SCALED(127u, 127u, 3u, 2u, 5u, uint16_t);
    WALK_SCALED(127u, 127u, 0u, 5u, 2u, uint16_t);
}

union number {
    int32_t value;
    struct {
        uint16_t magnitude;
        uint8_t negative;
    } parts;
};

// Every form of the sum after one product, and after another one of the
// opposite sign. A product of 0 may have either sign.
static uint32_t wrong_sums(uint8_t gain, uint16_t magnitude, uint8_t negative)
{
    const int32_t product = (int32_t)gain * magnitude;
    const int32_t expected = negative != 0u ? -product : product;
    const union number value = {.value = expected};
    const union number one = {.value = negative != 0u ? -1 : 1};
    const union number parts = {.parts = {magnitude, negative}};
    const union number opposite = {
        .parts = {magnitude, (uint8_t)(negative ^ 1u)}};
    uint32_t wrong = 0;
    int32_t sum;

    FIXPID_VALUE_PRODUCTS(sum, 1, value, gain, one, 1, value, none);
    wrong += sum != 2 * expected + (negative != 0u ? -gain : gain);
    FIXPID_PARTS_PRODUCT(sum, gain, parts, none);
    wrong += sum != expected;
    FIXPID_PARTS_ADD_PRODUCT(sum, gain, opposite, none);
    wrong += sum != 0;
    FIXPID_PARTS_ADD_PRODUCT(sum, gain, opposite, none);
    wrong += sum != -expected;
    FIXPID_PARTS_PRODUCTS(sum, 0, opposite, gain, parts, 1, parts, none);
    wrong += sum != expected + (negative != 0u ? -magnitude : magnitude);
    FIXPID_KERNEL_PRODUCTS(sum, gain, opposite, 1, parts, gain, opposite, none);
    return wrong +
           (sum != -2 * expected + (negative != 0u ? -magnitude : magnitude));
}

void test_sum_of_products_whole_domain(void)
{
    uint32_t wrong = 0;

    for (uint32_t gain = 0; gain <= 255u; gain++) {
        for (uint32_t magnitude = 0; magnitude <= 65535u;
             magnitude += TEST_STRIDE) {
            wrong += wrong_sums((uint8_t)gain, (uint16_t)magnitude,
                                (uint8_t)(magnitude & 1u));
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_sum_of_values_whole_rows(void)
{
    for (int32_t number = -65535; number <= 65535; number++) {
        const union number value = {.value = number};
        const uint8_t gain = (uint8_t)number;
        int32_t sum;

        FIXPID_VALUE_PRODUCT(sum, gain, value, none);
        TEST_ASSERT_EQUAL_INT32(gain * number, sum);
        sum = 1000;
        FIXPID_VALUE_ADD_PRODUCT(sum, gain, value, none);
        TEST_ASSERT_EQUAL_INT32(1000 + gain * number, sum);
    }
}

static void check_sixteenth(int64_t total)
{
    const int64_t most = 0xFFFFFF;
    const int64_t limited = reference_clamp(total, -most, most);
    const uint8_t others = 0x12; // bits that must stay
    const uint8_t expected =
        (uint8_t)(others | (total < 0 ? FIXPID_SUM_NEGATIVE : 0u) |
                  (total != limited ? FIXPID_SUM_SATURATED : 0u));
    int32_t sum = (int32_t)total, kernel_sum = (int32_t)total;
    uint8_t flags = others, kernel_flags = others;

    FIXPID_LIMITED_SIXTEENTH(sum, flags);
    FIXPID_KERNEL_SIXTEENTH(kernel_sum, kernel_flags);
    if (sum != limited / 16 || flags != expected || kernel_sum != sum ||
        kernel_flags != expected) {
        TEST_ASSERT_EQUAL_INT64(limited / 16, sum);
        TEST_ASSERT_EQUAL_INT32(sum, kernel_sum);
        TEST_ASSERT_EQUAL_HEX8(expected, flags);
        TEST_ASSERT_EQUAL_HEX8(expected, kernel_flags);
    }
}

void test_sixteenth_of_a_sum_all_over_and_densely_at_its_limits(void)
{
    static const int32_t places[] = {0, 0x1000000, 0x2000000, 0x3FE0000};

    for (int32_t total = -0x4000000; total <= 0x4000000; total += 1009) {
        check_sixteenth(total);
    }
    for (unsigned place = 0; place < 4; place++) {
        for (int32_t near = -40000; near <= 40000; near++) {
            check_sixteenth(places[place] + near);
            check_sixteenth(-places[place] + near);
        }
    }
}

// A number in both forms.
struct both {
    union number value;
    union number parts;
};

static void check_both(int64_t expected, const struct both *numbers)
{
    const int32_t parts = FIXPID_PARTS_GET(numbers->parts);
    const int32_t value = FIXPID_VALUE_GET(numbers->value);

    if (parts != expected || value != expected ||
        numbers->parts.parts.negative > 1u) {
        TEST_ASSERT_EQUAL_INT64(expected, value);
        TEST_ASSERT_EQUAL_INT64(expected, parts);
        TEST_ASSERT_LESS_OR_EQUAL_UINT8(1, numbers->parts.parts.negative);
    }
}

void test_number_set_and_clear_every_error(void)
{
    for (int32_t error = INT16_MIN; error <= INT16_MAX; error++) {
        struct both numbers = {.value = {.value = 7}};
        const int16_t from = (int16_t)error;

        FIXPID_VALUE_SET(numbers.value, from);
        FIXPID_PARTS_SET(numbers.parts, from);
        check_both(error, &numbers);
        FIXPID_VALUE_CLEAR(numbers.value);
        FIXPID_PARTS_CLEAR(numbers.parts);
        check_both(0, &numbers);
        TEST_ASSERT_EQUAL_UINT8(0, numbers.parts.parts.negative);
    }
}

static void check_difference(int16_t left, int16_t right)
{
    const uint16_t left_level = FIXPID_LEVEL(left);
    const uint16_t right_level = FIXPID_LEVEL(right);
    struct both numbers = {.parts = {.parts = {77, 1}}};

    FIXPID_VALUE_DIFFERENCE(numbers.value, left_level, right_level);
    FIXPID_PARTS_DIFFERENCE(numbers.parts, left_level, right_level);
    check_both((int64_t)left - right, &numbers);
}

void test_number_difference_whole_rows_and_columns(void)
{
    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        for (int32_t other = INT16_MIN; other <= INT16_MAX; other++) {
            check_difference(nasty[i], (int16_t)other);
            check_difference((int16_t)other, nasty[i]);
        }
    }
}

// `minus_zero` gives a 0 the sign that an earlier sum may have left.
static void check_add(int32_t number, int16_t addend, uint16_t limit,
                      bool minus_zero)
{
    const int64_t sum = (int64_t)number + addend;
    const int64_t expected = reference_clamp(sum, -(int64_t)limit, limit);
    const bool negative = number < 0 || (number == 0 && minus_zero);
    struct both numbers = {
        .value = {.value = number},
        .parts = {.parts = {(uint16_t)(negative ? -number : number),
                            negative ? 1 : 0}}};
    union number other_value, other_parts;
    uint8_t value_flags = 8, parts_flags = 8;

    FIXPID_VALUE_SET(other_value, addend);
    FIXPID_PARTS_SET(other_parts, addend);
    FIXPID_VALUE_ADD(numbers.value, other_value, limit, value_flags, 4);
    FIXPID_PARTS_ADD(numbers.parts, other_parts, limit, parts_flags, 4);
    check_both(expected, &numbers);
    TEST_ASSERT_EQUAL_UINT8(sum != expected ? 4 : 8, value_flags);
    TEST_ASSERT_EQUAL_UINT8(sum != expected ? 4 : 8, parts_flags);
}

void test_number_add_nasty_integers_crossed(void)
{
    static const uint16_t limits[] = {1,     2,     255,   256,  4000,
                                      32767, 32768, 65534, 65535};

    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        for (unsigned j = 0; j < NASTY_COUNT; j++) {
            for (unsigned k = 0; k < sizeof limits / sizeof limits[0]; k++) {
                const uint16_t magnitude = (uint16_t)nasty[i];
                const int16_t addend = nasty[j];

                check_add(magnitude, addend, limits[k], false);
                check_add(-(int32_t)magnitude, addend, limits[k], true);
            }
        }
    }
}

void test_number_add_random_integers(void)
{
    numbers_seed(17);
    for (uint32_t i = 0; i < 1000000u / TEST_STRIDE; i++) {
        const int32_t number = (int32_t)numbers_below(131071) - 65535;
        const uint16_t limit = (uint16_t)(1u + numbers_below(65535));

        check_add(number, numbers_int16(), limit, (i & 1u) != 0u);
    }
}

void test_products_of_nasty_integers_crossed_match_64_bits(void)
{
    uint32_t wrong = 0;

    for (unsigned i = 0; i < NASTY_COUNT; i++) {
        for (unsigned j = 0; j < NASTY_COUNT; j++) {
            const uint16_t x = (uint16_t)((uint16_t)nasty[i] & 16383u);
            const uint16_t k = (uint16_t)((uint16_t)nasty[j] & 1023u);

            CHECK_SCALED(x, k, 0u, 10u, 0u, uint16_t);
            CHECK_SCALED(x, k, 1023u, 10u, 0u, uint16_t);
            wrong += wrong_sums((uint8_t)k, (uint16_t)nasty[i], 0);
            wrong += wrong_sums((uint8_t)k, (uint16_t)nasty[i], 1);
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_byte_product_whole_domain(void)
{
    for (unsigned a = 0; a <= 255u; a++) {
        for (unsigned b = 0; b <= 255u; b++) {
            const uint8_t left = (uint8_t)a;
            const uint8_t right = (uint8_t)b;
            const uint16_t product = FIXPID_BYTE_PRODUCT(left, right);

            TEST_ASSERT_EQUAL_UINT16((uint32_t)a * b, product);
        }
    }
}

void test_negated_every_negative_pattern_gives_the_magnitude(void)
{
    for (int32_t value = -32768; value < 0; value++) {
        const int16_t pattern = (int16_t)value;

        TEST_ASSERT_EQUAL_UINT16(-value, FIXPID_NEGATED(pattern));
    }
    for (uint32_t magnitude = 1; magnitude <= 65535u; magnitude++) {
        TEST_ASSERT_EQUAL_UINT16(65536u - magnitude,
                                 FIXPID_NEGATED((uint16_t)magnitude));
    }
}
void test_with_sign_and_magnitude_every_value_round_trips(void)
{
    for (int32_t value = -32767; value <= 32767; value++) {
        const int16_t number = (int16_t)value;
        const uint16_t magnitude = FIXPID_MAGNITUDE(value < 0, number);

        TEST_ASSERT_EQUAL_UINT16(value < 0 ? -value : value, magnitude);
        TEST_ASSERT_EQUAL_INT16(value, FIXPID_WITH_SIGN(value < 0, magnitude));
    }
}

// ---- Signed values ----

static int64_t floor_divided(int64_t dividend, int64_t divisor)
{
    return dividend / divisor - (dividend % divisor < 0 ? 1 : 0);
}

static int64_t kept_within(int64_t value, int64_t low, int64_t high)
{
    return value < low ? low : value > high ? high : value;
}

static const int32_t nasty32[] = {
    0,
    1,
    -1,
    127,
    -128,
    255,
    256,
    -256,
    -257,
    32767,
    -32768,
    65535,
    65536,
    -65536,
    -65537,
    0x7FFFFF,
    -0x7FFFFF,
    -0x800000,
    0x40000000,
    -0x40000000,
    0x7FFF0000,
    -0x7FFF0000,
    INT32_MAX - 1,
    INT32_MAX,
    INT32_MIN + 1,
    INT32_MIN,
};
#define NASTY32_COUNT (sizeof nasty32 / sizeof nasty32[0])

static void check_floor(int32_t x)
{
    for (uint8_t bits = 0; bits <= 20; bits++) {
        const int64_t expected = floor_divided(x, 1 << (bits & 7));
        int32_t shift, steps;

        FIXPID_FLOOR_BY_SHIFT(shift, x, bits);
        FIXPID_FLOOR_BY_STEPS(steps, x, bits);
        TEST_ASSERT_EQUAL_INT32(expected, shift);
        TEST_ASSERT_EQUAL_INT32(expected, steps);
    }
    for (uint8_t n = 0; n <= 30; n++) {
        const int64_t expected = floor_divided(x, INT64_C(1) << n);

        TEST_ASSERT_EQUAL_INT32(expected, FIXPID_FLOOR_SHIFT(x, n));
        TEST_ASSERT_EQUAL_INT32(expected, FIXPID_FLOOR_PORTABLE(x, n));
    }
}

void test_floor_of_nasty_and_random_values_goes_down(void)
{
    numbers_seed(1);
    for (unsigned i = 0; i < NASTY32_COUNT; i++) {
        check_floor(nasty32[i]);
    }
    for (unsigned i = 0; i < 1000; i++) {
        check_floor((int32_t)numbers_next());
    }
}

void test_raised_every_16_bits_and_back(void)
{
    for (int32_t value = -32768; value <= 32767; value++) {
        const int16_t counts = (int16_t)value;
        const int32_t raised = value * INT32_C(65536);

        TEST_ASSERT_EQUAL_INT32(value * 256, FIXPID_RAISED(counts, 8));
        TEST_ASSERT_EQUAL_INT32(raised, FIXPID_RAISED(counts, 16));
        TEST_ASSERT_EQUAL_INT16(value, FIXPID_FLOOR(raised, 16));
    }
}

void test_clamp_keeps_a_variable_within_both_ends(void)
{
    static const int16_t expected[] = {-3, -3, -3, -2, -1, 0, 1, 2, 2, 2};

    for (int16_t value = -5; value < 5; value++) {
        int16_t kept = value;

        FIXPID_CLAMP(kept, -3, 2);
        TEST_ASSERT_EQUAL_INT16(expected[value + 5], kept);
        FIXPID_CLAMP(kept, 7, 7);
        TEST_ASSERT_EQUAL_INT16(7, kept);
    }
}

void test_mirrored_images_turn_a_difference_round(void)
{
    for (int32_t value = -32768; value <= 32767; value++) {
        const int16_t x = (int16_t)value;

        TEST_ASSERT_EQUAL_INT16(-1 - value, FIXPID_MIRRORED(x));
    }
}

static uint32_t differences_wrong(int16_t a, int16_t b)
{
    const int16_t expected =
        (int16_t)kept_within((int64_t)a - b, INT16_MIN, INT16_MAX);
    int16_t wide, narrow, chosen;

    FIXPID_DIFFERENCE_WIDE(wide, a, b);
    FIXPID_DIFFERENCE_NARROW(narrow, a, b);
    FIXPID_SATURATED_DIFFERENCE(chosen, a, b);
    return (wide != expected ? 1u : 0u) + (narrow != expected ? 1u : 0u) +
           (chosen != expected ? 1u : 0u);
}

void test_difference_of_every_value_and_nasty_ones_is_saturated(void)
{
    uint32_t wrong = 0;

    for (int32_t value = -32768; value <= 32767; value += TEST_STRIDE) {
        for (unsigned i = 0; i < NASTY_COUNT; i++) {
            wrong += differences_wrong((int16_t)value, nasty[i]);
            wrong += differences_wrong(nasty[i], (int16_t)value);
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

static uint32_t sums_wrong(int32_t a, int32_t b)
{
    const int32_t expected =
        (int32_t)kept_within((int64_t)a + b, INT32_MIN, INT32_MAX);
    int32_t portable, flag, chosen;

    FIXPID_SUM_PORTABLE(portable, a, b);
    FIXPID_SUM_FLAG(flag, a, b);
    FIXPID_SATURATED_SUM(chosen, a, b);
    return (portable != expected ? 1u : 0u) + (flag != expected ? 1u : 0u) +
           (chosen != expected ? 1u : 0u);
}

void test_sum_of_nasty_and_random_values_is_saturated(void)
{
    uint32_t wrong = 0;

    for (unsigned i = 0; i < NASTY32_COUNT; i++) {
        for (unsigned j = 0; j < NASTY32_COUNT; j++) {
            wrong += sums_wrong(nasty32[i], nasty32[j]);
        }
    }
    numbers_seed(2);
    for (uint32_t n = 0; n < UINT32_C(100000); n += TEST_STRIDE) {
        const int32_t a = (int32_t)numbers_next();

        wrong += sums_wrong(a, (int32_t)numbers_next());
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

static uint32_t signed_products_wrong(uint16_t gain, int16_t x)
{
    const int32_t expected = (int32_t)((int64_t)gain * x);
    int32_t multiply, bytes, chosen;

    FIXPID_SIGNED_MULTIPLY(multiply, gain, x);
    FIXPID_SIGNED_BYTES(bytes, gain, x);
    FIXPID_SIGNED_PRODUCT(chosen, gain, x);
    return (multiply != expected ? 1u : 0u) + (bytes != expected ? 1u : 0u) +
           (chosen != expected ? 1u : 0u);
}

void test_signed_product_of_every_value_and_nasty_ones(void)
{
    uint32_t wrong = 0;

    for (uint32_t value = 0; value <= 32767u; value += TEST_STRIDE) {
        for (unsigned i = 0; i < NASTY_COUNT; i++) {
            const uint16_t gain = (uint16_t)((uint16_t)nasty[i] & 32767u);
            const int16_t x = (int16_t)value;

            wrong += signed_products_wrong((uint16_t)value, nasty[i]);
            wrong += signed_products_wrong(gain, x);
            wrong += signed_products_wrong(gain, (int16_t)(-1 - x));
        }
    }
    wrong += signed_products_wrong(32767u, INT16_MAX);
    wrong += signed_products_wrong(32767u, INT16_MIN);
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}
