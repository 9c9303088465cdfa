// SPDX-License-Identifier: MIT
#include <string.h>

#include "fixpid_autotune.h"
#include "numbers.h"
#include "poison.h"
#include "unity.h"

TEST_SOURCE_FILE("src/autotune/fixpid_autotune.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_cycle.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_more.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_record.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_relay.c")
TEST_SOURCE_FILE("src/autotune/fixpid_autotune_result.c")

#define REST 77
#define NOISE_STEPS 34
#define OVER 6
#define COUNT(table) (sizeof(table) / sizeof(table)[0])

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

static struct fixpid_autotune_stage progress(void)
{
    struct fixpid_autotune_stage stage;

    memset(&stage, 0xA5, sizeof stage);
    fixpid_autotune_progress(&autotune_controller, &stage);
    return stage;
}

static void is_stage(uint8_t phase, uint8_t done, uint8_t expected,
                     uint16_t period)
{
    const struct fixpid_autotune_stage stage = progress();

    TEST_ASSERT_EQUAL_UINT8(phase, stage.phase);
    TEST_ASSERT_EQUAL_UINT8(done, stage.done);
    TEST_ASSERT_EQUAL_UINT8(expected, stage.expected);
    TEST_ASSERT_EQUAL_UINT16(period, stage.period);
}

// Neither model nor gains, as it is not done.
static void has_none(void)
{
    struct fixpid_autotune_process process;
    struct fixpid_pid_config pid;

    TEST_ASSERT_EQUAL_UINT8(
        FIXPID_AUTOTUNE_NOT_DONE,
        fixpid_autotune_reason(&autotune_controller, FIXPID_AUTOTUNE_PI, 16));
    TEST_ASSERT_FALSE(fixpid_autotune_result(&autotune_controller,
                                             FIXPID_AUTOTUNE_PI, 16, &pid));
    TEST_ASSERT_FALSE(fixpid_autotune_model(&autotune_controller, &process));
}

static void is_over(uint8_t with)
{
    is(with);
    is_stage(OVER, (uint8_t)(7 + 3 * config.cycles),
             (uint8_t)(7 + 3 * config.cycles), progress().period);
    TEST_ASSERT_EQUAL_INT16(config.output_rest, step(0));
    TEST_ASSERT_EQUAL_INT16(config.output_rest, step(INT16_MAX));
    TEST_ASSERT_EQUAL_INT16(config.output_rest, step(-INT16_MAX));
    is(with);
    if (with != FIXPID_AUTOTUNE_DONE) {
        has_none();
    }
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

static void usuals(uint8_t count)
{
    while (count != 0) {
        is(FIXPID_AUTOTUNE_RUNNING);
        usual();
        count--;
    }
}

// The first 34 steps: no noise, so far below the setpoint that the whole range
// has to find it, and then the relay is high.
static void quiet(void)
{
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS, -24);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(0); // the first one of the first half counts for no cycle
}

// The same at rest.
static void quiet_at_rest(void)
{
    TEST_ASSERT_TRUE(init());
    steps(NOISE_STEPS, 0);
    step(0);
}

// Up to the first cycle of the first relay, from which on the sums count.
static void begin(void)
{
    quiet();
    usuals(5); // of the first relay the first, which is never averaged
    is_stage(3, 5, (uint8_t)(7 + 3 * config.cycles), 40);
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
                                             .swing = 75,
                                             .timeout_steps = 1000,
                                             .cycles = 1};
}

void tearDown(void)
{
}

// ---- init and reset ----

static void is_refused(void)
{
    struct fixpid_autotune_record record;

    is(FIXPID_AUTOTUNE_REFUSED);
    is_stage(OVER, 0, 0, 0);
    TEST_ASSERT_EQUAL_INT16(0, step(100));
    TEST_ASSERT_EQUAL_INT16(0, step(INT16_MAX));
    has_none();
    TEST_ASSERT_FALSE(fixpid_autotune_pack(&autotune_controller, &record));
    is(FIXPID_AUTOTUNE_REFUSED);
}

static void starts(void)
{
    is(FIXPID_AUTOTUNE_RUNNING);
    is_stage(0, 0, (uint8_t)(7 + 3 * config.cycles), 0);
    TEST_ASSERT_EQUAL_INT16(config.output_rest, step(0));
}

