// SPDX-License-Identifier: MIT
// The whole way on five plants: the experiment, gains by each of the calmer
// rules, and the loop closed with them from rest.
#include "fixpid_pid.h"
#include "fixpid_relay.h"
#include "unity.h"

TEST_SOURCE_FILE("src/relay/fixpid_relay.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")

#define DELAY_MAX 40
#define PERCENT (INT64_C(1) << 24)
#define COUNT (100 * PERCENT)

// Lags in steps, counts of the measurement per count of the output in 1/100.
struct plant {
    int16_t output_min, output_max;
    int32_t gain_percent;
    int32_t lag, second_lag; // lag 0: an integrator
    uint8_t dead_time;
    int16_t noise;
    int16_t setpoint;
    int16_t measurement_max; // of the sensor
};

static const struct plant lag_and_dead_time = {.output_max = 255,
                                               .gain_percent = 400,
                                               .lag = 50,
                                               .dead_time = 3,
                                               .setpoint = 700,
                                               .measurement_max = 1023};
static const struct plant two_lags = {.output_max = 255,
                                      .gain_percent = 400,
                                      .lag = 20,
                                      .second_lag = 10,
                                      .dead_time = 1,
                                      .setpoint = 600,
                                      .measurement_max = 1023};
static const struct plant integrator = {.output_min = -255,
                                        .output_max = 255,
                                        .gain_percent = 3,
                                        .dead_time = 4,
                                        .setpoint = 400,
                                        .measurement_max = 1023};
static const struct plant motor = {.output_min = -255,
                                   .output_max = 255,
                                   .gain_percent = 800,
                                   .lag = 25,
                                   .dead_time = 1,
                                   .noise = 2,
                                   .setpoint = 1500,
                                   .measurement_max = 32767};
static const struct plant oven = {.output_max = 255,
                                  .gain_percent = 450,
                                  .lag = 2000,
                                  .dead_time = 40,
                                  .noise = 1,
                                  .setpoint = 600,
                                  .measurement_max = 1023};

static const struct plant *plant;
static int64_t level, second;   // of the measurement, in 1/COUNT
static int16_t line[DELAY_MAX]; // outputs on their way
static uint8_t at;
static uint32_t random_state;

static int16_t noise(void)
{
    const uint64_t next =
        random_state * UINT64_C(1664525) + UINT32_C(1013904223);

    random_state = (uint32_t)(next & UINT32_MAX);
    if (plant->noise == 0) {
        return 0;
    }
    return (int16_t)((int16_t)((random_state >> 16) %
                               (2u * (uint32_t)plant->noise + 1u)) -
                     plant->noise);
}

static void rest(const struct plant *the_plant)
{
    plant = the_plant;
    level = 0;
    second = 0;
    at = 0;
    for (uint8_t i = 0; i < DELAY_MAX; i++) {
        line[i] = 0;
    }
}

static int64_t position(void)
{
    return plant->second_lag == 0 ? level : second;
}

static void drive(int16_t output)
{
    const int64_t driven = line[at] * plant->gain_percent * PERCENT;

    line[at] = output;
    at = (uint8_t)((at + 1u) % plant->dead_time);
    level += plant->lag == 0 ? driven : (driven - level) / plant->lag;
    if (plant->second_lag != 0) {
        second += (level - second) / plant->second_lag;
    }
}

// To the nearest count, half up; nothing is far below zero here.
static int16_t measured(void)
{
    const int64_t counts = (position() + (1000 * COUNT) + (COUNT / 2)) / COUNT;

    return (int16_t)(counts - 1000 + noise());
}

// What the experiment and the closed loop must reach.
struct expected {
    int16_t relay_low, relay_high, setpoint; // of the experiment
    uint16_t timeout_steps;
    uint16_t steps; // of the loop
    // With the gains for PI and for PID: counts above the setpoint, and steps
    // until the plant stays within 2 % of it; 0 where the rule does not serve.
    int32_t overshoot_tenths[2];
    uint16_t settled_after[2];
};

static struct fixpid_relay tuner;

static uint8_t experiment(const struct plant *of,
                          const struct expected *expected)
{
    const struct fixpid_relay_config config = {
        .output_min = expected->relay_low,
        .output_max = expected->relay_high,
        .output_rest = 0,
        .measurement_min = -32000,
        .measurement_max = (int16_t)(of->measurement_max - 1),
        .hysteresis = 4,
        .timeout_steps = expected->timeout_steps,
        .cycles = 4,
        .options = 0};

    TEST_ASSERT_TRUE(fixpid_relay_init(&tuner, &config));
    random_state = 1;
    rest(of);
    while (fixpid_relay_status(&tuner) == FIXPID_RELAY_RUNNING) {
        drive(fixpid_relay_step(&tuner, expected->setpoint, measured()));
    }
    return fixpid_relay_status(&tuner);
}

