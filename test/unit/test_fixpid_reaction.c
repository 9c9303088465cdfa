// SPDX-License-Identifier: MIT
#include <string.h>

#include "fixpid_reaction.h"
#include "numbers.h"
#include "numbers_control.h"
#include "numbers_reaction.h"
#include "poison.h"
#include "reference_reaction.h"
#include "unity.h"

TEST_SOURCE_FILE("src/reaction/fixpid_reaction.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction_block.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction_more.c")
TEST_SOURCE_FILE("src/reaction/fixpid_reaction_result.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 1000000
#endif

#define LISTENING 32
#define COUNT(table) (sizeof(table) / sizeof(table)[0])

FIXPID_DATA struct fixpid_reaction reaction_controller;
static struct reference_reaction reference;
static struct fixpid_reaction_config config;
static int16_t start; // a test's readings are counts from it

void setUp(void)
{
    config = (struct fixpid_reaction_config){
        .output_rest = 10, .output_drive = 110, .measurement_stop = 1000};
    start = 0;
}

void tearDown(void)
{
}

static bool init(void)
{
    const bool accepted = fixpid_reaction_init(&reaction_controller, &config);

    TEST_ASSERT_EQUAL(reference_reaction_init(&reference, &config), accepted);
    return accepted;
}

static void reset(void)
{
    fixpid_reaction_reset(&reaction_controller);
    reference_reaction_reset(&reference);
}

static void is(uint8_t status)
{
    TEST_ASSERT_EQUAL_UINT8(status,
                            fixpid_reaction_status(&reaction_controller));
}

// One step, which must be as defined.
static int16_t read(int16_t measurement)
{
    const int16_t output =
        fixpid_reaction_step(&reaction_controller, measurement);

    TEST_ASSERT_EQUAL_INT16(reference_reaction_step(&reference, measurement),
                            output);
    is((uint8_t)reference.status);
    TEST_ASSERT_EQUAL_UINT8(reference_reaction_progress(&reference),
                            fixpid_reaction_progress(&reaction_controller));
    return output;
}

static void reads(unsigned count, int16_t counts)
{
    for (unsigned i = 0; i < count; i++) {
        (void)read((int16_t)(start + counts));
    }
}

static void begin(void)
{
    TEST_ASSERT_TRUE(init());
    reads(LISTENING, 0);
}

// Gains as defined, or none and nothing written.
static bool gains_are_as_defined(uint8_t rule, uint8_t robustness_q4,
                                 struct fixpid_pid_gains *gains)
{
    struct fixpid_pid_gains defined;
    bool found;

    memset(gains, 0xA5, sizeof *gains);
    memset(&defined, 0xA5, sizeof defined);
    found = fixpid_reaction_result(&reaction_controller, rule, robustness_q4,
                                   gains);
    TEST_ASSERT_EQUAL(
        reference_reaction_result(&reference, rule, robustness_q4, &defined),
        found);
    TEST_ASSERT_EQUAL_UINT16(defined.kp_q8, gains->kp_q8);
    TEST_ASSERT_EQUAL_UINT32(defined.ki_q24, gains->ki_q24);
    TEST_ASSERT_EQUAL_UINT16(defined.kd_q8, gains->kd_q8);
    TEST_ASSERT_EQUAL_UINT8(defined.derivative_filter,
                            gains->derivative_filter);
    return found;
}

static bool model_is_as_defined(struct fixpid_reaction_process *process)
{
    struct fixpid_reaction_process defined;
    bool found;

    memset(process, 0xA5, sizeof *process);
    memset(&defined, 0xA5, sizeof defined);
    found = fixpid_reaction_model(&reaction_controller, process);
    TEST_ASSERT_EQUAL(reference_reaction_model(&reference, &defined), found);
    TEST_ASSERT_EQUAL_UINT32(defined.slope_q24, process->slope_q24);
    TEST_ASSERT_EQUAL_UINT32(defined.dead_q4, process->dead_q4);
    TEST_ASSERT_EQUAL_UINT16(defined.noise_q4, process->noise_q4);
    return found;
}

static void results_are_as_defined(void)
{
    struct fixpid_reaction_process process;
    struct fixpid_pid_gains gains;

    (void)model_is_as_defined(&process);
    for (uint8_t rule = 0; rule < 3u; rule++) {
        (void)gains_are_as_defined(rule, FIXPID_REACTION_SAFE, &gains);
        (void)gains_are_as_defined(rule, (uint8_t)(7u + numbers_below(59)),
                                   &gains);
    }
}

static void is_over(uint8_t status)
{
    is(status);
    TEST_ASSERT_EQUAL_INT16(config.output_rest, read(start));
    TEST_ASSERT_EQUAL_INT16(config.output_rest, read(INT16_MIN));
    TEST_ASSERT_EQUAL_INT16(config.output_rest, read(INT16_MAX));
    is(status);
    results_are_as_defined();
}

// The reading rises by `slope` a step, `delay` steps after the output.
static void rise(unsigned delay, int16_t slope)
{
    int16_t counts = 0;

    reads(LISTENING + delay, 0);
    while (fixpid_reaction_status(&reaction_controller) ==
           FIXPID_REACTION_RUNNING) {
        counts = (int16_t)(counts + slope);
        reads(1, counts);
    }
}

void test_init_no_change_of_the_output_and_a_long_timeout_are_refused(void)
{
    config.output_drive = config.output_rest;
    TEST_ASSERT_FALSE(init());
    TEST_ASSERT_EQUAL_INT16(0, read(5));
    is(FIXPID_REACTION_REFUSED);
    reset();
    TEST_ASSERT_EQUAL_INT16(0, read(5));
    config.output_drive = 11;
    config.timeout_steps = 32768;
    TEST_ASSERT_FALSE(init());
    TEST_ASSERT_EQUAL_INT16(0, read(5));
    config.timeout_steps = 32767;
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_EQUAL_INT16(10, read(5));
}

void test_step_all_zero_object_is_refused(void)
{
    static FIXPID_DATA const struct fixpid_reaction zero;

    reaction_controller = zero;
    memset(&reference, 0, sizeof reference);
    TEST_ASSERT_EQUAL_INT16(0, read(500));
    reset();
    is(FIXPID_REACTION_REFUSED);
    results_are_as_defined();
}

static void init_good(void)
{
    (void)fixpid_reaction_init(&reaction_controller, &config);
}

void test_init_whatever_the_memory_held_sets_each_of_its_40_bytes(void)
{
    TEST_ASSERT_EQUAL_UINT(0,
                           poison_left(&reaction_controller,
                                       sizeof reaction_controller, init_good));
    config.timeout_steps = 32768; // refused
    TEST_ASSERT_EQUAL_UINT(0,
                           poison_left(&reaction_controller,
                                       sizeof reaction_controller, init_good));
    TEST_ASSERT_EQUAL_UINT(40, sizeof reaction_controller);
}

void test_step_listens_for_32_steps_and_then_heats(void)
{
    TEST_ASSERT_TRUE(init());
    for (unsigned i = 1; i < LISTENING; i++) {
        TEST_ASSERT_EQUAL_INT16(10, read(0));
        TEST_ASSERT_EQUAL_UINT8(i / 4u,
                                fixpid_reaction_progress(&reaction_controller));
    }
    TEST_ASSERT_EQUAL_INT16(110, read(0));
    TEST_ASSERT_EQUAL_UINT8(8, fixpid_reaction_progress(&reaction_controller));
    is(FIXPID_REACTION_RUNNING);
}

void test_step_511_counts_are_rest_and_512_are_not(void)
{
    for (int16_t sign = -1; sign <= 1; sign = (int16_t)(sign + 2)) {
        TEST_ASSERT_TRUE(init());
        reads(1, 0);
        reads(1, (int16_t)(511 * sign));
        is(FIXPID_REACTION_RUNNING);
        reads(1, (int16_t)(512 * sign));
        is_over(FIXPID_REACTION_MOVING);
    }
}

// With a band of 2 the sums may be 5 * 2 + 16 = 26 apart.
void test_step_a_reading_that_rises_at_rest_is_moving_and_one_that_falls_is_not(
    void)
{
    for (int16_t last = 0; last <= 1; last++) {
        TEST_ASSERT_TRUE(init());
        reads(16, 0);
        reads(13, 2);
        reads(3, 0);
        is(FIXPID_REACTION_RUNNING);
        TEST_ASSERT_TRUE(init());
        reads(16, 0);
        reads(13, 2);
        reads(2, 0);
        reads(1, last);
        is(last == 1 ? FIXPID_REACTION_MOVING : FIXPID_REACTION_RUNNING);
        TEST_ASSERT_TRUE(init());
        reads(16, 0);
        reads(16, -500);
        is(FIXPID_REACTION_RUNNING);
    }
}

// The largest of 1, 2, 4, 8 and 16 with which the reach is 16384 at most.
void test_step_the_record_is_as_fine_as_16_bits_hold(void)
{
    static const int16_t reach_and_scale[][2] = {
        {16384, 0}, {8193, 0}, {8192, 1}, {4097, 1}, {4096, 2},
        {2049, 2},  {2048, 3}, {1025, 3}, {1024, 4}, {1, 4}};

    for (unsigned i = 0; i < COUNT(reach_and_scale); i++) {
        config.measurement_stop = reach_and_scale[i][0];
        begin();
        TEST_ASSERT_EQUAL_UINT8(reach_and_scale[i][1],
                                reaction_controller.scale);
    }
}

void test_step_eight_blocks_become_the_means_of_four_pairs(void)
{
    begin();
    for (int16_t i = 0; i < 8; i++) {
        reads(1, (int16_t)(i * i));
    }
    reads(1, 60);
    for (int16_t i = 0; i < 4; i++) {
        const int16_t a = (int16_t)(2 * i);

        TEST_ASSERT_EQUAL_UINT16(16 * 1000 + 8 * (a * a + (a + 1) * (a + 1)),
                                 reaction_controller.record[i]);
        TEST_ASSERT_EQUAL_UINT16(16 * (1000 + (i + 4) * (i + 4)),
                                 reaction_controller.record[i + 4]);
    }
}

void test_step_a_stop_on_the_other_side_is_a_limit_before_any_output(void)
{
    for (int16_t stop = -1; stop <= 0; stop++) {
        config.measurement_stop = stop;
        TEST_ASSERT_TRUE(init());
        reads(31, 0);
        TEST_ASSERT_EQUAL_INT16(10, read(0));
        is_over(FIXPID_REACTION_LIMIT);
    }
    config.measurement_stop = 1;
    begin();
    is(FIXPID_REACTION_RUNNING);
}

void test_step_a_reading_at_the_stop_ends_it(void)
{
    begin();
    reads(1, 999);
    reads(1, 1000);
    is_over(FIXPID_REACTION_LIMIT);
    // of more than 16384 counts, 16384
    config.measurement_stop = 16385;
    begin();
    reads(1, 16384);
    is_over(FIXPID_REACTION_LIMIT);
    config.measurement_stop = 32767;
    start = -32768;
    begin();
    reads(1, 16384);
    is_over(FIXPID_REACTION_LIMIT);
    begin();
    reads(2, -32768); // which is a jump of 65535 and more
    is(FIXPID_REACTION_LIMIT);
}

void test_step_without_noise_the_first_jump_is_the_band_to_1022(void)
{
    config.measurement_stop = 1024;
    for (int16_t jump = -1023; jump <= 1023; jump++) {
        const int16_t counts = (int16_t)(jump < 0 ? -jump : jump);

        begin();
        reads(1, 0);
        reads(1, jump);
        TEST_ASSERT_EQUAL_UINT16(counts < 1022 ? counts : 1022,
                                 reaction_controller.band);
    }
}

void test_step_without_a_movement_it_ends_after_timeout_steps(void)
{
    config.timeout_steps = 7;
    begin();
    reads(6, 0);
    is(FIXPID_REACTION_RUNNING);
    reads(1, 0);
    is_over(FIXPID_REACTION_NO_MOVEMENT);
    config.timeout_steps = 0; // 1000, at the next end of a block of 128
    begin();
    reads(1023, 0);
    is(FIXPID_REACTION_RUNNING);
    reads(1, 0);
    is_over(FIXPID_REACTION_NO_MOVEMENT);
}

void test_step_a_reading_that_goes_the_other_way_by_a_quarter_is_wrong(void)
{
    begin();
    reads(1, -1); // the quantum
    reads(1, -250);
    is(FIXPID_REACTION_RUNNING);
    reads(1, -251);
    is_over(FIXPID_REACTION_WRONG_WAY);
}

void test_step_a_reading_that_stands_again_levels_off(void)
{
    begin();
    reads(4, 1);
    reads(7, 50);
    is(FIXPID_REACTION_RUNNING);
    reads(1, 50);
    is_over(FIXPID_REACTION_LEVELS_OFF);
}

// The first jump is the quantum: then the rise is no clear movement for long.
void test_step_32768_steps_of_the_heat_up_are_too_slow(void)
{
    config.measurement_stop = 16000;
    config.timeout_steps = 32767;
    begin();
    for (int32_t i = 1; i <= 32767; i++) {
        (void)read((int16_t)(i * i / 167000));
        is(FIXPID_REACTION_RUNNING);
    }
    (void)read(6400);
    is_over(FIXPID_REACTION_TOO_SLOW);
}

static void ramp(unsigned delay, int16_t slope)
{
    TEST_ASSERT_TRUE(init());
    rise(delay, slope);
}

// 4 counts a step of 100 of the output, 10 steps late: a slope of 0.04 and,
// with a quantum of 4 counts and one and a half steps, a delay of 12.5 steps
// and a half of the four counts, which is half a step.
void test_model_a_ramp_has_its_slope_and_its_delay(void)
{
    struct fixpid_reaction_process process;

    ramp(10, 4);
    is(FIXPID_REACTION_DONE);
    TEST_ASSERT_TRUE(model_is_as_defined(&process));
    TEST_ASSERT_UINT32_WITHIN(1, (uint32_t)(0.04 * 16777216),
                              process.slope_q24);
    TEST_ASSERT_UINT32_WITHIN(8, 12 * 16, process.dead_q4);
    TEST_ASSERT_EQUAL_UINT16(16, process.noise_q4);
}

void test_reset_starts_the_same_experiment_again(void)
{
    struct fixpid_pid_gains first;
    struct fixpid_pid_gains again;

    ramp(10, 4);
    TEST_ASSERT_TRUE(gains_are_as_defined(0, 16, &first));
    reset();
    is(FIXPID_REACTION_RUNNING);
    TEST_ASSERT_EQUAL_UINT8(0, fixpid_reaction_progress(&reaction_controller));
    rise(10, 4);
    TEST_ASSERT_TRUE(gains_are_as_defined(0, 16, &again));
    TEST_ASSERT_EQUAL_UINT32(first.ki_q24, again.ki_q24);
    TEST_ASSERT_EQUAL_UINT8(4, reaction_controller.scale);
}

// The same way down, however output and reading lead there.
void test_result_a_mirrored_experiment_has_the_same_gains(void)
{
    struct fixpid_pid_gains up;
    struct fixpid_pid_gains gains;

    ramp(10, 4);
    TEST_ASSERT_TRUE(
        gains_are_as_defined(FIXPID_REACTION_PID, FIXPID_REACTION_SAFE, &up));
    for (unsigned way = 0; way < 3u; way++) {
        const int16_t sign = way == 1u ? 1 : -1;

        config.output_drive = way == 0u ? 110 : -90;
        config.reverse = way < 2u;
        config.measurement_stop = (int16_t)(1000 * sign);
        ramp(10, (int16_t)(4 * sign));
        TEST_ASSERT_TRUE(gains_are_as_defined(FIXPID_REACTION_PID,
                                              FIXPID_REACTION_SAFE, &gains));
        TEST_ASSERT_EQUAL_UINT16(up.kp_q8, gains.kp_q8);
        TEST_ASSERT_EQUAL_UINT32(up.ki_q24, gains.ki_q24);
        TEST_ASSERT_EQUAL_UINT16(up.kd_q8, gains.kd_q8);
    }
}

void test_result_other_rules_and_robustness_and_what_is_not_done_have_none(void)
{
    struct fixpid_pid_gains gains;

    ramp(10, 4);
    TEST_ASSERT_TRUE(gains_are_as_defined(0, 8, &gains));
    TEST_ASSERT_TRUE(gains_are_as_defined(1, 64, &gains));
    TEST_ASSERT_FALSE(gains_are_as_defined(2, 16, &gains));
    TEST_ASSERT_FALSE(gains_are_as_defined(0, 7, &gains));
    TEST_ASSERT_FALSE(gains_are_as_defined(0, 65, &gains));
    reset();
    TEST_ASSERT_FALSE(gains_are_as_defined(0, 16, &gains));
    is(FIXPID_REACTION_RUNNING);
}

// Its numbers are private: a record of eight blocks that rises by `rise` behind
// block 1 + `place`.
static void done(uint16_t rise, uint16_t band, uint8_t doubled, uint8_t scale,
                 int16_t change, uint8_t place)
{
    config.output_rest = (int16_t) - (change / 2);
    config.output_drive = (int16_t)(config.output_rest + change);
    config.reverse = change < 0;
    config.measurement_stop = (int16_t)(16384 >> scale);
    begin();
    reaction_controller.state = FIXPID_REACTION_DONE;
    reaction_controller.blocks = 8;
    reaction_controller.doubled = doubled;
    reaction_controller.band = band;
    reference.status = FIXPID_REACTION_DONE;
    reference.n = 8;
    reference.b = doubled;
    reference.band = band;
    for (uint8_t i = 0; i < 8u; i++) {
        reaction_controller.record[i] =
            (uint16_t)(16384 + (i < 2u + place ? 0 : rise));
        reference.m[i] = reaction_controller.record[i];
    }
    TEST_ASSERT_EQUAL_UINT8(scale, reaction_controller.scale & 7u);
}

void test_result_gains_of_any_record_are_as_defined(void)
{
    numbers_seed(4);
    for (unsigned turn = 0; turn < TEST_MEMORIES; turn++) {
        const int16_t change = (int16_t)(numbers_any_size() & 0x7FFFu);
        const uint8_t tilt = (uint8_t)numbers_below(3);

        done((uint16_t)(1u + (numbers_any_size() & 0x3FFFu)),
             (uint16_t)numbers_below(1023), (uint8_t)(1u + numbers_below(12)),
             (uint8_t)numbers_below(5),
             (int16_t)(numbers_one_in(2) ? change + 1 : -1 - change),
             (uint8_t)numbers_below(6));
        for (uint8_t i = 0; i < 8u; i++) {
            reference.m[i] -= tilt * i;
            reaction_controller.record[i] = (uint16_t)reference.m[i];
        }
        results_are_as_defined();
    }
}

// Searched for: at the end of each range, and one beyond.
void test_result_gains_at_the_ends_of_their_ranges_are_as_defined(void)
{
    static const struct {
        uint16_t rise, band;
        uint8_t doubled, scale;
        int16_t change;
        uint8_t robustness_q4;
        bool pi, pid;
    } ends[] = {
        {3, 89, 10, 0, 32767, 57, true, false},   // kp 32767
        {1, 18, 1, 0, 4352, 29, false, false},    // 32768
        {1, 0, 1, 4, 16, 29, true, true},         // of PID 32767
        {235, 30, 2, 1, 23284, 14, true, false},  // 32768
        {7, 957, 5, 4, 708, 13, true, true},      // kd 32255
        {227, 864, 10, 1, 5728, 23, true, false}, // 32256
        {1, 688, 11, 0, 18462, 22, true, false},  // a long delay
        {1, 689, 11, 0, 18462, 22, false, false}, // C 2^26
        {1, 288, 8, 3, 26219, 58, true, false},   // kd of 33 bits
        {106, 664, 6, 1, 24, 62, true, true},     // ki 8
        {4, 510, 3, 4, 86, 34, false, true},      // 7
        {1, 158, 3, 2, 11, 54, false, true},      // of PID 8
        {417, 294, 12, 2, 83, 63, false, false},  // 7
    };

    for (unsigned i = 0; i < COUNT(ends); i++) {
        struct fixpid_pid_gains gains;

        done(ends[i].rise, ends[i].band, ends[i].doubled, ends[i].scale,
             ends[i].change, 0);
        TEST_ASSERT_EQUAL(ends[i].pi,
                          gains_are_as_defined(FIXPID_REACTION_PI,
                                               ends[i].robustness_q4, &gains));
        TEST_ASSERT_EQUAL(ends[i].pid,
                          gains_are_as_defined(FIXPID_REACTION_PID,
                                               ends[i].robustness_q4, &gains));
    }
}

// Only flipped bits make a delay of a quarter of a step: ki is 1024 * 2^20 / 12
// and 31744 * 2^20 / 12, of which the second is above 0x7FFF0000.
void test_result_of_flipped_bits_is_within_its_ranges(void)
{
    struct fixpid_pid_gains gains = {0, 0, 0, 0};

    for (int16_t change = 31; change >= 1; change = (int16_t)(change - 30)) {
        done(0, 0, 15, 0, change, 0);
        reaction_controller.stop = 0; // the start
        memset(reaction_controller.record, 0,
               sizeof reaction_controller.record);
        reaction_controller.record[1] = 65535;
        reaction_controller.record[2] = 65535;
        TEST_ASSERT_EQUAL(
            change == 1, fixpid_reaction_result(&reaction_controller,
                                                FIXPID_REACTION_PI, 8, &gains));
    }
    TEST_ASSERT_EQUAL_UINT32(1024u * (1048576u / 12u) + 341u, gains.ki_q24);
}

// A block whose mean is next to what decides: as steep as before and an eighth
// more, half as steep as the steepest, a clear movement, and so on.
static int64_t mean_at_a_bound(const struct reference_reaction *ahead)
{
    const int64_t n = ahead->n;
    const int64_t last = n > 0 ? ahead->m[n - 1] : ahead->reach;
    const int64_t older = n > 1 ? ahead->m[n - 2] : last;
    const int64_t origin = ahead->reach * ahead->scale;
    const int64_t need = 4 * (ahead->band + 1) * ahead->scale;
    const int64_t close = (int64_t)numbers_below(3) - 1;
    int64_t steepest = 0;
    int64_t before = 0;

    for (int64_t j = 2; j < n; j++) {
        const int64_t rise = ahead->m[j] - ahead->m[j - 2];

        steepest = rise > steepest ? rise : steepest;
        before = j < n - 1 ? steepest : before;
    }
    switch (numbers_below(n < 5 ? 40 : 12)) {
    case 0:
        return older + before + before / 8 + close;
    case 1:
        return older + steepest / 2 + close;
    case 2:
        return last + steepest / 4 + close;
    case 3:
        return origin + 2 * need + close;
    case 4:
        return origin - (origin / 4 > need ? origin / 4 : need) + close;
    case 5:
        return older + 2 * origin / (n + 2) + close;
    case 6:
        return older + need + close;
    case 7:
        return older + steepest + close;
    default:
        return 2 * last - older + close * (1 + (int64_t)numbers_below(20));
    }
}

static void heat_at_the_bounds(void)
{
    while (fixpid_reaction_status(&reaction_controller) ==
           FIXPID_REACTION_RUNNING) {
        struct reference_reaction ahead = reference;
        int64_t counts;
        int64_t steps;

        if (ahead.n == 8) { // the next reading halves it
            (void)reference_reaction_step(&ahead, start);
        }
        counts = mean_at_a_bound(&ahead) / ahead.scale - ahead.reach;
        counts = counts > ahead.reach ? ahead.reach : counts;
        counts = counts < -ahead.reach - 1 ? -ahead.reach - 1 : counts;
        steps = reference.n == 8 ? 2 * reference.left : reference.left;
        reads((unsigned)steps, (int16_t)counts);
    }
}

void test_step_at_the_bounds_of_each_verdict_is_as_defined(void)
{
    unsigned seen = 0;

    numbers_seed(12);
    for (unsigned turn = 0; turn < TEST_MEMORIES / 8u; turn++) {
        const int16_t noise = (int16_t)(numbers_any_size() & 0x1FFu);

        config.measurement_stop =
            (int16_t)(numbers_one_in(2) ? 8193u + numbers_below(8192)
                                        : numbers_any_size() & 0x7FFFu);
        config.timeout_steps = (uint16_t)(1u + numbers_below(40));
        TEST_ASSERT_TRUE(init());
        reads(2, 0);
        reads(6, noise);
        reads(8, (int16_t)-noise);
        reads(16, 0);
        heat_at_the_bounds();
        results_are_as_defined();
        seen |= 1u << fixpid_reaction_status(&reaction_controller);
    }
    TEST_ASSERT_EQUAL_HEX(
        1u << FIXPID_REACTION_DONE | 1u << FIXPID_REACTION_NO_MOVEMENT |
            1u << FIXPID_REACTION_WRONG_WAY | 1u << FIXPID_REACTION_LIMIT |
            1u << FIXPID_REACTION_LEVELS_OFF,
        seen);
}

// Of every slope in 64ths of a count, on a sensor with a band of 3 or without.
void test_step_ramps_of_each_slope_are_as_defined(void)
{
    config.measurement_stop = 16384;
    for (int32_t slope = 1; slope <= (int32_t)(TEST_MEMORIES / 50u); slope++) {
        int32_t at = 0;

        TEST_ASSERT_TRUE(init());
        reads(16, (int16_t)(slope % 2 * 3));
        reads(16, 0);
        while (fixpid_reaction_status(&reaction_controller) ==
               FIXPID_REACTION_RUNNING) {
            at += slope;
            reads(1, (int16_t)(at / 64));
        }
        results_are_as_defined();
    }
}

void test_step_random_experiments_are_as_defined(void)
{
    uint32_t steps = 0;

    numbers_seed(45);
    while (steps < TEST_RANDOM_STEPS) {
        numbers_reaction_config(&config);
        (void)init();
        do {
            if (numbers_one_in(2000)) {
                reset();
            }
            numbers_reaction_move(read(numbers_reaction_measure()));
            steps++;
        } while (fixpid_reaction_status(&reaction_controller) ==
                 FIXPID_REACTION_RUNNING);
        results_are_as_defined();
    }
}

// Each call is defined, which the sanitizers see, an output is one of three,
// and it ends.
void test_step_of_any_bytes_ends(void)
{
    struct fixpid_reaction_process process;
    struct fixpid_pid_gains gains;

    numbers_seed(21);
    for (unsigned turn = 0; turn < TEST_MEMORIES; turn++) {
        int16_t output;

        numbers_fill(&reaction_controller, sizeof reaction_controller);
        if (numbers_one_in(2)) {
            reaction_controller.state = (uint8_t)numbers_below(10);
        }
        (void)fixpid_reaction_model(&reaction_controller, &process);
        (void)fixpid_reaction_result(&reaction_controller,
                                     (uint8_t)numbers_below(2), 16, &gains);
        output = fixpid_reaction_step(&reaction_controller, numbers_int16());
        TEST_ASSERT_TRUE(output == reaction_controller.output_rest ||
                         output == reaction_controller.output_drive ||
                         output == 0);
        TEST_ASSERT_TRUE(fixpid_reaction_progress(&reaction_controller) <= 100);
    }
    numbers_fill(&reaction_controller, sizeof reaction_controller);
    reaction_controller.state = 200;
    for (uint32_t i = 0; i < 300000; i++) {
        (void)fixpid_reaction_step(&reaction_controller,
                                   reaction_controller.start);
    }
    TEST_ASSERT_NOT_EQUAL(FIXPID_REACTION_RUNNING,
                          fixpid_reaction_status(&reaction_controller));
}
