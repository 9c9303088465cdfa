// SPDX-License-Identifier: MIT
#include <string.h>

#include "fixpid_autotune.h"
#include "numbers.h"
#include "poison.h"
#include "unity.h"

TEST_SOURCE_FILE("src/autotune/fixpid_autotune.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_cycle.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_more.c")

#define REST 77
#define NOISE_STEPS 34

FIXPID_DATA struct fixpid_autotune autotune_controller;
static struct fixpid_autotune_config config;
static int16_t sign; // of the deviations that the tests give: -1 is reverse
static int16_t inside_high, inside_low; // deviations within a half

static bool init(void)
{
    return fixpid_autotune_init(&autotune_controller, &config);
}

static int16_t step(int16_t deviation)
{
    return fixpid_autotune_step(&autotune_controller, 0,
                                (int16_t)(sign * deviation));
}

static void steps(uint16_t count, int16_t deviation)
{
    while (count != 0) {
        step(deviation);
        count--;
    }
}

static uint8_t status(void)
{
    return fixpid_autotune_status(&autotune_controller);
}

static void is(uint8_t expected)
{
    TEST_ASSERT_EQUAL_UINT8(expected, status());
}

static void is_over(uint8_t with)
{
    is(with);
    TEST_ASSERT_EQUAL_INT16(config.output_rest, step(0));
    TEST_ASSERT_EQUAL_INT16(config.output_rest, step(INT16_MAX));
    TEST_ASSERT_EQUAL_INT16(config.output_rest, step(-INT16_MAX));
    is(with);
}

// The relay is high for `high` steps, of which the last measures `top`, and low
// for `low` steps down to `bottom`. Returns the output after it.
static int16_t cycle(uint16_t high, uint16_t low, int16_t top, int16_t bottom)
{
    steps((uint16_t)(high - 1u), inside_high);
    step(top);
    steps((uint16_t)(low - 1u), inside_low);
    return step(bottom);
}

// One cycle of 20 steps each.
static int16_t usual(void)
{
    return cycle(20, 20, 50, -50);
}

// The first 34 steps: no noise, and then the relay is high.
static void quiet(void)
{
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS, 0);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(0); // the first one of the first half counts for no cycle
}

// Up to the first cycle of the first relay, from which on the sums count. With
// the usual configuration the outputs are -49 and 98, then -98 and 49.
static void begin(void)
{
    quiet();
    usual();
    usual();
    usual();
    usual();
    usual(); // of the first relay the first, which is never averaged
    is(FIXPID_AUTOTUNE_RUNNING);
}

void setUp(void)
{
    sign = 1;
    inside_high = 0;
    inside_low = 0;
    config = (struct fixpid_autotune_config){.output_min = -300,
                                             .output_max = 300,
                                             .output_rest = REST,
                                             .measurement_min = INT16_MIN,
                                             .measurement_max = INT16_MAX,
                                             .swing = 50,
                                             .timeout_steps = 1000,
                                             .cycles = 1,
                                             .options = 0};
}

void tearDown(void)
{
}

// --- init and reset ---

static void refused(void)
{
    TEST_ASSERT_FALSE(init());
    is(FIXPID_AUTOTUNE_REFUSED);
    TEST_ASSERT_EQUAL_INT16(0, step(100));
    TEST_ASSERT_EQUAL_INT16(0, step(INT16_MAX));
    is(FIXPID_AUTOTUNE_REFUSED);
    setUp();
}

static void accepted(void)
{
    TEST_ASSERT_TRUE(init());
    is(FIXPID_AUTOTUNE_RUNNING);
    TEST_ASSERT_EQUAL_INT16(config.output_rest, step(0));
    setUp();
}

void test_init_output_min_not_below_max_is_refused(void)
{
    config.output_min = 77;
    config.output_max = 77;
    refused();
    config.output_min = 78;
    config.output_max = 77;
    refused();
    config.output_min = 76;
    config.output_max = 77;
    accepted();
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    accepted();
}

void test_init_output_rest_outside_the_range_is_refused(void)
{
    config.output_rest = -301;
    refused();
    config.output_rest = -300;
    accepted();
    config.output_rest = 300;
    accepted();
    config.output_rest = 301;
    refused();
}

void test_init_measurement_min_not_below_max_is_refused(void)
{
    config.measurement_min = INT16_MAX;
    refused();
    config.measurement_min = 51;
    config.measurement_max = 50;
    refused();
    config.measurement_min = -1;
    config.measurement_max = 0;
    TEST_ASSERT_TRUE(init());
}

void test_init_swing_neither_0_nor_8_to_16383_is_refused(void)
{
    config.swing = 0;
    accepted();
    config.swing = 1;
    refused();
    config.swing = 7;
    refused();
    config.swing = 8;
    accepted();
    config.swing = 16383;
    accepted();
    config.swing = 16384;
    refused();
    config.swing = UINT16_MAX;
    refused();
}

void test_init_timeout_outside_2_to_32767_is_refused(void)
{
    config.timeout_steps = 0;
    refused();
    config.timeout_steps = 1;
    refused();
    config.timeout_steps = 2;
    accepted();
    config.timeout_steps = 32767;
    accepted();
    config.timeout_steps = 32768u;
    refused();
}

void test_init_cycles_outside_1_to_4_are_refused(void)
{
    config.cycles = 0;
    refused();
    config.cycles = 1;
    accepted();
    config.cycles = 4;
    accepted();
    config.cycles = 5;
    refused();
    config.cycles = UINT8_MAX;
    refused();
}

void test_init_options_but_reverse_are_refused(void)
{
    for (unsigned options = 0; options <= UINT8_MAX; options++) {
        config.options = (uint8_t)options;
        if (options == 0 || options == FIXPID_AUTOTUNE_REVERSE) {
            accepted();
        } else {
            refused();
        }
    }
}

static void nothing_is_known(void)
{
    struct fixpid_autotune_process model;
    struct fixpid_autotune_process model_before;
    struct fixpid_pid_config pid;
    struct fixpid_pid_config pid_before;

    memset(&model, 0xA5, sizeof model);
    memset(&pid, 0xA5, sizeof pid);
    memcpy(&model_before, &model, sizeof model);
    memcpy(&pid_before, &pid, sizeof pid);
    TEST_ASSERT_FALSE(fixpid_autotune_model(&autotune_controller, &model));
    for (uint8_t rule = 0; rule <= 7; rule++) {
        TEST_ASSERT_FALSE(
            fixpid_autotune_result(&autotune_controller, rule, 16, &pid));
    }
    TEST_ASSERT_EQUAL_MEMORY(&model_before, &model, sizeof model);
    TEST_ASSERT_EQUAL_MEMORY(&pid_before, &pid, sizeof pid);
}

void test_init_refused_stays_refused_until_a_good_init(void)
{
    config.cycles = 0;
    TEST_ASSERT_FALSE(init());
    fixpid_autotune_reset(&autotune_controller);
    is(FIXPID_AUTOTUNE_REFUSED);
    TEST_ASSERT_EQUAL_INT16(0, step(100));
    nothing_is_known();
    config.cycles = 1;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(REST, step(100));
}

void test_an_all_zero_object_is_refused(void)
{
    static const struct fixpid_autotune zero; // like one at file scope

    autotune_controller = zero;
    is(FIXPID_AUTOTUNE_REFUSED);
    TEST_ASSERT_EQUAL_INT16(0, step(100));
    nothing_is_known();
    fixpid_autotune_reset(&autotune_controller);
    TEST_ASSERT_EQUAL_INT16(0, step(100));
    is(FIXPID_AUTOTUNE_REFUSED);
}

static void init_good(void)
{
    (void)fixpid_autotune_init(&autotune_controller, &config);
}

