// SPDX-License-Identifier: MIT
// Every form of the leaves, over its whole domain or, with 16 x 16 bits and
// more, over every value of one operand.
#include "fixpid_an937_arith.h"
#include "fixpid_an937_pic18.h"
#include "fixpid_an964_pic14.h"
#include "fixpid_arith.h"
#include "fixpid_pid_arith.h"
#include "numbers.h"
#include "reference.h"
#include "unity.h"

TEST_SOURCE_FILE("src/fixpid_an937_pic18.c")
TEST_SOURCE_FILE("src/fixpid_an964_pic14.c")
TEST_SOURCE_FILE("src/fixpid_an964_8bit_pic14.c")

#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 walks a whole domain
#endif

void setUp(void)
{
}

void tearDown(void)
{
}

// x * k / 2^n in 64 bits, rounded up where `up` is not 0.
#define EXPECTED(x, k, up, n)                                                  \
    ((uint16_t)(((uint64_t)(x) * (k) +                                         \
                 ((up) != 0 ? (UINT64_C(1) << (n)) - 1u : 0u)) >>              \
                (n)))

// One form of a product, with variables of its own. Plain comparisons, because
// there are a hundred million.
#define CHECK(form, x, k, x_type, up, n, more)                                 \
    do {                                                                       \
        x_type used_x = (x_type)(x);                                           \
        uint16_t used_k = (uint16_t)(k);                                       \
        const uint8_t rounded_up = (up);                                       \
        uint16_t result;                                                       \
        form(result, used_x, used_k, rounded_up, n, more);                     \
        wrong += result != EXPECTED(x, k, up, n);                              \
        (void)rounded_up;                                                      \
    } while (0)
#define CHECK_7X7(x, k, up, n, more)                                           \
    do {                                                                       \
        CHECK(FIXPID_7X7_MULTIPLY, x, k, uint8_t, up, n, more);                \
        CHECK(FIXPID_7X7_BYTES, x, k, uint8_t, up, n, more);                   \
        CHECK(FIXPID_7X7_SHIFT, x, k, uint8_t, up, n, more);                   \
    } while (0)
#define CHECK_10X8(x, k, up, n, more)                                          \
    do {                                                                       \
        CHECK(FIXPID_10X8_MULTIPLY, x, k, uint16_t, up, n, more);              \
        CHECK(FIXPID_10X8_BYTES, x, k, uint16_t, up, n, more);                 \
        CHECK(FIXPID_10X8_SHIFT, x, k, uint16_t, up, n, more);                 \
        CHECK(FIXPID_10X8_UNROLLED, x, k, uint16_t, up, n, more);              \
    } while (0)

// 14X10 has neither `up` nor `n` nor `more`.
#define MULTIPLY_14X10(result, x, k, up, n, more)                              \
    FIXPID_14X10_MULTIPLY(result, x, k)
#define BYTES_14X10(result, x, k, up, n, more) FIXPID_14X10_BYTES(result, x, k)
#define SHIFT_14X10(result, x, k, up, n, more) FIXPID_14X10_SHIFT(result, x, k)
#define UNROLLED_14X10(result, x, k, up, n, more)                              \
    FIXPID_14X10_UNROLLED(result, x, k)
#define KERNEL_14X10(result, x, k, up, n, more)                                \
    ((result) = fixpid_kernel_14x10(x, k))
#define CHECK_14X10(x, k, up, n, more)                                         \
    do {                                                                       \
        CHECK(MULTIPLY_14X10, x, k, uint16_t, up, n, more);                    \
        CHECK(BYTES_14X10, x, k, uint16_t, up, n, more);                       \
        CHECK(SHIFT_14X10, x, k, uint16_t, up, n, more);                       \
        CHECK(UNROLLED_14X10, x, k, uint16_t, up, n, more);                    \
        CHECK(KERNEL_14X10, x, k, uint16_t, up, n, more);                      \
    } while (0)

