// SPDX-License-Identifier: MIT
// What fixpid_autotune makes of an experiment that is over: model, gains or a
// reason, and a record.
#include <string.h>

#include "crc16.h"
#include "fixpid_autotune.h"
#include "numbers.h"
#include "unity.h"

TEST_SOURCE_FILE("src/autotune/fixpid_autotune.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_cycle.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_more.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_record.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_relay.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_result.c")

#define PI FIXPID_AUTOTUNE_PI
#define PID FIXPID_AUTOTUNE_PID
#define FINE FIXPID_AUTOTUNE_NO_REASON
#define SHAPE FIXPID_AUTOTUNE_SHAPE
#define TWO_PROCESSES FIXPID_AUTOTUNE_TWO_PROCESSES
#define RUNS_AWAY FIXPID_AUTOTUNE_RUNS_AWAY
#define GAIN_TOO_LARGE FIXPID_AUTOTUNE_GAIN_TOO_LARGE
#define GAIN_TOO_SMALL FIXPID_AUTOTUNE_GAIN_TOO_SMALL
#define COUNT(table) (sizeof(table) / sizeof(table)[0])

FIXPID_DATA struct fixpid_autotune autotune_controller;
static struct fixpid_autotune_config config;

static bool init(void)
{
    return fixpid_autotune_init(&autotune_controller, &config);
}

static int16_t step(int16_t deviation)
{
    return fixpid_autotune_step(&autotune_controller, 0, deviation);
}

static void is(uint8_t expected)
{
    TEST_ASSERT_EQUAL_UINT8(expected,
                            fixpid_autotune_status(&autotune_controller));
}

void setUp(void)
{
    config = (struct fixpid_autotune_config){.output_min = -300,
                                             .output_max = 300,
                                             .output_rest = 77,
                                             .measurement_min = INT16_MIN,
                                             .measurement_max = INT16_MAX,
                                             .timeout_steps = 1000,
                                             .cycles = 1};
}

void tearDown(void)
{
}

// No model and no gains by a rule, for this reason, and nothing is written.
static void has_none(uint8_t rule, uint8_t robustness_q4, uint8_t cause)
{
    struct fixpid_autotune_process process;
    struct fixpid_autotune_process process_before;
    struct fixpid_pid_config pid;
    struct fixpid_pid_config pid_before;

    memset(&process, 0xA5, sizeof process);
    memset(&pid, 0xA5, sizeof pid);
    memcpy(&process_before, &process, sizeof process);
    memcpy(&pid_before, &pid, sizeof pid);
    TEST_ASSERT_EQUAL_UINT8(cause, fixpid_autotune_reason(&autotune_controller,
                                                          rule, robustness_q4));
    TEST_ASSERT_FALSE(fixpid_autotune_result(&autotune_controller, rule,
                                             robustness_q4, &pid));
    TEST_ASSERT_EQUAL_MEMORY(&pid_before, &pid, sizeof pid);
    if (rule == PI && cause != FIXPID_AUTOTUNE_NOT_LEGAL &&
        cause < GAIN_TOO_LARGE) { // not for the rule's sake
        TEST_ASSERT_FALSE(
            fixpid_autotune_model(&autotune_controller, &process));
        TEST_ASSERT_EQUAL_MEMORY(&process_before, &process, sizeof process);
    }
}

// ---- The model and the gains ----

// Of a lag with dead time, and of an integrator with a lag. The numbers of
// these tests were made by another program, in 64 bits.
static const struct fixpid_autotune lag = {
    .state = FIXPID_AUTOTUNE_DONE,
    .last_period = 136,
    .highest = 288,
    .lowest = -200,
    .noise = 92,
    .edge = 84,
    .centre = 604,
    .half = 243,
    .config = {-1000, 1000, 400, -32768, 32767, 450, 1000, 1, 0},
    .sums = {{11485, -12402, 392, 271, 114}, {-8049, -14216, 198, 134, 81}}};

static const struct fixpid_autotune integrator = {
    .state = FIXPID_AUTOTUNE_DONE,
    .last_period = 61,
    .highest = 41,
    .lowest = -32,
    .noise = 97,
    .edge = 15,
    .centre = 396,
    .half = 332,
    .config = {0, 1000, 440, -32768, 32767, 85, 1000, 2, 1},
    .sums = {{1680, -1452, 169, 247, 100}, {-628, -1404, 85, 139, 84}}};

static struct fixpid_autotune_process model(void)
{
    struct fixpid_autotune_process process;