static void init_bad(void)
{
    struct fixpid_autotune_config bad = config;
    bad.cycles = 0;
    (void)fixpid_autotune_init(&autotune_controller, &bad);
}

void test_init_whatever_the_memory_held_sets_every_member(void)
{
    // The two sums have theirs, too.
    const unsigned padding =
        (unsigned)POISON_PADDING(struct fixpid_autotune, averaged) +
        2u * ((unsigned)sizeof(struct fixpid_autotune_sums) - 14u);

    TEST_ASSERT_EQUAL_UINT(padding,
                           poison_left(&autotune_controller,
                                       sizeof(autotune_controller), init_good));
    TEST_ASSERT_EQUAL_UINT(padding,
                           poison_left(&autotune_controller,
                                       sizeof(autotune_controller), init_bad));
}

// Whatever was before, the same experiment follows.
void test_reset_forgets_everything_but_the_configuration(void)
{
    begin();
    usual();
    fixpid_autotune_reset(&autotune_controller);
    is(FIXPID_AUTOTUNE_RUNNING);
    for (unsigned i = 0; i < NOISE_STEPS - 1u; i++) {
        TEST_ASSERT_EQUAL_INT16(REST, step(0));
    }
    TEST_ASSERT_EQUAL_INT16(300, step(0));
    step(0);
    for (unsigned i = 0; i < 10; i++) {
        is(FIXPID_AUTOTUNE_RUNNING);
        usual();
    }
    is_over(FIXPID_AUTOTUNE_DONE);
}

// --- the noise ---

// Where the relay switches after the steps so far, one or more on each side.
static void switches_beyond(int16_t hysteresis)
{
    step(-hysteresis);
    TEST_ASSERT_EQUAL_INT16(300, step(hysteresis));
    TEST_ASSERT_EQUAL_INT16(-300, step((int16_t)(hysteresis + 1)));
    TEST_ASSERT_EQUAL_INT16(-300, step((int16_t)-hysteresis));
    TEST_ASSERT_EQUAL_INT16(300, step((int16_t)(-hysteresis - 1)));
}

void test_step_without_noise_the_hysteresis_is_1(void)
{
    TEST_ASSERT_TRUE(init());
    for (unsigned i = 0; i < NOISE_STEPS - 1u; i++) {
        TEST_ASSERT_EQUAL_INT16(REST, step(-300));
    }
    TEST_ASSERT_EQUAL_INT16(300, step(-300));
    switches_beyond(1);
}

void test_step_a_slope_is_no_noise(void)
{
    TEST_ASSERT_TRUE(init());
    for (int16_t i = 0; i < NOISE_STEPS; i++) {
        step((int16_t)(16500 - 500 * i)); // the last is 0
    }
    switches_beyond(1);
}

// 1 + (10 + 5 + 16) / 32 = 1, 1 + (11 + 5 + 16) / 32 = 2
void test_step_the_hysteresis_is_3_deviations_of_the_noise_and_1(void)
{
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS - 1, 0);
    step(-10);
    switches_beyond(1);
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS - 1, 0);
    step(-11);
    switches_beyond(2);
}

// The second differences are 4000, of which 1023 count: with 32 * 1023 = 32736
// it is 1 + (32736 + 16368 + 16) / 32 = 1536.
void test_step_the_hysteresis_is_at_most_1536(void)
{
    TEST_ASSERT_TRUE(init());
    for (unsigned i = 0; i < NOISE_STEPS; i++) {
        step(i % 2u == 0u ? 1000 : -1000);
    }
    switches_beyond(1536);
    TEST_ASSERT_TRUE(init());
    for (unsigned i = 0; i < NOISE_STEPS; i++) { // one beyond 1023 each
        step(i % 2u == 0u ? 256 : -256);
    }
    switches_beyond(1536);
}

// 1 + (1022 + 511 + 16) / 32 = 49 of one second difference of 1022, and more
// does not count for more than 1023: 1 + (1023 + 511 + 16) / 32 = 49.
void test_step_a_second_difference_counts_1023_at_most(void)
{
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS - 1, 0);
    step(-1022);
    switches_beyond(49);
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS - 1, 0);
    step(-9000);
    switches_beyond(49);
}

void test_step_the_last_deviation_decides_the_first_side(void)
{
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS - 1, 0);
    TEST_ASSERT_EQUAL_INT16(300, step(0));
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS - 1, 0);
    TEST_ASSERT_EQUAL_INT16(-300, step(1));
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS - 1, 0);
    TEST_ASSERT_EQUAL_INT16(300, step(-1));
}

// The difference has 17 bits; what is beyond 32767 counts as that.
void test_step_setpoint_and_measurement_may_be_anything(void)
{
    static const struct {
        int16_t setpoint, measurement, output;
    } rows[] = {{INT16_MIN, INT16_MAX - 1, -300},
                {INT16_MAX, -INT16_MAX, 300},
                {INT16_MIN, 0, -300},
                {INT16_MAX, -1, 300},
                {INT16_MIN, -1, -300},
                {INT16_MAX, 0, 300},
                {32000, 31999, 300},
                {-32000, -31999, -300}};

    for (unsigned i = 0; i < 2u * sizeof rows / sizeof rows[0]; i++) {
        setUp();
        config.options = (uint8_t)(i % 2u == 0u ? 0 : FIXPID_AUTOTUNE_REVERSE);
        TEST_ASSERT_TRUE(init());
        steps(NOISE_STEPS - 1, 0);
        TEST_ASSERT_EQUAL_INT16(
            i % 2u == 0u ? rows[i / 2u].output : -rows[i / 2u].output,
            fixpid_autotune_step(&autotune_controller, rows[i / 2u].setpoint,
                                 rows[i / 2u].measurement));
    }
}

// --- the relays ---

// A usual cycle whose outputs are known; `next` is the one after it.
static void drives(int16_t low, int16_t next)
{
    steps(19, 0);
    TEST_ASSERT_EQUAL_INT16(low, step(50));
    steps(19, 0);
    TEST_ASSERT_EQUAL_INT16(next, step(-50));
}

// The swing of 100 counts about the setpoint is twice the one wanted, so that
// 300 counts of output are left of 600, and 148 of 296; a third is 99, and 49.
void test_step_each_phase_has_its_relay(void)
{
    quiet();
    drives(-300, 300);
    drives(-300, 148);
    drives(-148, 148);
    drives(-148, 98);
    drives(-49, 98);
    drives(-49, 49);
    drives(-98, 49);
    drives(-98, 98);
    drives(-49, 98);
    drives(-49, REST);
    is_over(FIXPID_AUTOTUNE_DONE);
}

void test_step_each_relay_is_averaged_over_as_many_cycles_as_asked_for(void)
{
    config.cycles = 3;
    begin();
    drives(-49, 98);
    drives(-49, 98);
    drives(-49, 49);
    drives(-98, 49);
    drives(-98, 49);
    drives(-98, 49);
    drives(-98, 98);
    drives(-49, 98);
    drives(-49, 98);
    drives(-49, 98);
    drives(-49, REST);
    is_over(FIXPID_AUTOTUNE_DONE);
}

// The outputs of the second relay after a first one of so much swing.
static void centres(int16_t top, int16_t bottom, int16_t low, int16_t high)
{
    quiet();
    cycle(20, 20, top, bottom);
    TEST_ASSERT_EQUAL_INT16(high, cycle(20, 20, top, bottom));
    TEST_ASSERT_EQUAL_INT16(low, step(top));
}

// A quarter of the swing below: -300 + 150, and 99 + 49 on each side.
void test_step_the_setpoint_cuts_the_swing_like_the_relay(void)
{
    centres(75, -25, -298, -2);
    centres(25, -75, 2, 298);
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    centres(50, -50, -16318, 16318);
}