// Each at its ends and beyond.
static const struct {
    struct fixpid_autotune_config config;
    bool legal;
} configs[] = {
    {{77, 77, 77, -9, 9, 50, 100, 1, false}, false},
    {{78, 77, 77, -9, 9, 50, 100, 1, false}, false},
    {{76, 77, 77, -9, 9, 50, 100, 1, false}, true},
    {{-32768, 32767, 0, -32768, 32767, 50, 100, 1, true}, true},
    {{-300, 300, -301, -9, 9, 50, 100, 1, false}, false},
    {{-300, 300, -300, -9, 9, 50, 100, 1, false}, true},
    {{-300, 300, 300, -9, 9, 50, 100, 1, true}, true},
    {{-300, 300, 301, -9, 9, 50, 100, 1, false}, false},
    {{-300, 300, 0, 9, 9, 50, 100, 1, false}, false},
    {{-300, 300, 0, 10, 9, 50, 100, 1, false}, false},
    {{-300, 300, 0, -1, 0, 50, 100, 1, false}, true},
    {{-300, 300, 0, -9, 9, 0, 100, 1, false}, true},
    {{-300, 300, 0, -9, 9, 1, 100, 1, false}, false},
    {{-300, 300, 0, -9, 9, 7, 100, 1, false}, false},
    {{-300, 300, 0, -9, 9, 8, 100, 1, false}, true},
    {{-300, 300, 0, -9, 9, 16383, 100, 1, false}, true},
    {{-300, 300, 0, -9, 9, 16384, 100, 1, false}, false},
    {{-300, 300, 0, -9, 9, 65535, 100, 1, false}, false},
    {{-300, 300, 0, -9, 9, 50, 0, 1, false}, false},
    {{-300, 300, 0, -9, 9, 50, 1, 1, false}, false},
    {{-300, 300, 0, -9, 9, 50, 2, 1, false}, true},
    {{-300, 300, 0, -9, 9, 50, 32767, 1, false}, true},
    {{-300, 300, 0, -9, 9, 50, 32768u, 1, false}, false},
    {{-300, 300, 0, -9, 9, 50, 100, 0, false}, false},
    {{-300, 300, 0, -9, 9, 50, 100, 4, false}, true},
    {{-300, 300, 0, -9, 9, 50, 100, 5, false}, false},
    {{-300, 300, 0, -9, 9, 50, 100, 255, true}, false},
};

void test_init_a_configuration_outside_its_ranges_is_refused_until_a_good_one(
    void)
{
    for (unsigned i = 0; i < COUNT(configs); i++) {
        config = configs[i].config;
        TEST_ASSERT_EQUAL(configs[i].legal, init());
        if (configs[i].legal) {
            starts();
        } else {
            is_refused();
            fixpid_autotune_reset(&autotune_controller);
            is_refused();
        }
    }
    setUp();
    TEST_ASSERT_TRUE(init());
    starts();
}

void test_an_all_zero_object_is_refused(void)
{
    static const struct fixpid_autotune zero; // like one at file scope

    autotune_controller = zero;
    is_refused();
    fixpid_autotune_reset(&autotune_controller);
    is_refused();
}

static void init_good(void)
{
    (void)init();
}

static void init_bad(void)
{
    struct fixpid_autotune_config bad = config;

    bad.cycles = 0;
    (void)fixpid_autotune_init(&autotune_controller, &bad);
}

void test_init_whatever_the_memory_held_sets_each_of_its_72_bytes(void)
{
    const unsigned padding = (unsigned)sizeof autotune_controller - 72u;

    TEST_ASSERT_EQUAL_UINT(padding,
                           poison_left(&autotune_controller,
                                       sizeof autotune_controller, init_good));
    TEST_ASSERT_EQUAL_UINT(padding,
                           poison_left(&autotune_controller,
                                       sizeof autotune_controller, init_bad));
}

void test_reset_starts_the_same_experiment_again(void)
{
    begin();
    usual();
    fixpid_autotune_reset(&autotune_controller);
    starts();
    for (unsigned i = 1; i < NOISE_STEPS - 1u; i++) {
        TEST_ASSERT_EQUAL_INT16(REST, step(0));
    }
    TEST_ASSERT_EQUAL_INT16(113, step(0));
    step(0);
    usuals(8);
    is_over(FIXPID_AUTOTUNE_DONE);
}

// ---- The noise and the hysteresis ----

// Where the relay switches after the steps so far, which ended on a side.
static void switches_beyond(int16_t hysteresis)
{
    step((int16_t)-hysteresis);
    TEST_ASSERT_EQUAL_INT16(300, step(hysteresis));
    TEST_ASSERT_EQUAL_INT16(-300, step((int16_t)(hysteresis + 1)));
    TEST_ASSERT_EQUAL_INT16(-300, step((int16_t)-hysteresis));
    TEST_ASSERT_EQUAL_INT16(300, step((int16_t)(-hysteresis - 1)));
}