    memset(&process, 0xA5, sizeof process);
    TEST_ASSERT_TRUE(fixpid_autotune_model(&autotune_controller, &process));
    return process;
}

static void is_model(uint32_t gain_q8, uint32_t lag_q4, uint32_t dead_q4,
                     uint32_t slope_q24, int16_t holding, uint16_t noise_q4)
{
    const struct fixpid_autotune_process process = model();

    TEST_ASSERT_EQUAL_UINT32(gain_q8, process.gain_q8);
    TEST_ASSERT_EQUAL_UINT32(lag_q4, process.lag_q4);
    TEST_ASSERT_EQUAL_UINT32(dead_q4, process.dead_q4);
    TEST_ASSERT_EQUAL_UINT32(slope_q24, process.slope_q24);
    TEST_ASSERT_EQUAL_INT16(holding, process.holding);
    TEST_ASSERT_EQUAL_UINT16(noise_q4, process.noise_q4);
    TEST_ASSERT_EQUAL_UINT16(autotune_controller.edge, process.hysteresis);
}

static void has_model_of(const struct fixpid_autotune *experiment)
{
    if (experiment == &lag) {
        is_model(369, 775, 760, 499064, 600, 23);
    } else {
        is_model(FIXPID_AUTOTUNE_INTEGRATING, FIXPID_AUTOTUNE_INTEGRATING, 263,
                 107780, 441, 24);
    }
}

static void same_gains(struct fixpid_pid_gains expected,
                       struct fixpid_pid_gains found)
{
    TEST_ASSERT_EQUAL_UINT16(expected.kp_q8, found.kp_q8);
    TEST_ASSERT_EQUAL_UINT32(expected.ki_q24, found.ki_q24);
    TEST_ASSERT_EQUAL_UINT16(expected.kd_q8, found.kd_q8);
    TEST_ASSERT_EQUAL_UINT8(expected.derivative_filter,
                            found.derivative_filter);
}

// What a function leaves unset on the stack is a large number.
static void fill_stack(void)
{
    volatile uint8_t bytes[512];

    for (unsigned i = 0; i < sizeof bytes; i++) {
        bytes[i] = 1;
    }
}

// And nothing else but a setpoint weight of 1 and no proportional on
// measurement.
static void has_gains(uint8_t rule, uint8_t robustness_q4,
                      struct fixpid_pid_gains expected)
{
    for (unsigned i = 0; i < 2; i++) {
        struct fixpid_pid_config pid;

        memset(&pid, i == 0 ? 0 : 0xFF, sizeof pid);
        pid.reverse = i != 0;
        pid.derivative_on_error = i != 0;
        pid.proportional_on_measurement = true;
        fill_stack();
        TEST_ASSERT_EQUAL_UINT8(
            FINE,
            fixpid_autotune_reason(&autotune_controller, rule, robustness_q4));
        TEST_ASSERT_TRUE(fixpid_autotune_result(&autotune_controller, rule,
                                                robustness_q4, &pid));
        same_gains(expected, pid.gains);
        TEST_ASSERT_EQUAL_UINT16(256, pid.setpoint_weight_q8);
        TEST_ASSERT_FALSE(pid.proportional_on_measurement);
        TEST_ASSERT_EQUAL(i != 0, pid.reverse);
        TEST_ASSERT_EQUAL(i != 0, pid.derivative_on_error);
        TEST_ASSERT_EQUAL_INT16(i == 0 ? 0 : -1, pid.output_min);
        TEST_ASSERT_EQUAL_INT16(i == 0 ? 0 : -1, pid.output_max);
        TEST_ASSERT_EQUAL_INT16(i == 0 ? 0 : -1, pid.integral_min);
        TEST_ASSERT_EQUAL_INT16(i == 0 ? 0 : -1, pid.integral_max);
    }
}

static const struct {
    const struct fixpid_autotune *of;
    uint8_t rule, robustness_q4;
    struct fixpid_pid_gains gains;
} results[] = {
    {&lag, PI, 8, {151, 135920, 0, 0}},
    {&lag, PI, 16, {115, 103938, 0, 0}},
    {&lag, PI, 32, {78, 70680, 0, 0}},
    {&lag, PI, 64, {48, 43097, 0, 0}},
    {&lag, PID, 8, {132, 169088, 525, 1}},
    {&lag, PID, 16, {109, 124788, 535, 1}},
    {&lag, PID, 32, {84, 81402, 552, 1}},
    {&lag, PID, 64, {64, 47637, 289, 2}},
    {&integrator, PI, 8, {1494, 917760, 0, 0}},
    {&integrator, PI, 16, {1143, 536704, 0, 0}},
    {&integrator, PI, 32, {777, 248164, 0, 0}},
    {&integrator, PI, 64, {474, 92268, 0, 0}},
    {&integrator, PID, 8, {2698, 2658112, 4497, 1}},
    {&integrator, PID, 16, {2063, 1554464, 4497, 1}},
    {&integrator, PID, 32, {1403, 718752, 4497, 1}},
    {&integrator, PID, 64, {855, 267232, 4497, 1}},
};

