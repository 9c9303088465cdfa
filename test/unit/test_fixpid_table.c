// SPDX-License-Identifier: MIT
#include "fixpid_table.h"
#include "numbers.h"
#include "numbers_control.h"
#include "reference_control.h"
#include "table_in_flash.h"
#include "unity.h"
#include "vectors.h"
#include "vectors_columns.h"

TEST_SOURCE_FILE("test/support/numbers_table.c")
TEST_SOURCE_FILE("src/table/fixpid_table.c")
TEST_SOURCE_FILE("src/table/fixpid_table_avr.c")
TEST_SOURCE_FILE("test/support/reference.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 1000000
#endif
#ifndef TEST_STRIDE
#define TEST_STRIDE 1 // 1 takes every x
#endif

#define ROWS 800
#define MOST 255u

static struct fixpid_table_point points[MOST + 1u];
static struct fixpid_table table;

void setUp(void)
{
    table.points = points;
    table.count = 0;
}

void tearDown(void)
{
}

static void add(int16_t x, int16_t y)
{
    points[table.count].x = x;
    points[table.count].y = y;
    table.count++;
}

static int16_t at(int16_t x)
{
    return fixpid_table_at(&table, x);
}

static void every_x_is_as_defined(void)
{
    TEST_ASSERT_TRUE(fixpid_table_valid(&table));
    for (int32_t x = INT16_MIN; x <= INT16_MAX; x += TEST_STRIDE) {
        TEST_ASSERT_EQUAL_INT16(reference_table_at(&table, x), at((int16_t)x));
    }
    TEST_ASSERT_EQUAL_INT16(reference_table_at(&table, INT16_MAX),
                            at(INT16_MAX));
}

void test_at_is_each_recorded_row(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    int32_t last = 0;
    unsigned rows = 0;

    VECTORS_OPEN(table);
    while (vectors_next(row)) {
        rows++;
        if (row[TABLE_TABLE] != last) {
            last = row[TABLE_TABLE];
            table.count = 0;
        }
        if (row[TABLE_KIND] == TABLE_POINT) {
            add((int16_t)row[TABLE_X], (int16_t)row[TABLE_Y]);
        } else if (row[TABLE_KIND] == TABLE_VERDICT) {
            TEST_ASSERT_EQUAL_INT32(row[TABLE_X], table.count);
            TEST_ASSERT_EQUAL_INT32(row[TABLE_Y], fixpid_table_valid(&table));
        } else {
            TEST_ASSERT_EQUAL_INT32(TABLE_LOOKUP, row[TABLE_KIND]);
            TEST_ASSERT_EQUAL_INT32(row[TABLE_Y], at((int16_t)row[TABLE_X]));
        }
    }
    TEST_ASSERT_EQUAL_UINT(ROWS, rows);
}

void test_at_rising_over_everything_is_x(void)
{
    add(INT16_MIN, INT16_MIN);
    add(INT16_MAX, INT16_MAX);
    for (int32_t x = INT16_MIN; x <= INT16_MAX; x += TEST_STRIDE) {
        TEST_ASSERT_EQUAL_INT16(x, at((int16_t)x));
    }
}

void test_at_falling_over_everything_is_its_mirror_image(void)
{
    add(INT16_MIN, INT16_MAX);
    add(INT16_MAX, INT16_MIN);
    for (int32_t x = INT16_MIN; x <= INT16_MAX; x += TEST_STRIDE) {
        TEST_ASSERT_EQUAL_INT16(-1 - x, at((int16_t)x));
    }
}

void test_at_half_goes_up_whichever_way_the_line_is_written(void)
{
    add(0, 0);
    add(2, 1);
    TEST_ASSERT_EQUAL_INT16(1, at(1));
    points[1].y = -1;
    TEST_ASSERT_EQUAL_INT16(0, at(1));
    points[0].y = -1;
    points[1].y = 0;
    TEST_ASSERT_EQUAL_INT16(0, at(1));
}

void test_at_odd_run_goes_to_the_nearest(void)
{
    add(0, 0);
    add(3, -1);
    TEST_ASSERT_EQUAL_INT16(0, at(1));
    TEST_ASSERT_EQUAL_INT16(-1, at(2));
}

void test_at_longest_run_and_least_rise_turns_in_the_middle(void)
{
    add(INT16_MIN, 0);
    add(INT16_MAX, 1);
    TEST_ASSERT_EQUAL_INT16(0, at(INT16_MIN));
    TEST_ASSERT_EQUAL_INT16(0, at(-1));
    TEST_ASSERT_EQUAL_INT16(1, at(0));
    TEST_ASSERT_EQUAL_INT16(1, at(INT16_MAX));
}

void test_at_jump_is_two_points_one_apart(void)
{
    add(5, 7);
    add(6, -7);
    TEST_ASSERT_EQUAL_INT16(7, at(4));
    TEST_ASSERT_EQUAL_INT16(7, at(5));
    TEST_ASSERT_EQUAL_INT16(-7, at(6));
    TEST_ASSERT_EQUAL_INT16(-7, at(7));
}

void test_at_no_points_is_0(void)
{
    table.points = 0;
    TEST_ASSERT_EQUAL_INT16(0, at(INT16_MIN));
    TEST_ASSERT_EQUAL_INT16(0, at(0));
}

void test_at_one_point_is_a_constant_which_is_not_valid(void)
{
    add(9, -3);
    TEST_ASSERT_FALSE(fixpid_table_valid(&table));
    TEST_ASSERT_EQUAL_INT16(-3, at(INT16_MIN));
    TEST_ASSERT_EQUAL_INT16(-3, at(8));
    TEST_ASSERT_EQUAL_INT16(-3, at(9));
    TEST_ASSERT_EQUAL_INT16(-3, at(10));
    TEST_ASSERT_EQUAL_INT16(-3, at(INT16_MAX));
}

void test_at_each_point_is_its_y_and_beyond_both_ends_theirs(void)
{
    for (uint8_t i = 0; i < MOST; i++) {
        add((int16_t)(i * 250L - 32000L), (int16_t)(i * 16381u));
    }
    for (uint8_t i = 0; i < MOST; i++) {
        TEST_ASSERT_EQUAL_INT16(points[i].y, at(points[i].x));
    }
    TEST_ASSERT_EQUAL_INT16(points[0].y, at(INT16_MIN));
    TEST_ASSERT_EQUAL_INT16(points[MOST - 1u].y, at(INT16_MAX));
}

void test_at_255_points_every_x(void)
{
    for (uint8_t i = 0; i < MOST; i++) {
        add((int16_t)(i * 257L - 32768L), (int16_t)(i * 16381u));
    }
    points[MOST - 1u].x = INT16_MAX;
    every_x_is_as_defined();
}

void test_at_every_count_finds_the_neighbours(void)
{
    for (uint8_t i = 0; i < MOST; i++) {
        add((int16_t)(i * 3), (int16_t)(i % 2u == 0u ? i * 3 : -i));
        for (int16_t x = -1; x <= (int16_t)(i * 3 + 1); x += TEST_STRIDE) {
            TEST_ASSERT_EQUAL_INT16(reference_table_at(&table, x), at(x));
        }
    }
}

void test_at_an_ntc_every_x(void)
{
    add(20, 14848);
    add(30, 13082);
    add(120, 7001);
    add(500, 2511);
    add(900, -1307);
    add(1003, -3210);
    every_x_is_as_defined();
}

void test_at_neighbours_and_a_plateau_every_x(void)
{
    add(-32767, INT16_MAX);
    add(-1, INT16_MIN);
    add(0, INT16_MAX);
    add(1, 0);
    add(20000, 0);
    add(32766, -1);
    every_x_is_as_defined();
}

void test_at_between_two_points_it_moves_in_one_direction(void)
{
    int16_t last;

    add(-300, 1000);
    add(700, -31000);
    last = at(-300);
    for (int16_t x = -299; x <= 700; x++) {
        TEST_ASSERT_TRUE(at(x) <= last);
        last = at(x);
    }
    TEST_ASSERT_EQUAL_INT16(-31000, last);
}

void test_at_strictly_rising_table_swapped_is_its_inverse(void)
{
    static const struct fixpid_table_point swapped[] = {
        {-500, -100}, {0, 0}, {3000, 200}, {4000, 900}};
    static const struct fixpid_table inverse = FIXPID_TABLE(swapped);

    for (uint8_t i = 0; i < inverse.count; i++) {
        add(swapped[i].y, swapped[i].x);
    }
    for (int16_t x = -100; x <= 900; x++) { // steeper than 1 everywhere
        TEST_ASSERT_EQUAL_INT16(x, fixpid_table_at(&inverse, at(x)));
    }
}

void test_at_random_tables_are_as_defined(void)
{
    numbers_seed(2026);
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS; i++) {
        int16_t x;

        if (i % 20u == 0u) {
            table.count = numbers_table_points(points, MOST);
            TEST_ASSERT_EQUAL(reference_table_valid(&table),
                              fixpid_table_valid(&table));
        }
        x = numbers_table_x(points, table.count);
        if (table.count < 2u || reference_table_valid(&table)) {
            TEST_ASSERT_EQUAL_INT16(reference_table_at(&table, x), at(x));
        }
    }
}