// 257 counts at 127 / 256 are 127.496, 1 / 256 below a half.
void test_step_the_centre_is_to_the_nearest(void)
{
    config.output_min = -128;
    config.output_max = 129;
    config.swing = 128;
    centres(129, -127, -64, 62);
}

// 24 of 100 counts are 61 / 256: 142 of 600, of which a third is 47.
void test_step_without_a_wanted_swing_it_is_24_times_the_hysteresis(void)
{
    config.swing = 0;
    centres(50, -50, -70, 70);
}

// 800 is 8 times the swing; a third of the whole range is 199.
void test_step_a_relay_is_never_wider_than_the_range(void)
{
    config.swing = 800;
    centres(50, -50, -298, 298);
    config.swing = 100;
    centres(50, -50, -298, 298);
    config.swing = 16383;
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    centres(2, -2, -32638, 32638);
}

// The swing asked for takes 16384 * 2^12 * 192 / 256 counts, which with the 256
// are beyond 32 bits; a third of the whole range is 5440.
void test_step_a_relay_for_any_wanted_swing_is_not_wider_either(void)
{
    config.swing = 16383;
    config.output_min = -8192;
    config.output_max = 8192;
    centres(2, -2, -8160, 8160);
}

// 100 is 50 when halved, 129 / 256 of 99: of twice the relay of 596 counts 600,
// of which a third is 199. The swing is cut at 49, 126 / 256 of it: 293 above
// -298.
void test_step_a_wanted_swing_one_beyond_the_present_one_is_halved(void)
{
    config.swing = 100;
    quiet();
    usual();
    usual();
    cycle(20, 20, 50, -49);
    cycle(20, 20, 50, -49);
    TEST_ASSERT_EQUAL_INT16(-298 + 293 - 199, step(50));
}

// 101 is 50 when halved, half of the swing: the whole of 600 again. 99 of 100
// are 253 / 256: 592, of which a third is 196.
void test_step_a_wanted_swing_beyond_the_present_one_is_halved(void)
{
    config.swing = 101;
    centres(50, -50, -298, 298);
    config.swing = 99;
    centres(50, -50, -294, 294);
}

void test_step_a_swing_too_small_by_far_drives_2_counts(void)
{
    config.swing = 8;
    centres(1000, -1000, -3, 3);
}

// A relay of 24 counts on each side of 10, in the range of 0..100.
void test_step_a_relay_is_cut_off_at_the_end_of_the_range(void)
{
    config.output_min = 0;
    config.output_max = 100;
    config.output_rest = REST;
    quiet();
    cycle(20, 20, 90, -10);
    TEST_ASSERT_EQUAL_INT16(34, cycle(20, 20, 90, -10));
    TEST_ASSERT_EQUAL_INT16(0, step(50));
}

static void lose(void)
{
    steps(162, 0); // with the one that switched, 4 * 40 + 3
    is(FIXPID_AUTOTUNE_RUNNING);
}

// Four times the last period and 4 steps without a switch.
void test_step_a_swing_that_is_lost_is_looked_for_with_the_whole_range(void)
{
    begin();
    steps(162, 0);
    TEST_ASSERT_EQUAL_INT16(98, autotune_controller.output);
    TEST_ASSERT_EQUAL_INT16(300, step(0));
    drives(-300, 300); // counts for no relay
    drives(-300, 148);
    drives(-148, 148);
    drives(-148, 98);
    drives(-49, 98);
    drives(-49, 49);
    drives(-98, 49);
    drives(-98, 98);
    drives(-49, 98);
    drives(-49, REST);
    is_over(FIXPID_AUTOTUNE_DONE);
}

void test_step_a_swing_may_be_lost_from_the_second_relay_on(void)
{
    quiet();
    usual();
    steps(500, 0);
    TEST_ASSERT_EQUAL_INT16(300, step(0)); // the whole range anyhow
    quiet();
    usual();
    usual();
    TEST_ASSERT_EQUAL_INT16(148, autotune_controller.output);
    steps(162, 0);
    TEST_ASSERT_EQUAL_INT16(148, autotune_controller.output);
    TEST_ASSERT_EQUAL_INT16(300, step(0));
}

// The step that found it lost is the first one.
void test_step_a_swing_that_is_lost_has_timeout_steps_to_be_found(void)
{
    config.timeout_steps = 300;
    begin();
    lose();
    step(0);
    TEST_ASSERT_EQUAL_INT16(300, autotune_controller.output);
    steps(299, 0);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(0);
    is_over(FIXPID_AUTOTUNE_NO_OSCILLATION);
}

// Periods in steps: one of the first relay that is not averaged, and the next.
static bool alike(uint16_t before, uint16_t now)
{
    quiet();
    usual();
    usual();
    usual();
    usual();
    cycle(20, (uint16_t)(before - 20u), 50, -50);
    return cycle(20, (uint16_t)(now - 20u), 50, -50) == 49;
}

void test_step_cycles_are_alike_within_an_eighth_and_a_step(void)
{
    TEST_ASSERT_TRUE(alike(46, 40));
    TEST_ASSERT_FALSE(alike(47, 40));
    TEST_ASSERT_TRUE(alike(34, 40));
    TEST_ASSERT_FALSE(alike(33, 40));
    TEST_ASSERT_TRUE(alike(39, 45));
    TEST_ASSERT_FALSE(alike(38, 45));
    TEST_ASSERT_TRUE(alike(40, 40));
}

// A cycle unlike the one before may be the first of new ones.
void test_step_a_cycle_unlike_the_last_one_starts_the_average_again(void)
{
    config.cycles = 2;
    begin();
    usual();
    TEST_ASSERT_EQUAL_INT16(98, cycle(40, 40, 50, -50));
    TEST_ASSERT_EQUAL_INT16(98, cycle(40, 40, 50, -50));
    TEST_ASSERT_EQUAL_INT16(49, cycle(40, 40, 50, -50));
    TEST_ASSERT_EQUAL_INT16(49, cycle(40, 40, 50, -50));
    TEST_ASSERT_EQUAL_INT16(49, cycle(40, 40, 50, -50));
    TEST_ASSERT_EQUAL_INT16(49, cycle(20, 20, 50, -50));
    TEST_ASSERT_EQUAL_INT16(49, cycle(20, 20, 50, -50));
    TEST_ASSERT_EQUAL_INT16(98, cycle(20, 20, 50, -50));
}

// The first relay is high for 20 steps of 40; the third one for so many.
static bool same_load(uint16_t high)
{
    begin();
    usual();
    usual();
    usual();
    usual(); // of the third relay the first
    return cycle(high, (uint16_t)(40u - high), 50, -50) == REST;
}

void test_step_the_load_is_the_same_within_a_32nd_of_the_period(void)
{
    TEST_ASSERT_TRUE(same_load(22));
    is_over(FIXPID_AUTOTUNE_DONE);
    TEST_ASSERT_TRUE(same_load(18));
    TEST_ASSERT_FALSE(same_load(23));
    is(FIXPID_AUTOTUNE_RUNNING);
    TEST_ASSERT_FALSE(same_load(17));
}

// With 2 cycles of each, 2 and then 3 others: 2 * 20 and 3 * 2 steps off.
void test_step_the_load_is_compared_with_all_cycles_before(void)
{
    static const struct {
        uint16_t third, fourth;
        bool same;
    } rows[] = {{22, 22, true},  {22, 18, false}, {22, 19, true},
                {18, 22, false}, {20, 22, true},  {20, 23, false}};

    for (unsigned i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const uint16_t third = rows[i].third;
        const uint16_t fourth = rows[i].fourth;

        config.cycles = 2;
        begin();
        usual();
        usual();
        usual();
        usual();
        usual();
        usual(); // of the third relay the first
        TEST_ASSERT_EQUAL_INT16(98,
                                cycle(third, (uint16_t)(40u - third), 50, -50));
        TEST_ASSERT_EQUAL_INT16(
            rows[i].same ? REST : 98,
            cycle(fourth, (uint16_t)(40u - fourth), 50, -50));
    }
}