void test_result_and_model_a_lag_and_an_integrator_have_theirs(void)
{
    for (unsigned i = 0; i < COUNT(results); i++) {
        autotune_controller = *results[i].of;
        has_gains(results[i].rule, results[i].robustness_q4, results[i].gains);
        has_model_of(results[i].of);
    }
}

void test_result_no_other_rule_and_robustness_is_legal(void)
{
    static const uint8_t illegal[] = {0, 7, 65, 255};

    autotune_controller = lag;
    for (unsigned i = 0; i < COUNT(illegal); i++) {
        has_none(PI, illegal[i], FIXPID_AUTOTUNE_NOT_LEGAL);
        has_none(PID, illegal[i], FIXPID_AUTOTUNE_NOT_LEGAL);
    }
    has_none(2, 16, FIXPID_AUTOTUNE_NOT_LEGAL);
    has_none(255, 16, FIXPID_AUTOTUNE_NOT_LEGAL);
}

void test_result_unless_done_there_are_no_gains(void)
{
    autotune_controller = lag;
    for (unsigned state = 0; state <= 255u; state++) {
        autotune_controller.state = (uint8_t)state;
        if (state != FIXPID_AUTOTUNE_DONE) {
            has_none(PI, 16, FIXPID_AUTOTUNE_NOT_DONE);
            has_none(2, 7, FIXPID_AUTOTUNE_NOT_DONE); // which comes first
        }
    }
}