// At an end of its range the output at rest holds no relay, and the first one
// is the whole range. The noise of 32 second differences makes a hysteresis of
// 1 + (sum + sum / 2 + 16) / 32.
void test_step_the_first_hysteresis_is_what_the_noise_asks(void)
{
    static const struct {
        int16_t first, second, odd, even, last; // deviations
        int16_t hysteresis;
    } rows[] = {
        {0, 0, 0, 0, 0, 1},
        {0, 0, 0, 0, -10, 1},               // (10 + 5 + 16) / 32 is 0
        {0, 0, 0, 0, -11, 2},               // (11 + 5 + 16) / 32 is 1
        {7, 0, 0, 0, 0, 1},                 // the first two make none
        {0, 0, 0, 0, -1022, 49},            // (1022 + 511 + 16) / 32 is 48
        {0, 0, 0, 0, -9000, 49},            // one counts 1023 at most
        {256, -256, 256, -256, -256, 1536}, // (32736 + 16368 + 16) / 32
        {9000, -9000, 9000, -9000, -9000, 1536},
    };

    config.output_rest = config.output_min;
    for (unsigned i = 0; i < COUNT(rows); i++) {
        TEST_ASSERT_TRUE(init());
        step(rows[i].first);
        step(rows[i].second);
        for (unsigned at = 3; at < NOISE_STEPS; at++) {
            TEST_ASSERT_EQUAL_INT16(
                -300, step(at % 2u != 0 ? rows[i].odd : rows[i].even));
        }
        TEST_ASSERT_EQUAL_INT16(300, step(rows[i].last));
        switches_beyond(rows[i].hysteresis);
    }
}

void test_step_a_slope_is_no_noise(void)
{
    config.output_rest = config.output_min;
    TEST_ASSERT_TRUE(init());
    for (int16_t i = 0; i < NOISE_STEPS; i++) {
        step((int16_t)(16500 - 500 * i)); // the last is 0
    }
    switches_beyond(1);
}

// An eighth of the range is 75 counts, and a third of that 24.
void test_step_at_rest_near_the_setpoint_a_small_relay_is_enough(void)
{
    static const struct {
        int16_t rest, noise, last; // a deviation at first, and at last
        int16_t low, high;
    } rows[] = {
        {77, 0, 0, 41, 113},     {77, 0, -23, 41, 113},
        {77, 0, 23, 41, 113},    {77, 0, -24, -300, 300},
        {77, 0, 24, -300, 300},  {77, -6, 47, 41, 113}, // of 2 counts
        {77, -6, 48, -300, 300}, {-300, 0, 0, -300, 300},
        {300, 0, 0, -300, 300},  {-299, 0, 0, -300, -263},
        {299, 0, 0, 263, 300},
    };

    for (unsigned i = 0; i < COUNT(rows); i++) {
        config.output_rest = rows[i].rest;
        TEST_ASSERT_TRUE(init());
        steps(2, rows[i].last);
        step((int16_t)(rows[i].last + rows[i].noise)); // counts four times
        steps(NOISE_STEPS - 3, rows[i].last);
        TEST_ASSERT_EQUAL_INT16(rows[i].high, step(-3000));
        TEST_ASSERT_EQUAL_INT16(rows[i].low, step(3000));
    }
}

// 15 / 8 is 1, and a third of that nothing.
void test_step_the_smallest_relay_at_rest_is_3_counts_each_side(void)
{
    config.output_min = 70;
    config.output_max = 85;
    quiet_at_rest();
    TEST_ASSERT_EQUAL_INT16(80, step(0));
    TEST_ASSERT_EQUAL_INT16(74, step(2));
}

void test_step_the_last_deviation_of_the_noise_decides_the_first_side(void)
{
    for (int16_t deviation = -1; deviation <= 1; deviation++) {
        TEST_ASSERT_TRUE(init());
        steps(NOISE_STEPS - 1, 0);
        TEST_ASSERT_EQUAL_INT16(deviation > 0 ? 41 : 113, step(deviation));
    }
}

// The difference has 17 bits; what is beyond 32767 counts as that.
void test_step_every_measurement_and_setpoint_is_legal(void)
{
    for (unsigned i = 0; i < NASTY_COUNT * NASTY_COUNT; i++) {
        const int16_t setpoint = nasty[i / NASTY_COUNT];
        const int16_t measurement = nasty[i % NASTY_COUNT];
        int32_t deviation = (int32_t)measurement - setpoint;

        if (measurement > INT16_MIN && measurement < INT16_MAX) {
            config.reverse = i % 2u != 0;
            deviation = deviation < -INT16_MAX  ? -INT16_MAX
                        : deviation > INT16_MAX ? INT16_MAX
                                                : deviation;
            TEST_ASSERT_TRUE(init());
            fixpid_autotune_step(&autotune_controller, setpoint, measurement);
            TEST_ASSERT_EQUAL_INT32(config.reverse ? -deviation : deviation,
                                    autotune_controller.highest);
        }
    }
}

// ---- The relays ----