static bool is_between_neighbours(int16_t y)
{
    for (uint8_t i = 1; i < table.count; i++) {
        const int16_t a = points[i - 1u].y;
        const int16_t b = points[i].y;

        if ((a <= y && y <= b) || (b <= y && y <= a)) {
            return true;
        }
    }
    return false;
}

void test_at_points_in_any_order_is_between_two_neighbours(void)
{
    numbers_seed(7);
    for (uint32_t i = 0; i < TEST_RANDOM_STEPS / 10u; i++) {
        setUp();
        while (table.count < 6u) {
            add((int16_t)numbers_below(8), numbers_int16());
        }
        TEST_ASSERT_TRUE(is_between_neighbours(at((int16_t)numbers_below(9))));
    }
}

void test_at_same_x_twice_divides_by_nothing(void)
{
    add(3, 1);
    add(3, 2);
    TEST_ASSERT_FALSE(fixpid_table_valid(&table));
    TEST_ASSERT_EQUAL_INT16(1, at(3));
    TEST_ASSERT_EQUAL_INT16(2, at(4));
}

void test_valid_from_two_points_on(void)
{
    TEST_ASSERT_FALSE(fixpid_table_valid(&table));
    add(0, 5);
    TEST_ASSERT_FALSE(fixpid_table_valid(&table));
    add(1, 5);
    TEST_ASSERT_TRUE(fixpid_table_valid(&table));
}