// From the cycle that was different, the relays are run again.
void test_step_another_load_starts_the_relays_again(void)
{
    TEST_ASSERT_FALSE(same_load(25));
    TEST_ASSERT_EQUAL_INT16(49, cycle(25, 15, 50, -50));
    usual();
    TEST_ASSERT_EQUAL_INT16(98, usual());
    usual();
    TEST_ASSERT_EQUAL_INT16(REST, cycle(25, 15, 50, -50));
    is_over(FIXPID_AUTOTUNE_DONE);
}

// --- how it ends ---

void test_step_timeout_steps_without_a_switch_end_it(void)
{
    config.timeout_steps = 100;
    quiet();
    steps(99, 0);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(50); // too late
    is_over(FIXPID_AUTOTUNE_NO_OSCILLATION);
    quiet();
    steps(98, 0);
    step(50); // low in time
    steps(99, 0);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(0);
    is_over(FIXPID_AUTOTUNE_NO_OSCILLATION);
}

void test_step_a_timeout_may_end_it_while_the_noise_is_measured(void)
{
    config.timeout_steps = 33;
    TEST_ASSERT_TRUE(init());
    steps(33, 0);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(0);
    is_over(FIXPID_AUTOTUNE_NO_OSCILLATION);
}

void test_step_a_measurement_at_its_limits_ends_it(void)
{
    config.measurement_min = -60;
    config.measurement_max = 70;
    TEST_ASSERT_TRUE(init());
    step(69);
    step(-59);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(70);
    is_over(FIXPID_AUTOTUNE_SATURATED);
    quiet();
    step(69);
    step(-59);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(-60);
    is_over(FIXPID_AUTOTUNE_SATURATED);
    quiet();
    step(INT16_MAX);
    is_over(FIXPID_AUTOTUNE_SATURATED);
}

void test_step_a_measurement_at_its_limits_says_more_than_a_timeout(void)
{
    config.timeout_steps = 10;
    TEST_ASSERT_TRUE(init());
    steps(10, 0);
    step(INT16_MAX);
    is_over(FIXPID_AUTOTUNE_SATURATED);
}

static void unlike_cycles(unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        const uint16_t half = (i % 2u == 0u) ? 40u : 20u;

        is(FIXPID_AUTOTUNE_RUNNING);
        cycle(half, half, 50, -50);
    }
}

void test_step_48_cycles_are_too_many(void)
{
    begin(); // 5 cycles
    unlike_cycles(43);
    is_over(FIXPID_AUTOTUNE_IRREGULAR);
}

void test_step_a_swing_that_is_lost_counts_as_8_cycles(void)
{
    begin();
    lose();
    step(0);
    unlike_cycles(35);
    is_over(FIXPID_AUTOTUNE_IRREGULAR);
}

// The halves of the first relay and the third, and of the second.
static uint8_t ending(uint16_t high, uint16_t low, uint16_t second_high,
                      uint16_t second_low)
{
    begin();
    cycle(high, low, 50, -50);
    cycle(high, low, 50, -50);
    cycle(second_high, second_low, 50, -50);
    cycle(second_high, second_low, 50, -50);
    cycle(high, low, 50, -50);
    cycle(high, low, 50, -50);
    return status();
}

void test_step_a_half_below_an_eighth_is_irregular(void)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_DONE, ending(5, 35, 20, 20));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_IRREGULAR, ending(4, 36, 20, 20));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_DONE, ending(35, 5, 20, 20));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_IRREGULAR, ending(36, 4, 20, 20));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_DONE, ending(20, 20, 5, 35));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_IRREGULAR, ending(20, 20, 4, 36));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_DONE, ending(20, 20, 35, 5));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_IRREGULAR, ending(20, 20, 36, 4));
}

void test_step_a_period_below_10_steps_is_too_fast(void)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_DONE, ending(5, 5, 20, 20));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_TOO_FAST, ending(5, 4, 20, 20));
}

// The hysteresis is 2, and with a height of 1 more it is the swing.
static uint8_t with_swing(uint16_t period, int16_t top, int16_t bottom)
{
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS - 1, 0);
    step(-11);
    step(0);
    for (unsigned i = 0; i < 10; i++) {
        is(FIXPID_AUTOTUNE_RUNNING);
        cycle((uint16_t)(period / 2u), (uint16_t)(period - period / 2u), top,
              bottom);
    }
    return status();
}

void test_step_a_swing_below_four_times_the_hysteresis_is_too_small(void)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_DONE, with_swing(40, 4, -4));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_TOO_SMALL, with_swing(40, 4, -3));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_TOO_SMALL, with_swing(40, 3, -4));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_TOO_FAST, with_swing(9, 3, -4));
}

void test_step_32767_steps_of_one_relay_are_too_slow(void)
{
    config.timeout_steps = 32767;
    begin();
    cycle(4000, 4000, 50, -50); // unlike the one before
    steps(15999, 0);
    step(50);
    steps(16766, 0);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(-50);
    is_over(FIXPID_AUTOTUNE_TOO_SLOW);
}

// --- the model and the gains ---

struct wave {
    int16_t inside_high, inside_low, top, bottom;
    uint16_t high, low;
};

static void play(const struct wave *wave)
{
    inside_high = wave->inside_high;
    inside_low = wave->inside_low;
    for (unsigned i = 0; i <= config.cycles; i++) {
        cycle(wave->high, wave->low, wave->top, wave->bottom);
    }
}

// An experiment with these waves for the first and third relay, and the second.
static void found(struct wave first, struct wave second)
{
    inside_high = 0;
    inside_low = 0;
    quiet();
    usual();
    usual();
    usual();
    usual();
    play(&first);
    play(&second);
    play(&first);
    is_over(FIXPID_AUTOTUNE_DONE);
}

static struct fixpid_autotune_process model(void)
{
    struct fixpid_autotune_process found_model;

    TEST_ASSERT_TRUE(fixpid_autotune_model(&autotune_controller, &found_model));
    return found_model;
}

static void is_model(struct fixpid_autotune_process expected)
{
    const struct fixpid_autotune_process is_found = model();

    TEST_ASSERT_EQUAL_UINT32(expected.gain_q8, is_found.gain_q8);
    TEST_ASSERT_EQUAL_UINT32(expected.lag_q4, is_found.lag_q4);
    TEST_ASSERT_EQUAL_UINT32(expected.dead_q4, is_found.dead_q4);
    TEST_ASSERT_EQUAL_UINT32(expected.slope_q24, is_found.slope_q24);
    TEST_ASSERT_EQUAL_UINT32(expected.ultimate_q8, is_found.ultimate_q8);
    TEST_ASSERT_EQUAL_UINT32(expected.period_q4, is_found.period_q4);
    TEST_ASSERT_EQUAL_INT16(expected.holding, is_found.holding);
    TEST_ASSERT_EQUAL_UINT16(expected.noise_q4, is_found.noise_q4);
    TEST_ASSERT_EQUAL_UINT16(expected.hysteresis, is_found.hysteresis);
}

// What a function leaves unset on the stack is a large number.
static void fill_stack(void)
{
    volatile uint8_t bytes[512];

    for (unsigned i = 0; i < sizeof bytes; i++) {
        bytes[i] = 1;
    }
}