// The swing of 98 counts beyond the hysteresis of 1 is to be one of 62, so that
// 377 counts of output are left of 600, and of 374 then 321: of 72 counts
// beyond a hysteresis of 14. A third is 125, and 106.
void test_step_and_progress_each_phase_has_its_relay_and_its_cycles(void)
{
    static const int16_t highs[] = {0, 300, 187, 212, 106, 212};
    static const int16_t lows[] = {0, -300, -187, -106, -212, -106};

    for (config.cycles = 1; config.cycles <= 4; config.cycles++) {
        const uint8_t expected = (uint8_t)(7 + 3 * config.cycles);

        quiet();
        step(0); // which is not the first of a cycle
        for (uint8_t done = 0; done < expected; done++) {
            const unsigned phase =
                done < 4 ? 1u + done / 2u
                         : 3u + (done - 4u) / (1u + config.cycles);

            is_stage((uint8_t)phase, done, expected,
                     done == 0   ? 0
                     : done == 1 ? 41
                                 : 40);
            TEST_ASSERT_EQUAL_INT16(highs[phase], step(0));
            steps(18, 0);
            TEST_ASSERT_EQUAL_INT16(lows[phase], step(50));
            steps(19, 0);
            step(-50);
        }
        is_over(FIXPID_AUTOTUNE_DONE);
        is_stage(OVER, expected, expected, 40);
    }
}

// The relay of the second cycles and its hysteresis, after first ones of so
// much swing. The comments are without the first hysteresis of 1, or of 5.
static const struct {
    int16_t output_min, output_max;
    uint16_t swing;
    int16_t noise, top, bottom, low, high, hysteresis;
} centres[] = {
    {-300, 300, 75, 0, 50, -50, -187, 187, 14},
    {-300, 300, 75, 0, 84, -34, -288, 26, 13}, // 33 of 116 below
    {-300, 300, 75, 0, 34, -84, -28, 286, 13},
    {-32768, 32767, 75, 0, 50, -50, -20526, 20526, 14},
    {-300, 300, 0, 0, 50, -50, -249, 249, 18}, // an eighth of 800 counts
    // No wider than the range, whose third is 199, 21759 and 5440, nor smaller
    // than 2.
    {-300, 300, 800, 0, 200, -200, -298, 298, 90},
    {-32768, 32767, 16383, 0, 400, -400, -32638, 32638, 182},
    {-8192, 8192, 16383, 0, 3071, -3071, -8160, 8160, 1409},
    {-300, 300, 8, 0, 1000, -1000, -3, 3, 3},
    {-16384, 16384, 16383, 0, 2, -2, -16320, 16320, 2}, // 2^28 are wanted
    // A half is no wider than the way to the nearer end, or 2.
    {0, 100, 75, 0, 90, -20, 0, 45, 13},
    {0, 100, 75, 0, 90, -2, 0, 4, 1},
    {-128, 129, 50, 0, 138, -136, -19, 17, 8}, // 257 at 127 / 256: 127.496
    {-300, 300, 50, 0, 22, -21, -300, 289, 9}, // 41 counts are wanted, and are
    {-300, 300, 101, 0, 45, -40, -300, 279, 18}, // 83 of 83
    // What the noise asks for, 5, and a swing of 6 times that.
    {-300, 300, 50, -75, 60, -60, -109, 109, 8}, // 38 beyond it
    {-300, 300, 33, -75, 60, -60, -72, 72, 5},   // 24
    {-300, 300, 20, -75, 60, -60, -45, 45, 7},   // 15
};

void test_step_the_next_relay_swings_as_far_as_wanted_about_the_setpoint(void)
{
    for (unsigned i = 0; i < COUNT(centres); i++) {
        config.output_min = centres[i].output_min;
        config.output_max = centres[i].output_max;
        config.output_rest = config.output_min;
        config.swing = centres[i].swing;
        config.measurement_min = config.swing == 0 ? -400 : INT16_MIN;
        config.measurement_max = config.swing == 0 ? 400 : INT16_MAX;
        TEST_ASSERT_TRUE(init());
        steps(NOISE_STEPS - 1, 0);
        step(centres[i].noise);
        step(0);
        cycle(20, 20, centres[i].top, centres[i].bottom);
        TEST_ASSERT_EQUAL_INT16(
            centres[i].high, cycle(20, 20, centres[i].top, centres[i].bottom));
        TEST_ASSERT_EQUAL_INT16(centres[i].high, step(centres[i].hysteresis));
        TEST_ASSERT_EQUAL_INT16(centres[i].low,
                                step((int16_t)(centres[i].hysteresis + 1)));
    }
}
// Centre and half of the relay that the first waves make, and of the one that
// the second waves make with it.
static const struct {
    uint16_t swing;
    int16_t top, bottom, second_top, second_bottom;
    bool fits;
} relays[] = {
    {255, 270, -150, 72, -78, true},    // -289, 332; -238, 664
    {325, 370, -300, 140, -108, false}, // -109, 261; -207, 523
    {270, 360, -350, 308, -222, true},  // -16, 204; -78, 102
    {205, 210, -220, 154, -254, false}, // 16, 259; 131, 129
    {295, 210, -40, 104, -340, true},   // -687, 313; -374, 159
    {185, 240, -310, 70, -226, false},  // 125, 181; 307, 117
    {325, 60, -380, 192, -78, true},    // 727, 273; 454, 313
    {215, 390, -220, 274, -86, false},  // -281, 191; -473, 117
};