// Sums of waves without noise, one beside the other where a reason begins or a
// limit of the gains is. With relays of full range, and a swing of `highest`
// and as much below.
// clang-format off
#define NONE {0, 0, 0, 0}
static const struct {
    struct fixpid_autotune_sums sums[2];
    uint16_t half;
    int16_t highest;
    uint8_t rule, robustness_q4, cause;
    struct fixpid_pid_gains gains;
} waves[] = {
    // ROUND above 0.3, which a larger swing takes from it, for PID
    {{{0, -1000, 100, 60, 20}, {0, -500, 50, 30, 20}}, 200, 131,
     PID, 16, FINE, {342, 329248, 364, 1}},
    {{{0, -1000, 100, 60, 20}, {0, -500, 50, 30, 20}}, 200, 132,
     PID, 16, SHAPE, NONE},
    {{{0, -1000, 100, 60, 20}, {0, -500, 50, 30, 20}}, 200, 132,
     PI, 16, FINE, {381, 366384, 0, 0}},
    // CHI at most 1.5, for PID
    {{{0, -1000, 872, 60, 20}, {0, -500, 50, 30, 20}}, 200, 30,
     PID, 16, FINE, {970, 2120960, 782, 1}},
    {{{0, -1000, 873, 60, 20}, {0, -500, 50, 30, 20}}, 200, 30,
     PID, 16, SHAPE, NONE},
    {{{0, -1000, 873, 60, 20}, {0, -500, 50, 30, 20}}, 200, 30,
     PI, 16, FINE, {490, 622784, 0, 0}},
    // One that falls takes no time.
    {{{0, -1000, -100, 60, 20}, {0, -500, 50, 30, 20}}, 200, 30,
     PI, 16, FINE, {66, 11514, 0, 0}},
    {{{0, -1000, 100, 60, 20}, {0, -500, -50, 30, 20}}, 200, 30,
     PI, 16, FINE, {66, 11514, 0, 0}},
    // The least area is 1.
    {{{0, -2, 0, 4, 2}, {0, -1, 0, 2, 1}}, 200, 0,
     PI, 16, FINE, {1840, 2888064, 0, 0}},
    {{{0, 0, 0, 4, 2}, {0, -1, 0, 2, 1}}, 200, 0, PI, 16, SHAPE, NONE},
    {{{0, -2, 0, 4, 2}, {0, 0, 0, 2, 1}}, 200, 0, PI, 16, SHAPE, NONE},
    {{{0, -2, 0, 4, 2}, {0, 1, 0, 2, 1}}, 200, 0, PI, 16, SHAPE, NONE},
    // Slopes that are half of their mean apart: a PI has the larger one.
    {{{0, -1000, 100, 60, 20}, {0, -871, 50, 30, 20}}, 200, 30,
     PI, 16, FINE, {59, 11601, 0, 0}},
    {{{0, -1000, 100, 60, 20}, {0, -871, 50, 30, 20}}, 200, 30,
     PID, 16, FINE, {116, 39505, 601, 1}},
    {{{0, -1000, 100, 60, 20}, {0, -872, 50, 30, 20}}, 200, 30,
     PI, 16, FINE, {47, 9267, 0, 0}},
    {{{0, -1000, 100, 60, 20}, {0, -872, 50, 30, 20}}, 200, 30,
     PID, 16, TWO_PROCESSES, NONE},
    {{{0, -1743, 100, 60, 20}, {0, -500, 50, 30, 20}}, 200, 30,
     PID, 16, FINE, {116, 39477, 601, 1}},
    {{{0, -1744, 100, 60, 20}, {0, -500, 50, 30, 20}}, 200, 30,
     PID, 16, TWO_PROCESSES, NONE},
    {{{0, -1744, 100, 60, 20}, {0, -500, 50, 30, 20}}, 200, 30,
     PI, 16, FINE, {47, 9267, 0, 0}},
    // Less mean output, and R above 0.06.
    {{{11485, -12402, 392, 271, 69}, {-8049, -17000, 198, 134, 81}}, 243, 240,
     PI, 16, FINE, {52, 5839, 0, 0}},
    {{{11485, -12402, 392, 271, 68}, {-8049, -17000, 198, 134, 81}}, 243, 240,
     PI, 16, RUNS_AWAY, NONE},
    // Which a PI minds unless the slopes are above a fifth of their mean apart.
    {{{11485, -12402, 392, 271, 63}, {-8049, -15778, 198, 134, 81}}, 243, 240,
     PI, 16, RUNS_AWAY, NONE},
    {{{11485, -12402, 392, 271, 63}, {-8049, -15777, 198, 134, 81}}, 243, 240,
     PI, 16, FINE, {46, 4655, 0, 0}},
    {{{11485, -12402, 392, 271, 63}, {-8049, -15777, 198, 134, 81}}, 243, 240,
     PID, 16, RUNS_AWAY, NONE},
    // More by 1/256 of a count.
    {{{6, -300000, 0, 1536, 513}, {0, -150000, 0, 768, 512}}, 2, 0,
     PI, 16, GAIN_TOO_SMALL, NONE},
    // kp, ki and kd of 32767, 8..0x7FFF0000 and 32255. (A kp of 0 is legal.)
    {{{0, -154, 0, 30, 10}, {0, -77, 0, 15, 10}}, 9075, 34,
     PI, 8, FINE, {32767, 34981888, 0, 0}},
    {{{0, -168, 0, 54, 18}, {0, -84, 0, 27, 18}}, 6837, 14,
     PI, 16, GAIN_TOO_LARGE, NONE},
    {{{-2, -58, 13, 12, 10}, {-20, -14, 2, 3, 1}}, 3626, 21,
     PI, 8, FINE, {30667, 2147418112, 0, 0}},
    {{{-2, -58, 13, 12, 10}, {-20, -14, 2, 3, 1}}, 3627, 21,
     PI, 8, GAIN_TOO_LARGE, NONE},
    {{{0, -32570, 44, 30, 10}, {0, -16285, 22, 15, 10}}, 7, 37,
     PI, 16, FINE, {0, 8, 0, 0}},
    {{{0, -43764, 0, 102, 34}, {0, -21882, 0, 51, 34}}, 8, 575,
     PI, 16, GAIN_TOO_SMALL, NONE},
    {{{0, -1976, 0, 114, 38}, {0, -988, 0, 57, 38}}, 9196, 96,
     PID, 16, FINE, {7780, 1921600, 32255, 1}},
    {{{0, -51522, 76, 8568, 2856}, {0, -25761, 38, 4284, 2856}}, 903, 58,
     PID, 8, GAIN_TOO_LARGE, NONE},
};
// clang-format on

static void take(const struct fixpid_autotune_sums sums[2], uint16_t half,
                 int16_t highest)
{
    config.output_min = INT16_MIN;
    config.output_max = INT16_MAX;
    TEST_ASSERT_TRUE(init());
    autotune_controller.state = FIXPID_AUTOTUNE_DONE;
    autotune_controller.sums[0] = sums[0];
    autotune_controller.sums[1] = sums[1];
    autotune_controller.half = half;
    autotune_controller.highest = highest;
    autotune_controller.lowest = (int16_t)-highest;
}