#define WALK(check, x_max, k_max, up, n, more)                                 \
    do {                                                                       \
        uint32_t wrong = 0;                                                    \
        for (uint32_t x = 0; x <= (x_max); x += TEST_STRIDE) {                 \
            for (uint32_t k = 0; k <= (k_max); k++) {                          \
                check(x, k, up, n, more);                                      \
            }                                                                  \
        }                                                                      \
        for (uint32_t k = 0; k <= (k_max); k++) {                              \
            check(x_max, k, up, n, more);                                      \
        }                                                                      \
        TEST_ASSERT_EQUAL_UINT32(0, wrong);                                    \
    } while (0)

void test_product_of_an964_integral_whole_domain(void)
{
    WALK(CHECK_10X8, 1023u, 127u, 0, 4, 3);
}

void test_product_of_an964_derivative_seven_bits_whole_domain(void)
{
    WALK(CHECK_10X8, 1023u, 127u, 0, 5, 2);
    WALK(CHECK_10X8, 1023u, 127u, 0xFF, 5, 2);
}

void test_product_of_an964_derivative_eight_bits_whole_domain(void)
{
    WALK(CHECK_10X8, 1023u, 255u, 0, 5, 3);
    WALK(CHECK_10X8, 1023u, 255u, 0xFF, 5, 3);
}

void test_product_of_an964_output_whole_domain(void)
{
    WALK(CHECK_14X10, 8758u, 1023u, 0, 10, 0);
}