static void find_relays(unsigned i, uint8_t seen)
{
    config.output_min = -1000;
    config.output_max = 1000;
    config.swing = relays[i].swing;
    quiet();
    cycle(20, 20, relays[i].top, relays[i].bottom);
    cycle(20, 20, relays[i].top, relays[i].bottom);
    cycle(20, 20, relays[i].second_top, relays[i].second_bottom);
    autotune_controller.seen = seen;
    cycle(20, 20, relays[i].second_top, relays[i].second_bottom);
}

void test_step_and_progress_a_relay_like_the_one_before_measures(void)
{
    for (unsigned i = 0; i < COUNT(relays); i++) {
        find_relays(i, 3);
        TEST_ASSERT_EQUAL_UINT8(relays[i].fits ? 3 : 2, progress().phase);
        TEST_ASSERT_EQUAL_UINT8(relays[i].fits ? 4 : 2, progress().done);
    }
}

void test_step_and_progress_from_20_cycles_on_each_relay_measures(void)
{
    find_relays(1, 18);
    TEST_ASSERT_EQUAL_UINT8(2, progress().phase);
    find_relays(1, 19);
    TEST_ASSERT_EQUAL_UINT8(3, progress().phase);
}

// Waves of the first relay and the second, whose sums can be counted.
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

static void has_sums(unsigned relay, int32_t cycles, int32_t all, int32_t on,
                     int32_t rise, int32_t all_steps, int32_t on_steps)
{
    const struct fixpid_autotune_sums sums = autotune_controller.sums[relay];

    TEST_ASSERT_EQUAL_INT32(cycles * all, sums.all);
    TEST_ASSERT_EQUAL_INT32(cycles * on, sums.on);
    TEST_ASSERT_EQUAL_INT32(cycles * rise, sums.rise);
    TEST_ASSERT_EQUAL_INT32(cycles * all_steps, sums.steps);
    TEST_ASSERT_EQUAL_INT32(cycles * on_steps, sums.on_steps);
}

// -19 * 20 + 60 are -320, and 29 * 40 - 20 are 1140.
void test_step_the_sums_are_those_of_the_cycles_that_are_averaged(void)
{
    static const struct wave up = {-20, 40, 60, -20, 20, 30};
    static const struct wave down = {-40, 20, 20, -60, 30, 20};

    for (config.cycles = 1; config.cycles <= 4; config.cycles++) {
        config.reverse = config.cycles % 2u != 0;
        sign = config.reverse ? -1 : 1;
        inside_high = 0;
        inside_low = 0;
        quiet();
        usuals(4);
        play(&up);
        play(&down);
        play(&up);
        is_over(FIXPID_AUTOTUNE_DONE);
        has_sums(0, 2 * config.cycles, 820, -320, 60, 50, 20);
        has_sums(1, config.cycles, -820, -1140, 60, 50, 30);
    }
}

void test_step_what_is_measured_first_after_a_switch_is_a_rise_to_2047(void)
{
    static const struct {
        int16_t after_high, after_low, rise;
    } rows[] = {{0, 0, 0},         {1, -1, -2},         {-3000, 30, 2077},
                {-30, 3000, 2077}, {-2047, 2047, 4094}, {-2048, 2048, 4094}};

    for (unsigned i = 0; i < COUNT(rows); i++) {
        quiet();
        usuals(4);
        for (unsigned n = 0; n < 6; n++) {
            step(rows[i].after_high);
            steps(18, -30);
            step(50);
            step(rows[i].after_low);
            steps(18, 30);
            step(-50);
        }
        is_over(FIXPID_AUTOTUNE_DONE);
        TEST_ASSERT_EQUAL_INT16(2 * rows[i].rise,
                                autotune_controller.sums[0].rise);
    }
}

// ---- Cycles that are thrown away ----