static void robust_gains_are(uint8_t robustness_q4, uint8_t rule,
                             struct fixpid_pid_gains expected, bool measured)
{
    struct fixpid_pid_config pid;

    for (unsigned i = 0; i < 2; i++) {
        memset(&pid, i == 0 ? 0 : 0xFF, sizeof pid);
        pid.reverse = i != 0;
        pid.derivative_on_error = i != 0;
        pid.proportional_on_measurement = i != 0;
        fill_stack();
        TEST_ASSERT_TRUE(fixpid_autotune_result(&autotune_controller, rule,
                                                robustness_q4, &pid));
        TEST_ASSERT_EQUAL_UINT16(expected.kp_q8, pid.gains.kp_q8);
        TEST_ASSERT_EQUAL_UINT32(expected.ki_q24, pid.gains.ki_q24);
        TEST_ASSERT_EQUAL_UINT16(expected.kd_q8, pid.gains.kd_q8);
        TEST_ASSERT_EQUAL_UINT8(expected.derivative_filter,
                                pid.gains.derivative_filter);
        TEST_ASSERT_EQUAL_UINT16(measured ? 0 : 256, pid.setpoint_weight_q8);
        TEST_ASSERT_EQUAL(i != 0, pid.reverse);
        TEST_ASSERT_EQUAL(i != 0, pid.derivative_on_error);
        TEST_ASSERT_EQUAL(measured, pid.proportional_on_measurement);
        TEST_ASSERT_EQUAL_INT16(i == 0 ? 0 : -1, pid.output_min);
        TEST_ASSERT_EQUAL_INT16(i == 0 ? 0 : -1, pid.output_max);
        TEST_ASSERT_EQUAL_INT16(i == 0 ? 0 : -1, pid.integral_min);
        TEST_ASSERT_EQUAL_INT16(i == 0 ? 0 : -1, pid.integral_max);
    }
}

static void gains_are(uint8_t rule, uint16_t kp_q8, uint32_t ki_q24,
                      uint16_t kd_q8, uint8_t filter)
{
    robust_gains_are(16, rule,
                     (struct fixpid_pid_gains){.kp_q8 = kp_q8,
                                               .ki_q24 = ki_q24,
                                               .kd_q8 = kd_q8,
                                               .derivative_filter = filter},
                     rule == FIXPID_AUTOTUNE_AMIGO_PID);
}

static bool gives(uint8_t rule, uint8_t robustness_q4)
{
    struct fixpid_pid_config pid;
    struct fixpid_pid_config before;
    bool good;

    memset(&pid, 0xA5, sizeof pid);
    memcpy(&before, &pid, sizeof pid);
    good =
        fixpid_autotune_result(&autotune_controller, rule, robustness_q4, &pid);
    if (!good) {
        TEST_ASSERT_EQUAL_MEMORY(&before, &pid, sizeof pid);
    }
    return good;
}

// The numbers of these tests are those of test/model/autotune/model.rb.
static const struct wave lag_up = {-20, 40, 60, -20, 20, 30};
static const struct wave lag_down = {-40, 20, 20, -60, 30, 20};
static const struct wave integrator_up = {-30, 30, 50, -50, 20, 40};
static const struct wave integrator_down = {-30, 30, 50, -50, 40, 20};

static void lag_is_found(void)
{
    is_model((struct fixpid_autotune_process){428, 345, 174, 1302784, 569, 800,
                                              0, 0, 1});
    gains_are(FIXPID_AUTOTUNE_SIMC_PI, 82, 249892, 0, 0);
    gains_are(FIXPID_AUTOTUNE_AMIGO_PI, 59, 193400, 0, 0);
    gains_are(FIXPID_AUTOTUNE_AMIGO_PID, 161, 574976, 791, 0);
    gains_are(FIXPID_AUTOTUNE_TYREUS_LUYBEN_PI, 178, 105530, 0, 0);
    gains_are(FIXPID_AUTOTUNE_TYREUS_LUYBEN_PID, 258, 153016, 2063, 0);
    gains_are(FIXPID_AUTOTUNE_ZIEGLER_NICHOLS_PI, 255, 401480, 0, 0);
    gains_are(FIXPID_AUTOTUNE_ZIEGLER_NICHOLS_PID, 342, 896624, 2138, 0);
}

void test_result_a_lag_has_gains_by_every_rule(void)
{
    found(lag_up, lag_down);
    lag_is_found();
}

void test_result_averages_all_cycles(void)
{
    config.cycles = 2;
    found(lag_up, lag_down);
    lag_is_found();
    config.cycles = 4;
    found(lag_up, lag_down);
    lag_is_found();
}

void test_result_of_a_reverse_process_is_the_same(void)
{
    config.options = FIXPID_AUTOTUNE_REVERSE;
    sign = -1;
    found(lag_up, lag_down);
    lag_is_found();
}

void test_result_an_integrator_has_gains_by_every_rule(void)
{
    found(integrator_up, integrator_down);
    is_model((struct fixpid_autotune_process){FIXPID_AUTOTUNE_INTEGRATING,
                                              FIXPID_AUTOTUNE_INTEGRATING, 131,
                                              1108768, 524, 960, 0, 0, 1});
    gains_are(FIXPID_AUTOTUNE_SIMC_PI, 108, 49111, 0, 0);
    gains_are(FIXPID_AUTOTUNE_AMIGO_PI, 157, 88472, 0, 0);
    gains_are(FIXPID_AUTOTUNE_AMIGO_PID, 201, 190528, 872, 0);
    gains_are(FIXPID_AUTOTUNE_TYREUS_LUYBEN_PI, 164, 81034, 0, 0);
    gains_are(FIXPID_AUTOTUNE_TYREUS_LUYBEN_PID, 237, 117498, 2281, 0);
    gains_are(FIXPID_AUTOTUNE_ZIEGLER_NICHOLS_PI, 235, 308280, 0, 0);
    gains_are(FIXPID_AUTOTUNE_ZIEGLER_NICHOLS_PID, 315, 688480, 2364, 0);
}

// A second difference of 11 of the noise is 3 / 16, of which the wave is rid.
void test_model_noise_and_hysteresis_are_those_of_the_first_steps(void)
{
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS - 1, 0);
    step(-11);
    step(0);
    usual();
    usual();
    usual();
    usual();
    play(&lag_up);
    play(&lag_down);
    play(&lag_up);
    is_over(FIXPID_AUTOTUNE_DONE);
    is_model((struct fixpid_autotune_process){428, 345, 174, 1302784, 569, 800,
                                              0, 3, 2});
    gains_are(FIXPID_AUTOTUNE_SIMC_PI, 81, 246512, 0, 0);
}

// Without more lag than dead time the setpoint may act.
void test_result_amigo_pid_weighs_the_setpoint_where_dead_time_is_long(void)
{
    found((struct wave){-15, 20, 24, -6, 6, 12},
          (struct wave){-5, 7, 5, -19, 5, 9});
    is_model((struct fixpid_autotune_process){42, 20, 97, 2178560, 3434, 256,
                                              -55, 0, 1});
    robust_gains_are(16, FIXPID_AUTOTUNE_AMIGO_PID,
                     (struct fixpid_pid_gains){.kp_q8 = 446,
                                               .ki_q24 = 8167680,
                                               .kd_q8 = 574,
                                               .derivative_filter = 0},
                     false);
}