void test_reason_says_why_there_are_no_gains(void)
{
    for (unsigned i = 0; i < COUNT(waves); i++) {
        const uint8_t rule = waves[i].rule;
        const uint8_t robustness_q4 = waves[i].robustness_q4;

        take(waves[i].sums, waves[i].half, waves[i].highest);
        if (waves[i].cause == FINE) {
            has_gains(rule, robustness_q4, waves[i].gains);
            (void)model();
        } else {
            has_none(rule, robustness_q4, waves[i].cause);
        }
    }
}

// Flipped bits may have made any sums of either relay's.
static void with_sums(struct fixpid_autotune_sums sums, bool sensible)
{
    for (unsigned relay = 0; relay < 2; relay++) {
        autotune_controller = lag;
        autotune_controller.sums[relay] = sums;
        if (sensible) {
            TEST_ASSERT_NOT_EQUAL_UINT8(
                SHAPE, fixpid_autotune_reason(&autotune_controller, PI, 16));
        } else {
            has_none(PI, 16, SHAPE);
        }
    }
}

void test_reason_no_area_or_one_side_alone_is_no_shape(void)
{
    static const struct {
        struct fixpid_autotune_sums sums;
        bool sensible;
    } rows[] = {
        {{0, -1, 0, 40, 20}, true},
        {{0, 0, 0, 40, 20}, false},
        {{0, 1, 0, 40, 20}, false},
        {{0, -32767, 0, 32767, 0}, false},
        {{0, -32767, 0, 32767, 1}, true},
        {{0, -32767, 0, 32767, 32766}, true},
        {{0, -32767, 0, 32767, 32767}, false},
        {{INT32_MIN, INT32_MIN, -32768, 65534u, 65535u}, false},
        {{INT32_MIN, INT32_MIN, -32768, 65535u, 65534u}, true},
    };

    for (unsigned i = 0; i < COUNT(rows); i++) {
        with_sums(rows[i].sums, rows[i].sensible);
    }
}

// The two mean deviations, in 1/256 of a count, differ by this much, of a swing
// of 40 counts.
static bool has_a_gain(int32_t measured)
{
    const struct fixpid_autotune_sums sums[2] = {
        {measured, measured * 3 / 8 - 3000, 0, 256, 96},
        {0, -1500, 0, 128, 80}};

    take(sums, 100, 20);
    return model().gain_q8 != FIXPID_AUTOTUNE_INTEGRATING;
}

void test_model_a_difference_above_a_16th_of_the_swing_is_a_gain(void)
{
    TEST_ASSERT_FALSE(has_a_gain(640));
    TEST_ASSERT_TRUE(has_a_gain(641));
}

// The same wave so many counts higher; the gain is 369 / 256.
static int16_t holding(const struct fixpid_autotune *experiment, int32_t counts)
{
    autotune_controller = *experiment;
    for (unsigned relay = 0; relay < 2; relay++) {
        struct fixpid_autotune_sums *const sums =
            &autotune_controller.sums[relay];

        sums->all += counts * sums->steps;
        sums->on += counts * sums->on_steps;
    }
    return model().holding;
}

void test_model_the_holding_output_is_the_nearest_one_within_the_range(void)
{
    static const int16_t rows[][2] = {
        {0, 600},     {1, 600},     {2, 599},     {-574, 999},   {-575, 1000},
        {-576, 1000}, {-577, 1000}, {2304, -999}, {2305, -1000}, {2306, -1000}};

    for (unsigned i = 0; i < COUNT(rows); i++) {
        TEST_ASSERT_EQUAL_INT16(rows[i][1], holding(&lag, rows[i][0]));
    }
}

// Mean outputs of an integrator that are 256 and 0, and 255 and 0, in 1/256 of
// a count.
void test_model_a_holding_output_of_a_half_is_rounded_up(void)
{
    static const struct fixpid_autotune_sums half[2] = {{0, -11400, 0, 200, 67},
                                                        {0, -5700, 0, 102, 68}};
    static const struct fixpid_autotune_sums less[2] = {
        {0, -400000, 0, 1203, 403}, {0, -200000, 0, 600, 400}};

    take(half, 200, 30);
    TEST_ASSERT_EQUAL_INT16(1, model().holding);
    take(less, 200, 30);
    TEST_ASSERT_EQUAL_INT16(0, model().holding);
}