// Four times the last period and 4 steps without a switch. The relay was one of
// -106 and 212: from the side that does not reach the setpoint it goes on by
// twice the half of 106, and three halves of that are 318.
void test_step_and_progress_a_relay_that_does_not_reach_is_widened(void)
{
    begin();
    steps(162, 0); // with the one that switched, 4 * 40 + 3
    is_stage(3, 5, 10, 40);
    TEST_ASSERT_EQUAL_INT16(300, step(0));
    is_stage(2, 2, 10, 40);
    has_sums(0, 1, 0, 0, 0, 0, 0);
    TEST_ASSERT_EQUAL_INT16(-18, step(50));
    step(-50);
    usuals(10);
    is_over(FIXPID_AUTOTUNE_DONE);
    begin();
    steps(19, 0);
    TEST_ASSERT_EQUAL_INT16(-106, step(50));
    steps(162, 0);
    is_stage(3, 5, 10, 40);
    TEST_ASSERT_EQUAL_INT16(-300, step(0));
    is_stage(2, 2, 10, 40);
    TEST_ASSERT_EQUAL_INT16(18, step(-50));
}

// Without whole cycles a 16th of the timeout is enough: 4 * 62 + 4.
void test_step_a_relay_is_widened_from_the_second_on(void)
{
    quiet();
    usual();
    steps(500, 0);
    is_stage(1, 1, 10, 40); // the whole range anyhow
    quiet();
    usuals(2);
    steps(162, 0);
    TEST_ASSERT_EQUAL_INT16(187, autotune_controller.output);
    TEST_ASSERT_EQUAL_INT16(300, step(0));
    for (uint8_t cycles = 0; cycles <= 2; cycles++) {
        quiet_at_rest();
        usuals(cycles);
        steps(cycles < 2 ? 250 : 162, 0);
        TEST_ASSERT_EQUAL_INT16(cycles < 2 ? 113 : 105,
                                autotune_controller.output);
        TEST_ASSERT_EQUAL_INT16(cycles < 2 ? 233 : 175, step(0));
        TEST_ASSERT_EQUAL_UINT8(cycles + 4, autotune_controller.seen);
    }
}

void test_step_a_relay_of_half_10000_is_not_widened_but_moved(void)
{
    static const uint16_t halves[][2] = {{9999, 19998}, {10000, 10000}};

    config.output_max = INT16_MAX;
    for (unsigned i = 0; i < COUNT(halves); i++) {
        begin();
        autotune_controller.half = halves[i][0];
        steps(162, 0);
        TEST_ASSERT_EQUAL_UINT16(halves[i][0], autotune_controller.half);
        step(0);
        TEST_ASSERT_EQUAL_UINT16(halves[i][1], autotune_controller.half);
    }
}

// With a swing of 100 it is high at 300.
void test_step_a_relay_at_the_end_of_its_range_waits_for_the_setpoint(void)
{
    config.swing = 100;
    begin();
    steps(999, 0);
    is_stage(3, 5, 10, 40);
    step(0);
    is_over(FIXPID_AUTOTUNE_NO_OSCILLATION);
}

// The step that found it lost is the first one.
void test_step_a_relay_that_is_widened_has_timeout_steps(void)
{
    config.timeout_steps = 300;
    begin();
    steps(163 + 299, 0);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(0);
    is_over(FIXPID_AUTOTUNE_NO_OSCILLATION);
}

void test_step_cycles_are_alike_within_an_eighth_and_a_step(void)
{
    static const struct {
        uint16_t before, now;
        bool alike;
    } rows[] = {{46, 40, true},  {47, 40, false}, {34, 40, true},
                {33, 40, false}, {39, 45, true},  {38, 45, false},
                {40, 40, true}};

    for (unsigned i = 0; i < COUNT(rows); i++) {
        quiet();
        usuals(4);
        cycle(20, (uint16_t)(rows[i].before - 20u), 50, -50);
        cycle(20, (uint16_t)(rows[i].now - 20u), 50, -50);
        TEST_ASSERT_EQUAL_UINT8(rows[i].alike ? 4 : 3, progress().phase);
    }
}

// A cycle unlike the one before may be the first of new ones.
void test_step_and_progress_a_cycle_unlike_the_last_one_starts_to_average(void)
{
    config.cycles = 2;
    begin();
    usual();
    is_stage(3, 6, 13, 40);
    cycle(40, 40, 50, -50);
    is_stage(3, 5, 13, 80);
    cycle(40, 40, 50, -50);
    cycle(40, 40, 50, -50);
    is_stage(4, 7, 13, 80);
    cycle(40, 40, 50, -50);
    cycle(40, 40, 50, -50);
    is_stage(4, 9, 13, 80);
    usual();
    is_stage(4, 8, 13, 40);
    usuals(2);
    is_stage(5, 10, 13, 40);
    has_sums(1, 2, 0, 50, 0, 40, 20);
    has_sums(0, 2, 0, 50, 0, 80, 40);
}