void test_valid_each_x_is_above_the_one_before(void)
{
    for (uint8_t i = 0; i < MOST; i++) {
        add((int16_t)(i - 100), 0);
    }
    TEST_ASSERT_TRUE(fixpid_table_valid(&table));
    for (uint8_t i = 1; i < MOST; i++) {
        const int16_t x = points[i].x;

        points[i].x = points[i - 1u].x;
        TEST_ASSERT_FALSE(fixpid_table_valid(&table));
        points[i].x = x;
    }
    TEST_ASSERT_TRUE(fixpid_table_valid(&table));
    points[0].x = INT16_MAX;
    TEST_ASSERT_FALSE(fixpid_table_valid(&table));
}

static const struct fixpid_table_point pair[] PROGMEM = {
    {INT16_MIN, INT16_MAX}, {INT16_MAX, INT16_MIN}};
static const struct fixpid_table_point several[] PROGMEM = {
    {-7, 32000}, {0, 0}, {1, -1}, {30000, 12345}, {30002, 12346}};
static const struct fixpid_table_point wrong[] PROGMEM = {{1, 2}, {1, 3}};

void test_at_P_points_in_flash_every_x(void)
{
    static const struct fixpid_table down = FIXPID_TABLE(pair);

    TEST_ASSERT_EQUAL_UINT8(2, down.count);
    for (int32_t x = INT16_MIN; x <= INT16_MAX; x += TEST_STRIDE) {
        TEST_ASSERT_EQUAL_INT16(-1 - x, fixpid_table_at_P(&down, (int16_t)x));
    }
}

void test_at_P_points_in_flash_are_those_in_memory(void)
{
    static const struct fixpid_table in_flash = FIXPID_TABLE(several);

    add(-7, 32000);
    add(0, 0);
    add(1, -1);
    add(30000, 12345);
    add(30002, 12346);
    TEST_ASSERT_EQUAL_UINT8(5, in_flash.count);
    for (int32_t x = -10; x <= INT16_MAX; x += TEST_STRIDE) {
        TEST_ASSERT_EQUAL_INT16(at((int16_t)x),
                                fixpid_table_at_P(&in_flash, (int16_t)x));
    }
    TEST_ASSERT_EQUAL_INT16(12346, fixpid_table_at_P(&in_flash, 30001));
}

void test_valid_P_asks_the_points_in_flash(void)
{
    static const struct fixpid_table good = FIXPID_TABLE(several);
    static const struct fixpid_table bad = FIXPID_TABLE(wrong);

    TEST_ASSERT_TRUE(fixpid_table_valid_P(&good));
    TEST_ASSERT_FALSE(fixpid_table_valid_P(&bad));
}

void test_at_split_range_has_its_gap(void)
{
    static const struct fixpid_table_point heat_points[] = {
        {0, 0}, {50, 0}, {1000, 1000}};
    static const struct fixpid_table_point cool_points[] = {
        {-1000, 1000}, {-50, 0}, {0, 0}};
    static const struct fixpid_table heat = FIXPID_TABLE(heat_points);
    static const struct fixpid_table cool = FIXPID_TABLE(cool_points);

    for (int16_t u = -50; u <= 50; u++) {
        TEST_ASSERT_EQUAL_INT16(0, fixpid_table_at(&heat, u));
        TEST_ASSERT_EQUAL_INT16(0, fixpid_table_at(&cool, u));
    }
    TEST_ASSERT_EQUAL_INT16(1, fixpid_table_at(&heat, 51));
    TEST_ASSERT_EQUAL_INT16(0, fixpid_table_at(&cool, 51));
    TEST_ASSERT_EQUAL_INT16(1, fixpid_table_at(&cool, -51));
    TEST_ASSERT_EQUAL_INT16(1000, fixpid_table_at(&cool, INT16_MIN));
}