void test_result_robustness_slows_simc_alone(void)
{
    const struct fixpid_pid_gains fast = {
        .kp_q8 = 110, .ki_q24 = 333184, .kd_q8 = 0, .derivative_filter = 0};
    const struct fixpid_pid_gains calm = {
        .kp_q8 = 33, .ki_q24 = 99956, .kd_q8 = 0, .derivative_filter = 0};
    const struct fixpid_pid_gains amigo = {
        .kp_q8 = 59, .ki_q24 = 193400, .kd_q8 = 0, .derivative_filter = 0};

    found(lag_up, lag_down);
    robust_gains_are(8, FIXPID_AUTOTUNE_SIMC_PI, fast, false);
    robust_gains_are(64, FIXPID_AUTOTUNE_SIMC_PI, calm, false);
    robust_gains_are(8, FIXPID_AUTOTUNE_AMIGO_PI, amigo, false);
    robust_gains_are(64, FIXPID_AUTOTUNE_AMIGO_PI, amigo, false);
}

void test_result_robustness_outside_8_to_64_is_refused(void)
{
    found(lag_up, lag_down);
    for (uint8_t rule = 0; rule <= 6; rule++) {
        TEST_ASSERT_FALSE(gives(rule, 0));
        TEST_ASSERT_FALSE(gives(rule, 7));
        TEST_ASSERT_TRUE(gives(rule, 8));
        TEST_ASSERT_TRUE(gives(rule, 64));
        TEST_ASSERT_FALSE(gives(rule, 65));
        TEST_ASSERT_FALSE(gives(rule, UINT8_MAX));
    }
}

void test_result_unknown_rule_is_refused(void)
{
    found(lag_up, lag_down);
    TEST_ASSERT_TRUE(gives(FIXPID_AUTOTUNE_ZIEGLER_NICHOLS_PID, 16));
    TEST_ASSERT_FALSE(gives(FIXPID_AUTOTUNE_ZIEGLER_NICHOLS_PID + 1, 16));
    TEST_ASSERT_FALSE(gives(UINT8_MAX, 16));
}

void test_result_unless_done_nothing_is_known(void)
{
    TEST_ASSERT_TRUE(init());
    nothing_is_known(); // running
    begin();
    nothing_is_known();
    step(INT16_MAX);
    nothing_is_known(); // saturated
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_TOO_FAST, ending(5, 4, 20, 20));
    nothing_is_known();
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_IRREGULAR, ending(4, 36, 20, 20));
    nothing_is_known();
    TEST_ASSERT_EQUAL_UINT8(FIXPID_AUTOTUNE_TOO_SMALL, with_swing(40, 4, -3));
    nothing_is_known();
    config.timeout_steps = 100;
    quiet();
    steps(100, 0);
    is(FIXPID_AUTOTUNE_NO_OSCILLATION);
    nothing_is_known();
}

// The measurement rises while the output is low, in either relay.
void test_result_sums_that_make_no_sense_are_refused(void)
{
    const struct wave wrong = {0, 0, 50, -50, 20, 20};
    const struct wave flat = {-5, 5, 45, -45, 11, 11}; // it has no area

    found(wrong, integrator_down);
    nothing_is_known();
    found(integrator_up, wrong);
    nothing_is_known();
    found(flat, integrator_down);
    nothing_is_known();
    found(integrator_up, flat);
    nothing_is_known();
}

void test_result_a_measurement_that_turns_at_once_has_no_delay_to_turn(void)
{
    found((struct wave){-30, -1, 50, -50, 20, 40},
          (struct wave){-30, -1, 50, -50, 40, 20});
    is_model((struct fixpid_autotune_process){FIXPID_AUTOTUNE_INTEGRATING,
                                              FIXPID_AUTOTUNE_INTEGRATING, 125,
                                              507520, 1173, 960, 0, 0, 1});
}

// Cycles whose halves begin with these deviations, between usual ones.
static void found_turns(int16_t after_high, int16_t after_low)
{
    quiet();
    usual();
    usual();
    usual();
    usual();
    for (unsigned i = 0; i < 6; i++) {
        is(FIXPID_AUTOTUNE_RUNNING);
        step(after_high);
        steps(18, -30);
        step(50);
        step(after_low);
        steps(18, 30);
        step(-50);
    }
    is_over(FIXPID_AUTOTUNE_DONE);
}

static void is_integrator(uint32_t dead_q4, uint32_t slope_q24,
                          uint32_t ultimate_q8)
{
    is_model((struct fixpid_autotune_process){
        FIXPID_AUTOTUNE_INTEGRATING, FIXPID_AUTOTUNE_INTEGRATING, dead_q4,
        slope_q24, ultimate_q8, 640, 0, 0, 1});
}

// In each half one turn, of 2047 counts at most.
void test_model_what_the_hysteresis_takes_is_seen_after_each_switch(void)
{
    found_turns(0, 0);
    is_integrator(176, 1118464, 623);
    found_turns(1, -1);
    is_integrator(176, 1118912, 623);
    found_turns(-3000, 3000);
    is_integrator(8, 6571264, 211);
    found_turns(-3000, 30);
    is_integrator(8, 4394368, 316);
    found_turns(-30, 3000);
    is_integrator(8, 4394368, 316);
}

static int16_t rise_of_turns(int16_t after_high, int16_t after_low)
{
    found_turns(after_high, after_low);
    return autotune_controller.sums[0].rise;
}

void test_model_a_turn_of_2048_counts_is_one_of_2047(void)
{
    const int16_t most = rise_of_turns(-3000, 3000);

    TEST_ASSERT_EQUAL_INT16(most, rise_of_turns(-2047, 2047));
    TEST_ASSERT_EQUAL_INT16(most, rise_of_turns(-2048, 2048));
}

// The two relays' means, in 1/256 of a count, differ by this much.
static bool has_a_gain(int32_t measured)
{
    found(lag_up, lag_down);
    autotune_controller.sums[0].steps = 256;
    autotune_controller.sums[0].all = measured;
    autotune_controller.sums[1].steps = 256;
    autotune_controller.sums[1].all = 0;
    return model().gain_q8 != FIXPID_AUTOTUNE_INTEGRATING;
}

void test_model_a_difference_above_a_16th_of_the_swing_is_a_gain(void)
{
    found(lag_up, lag_down);
    const int32_t swing =
        autotune_controller.highest - autotune_controller.lowest;

    TEST_ASSERT_FALSE(has_a_gain(16 * swing));
    TEST_ASSERT_TRUE(has_a_gain(16 * swing + 1));
}

void test_model_holding_output_one_beyond_the_range_is_at_its_end(void)
{
    found(lag_up, lag_down);
    const int16_t holding = model().holding;

    TEST_ASSERT_TRUE(holding > config.output_min);
    TEST_ASSERT_TRUE(holding < config.output_max);
    autotune_controller.config.output_min = (int16_t)(holding + 1);
    TEST_ASSERT_EQUAL_INT16(holding + 1, model().holding);
    autotune_controller.config.output_min = config.output_min;
    autotune_controller.config.output_max = (int16_t)(holding - 1);
    TEST_ASSERT_EQUAL_INT16(holding - 1, model().holding);
}

void test_model_dead_time_is_half_a_step_at_least(void)
{
    found((struct wave){-5, 7, 10, -12, 6, 4},
          (struct wave){-4, 7, 3, -17, 6, 4});
    TEST_ASSERT_EQUAL_UINT32(8, model().dead_q4);
}

// Beyond an end of the range by the mean deviation over the gain.
void test_model_holding_output_is_within_the_range(void)
{
    config.output_min = -3;
    config.output_max = 6579;
    config.output_rest = REST;
    config.swing = 300;
    found((struct wave){0, 194, 241, -2, 6, 14},
          (struct wave){-1, 152, 126, -9, 4, 10});
    TEST_ASSERT_EQUAL_INT16(-3, model().holding);
    config.output_min = -6579;
    config.output_max = 3;
    config.output_rest = 3;
    found((struct wave){-152, 1, 9, -126, 10, 4},
          (struct wave){-194, 0, 2, -241, 14, 6});
    TEST_ASSERT_EQUAL_INT16(3, model().holding);
}