// The first relay was high for 20 steps of 40, and the same part of its cycles
// is the third: within a 32nd of the period and 1 step of those before, each,
// and in the end within a 64th of all and 2 steps.
void test_step_and_progress_another_load_starts_the_first_relay_again(void)
{
    static const struct {
        uint8_t cycles;
        uint16_t high, low, then_high, then_low;
        uint8_t phase, done;
    } rows[] = {
        {1, 22, 18, 20, 20, OVER, 10}, {1, 18, 22, 20, 20, OVER, 10},
        {1, 23, 17, 20, 20, 4, 6},     {1, 17, 23, 20, 20, 4, 6},
        {1, 84, 76, 20, 20, OVER, 10}, // of 80 of 160: 2 and 2 of all
        {1, 85, 75, 20, 20, 3, 5},     // and unlike the next
        {2, 23, 17, 20, 20, OVER, 13}, // 40 * 2 * 3 of 2 * 120
        {2, 17, 23, 20, 20, OVER, 13}, {2, 24, 16, 20, 20, 3, 6},
        {2, 16, 24, 20, 20, 3, 6},     {2, 22, 18, 21, 19, OVER, 13},
        {2, 22, 18, 22, 18, 3, 5}, // 44 of 80, not 40: 1 and 2
        {2, 18, 22, 18, 22, 3, 5},     {2, 44, 40, 40, 40, OVER, 13},
    };

    for (unsigned i = 0; i < COUNT(rows); i++) {
        config.cycles = rows[i].cycles;
        begin();
        usuals((uint8_t)(2 * config.cycles + 2));
        cycle(rows[i].high, rows[i].low, 50, -50);
        cycle(rows[i].then_high, rows[i].then_low, 50, -50);
        TEST_ASSERT_EQUAL_UINT8(rows[i].phase, progress().phase);
        TEST_ASSERT_EQUAL_UINT8(rows[i].done, progress().done);
    }
}

// Of 41 * 23 and 20 * 43 the difference is 83, and 2 * 41 are allowed.
void test_step_another_load_is_one_by_a_step_more(void)
{
    for (uint16_t high = 22; high <= 23; high++) {
        begin();
        cycle(20, 21, 50, -50);
        usuals(3);
        cycle(high, (uint16_t)(43u - high), 50, -50);
        TEST_ASSERT_EQUAL_UINT8(high == 22 ? OVER : 3, progress().phase);
    }
}

// ---- How it ends ----

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
    config.timeout_steps = 33; // while the noise is measured
    TEST_ASSERT_TRUE(init());
    steps(33, 0);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(0);
    is_over(FIXPID_AUTOTUNE_NO_OSCILLATION);
}