// Of next to no gain the mean deviation takes more output than 32 bits hold.
void test_model_a_holding_output_far_beyond_the_range_is_at_its_end(void)
{
    static const struct fixpid_autotune_sums sums[2] = {{16, -53, 22, 30, 14},
                                                        {-21, -46, 14, 16, 9}};
    struct fixpid_autotune far;

    take(sums, 10900, 8);
    far = autotune_controller;
    TEST_ASSERT_EQUAL_INT16(INT16_MIN, holding(&far, 32700));
    TEST_ASSERT_EQUAL_INT16(INT16_MAX, holding(&far, -32700));
}

// Its time constant is about 2^n steps, 2 at least, and one more does not fit a
// quarter of Td, which grows with the period.
void test_result_the_filter_lags_at_most_a_quarter_of_td(void)
{
    static const struct {
        uint16_t third; // of the period
        uint8_t filter;
    } rows[] = {{2, 1},  {10, 1},  {11, 2},  {21, 2},
                {22, 3}, {351, 6}, {352, 7}, {5461, 7}};

    for (unsigned i = 0; i < COUNT(rows); i++) {
        const uint16_t third = rows[i].third;
        struct fixpid_autotune_sums sums[2] = {
            {.on = -100 * (int32_t)third, .on_steps = (uint16_t)(2 * third)},
            {.on = -50 * (int32_t)third, .on_steps = (uint16_t)(2 * third)}};
        struct fixpid_pid_config pid;

        sums[0].steps = (uint16_t)(6 * third);
        sums[1].steps = (uint16_t)(3 * third);
        take(sums, 200, 30);
        TEST_ASSERT_TRUE(
            fixpid_autotune_result(&autotune_controller, PID, 16, &pid));
        TEST_ASSERT_EQUAL_UINT8(rows[i].filter, pid.gains.derivative_filter);
        TEST_ASSERT_TRUE(
            fixpid_autotune_result(&autotune_controller, PI, 16, &pid));
        TEST_ASSERT_EQUAL_UINT8(0, pid.gains.derivative_filter);
    }
}