static bool gives_of(int16_t min, int16_t max, uint16_t swing, uint8_t rule,
                     struct wave first, struct wave second)
{
    config.output_min = min;
    config.output_max = max;
    config.output_rest = min;
    config.swing = swing;
    found(first, second);
    return gives(rule, 16);
}

void test_result_kp_beyond_its_range_is_refused(void)
{
    const uint8_t rule = FIXPID_AUTOTUNE_TYREUS_LUYBEN_PI;

    TEST_ASSERT_TRUE(gives_of(-87, 17776, 16383, rule,
                              (struct wave){-26, 18, 47, -17, 25, 15},
                              (struct wave){-29, 20, 4, -37, 6, 5}));
    gains_are(rule, 32767, 38158336, 0, 0);
    TEST_ASSERT_FALSE(gives_of(-98, 17772, 16383, rule,
                               (struct wave){-33, 26, 54, -12, 25, 15},
                               (struct wave){-33, 17, 12, -49, 6, 5}));
}

// A kp of 0 is a controller that integrates only.
void test_result_ki_below_8_is_refused(void)
{
    const uint8_t rule = FIXPID_AUTOTUNE_SIMC_PI;

    TEST_ASSERT_TRUE(gives_of(-4, 1, 50, rule,
                              (struct wave){-1107, 45, 88, -342, 30, 16},
                              (struct wave){-1268, 25, 42, -1888, 4, 4}));
    gains_are(rule, 0, 8, 0, 0);
    TEST_ASSERT_FALSE(gives_of(-598, -567, 50, rule,
                               (struct wave){-1243, 0, 7, -771, 28, 7},
                               (struct wave){-1497, 0, 2, -2079, 10, 9}));
}

// At most 0x7FFF0000, with the least robustness.
void test_result_ki_beyond_its_range_is_refused(void)
{
    const struct fixpid_pid_gains most = {.kp_q8 = 30635,
                                          .ki_q24 = 2147418112,
                                          .kd_q8 = 0,
                                          .derivative_filter = 0};

    config.output_min = -7722;
    config.output_max = 32169;
    config.swing = 300;
    found((struct wave){-11, 64, 115, -5, 6, 6},
          (struct wave){0, 39, 85, -30, 5, 6});
    robust_gains_are(8, FIXPID_AUTOTUNE_SIMC_PI, most, false);
    config.output_min = -7728;
    config.output_max = 32733;
    found((struct wave){-14, 64, 118, -2, 6, 6},
          (struct wave){0, 37, 85, -30, 5, 6});
    TEST_ASSERT_FALSE(gives(FIXPID_AUTOTUNE_SIMC_PI, 8));
}

void test_result_kd_beyond_its_range_is_refused(void)
{
    const uint8_t rule = FIXPID_AUTOTUNE_AMIGO_PID;
    const struct fixpid_pid_gains most = {.kp_q8 = 16368,
                                          .ki_q24 = 185487360,
                                          .kd_q8 = 32255,
                                          .derivative_filter = 0};

    TEST_ASSERT_TRUE(gives_of(-25, 17730, 16383, rule,
                              (struct wave){-20, 29, 51, -14, 25, 15},
                              (struct wave){-39, 0, 9, -21, 6, 5}));
    robust_gains_are(16, rule, most, false);
    TEST_ASSERT_FALSE(gives_of(-48, 17730, 16383, rule,
                               (struct wave){-11, 43, 47, -7, 25, 15},
                               (struct wave){-38, 13, 3, -34, 6, 5}));
}

// Experiments in which a constant one off in its last place shows, or a limit
// that is one off. Each stands on its own.
static const struct exact {
    int16_t output_min, output_max;
    uint16_t swing;
    struct wave first, second;
    struct fixpid_autotune_process model;
    uint16_t kp_q8; // of SIMC PI
    uint32_t ki_q24;
} exact[] = {
    // A RATIO made smaller by 15/16, and again.
    {0,
     16,
     58,
     {-13, 52, 88, -76, 17, 5},
     {-51, 29, 32, -94, 6, 7},
     {5647, 68, 57, 87687168, 35, 280, 9, 0, 1},
     6,
     93640},
    // A holding output of a half, which is rounded up, and a bit below one.
    {-499,
     63,
     218,
     {-9, 19, 58, -47, 10, 9},
     {-23, 22, 48, -72, 9, 5},
     {FIXPID_AUTOTUNE_INTEGRATING, FIXPID_AUTOTUNE_INTEGRATING, 22, 365456,
      8267, 264, -178, 0, 1},
     3113,
     13512192},
    {-36,
     6,
     114,
     {-49, 17, 105, -72, 5, 13},
     {-31, 2, 8, -6, 4, 14},
     {FIXPID_AUTOTUNE_INTEGRATING, FIXPID_AUTOTUNE_INTEGRATING, 25, 8675840,
      286, 288, -24, 0, 1},
     121,
     484496},
    // Means that differ by less than a 16th of the swing, by just that, and by
    // more.
    {-293,
     206,
     131,
     {-16, 19, 28, -37, 9, 8},
     {-16, 11, 5, -62, 6, 8},
     {FIXPID_AUTOTUNE_INTEGRATING, FIXPID_AUTOTUNE_INTEGRATING, 35, 470192,
      6160, 248, -52, 0, 1},
     1715,
     5276288},
    {-45,
     30,
     161,
     {-26, 36, 37, -70, 10, 11},
     {-15, 2, 89, -13, 10, 9},
     {FIXPID_AUTOTUNE_INTEGRATING, FIXPID_AUTOTUNE_INTEGRATING, 43, 3252288,
      2057, 320, -7, 0, 1},
     209,
     542112},
    {-1564,
     615,
     287,
     {-46, 35, 53, -9, 9, 12},
     {-53, 51, 105, -59, 12, 10},
     {12, 2, 182, 6817152, 5802, 344, -491, 0, 1},
     26,
     14615808},
    // Mean outputs that differ by 1/256 of a count.
    {0,
     1,
     55,
     {-13, 35, 89, -42, 14, 16},
     {-42, 45, 23, -24, 13, 15},
     {587776, 1938, 78, 317988864, 5, 464, 0, 0, 1},
     1,
     1920},
    // A RATIO of 1/256, which is an integrator's, and one bit above it.
    {-10,
     8,
     12,
     {-37, 67, 66, -53, 23, 44},
     {-53, 37, 2, -47, 27, 13},
     {FIXPID_AUTOTUNE_INTEGRATING, FIXPID_AUTOTUNE_INTEGRATING, 124, 52008960,
      13, 856, -1, 0, 1},
     1,
     59},
    {-324,
     626,
     75,
     {-25, 49, 42, -19, 26, 54},
     {-42, 25, 56, -91, 21, 11},
     {10372, 25358, 131, 428888, 1753, 896, 146, 0, 1},
     38,
     2425},
    // 6, 0.05 and 1.1.
    {-214,
     12,
     232,
     {-22, 41, 39, -19, 11, 12},
     {-17, 9, 34, -89, 11, 7},
     {401, 367, 49, 1147168, 4589, 328, -93, 0, 1},
     134,
     383040},
    {-1787,
     2335,
     122,
     {-32, 35, 58, -37, 8, 11},
     {-30, 19, 31, -17, 11, 7},
     {107, 998, 50, 112684, 18615, 296, 331, 0, 1},
     3477,
     5196800},
    {-155,
     172,
     73,
     {-30, 32, 86, -41, 9, 14},
     {-27, 11, 28, -56, 6, 13},
     {104, 48, 103, 2295040, 1218, 336, -25, 0, 1},
     135,
     2978944},
};