// Which says more than a timeout. RUNNING is 1, NO_OSCILLATION 3, SATURATED 4.
void test_step_a_measurement_at_its_limits_ends_it(void)
{
    static const struct {
        uint8_t steps;
        int16_t measurement;
        uint8_t status;
    } rows[] = {{0, 69, 1},   {0, 70, 4},     {0, 32767, 4}, {0, -59, 1},
                {0, -60, 4},  {0, -32768, 4}, {40, 69, 1},   {40, 70, 4},
                {40, -60, 4}, {100, 69, 3},   {100, 70, 4},  {100, -60, 4}};

    config.output_rest = config.output_min; // or the relay is widened
    config.measurement_min = -60;
    config.measurement_max = 70;
    config.timeout_steps = 60;
    for (unsigned i = 0; i < COUNT(rows); i++) {
        TEST_ASSERT_TRUE(init());
        steps(rows[i].steps > 94 ? 94 : rows[i].steps, 0);
        fixpid_autotune_step(&autotune_controller, -100, rows[i].measurement);
        is(rows[i].status);
    }
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

void test_step_48_cycles_are_too_many_and_a_relay_that_is_widened_counts_as_4(
    void)
{
    begin(); // 5 cycles
    unlike_cycles(43);
    is_over(FIXPID_AUTOTUNE_IRREGULAR);
    begin();
    steps(163, 0);
    unlike_cycles(39);
    is_over(FIXPID_AUTOTUNE_IRREGULAR);
    begin();
    unlike_cycles(38);
    steps(163, 0);
    is(FIXPID_AUTOTUNE_RUNNING);
    usual();
    is_over(FIXPID_AUTOTUNE_IRREGULAR);
    begin();
    unlike_cycles(39);
    steps(322, 0); // of 4 * 80 + 4
    is(FIXPID_AUTOTUNE_RUNNING);
    step(0);
    is_over(FIXPID_AUTOTUNE_IRREGULAR);
}

// The noise asks for 10 as hysteresis, of which four times are 40, and the
// relays' is 14.
static const struct {
    uint16_t high, low, second_high, second_low; // steps
    int16_t top, bottom;
    uint8_t status;
} endings[] = {
    {5, 35, 20, 20, 50, -50, FIXPID_AUTOTUNE_DONE},
    {4, 36, 20, 20, 50, -50, FIXPID_AUTOTUNE_IRREGULAR},
    {35, 5, 20, 20, 50, -50, FIXPID_AUTOTUNE_DONE},
    {36, 4, 20, 20, 50, -50, FIXPID_AUTOTUNE_IRREGULAR},
    {20, 20, 5, 35, 50, -50, FIXPID_AUTOTUNE_DONE},
    {20, 20, 4, 36, 50, -50, FIXPID_AUTOTUNE_IRREGULAR},
    {20, 20, 35, 5, 50, -50, FIXPID_AUTOTUNE_DONE},
    {20, 20, 36, 4, 50, -50, FIXPID_AUTOTUNE_IRREGULAR},
    {5, 5, 20, 20, 50, -50, FIXPID_AUTOTUNE_DONE},
    {5, 4, 20, 20, 50, -50, FIXPID_AUTOTUNE_TOO_FAST},
    {20, 20, 20, 20, 20, -20, FIXPID_AUTOTUNE_DONE},
    {20, 20, 20, 20, 20, -19, FIXPID_AUTOTUNE_TOO_SMALL},
    {20, 20, 20, 20, 19, -20, FIXPID_AUTOTUNE_TOO_SMALL},
    {5, 4, 20, 20, 19, -20, FIXPID_AUTOTUNE_TOO_FAST},
    {4, 36, 20, 20, 19, -20, FIXPID_AUTOTUNE_IRREGULAR},
};

void test_step_what_cannot_be_used_ends_with_a_status_that_says_why(void)
{
    config.output_rest = config.output_min;
    config.swing = 100;
    for (unsigned i = 0; i < COUNT(endings); i++) {
        const int16_t top = endings[i].top;
        const int16_t bottom = endings[i].bottom;

        TEST_ASSERT_TRUE(init());
        steps(NOISE_STEPS - 1, 0);
        step(-183);
        step(0);
        usuals(5);
        for (unsigned n = 0; n < 6; n++) { // each relay's first, and one
            const bool second = n == 2 || n == 3;

            cycle(second ? endings[i].second_high : endings[i].high,
                  second ? endings[i].second_low : endings[i].low, top, bottom);
        }
        is_over(endings[i].status);
    }
}

void test_step_32767_steps_of_one_relay_are_too_slow(void)
{
    config.timeout_steps = 32767;
    begin();
    cycle(160, 160, 50, -50); // each unlike the one before
    cycle(1280, 1280, 50, -50);
    cycle(4000, 4000, 50, -50);
    steps(15999, 0);
    step(50);
    steps(16766, 0);
    is(FIXPID_AUTOTUNE_RUNNING);
    step(-50);
    is_over(FIXPID_AUTOTUNE_TOO_SLOW);
}

// Retuning by a range about the output at rest stays there, too.
void test_step_whatever_is_measured_it_ends_and_stays_in_its_range(void)
{
    numbers_seed(31);
    for (unsigned run = 0; run < 60u; run++) {
        uint32_t left;

        config.output_min = (int16_t)(-1 - numbers_int16() / 2);
        config.output_rest = config.output_min;
        config.output_max =
            (int16_t)(config.output_min + 1 + (int32_t)numbers_below(16000));
        config.timeout_steps = (uint16_t)(2u + numbers_below(60));
        config.cycles = (uint8_t)(1u + numbers_below(4));
        left = 34u + 97u * config.timeout_steps;
        TEST_ASSERT_TRUE(init());
        while (status() == FIXPID_AUTOTUNE_RUNNING) {
            const struct fixpid_autotune_stage stage = progress();
            const int16_t measurement =
                (int16_t)((int32_t)numbers_below(300) - 150);
            const uint32_t times =
                1u + numbers_below(1u + config.timeout_steps / 4u);

            TEST_ASSERT_LESS_THAN_UINT8(stage.expected, stage.done);
            for (uint32_t i = 0; i < times && left > 0; i++) {
                const int16_t output = step(measurement);

                TEST_ASSERT_GREATER_OR_EQUAL_INT16(config.output_min, output);
                TEST_ASSERT_LESS_OR_EQUAL_INT16(config.output_max, output);
                left--;
            }
            TEST_ASSERT_NOT_EQUAL_UINT32(0, left);
        }
        TEST_ASSERT_EQUAL_INT16(config.output_rest, step(0));
    }
}

void test_step_a_flipped_bit_of_the_output_keeps_it_within_its_range(void)
{
    static const int16_t flipped[] = {32767, -32768, 301, -301, 299};
    static const int16_t returned[] = {300, -300, 300, -300, 299};

    TEST_ASSERT_TRUE(init());
    for (unsigned i = 0; i < COUNT(flipped); i++) {
        autotune_controller.output = flipped[i];
        TEST_ASSERT_EQUAL_INT16(returned[i], step(0));
    }
}
