// SPDX-License-Identifier: MIT
// The numbers of 16 significant bits, against arithmetic in 64 bits, and the
// constants among them.
#include "unity.h"

// By another name, or the test's runner would include it and use nothing of it.
#define UNDER_TEST "autotune/fixpid_autotune_constants.h"
#include UNDER_TEST

#define MANTISSAS 12

// With few bits and many, at both ends and between them.
static const uint16_t mantissas[MANTISSAS] = {0,      32768u, 32769u, 32770u,
                                              40000u, 43690u, 43691u, 49152u,
                                              54886u, 65533u, 65534u, 65535u};

static struct number16 result;

void setUp(void)
{
}

void tearDown(void)
{
}

static struct number16 number(uint8_t which, int16_t exponent)
{
    const uint16_t mantissa = mantissas[which];

    return (struct number16){mantissa,
                             (int8_t)(mantissa == 0 ? NOTHING : exponent)};
}

// The result is value * 2^exponent, of which it has the upper 16 bits.
static void is(uint64_t value, int16_t exponent)
{
    if (value == 0) {
        TEST_ASSERT_EQUAL_UINT16(0, result.mantissa);
        TEST_ASSERT_EQUAL_INT16(NOTHING, result.exponent);
        return;
    }
    while (value > 0xFFFFu) {
        value /= 2u;
        exponent++;
    }
    while (value < 0x8000u) {
        value *= 2u;
        exponent--;
    }
    TEST_ASSERT_EQUAL_UINT16(value, result.mantissa);
    TEST_ASSERT_EQUAL_INT16(exponent, result.exponent);
}

void test_make_keeps_the_upper_16_bits(void)
{
    static const uint32_t values[] = {
        0,     1,     2,      3,      32767,      32768,      32769,     65535,
        65536, 65537, 131071, 131072, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};

    for (unsigned i = 0; i < sizeof values / sizeof values[0]; i++) {
        for (int16_t exponent = -100; exponent <= 100; exponent += 25) {
            make(&result, values[i], exponent);
            is(values[i], exponent);
        }
    }
}

// b is larger than a by so many powers of 2 and less.
static void crossed(void (*check)(struct number16 a, struct number16 b))
{
    static const int16_t exponents[] = {0,  1,  2,  14, 15, 16,  17,  30,
                                        31, 32, 33, 50, -1, -15, -31, -32};

    for (uint8_t a = 0; a < MANTISSAS; a++) {
        for (uint8_t b = 0; b < MANTISSAS; b++) {
            for (uint8_t i = 0; i < sizeof exponents / sizeof exponents[0];
                 i++) {
                check(number(a, 5), number(b, (int16_t)(5 + exponents[i])));
            }
        }
    }
}

static void check_product(struct number16 a, struct number16 b)
{
    result = a;
    multiply(&result, &b);
    is((uint64_t)a.mantissa * b.mantissa, (int16_t)(a.exponent + b.exponent));
}

void test_multiply_is_the_product_cut_off(void)
{
    crossed(check_product);
}

static void check_quotient(struct number16 a, struct number16 b)
{
    if (b.mantissa != 0) {
        result = a;
        divide(&result, &b);
        is(((uint64_t)a.mantissa << 40) / b.mantissa,
           (int16_t)(a.exponent - b.exponent - 40));
    }
}

void test_divide_is_the_quotient_cut_off(void)
{
    crossed(check_quotient);
}

void test_divide_by_zero_is_zero(void)
{
    struct number16 nothing;

    make(&result, 1, 5);
    make(&nothing, 0, 0);
    divide(&result, &nothing);
    is(0, 0);
}

// In units of 2^(exponent - 15), where the lower number may lose bits.
static uint64_t units(struct number16 a, int16_t exponent)
{
    const int16_t places = (int16_t)(exponent - a.exponent);

    if (a.mantissa == 0 || places > 40) {
        return 0;
    }
    return ((uint64_t)a.mantissa << 15) >> places;
}

static int16_t upper(struct number16 a, struct number16 b)
{
    return a.exponent > b.exponent ? a.exponent : b.exponent;
}

static void check_sum(struct number16 a, struct number16 b)
{
    const int16_t exponent = upper(a, b);

    result = a;
    add(&result, &b);
    is(units(a, exponent) + units(b, exponent), (int16_t)(exponent - 15));
}

void test_add_has_15_bits_more_on_the_way(void)
{
    crossed(check_sum);
}

static void check_difference(struct number16 a, struct number16 b)
{
    const int16_t exponent = upper(a, b);
    const uint64_t minuend = units(a, exponent);
    const uint64_t subtrahend = units(b, exponent);

    result = a;
    subtract(&result, &b);
    if (minuend <= subtrahend) {
        is(0, 0);
    } else {
        is(minuend - subtrahend, (int16_t)(exponent - 15));
    }
    TEST_ASSERT_EQUAL(minuend > subtrahend, greater(&a, &b));
}