void test_model_is_exact_in_the_last_place(void)
{
    for (unsigned i = 0; i < sizeof exact / sizeof exact[0]; i++) {
        config.output_min = exact[i].output_min;
        config.output_max = exact[i].output_max;
        config.output_rest = exact[i].output_min;
        config.swing = exact[i].swing;
        found(exact[i].first, exact[i].second);
        is_model(exact[i].model);
        gains_are(FIXPID_AUTOTUNE_SIMC_PI, exact[i].kp_q8, exact[i].ki_q24, 0,
                  0);
    }
}

// The least that is not refused.
void test_model_of_an_area_of_1_is_one(void)
{
    config.output_min = -4401;
    config.output_max = 23;
    config.output_rest = 0;
    config.swing = 196;
    found((struct wave){-12, 15, 66, -15, 4, 11},
          (struct wave){-6, 10, 14, -42, 12, 5});
    is_model((struct fixpid_autotune_process){FIXPID_AUTOTUNE_INTEGRATING,
                                              FIXPID_AUTOTUNE_INTEGRATING, 8,
                                              4827, 1938528, 256, -2240, 0, 1});
}

static uint8_t filter_of(uint16_t high, uint16_t low)
{
    const struct wave wave = {-30, 30, 50, -50, high, low};
    struct fixpid_pid_config pid;

    config.timeout_steps = 32767;
    inside_high = 0;
    inside_low = 0;
    quiet();
    for (unsigned i = 0; i < 4; i++) { // short, but so that none is lost
        cycle((uint16_t)(high / 3u), (uint16_t)(low / 3u), 50, -50);
    }
    play(&wave);
    play(&wave);
    play(&wave);
    is_over(FIXPID_AUTOTUNE_DONE);
    TEST_ASSERT_TRUE(fixpid_autotune_result(
        &autotune_controller, FIXPID_AUTOTUNE_TYREUS_LUYBEN_PID, 16, &pid));
    return pid.gains.derivative_filter;
}

// Td is 41 / 256 of the period, and the filter lags at most an eighth of it.
void test_result_filter_is_the_largest_that_lags_an_eighth_of_td(void)
{
    TEST_ASSERT_EQUAL_UINT8(0, filter_of(48, 48));
    TEST_ASSERT_EQUAL_UINT8(1, filter_of(49, 48));
    TEST_ASSERT_EQUAL_UINT8(1, filter_of(97, 97));
    TEST_ASSERT_EQUAL_UINT8(2, filter_of(99, 98));
}

void test_result_filter_is_at_most_7(void)
{
    TEST_ASSERT_EQUAL_UINT8(7, filter_of(6394, 6394)); // 8 would lag an eighth
}

static void play_far(int16_t deviation, int16_t top)
{
    for (unsigned i = 0; i < 2; i++) {
        steps(19, 0);
        step(top);
        step(0);
        steps(18, deviation);
        step(-2);
    }
}

// Of next to no gain: the mean deviation takes 9.5 million counts of output,
// and 1/256 of them do not fit 32 bits.
void test_model_holding_output_far_beyond_the_range_is_at_its_end(void)
{
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    config.swing = 16383;
    quiet();
    usual();
    usual();
    usual();
    usual();
    play_far(1790, 32080);
    play_far(895, 16030);
    play_far(0, 2);
    is_over(FIXPID_AUTOTUNE_DONE);
    is_model((struct fixpid_autotune_process){0, 42, 306, 519, 3139328, 640,
                                              INT16_MIN, 0, 1});
}

// ---- Flipped bits ----

static void done(void)
{
    found(integrator_up, integrator_down);
}

static void refuses_sums(void)
{
    nothing_is_known();
    done();
    (void)model();
}

void test_result_sums_that_no_cycles_have_are_refused(void)
{
    struct fixpid_autotune_sums *const sums = &autotune_controller.sums[1];

    done();
    sums->steps = 32768;
    refuses_sums();
    sums->on_steps = 0;
    refuses_sums();
    sums->on_steps = sums->steps;
    refuses_sums();
    sums->all = (int32_t)sums->steps * 32767 + 1;
    refuses_sums();
    sums->all = INT32_MIN;
    refuses_sums();
    sums->on = (int32_t)sums->on_steps * -32767 - 1;
    refuses_sums();
}

static void takes_sums(void)
{
    autotune_controller.sums[1].rise = 0;
    (void)model();
}

void test_result_sums_at_the_ends_of_what_cycles_have_are_taken(void)
{
    struct fixpid_autotune_sums *const sums = &autotune_controller.sums[1];

    done();
    sums->steps = 32767;
    sums->on_steps = 1;
    sums->all = 0;
    sums->on = -32767;
    takes_sums();
    sums->on_steps = 32766;
    takes_sums();
    sums->all = INT32_C(32767) * 32767;
    takes_sums();
}

// Without a cycle there is nothing to divide by.
void test_result_no_number_of_cycles_divides_by_nothing(void)
{
    struct fixpid_pid_config pid = {0};

    done();
    autotune_controller.config.cycles = 0;
    (void)fixpid_autotune_result(&autotune_controller, 0, 16, &pid);
    TEST_ASSERT_LESS_OR_EQUAL_UINT16(FIXPID_PID_KP_MAX, pid.gains.kp_q8);
}

void test_step_a_flipped_bit_of_the_output_keeps_it_within_its_range(void)
{
    TEST_ASSERT_TRUE(init());
    autotune_controller.output = 32767;
    TEST_ASSERT_EQUAL_INT16(300, step(0));
    autotune_controller.output = -32768;
    TEST_ASSERT_EQUAL_INT16(-300, step(0));
    autotune_controller.output = 301;
    TEST_ASSERT_EQUAL_INT16(300, step(0));
    autotune_controller.output = -301;
    TEST_ASSERT_EQUAL_INT16(-300, step(0));
    autotune_controller.output = 299;
    TEST_ASSERT_EQUAL_INT16(299, step(0));
}

// Nothing undefined comes of any bytes, which the sanitizers see, and it ends.
void test_result_of_any_bytes_is_legal(void)
{
    unsigned given = 0;

    numbers_seed(66);
    for (unsigned turn = 0; turn < 3000u; turn++) {
        struct fixpid_autotune_process process;
        struct fixpid_pid_config pid = {0};

        numbers_fill(&autotune_controller, sizeof autotune_controller);
        autotune_controller.state = FIXPID_AUTOTUNE_DONE;
        autotune_controller.config.cycles &= 7u;
        for (unsigned relay = 0; relay < 2u; relay++) {
            struct fixpid_autotune_sums *const sums =
                &autotune_controller.sums[relay];

            sums->steps >>= 1;
            sums->on_steps = (uint16_t)(sums->on_steps & sums->steps);
            sums->all /= (int32_t)(1u << (turn & 15u));
            sums->on = -((sums->on & INT32_MAX) >> (turn & 15u));
        }
        (void)fixpid_autotune_model(&autotune_controller, &process);
        if (fixpid_autotune_result(&autotune_controller, (uint8_t)(turn % 7u),
                                   16, &pid)) {
            given++;
            TEST_ASSERT_LESS_OR_EQUAL_UINT16(FIXPID_PID_KP_MAX,
                                             pid.gains.kp_q8);
            TEST_ASSERT_LESS_OR_EQUAL_UINT32(FIXPID_PID_KI_MAX,
                                             pid.gains.ki_q24);
            TEST_ASSERT_LESS_OR_EQUAL_UINT16(FIXPID_PID_KD_MAX,
                                             pid.gains.kd_q8);
            TEST_ASSERT_LESS_OR_EQUAL_UINT8(FIXPID_PID_FILTER_MAX,
                                            pid.gains.derivative_filter);
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT(100, given);
}