// Nothing undefined comes of any bytes, which the sanitizers see, and it ends.
void test_result_of_any_bytes_is_legal(void)
{
    unsigned given = 0;

    numbers_seed(66);
    for (unsigned turn = 0; turn < 3000u; turn++) {
        const uint8_t rule = (uint8_t)(turn % 2u);
        struct fixpid_autotune_process process;
        struct fixpid_pid_config pid = {0};

        numbers_fill(&autotune_controller, sizeof autotune_controller);
        autotune_controller.state = FIXPID_AUTOTUNE_DONE;
        autotune_controller.config.cycles &= 7u; // 0 divides by nothing
        for (unsigned relay = 0; relay < 2u; relay++) {
            struct fixpid_autotune_sums *const sums =
                &autotune_controller.sums[relay];

            sums->steps >>= 1;
            sums->on_steps = (uint16_t)(sums->on_steps & sums->steps);
            sums->all /= (int32_t)(1u << (turn & 15u));
            sums->on = -((sums->on & INT32_MAX) >> (turn & 15u));
        }
        if ((turn & 16u) != 0) { // as of one process
            autotune_controller.sums[0] = autotune_controller.sums[1];
        }
        (void)fixpid_autotune_model(&autotune_controller, &process);
        if (fixpid_autotune_result(&autotune_controller, rule, 16, &pid)) {
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
    TEST_ASSERT_GREATER_THAN_UINT(30, given);
}

// ---- The record ----

// Every number of it in other bytes, as the header's table has them; the check
// is by hand.
static const struct fixpid_autotune packed = {
    .state = FIXPID_AUTOTUNE_TOO_SLOW,
    .centre = -2057,
    .half = 0x0A0B,
    .last_period = 0x0C0D,
    .edge = 0x0E0F,
    .noise = 0x1011,
    .highest = 0x1213,
    .lowest = -5141,
    .config = {-2, 0x0103, 5, -260, 0x0403, 0x0810, 0x0506, 3, 1},
    .sums = {{INT32_C(-0x01020305), 0x0A0B0C0D, -3855, 0x1112, 0x1314},
             {0x05060708, INT32_C(-0x03030304), 0x0203, 0x0405, 0x0607}}};

static const uint8_t packed_bytes[FIXPID_AUTOTUNE_RECORD_SIZE] = {
    0x03, 0xFE, 0xFF, 0x03, 0x01, 0x05, 0x00, 0xFC, 0xFE, 0x03, 0x04,
    0x10, 0x08, 0x06, 0x05, 0x03, 0x01, 0x08, 0xFB, 0xFC, 0xFD, 0xFE,
    0x0D, 0x0C, 0x0B, 0x0A, 0xF1, 0xF0, 0x12, 0x11, 0x14, 0x13, 0x08,
    0x07, 0x06, 0x05, 0xFC, 0xFC, 0xFC, 0xFC, 0x03, 0x02, 0x05, 0x04,
    0x07, 0x06, 0xF7, 0xF7, 0x0B, 0x0A, 0x0D, 0x0C, 0x0F, 0x0E, 0x11,
    0x10, 0x13, 0x12, 0xEB, 0xEB, 0xE5, 0x96};

#define CHECK_AT 60u
#define STATUS_AT 17u
#define REVERSE_AT 16u

static struct fixpid_autotune_record record;

// So that only what was changed is wrong, or nothing.
static void make_check(void)
{
    const uint16_t check = crc16(record.bytes, CHECK_AT, 0xFFFF);

    record.bytes[CHECK_AT] = (uint8_t)(check & 0xFFu);
    record.bytes[CHECK_AT + 1u] = (uint8_t)(check >> 8);
}

static bool pack(void)
{
    memset(&record, 0xA5, sizeof record);
    return fixpid_autotune_pack(&autotune_controller, &record);
}

// And has written nothing.
static void is_not_unpacked(void)
{
    struct fixpid_autotune before;

    memset(&autotune_controller, 0x5A, sizeof autotune_controller);
    memcpy(&before, &autotune_controller, sizeof before);
    TEST_ASSERT_FALSE(fixpid_autotune_unpack(&autotune_controller, &record));
    TEST_ASSERT_EQUAL_MEMORY(&before, &autotune_controller, sizeof before);
}

void test_pack_writes_the_bytes_of_the_headers_table(void)
{
    autotune_controller = packed;
    TEST_ASSERT_TRUE(pack());
    TEST_ASSERT_EQUAL_UINT(62, sizeof record);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(packed_bytes, record.bytes, sizeof record);
    autotune_controller.config.reverse = 0x80; // a flipped bit
    TEST_ASSERT_TRUE(pack());
    TEST_ASSERT_EQUAL_HEX8(1, record.bytes[REVERSE_AT]);
    autotune_controller.config.reverse = 0;
    TEST_ASSERT_TRUE(pack());
    TEST_ASSERT_EQUAL_HEX8(0, record.bytes[REVERSE_AT]);
}

// Nothing but its configuration and, if it ended behind the noise, that and the
// last deviation.
void test_pack_of_an_experiment_that_ended_early_is_0(void)
{
    static const uint8_t nothing[42];

    TEST_ASSERT_TRUE(init());
    step(INT16_MAX);
    TEST_ASSERT_TRUE(pack());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(nothing, &record.bytes[18], sizeof nothing);
    TEST_ASSERT_TRUE(init());
    for (unsigned i = 1; i < 34; i++) {
        step(0);
    }
    step(-3);
    step(INT16_MAX);
    TEST_ASSERT_EQUAL_INT16(-3, autotune_controller.highest);
    TEST_ASSERT_EQUAL_INT16(-3, autotune_controller.lowest);
}

static void remakes(const struct fixpid_autotune_record *made)
{
    numbers_fill(&autotune_controller, sizeof autotune_controller);
    TEST_ASSERT_TRUE(fixpid_autotune_unpack(&autotune_controller, made));
    TEST_ASSERT_TRUE(pack());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(made->bytes, record.bytes, sizeof record);
}

void test_unpack_gives_what_was_packed(void)
{
    struct fixpid_autotune_record made;

    memcpy(made.bytes, packed_bytes, sizeof made);
    remakes(&made);
    TEST_ASSERT_EQUAL_MEMORY(&packed.config, &autotune_controller.config,
                             sizeof packed.config);
    TEST_ASSERT_EQUAL_INT16(5, step(0));
    for (uint8_t state = FIXPID_AUTOTUNE_DONE;
         state <= FIXPID_AUTOTUNE_TOO_SLOW; state++) {
        record.bytes[STATUS_AT] = state;
        record.bytes[REVERSE_AT] ^= 1u;
        make_check();
        made = record;
        remakes(&made);
        is(state);
    }
}

// All functions answer as they did before, and reset starts it again.
void test_unpack_answers_like_the_experiment_that_was_packed(void)
{
    for (unsigned i = 0; i < COUNT(results); i++) {
        struct fixpid_autotune_stage stage;

        autotune_controller = *results[i].of;
        TEST_ASSERT_TRUE(pack());
        numbers_fill(&autotune_controller, sizeof autotune_controller);
        TEST_ASSERT_TRUE(fixpid_autotune_unpack(&autotune_controller, &record));
        is(FIXPID_AUTOTUNE_DONE);
        has_gains(results[i].rule, results[i].robustness_q4, results[i].gains);
        has_model_of(results[i].of);
        TEST_ASSERT_EQUAL_INT16(results[i].of->config.output_rest, step(0));
        fixpid_autotune_progress(&autotune_controller, &stage);
        TEST_ASSERT_EQUAL_UINT8(7 + 3 * results[i].of->config.cycles,
                                stage.done);
        TEST_ASSERT_EQUAL_UINT16(results[i].of->last_period, stage.period);
        fixpid_autotune_reset(&autotune_controller);
        is(FIXPID_AUTOTUNE_RUNNING);
    }
}

void test_pack_refuses_an_experiment_that_is_not_over(void)
{
    struct fixpid_autotune_record before;

    memset(&before, 0xA5, sizeof before);
    for (unsigned state = 0; state <= 255u; state++) {
        const bool over = state >= 2u && state <= 8u;

        autotune_controller = packed;
        autotune_controller.state = (uint8_t)state;
        TEST_ASSERT_EQUAL(over, pack());
        if (!over) {
            TEST_ASSERT_EQUAL_MEMORY(&before, &record, sizeof record);
        }
    }
    TEST_ASSERT_TRUE(init());
    TEST_ASSERT_FALSE(pack());
}

void test_unpack_refuses_what_pack_does_not_make(void)
{
    for (unsigned value = 0; value <= 255u; value++) {
        memcpy(record.bytes, packed_bytes, sizeof record);
        if (value != FIXPID_AUTOTUNE_RECORD_VERSION) {
            record.bytes[0] = (uint8_t)value;
            make_check();
            is_not_unpacked();
        }
        memcpy(record.bytes, packed_bytes, sizeof record);
        if (value > 1u) {
            record.bytes[REVERSE_AT] = (uint8_t)value;
            make_check();
            is_not_unpacked();
        }
        memcpy(record.bytes, packed_bytes, sizeof record);
        if (value < 2u || value > 8u) {
            record.bytes[STATUS_AT] = (uint8_t)value;
            make_check();
            is_not_unpacked();
        }
    }
    for (uint8_t cycles = 0; cycles <= 5u; cycles++) { // as init refuses them
        autotune_controller = packed;
        autotune_controller.config.cycles = cycles;
        TEST_ASSERT_TRUE(pack());
        if (cycles >= 1u && cycles <= 4u) {
            TEST_ASSERT_TRUE(
                fixpid_autotune_unpack(&autotune_controller, &record));
        } else {
            is_not_unpacked();
        }
    }
}

// A wrong bit changes the check by a power of x that has an odd number of bits,
// and each by another. So two make no third, and no two are the same.
void test_unpack_any_1_2_or_3_wrong_bits_are_noticed(void)
{
    bool taken[8u * FIXPID_AUTOTUNE_RECORD_SIZE] = {false};

    for (unsigned bit = 0; bit < COUNT(taken); bit++) {
        uint8_t wrong[FIXPID_AUTOTUNE_RECORD_SIZE] = {0};
        uint16_t power = 1;
        uint16_t change;
        unsigned n = 0;

        memcpy(record.bytes, packed_bytes, sizeof record);
        wrong[bit / 8u] = (uint8_t)(1u << bit % 8u);
        record.bytes[bit / 8u] ^= wrong[bit / 8u];
        is_not_unpacked();
        change = (uint16_t)(crc16(wrong, CHECK_AT, 0) ^ wrong[CHECK_AT] ^
                            wrong[CHECK_AT + 1u] * 256u);
        while (n < COUNT(taken) && power != change) {
            power = (uint16_t)((power & 0x7FFFu) << 1 ^
                               ((power & 0x8000u) != 0 ? 0x1021u : 0u));
            n++;
        }
        TEST_ASSERT_LESS_THAN_UINT(COUNT(taken), n);
        TEST_ASSERT_FALSE(taken[n]);
        taken[n] = true;
        while (change > 1u) {
            change = (uint16_t)(change >> 1 ^ (change & 1u));
        }
        TEST_ASSERT_EQUAL_UINT16(1, change);
    }
}