static void close_loop(uint8_t rule, unsigned which,
                       const struct expected *expected)
{
    struct fixpid_pid_config config = {.output_min = plant->output_min,
                                       .output_max = plant->output_max,
                                       .integral_min = -32767,
                                       .integral_max = 32767,
                                       .setpoint_weight_q8 = 256,
                                       .reverse = false};
    const int64_t setpoint = (int64_t)plant->setpoint * COUNT;
    const bool serves = expected->settled_after[which] != 0u;
    struct fixpid_pid pid;
    int64_t overshoot = 0;
    uint16_t settled_after = 0;

    TEST_ASSERT_EQUAL(serves, fixpid_relay_result(&tuner, rule, &config.gains));
    if (!serves) {
        return;
    }
    TEST_ASSERT_TRUE(fixpid_pid_init(&pid, &config));
    rest(plant);
    for (uint16_t n = 1; n <= expected->steps; n++) {
        int64_t above;

        drive(fixpid_pid_step(&pid, plant->setpoint, measured()));
        above = position() - setpoint;
        if (above > overshoot) {
            overshoot = above;
        }
        if (above > setpoint / 50 || above < -setpoint / 50) {
            settled_after = n;
        }
    }
    TEST_ASSERT_LESS_OR_EQUAL_INT32(
        expected->overshoot_tenths[which],
        (int32_t)((10 * overshoot + COUNT / 2) / COUNT));
    TEST_ASSERT_LESS_OR_EQUAL_UINT16(expected->settled_after[which],
                                     settled_after);
}

static void tune_and_close(const struct plant *of,
                           const struct expected *expected)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, experiment(of, expected));
    close_loop(FIXPID_RELAY_TYREUS_LUYBEN_PI, 0, expected);
    close_loop(FIXPID_RELAY_TYREUS_LUYBEN_PID, 1, expected);
}

void setUp(void)
{
}

void tearDown(void)
{
}

void test_plants_lag_and_dead_time_is_tuned_without_overshoot(void)
{
    static const struct expected expected = {0,   255,    700,     1000,
                                             800, {0, 0}, {124, 0}};

    tune_and_close(&lag_and_dead_time, &expected);
}

void test_plants_two_lags_are_tuned_almost_without_overshoot(void)
{
    static const struct expected expected = {0,   255,    600,    1000,
                                             800, {0, 0}, {0, 88}};

    tune_and_close(&two_lags, &expected);
}

// A controller with I overshoots a step when the plant integrates, too; 20
// counts are 5 %.
void test_plants_integrator_is_tuned_within_5_percent_of_overshoot(void)
{
    static const struct expected expected = {-60, 60,       400,     1000,
                                             800, {0, 160}, {0, 144}};

    tune_and_close(&integrator, &expected);
}

// Tuned at about half its speed; the hysteresis is twice the encoder's noise.
void test_plants_motor_with_noise_is_tuned_where_it_will_not_run(void)
{
    static const struct expected expected = {0,   200,     800,    1000,
                                             800, {14, 0}, {58, 0}};

    tune_and_close(&motor, &expected);
}

void test_plants_oven_is_tuned_with_a_dead_time_of_40_steps(void)
{
    static const struct expected expected = {0,    255,    600,         6000,
                                             9000, {6, 8}, {1726, 1668}};

    tune_and_close(&oven, &expected);
}

// The same plant, and what an experiment on it can fail of.
static uint8_t failure(int16_t setpoint, int16_t measurement_max)
{
    struct plant limited = lag_and_dead_time;
    const struct expected expected = {.relay_low = 0,
                                      .relay_high = 255,
                                      .setpoint = setpoint,
                                      .timeout_steps = 600};

    limited.measurement_max = measurement_max;
    return experiment(&limited, &expected);
}

void test_plants_setpoint_out_of_reach_is_no_oscillation(void)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_DONE, failure(700, 1023));
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_NO_OSCILLATION, failure(1100, 2000));
}

void test_plants_sensor_at_its_end_is_saturated(void)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_SATURATED, failure(500, 516));
}

void test_plants_setpoint_near_an_end_of_the_relay_is_irregular(void)
{
    TEST_ASSERT_EQUAL_UINT8(FIXPID_RELAY_IRREGULAR, failure(100, 1023));
}