void test_subtract_is_0_unless_the_first_one_is_greater(void)
{
    crossed(check_difference);
}

void test_integer_is_the_nearest_one_half_up(void)
{
    for (uint8_t which = 0; which < MANTISSAS; which++) {
        for (int16_t places = -40; places <= 30; places++) {
            for (int8_t fraction = -8; fraction <= 24; fraction += 16) {
                const struct number16 a =
                    number(which, (int16_t)(places - fraction));
                uint64_t expected = (uint64_t)a.mantissa << 30;

                if (places < 0) {
                    expected >>= -places;
                    expected = (expected + (UINT64_C(1) << 29)) >> 30;
                } else {
                    expected = places > 15 ? UINT32_MAX
                                           : (uint64_t)a.mantissa << places;
                }
                if (a.mantissa == 0) {
                    expected = 0;
                }
                TEST_ASSERT_EQUAL_UINT32(expected, integer(&a, fraction));
            }
        }
    }
}

void test_flash_is_read_like_any_memory(void)
{
    static const uint8_t bytes[2] FIXPID_AUTOTUNE_FLASH = {1, 254};
    static const uint16_t words[2] FIXPID_AUTOTUNE_FLASH = {1, 65534u};

    TEST_ASSERT_EQUAL_UINT8(1, flash_byte(&bytes[0]));
    TEST_ASSERT_EQUAL_UINT8(254, flash_byte(&bytes[1]));
    TEST_ASSERT_EQUAL_UINT16(1, flash_word(&words[0]));
    TEST_ASSERT_EQUAL_UINT16(65534u, flash_word(&words[1]));
}

// Some have more digits than their names: the regression gave them.
void test_constants_have_these_mantissas_and_exponents(void)
{
    static const struct {
        uint8_t which;
        uint16_t mantissa;
        int8_t exponent;
    } rows[] = {{ONE, 32768u, -15},       {TWO, 32768u, -14},
                {FOUR, 32768u, -13},      {HALF, 32768u, -16},
                {QUARTER, 32768u, -17},   {C1_32ND, 32768u, -20},
                {C1_256TH, 32768u, -23},  {C15_16THS, 61440u, -16},
                {C63_64THS, 64512u, -16}, {C0_03, 62915u, -21},
                {C0_05, 52429u, -20},     {C0_06, 62915u, -20},
                {C0_1, 52429u, -19},      {C0_12, 62915u, -19},
                {C0_2, 52429u, -18},      {C0_216, 56623u, -18},
                {C0_3, 39322u, -17},      {C0_31, 40632u, -17},
                {C0_4, 52429u, -17},      {C0_45, 58982u, -17},
                {C0_46, 60293u, -17},     {C0_47, 61604u, -17},
                {C0_53, 34734u, -16},     {C0_6, 39322u, -16},
                {C0_64, 41943u, -16},     {C0_75, 49152u, -16},
                {C0_8, 52429u, -16},      {C0_808, 52953u, -16},
                {C0_875, 57344u, -16},    {C0_9, 58982u, -16},
                {C1_03, 33751u, -15},     {C1_1, 36045u, -15},
                {C1_16, 38011u, -15},     {C1_188, 38935u, -15},
                {C1_193, 39086u, -15},    {C1_2, 39322u, -15},
                {C1_5, 49152u, -15},      {C2_068, 33882u, -14},
                {C2_272, 37224u, -14},    {C2_828, 46334u, -14},
                {C3_204, 52494u, -14},    {C4_382, 35898u, -13},
                {C4_608, 37748u, -13},    {C4_627, 37905u, -13},
                {C5_285, 43295u, -13},    {C5_488, 44957u, -13},
                {C6, 49152u, -13},        {C6_815, 55829u, -13},
                {C9_462, 38757u, -12},    {C10, 40960u, -12},
                {C11_667, 47790u, -12},   {C11_75, 48128u, -12},
                {C22_4, 45875u, -11},     {C26_16, 53576u, -11},
                {C28_086, 57520u, -11},   {C45_48, 46572u, -10},
                {C64, 32768u, -9}};

    TEST_ASSERT_EQUAL_UINT(sizeof constants / sizeof constants[0],
                           sizeof rows / sizeof rows[0]);
    for (unsigned i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct number16 *const constant =
            &constants[rows[i].which - CONSTANT];

        TEST_ASSERT_EQUAL_UINT(CONSTANT + i, rows[i].which);
        TEST_ASSERT_EQUAL_UINT16(rows[i].mantissa,
                                 flash_word(&constant->mantissa));
        TEST_ASSERT_EQUAL_INT8(
            rows[i].exponent,
            (int8_t)flash_byte((const uint8_t *)&constant->exponent));
    }
}