void test_product_14x10_at_its_precondition_whole_row(void)
{
    uint32_t wrong = 0;

    for (uint32_t k = 0; k <= 1023u; k++) {
        CHECK_14X10(16383u, k, 0, 10, 0);
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_product_of_8bit_integral_and_output_whole_domain(void)
{
    WALK(CHECK_7X7, 127u, 127u, 0, 3, 3);
    WALK(CHECK_7X7, 127u, 127u, 0, 5, 1);
}

void test_product_of_8bit_derivative_five_bits_whole_domain(void)
{
    WALK(CHECK_7X7, 127u, 31u, 0, 2, 2);
    WALK(CHECK_7X7, 127u, 31u, 0xFF, 2, 2);
}

void test_product_of_8bit_derivative_seven_bits_whole_domain(void)
{
    WALK(CHECK_7X7, 127u, 127u, 0, 2, 4);
    WALK(CHECK_7X7, 127u, 127u, 0xFF, 2, 4);
}

static uint16_t at_most(uint16_t value, uint16_t limit)
{
    return value > limit ? limit : value;
}

// Under the names that the steps use, in the form that was chosen.
void test_products_by_name_7x7_whole_domain(void)
{
    uint32_t wrong = 0;

    for (uint32_t x = 0; x <= 127u; x++) {
        for (uint32_t k = 0; k <= 127u; k++) {
            const uint8_t byte = (uint8_t)x;
            const uint16_t word = (uint16_t)k;
            const uint8_t up = 0xFF;
            uint16_t result;

            FIXPID_PRODUCT_7X7(result, byte, word, 5, 1);
            wrong += result != EXPECTED(x, k, 0, 5);
            FIXPID_BYTE_7X7(result, byte, word, 3, 3);
            wrong += result != at_most(EXPECTED(x, k, 0, 3), 127);
            FIXPID_LIMITED_7X7(result, byte, word, up, 2, 4, FIXPID_WORD(30));
            wrong += result != at_most(EXPECTED(x, k, 1, 2), 30);
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_products_by_name_10x8_whole_domain(void)
{
    uint32_t wrong = 0;

    for (uint32_t x = 0; x <= 1023u; x++) {
        for (uint32_t k = 0; k <= 127u; k++) {
            const uint16_t left = (uint16_t)x;
            const uint16_t right = (uint16_t)k;
            const uint8_t up = 0xFF;
            uint16_t result;

            FIXPID_PRODUCT_10X8(result, left, right, 4, 3);
            wrong += result != EXPECTED(x, k, 0, 4);
            FIXPID_LIMITED_10X8(result, left, right, up, 5, 2,
                                FIXPID_WORD(120));
            wrong += result != at_most(EXPECTED(x, k, 1, 5), 120);
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_byte_at_most_every_byte_and_limit(void)
{
    for (uint16_t limit = 1; limit <= 255u; limit++) {
        for (uint16_t value = 0; value <= 255u; value++) {
            uint16_t result;

            FIXPID_BYTE_AT_MOST(result, (uint8_t)value, limit);
            TEST_ASSERT_EQUAL_UINT16(at_most(value, limit), result);
        }
    }
}

// The kernels' twins; test/target runs the assembly.
void test_kernel_10x8_whole_domain(void)
{
    uint32_t wrong = 0;

    for (uint32_t x = 0; x <= 1023u; x++) {
        for (uint32_t k = 0; k <= 255u; k++) {
            const uint16_t word = (uint16_t)x;
            const uint8_t byte = (uint8_t)k;

            wrong += fixpid_kernel_10x8_4(byte, word) != EXPECTED(x, k, 0, 4);
            wrong += fixpid_kernel_10x8_5(byte, word, 0) !=
                     at_most(EXPECTED(x, k, 0, 5), 255);
            wrong += fixpid_kernel_10x8_5(byte, word, 0xFF) !=
                     at_most(EXPECTED(x, k, 1, 5), 255);
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
}

void test_kernel_7x7_whole_domain(void)
{
    uint32_t wrong = 0;

    for (uint32_t x = 0; x <= 127u; x++) {
        for (uint32_t k = 0; k <= 127u; k++) {
            const uint8_t left = (uint8_t)x;
            const uint8_t right = (uint8_t)k;

            wrong += fixpid_kernel_7x7_2(0, left, right) !=
                     at_most(EXPECTED(x, k, 0, 2), 127);
            wrong += fixpid_kernel_7x7_2(0xFF, left, right) !=
                     at_most(EXPECTED(x, k, 1, 2), 127);
            wrong += fixpid_kernel_7x7_3(left, right) !=
                     at_most(EXPECTED(x, k, 0, 3), 127);
            wrong += fixpid_kernel_7x7_5(left, right) != EXPECTED(x, k, 0, 5);
        }
    }
    TEST_ASSERT_EQUAL_UINT32(0, wrong);
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
    const int32_t once =
        negative != 0u ? -(int32_t)magnitude : (int32_t)magnitude;
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
    wrong += sum != expected + once;
    FIXPID_KERNEL_PRODUCTS(sum, gain, opposite, 1, parts, gain, opposite, none);
    return wrong + (sum != -2 * expected + once);
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

            CHECK_14X10(x, k, 0, 10, 0);
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

void test_negate_and_negative_every_value(void)
{
    for (int32_t value = -32767; value <= 32767; value++) {
        uint16_t bits = FIXPID_WORD(value);

        TEST_ASSERT_EQUAL_INT(value < 0, FIXPID_NEGATIVE(bits));
        FIXPID_NEGATE(bits);
        TEST_ASSERT_EQUAL_INT16(-value, FIXPID_SIGNED(bits));
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

void test_signed_every_pattern_keeps_its_bits(void)
{
    for (int32_t value = -32768; value <= 32767; value++) {
        const uint16_t bits = (uint16_t)((uint32_t)value & 0xFFFFu);

        TEST_ASSERT_EQUAL_INT16(value, FIXPID_SIGNED(bits));
    }
    for (int16_t value = -128; value <= 127; value++) {
        const uint8_t bits = (uint8_t)((uint16_t)value & 0xFFu);

        TEST_ASSERT_EQUAL_INT8(value, FIXPID_SIGNED_BYTE(bits));
    }
}

void test_says_so_zero_and_odd_flags(void)
{
    const uint8_t flags[] = {0, 1, 0xFF};

    TEST_ASSERT_FALSE(FIXPID_SAYS_SO(flags[0]));
    TEST_ASSERT_TRUE(FIXPID_SAYS_SO(flags[1]));
    TEST_ASSERT_TRUE(FIXPID_SAYS_SO(flags[2]));
}
