// SPDX-License-Identifier: MIT
// The random machines against what their equations say in closed form, and
// against linear plants where they are that.
#include <math.h>
#include <stdio.h>

#include "answer.h"
#include "chance.h"
#include "families.h"
#include "linear.h"
#include "machine.h"
#include "machine_subject.h"
#include "unity.h"

TEST_SOURCE_FILE("sim/random_plants/answer.c")
TEST_SOURCE_FILE("sim/random_plants/chance.c")
TEST_SOURCE_FILE("sim/random_plants/families_batch.c")
TEST_SOURCE_FILE("sim/random_plants/linear.c")
TEST_SOURCE_FILE("sim/random_plants/machine.c")
TEST_SOURCE_FILE("sim/random_plants/machine_kinds.c")
TEST_SOURCE_FILE("sim/random_plants/machine_subject.c")
TEST_INCLUDE_PATH("sim/random_plants")

static struct machine machine;
static struct answer answer;
static struct sampled sampled;
static struct motion motion;

static void assert_near(double expected, double actual, double tolerance)
{
    char message[100];

    snprintf(message, sizeof message, "%s: expected %.9g, was %.9g, +-%.3g",
             machine_name(machine.kind), expected, actual, tolerance);
    TEST_ASSERT_TRUE_MESSAGE(fabs(expected - actual) <= tolerance, message);
}

void setUp(void)
{
}

void tearDown(void)
{
}

static void start_smooth(enum machine_kind kind, long number)
{
    machine_draw(&machine, kind, 1, number);
    machine_start(&machine, true, 1);
    machine.smooth = true;
}

static double holding(void)
{
    return machine.holding * machine.output_max;
}

// Counts of the sensor for one of the output.
static double counts(double gain)
{
    return gain / machine.span * machine.sensor_max / machine.output_max;
}

static struct linear same_lags(void)
{
    const double part_s = machine.step_s / machine.parts;
    struct linear plant = {.dead_steps = floor(machine.dead_s / part_s + 0.5) /
                                         machine.parts};

    for (int i = 0; i < machine.states; i++) {
        linear_lag(&plant, machine.lag_s[i] / machine.step_s);
    }
    linear_amplify(&plant, counts(machine.gain));
    return plant;
}

void test_answer_of_lags_is_that_of_the_same_linear_plant(void)
{
    static const enum machine_kind kinds[] = {MACHINE_SSR, MACHINE_JITTER,
                                              MACHINE_NOISE};

    for (int i = 0; i < 30; i++) {
        struct linear plant;
        machine_draw(&machine, kinds[i % 3], 1, i);
        plant = same_lags();
        sampled_start(&sampled, &plant);
        answer_of(&answer, &machine);
        for (double radians = 0.01; radians < 3.0; radians *= 3.0) {
            const double complex expected = sampled_response(&sampled, radians);
            const double complex found = answer_response(&answer, radians);
            assert_near(0.0, cabs(found - expected) / cabs(expected), 0.03);
        }
    }
}

void test_answer_period_is_where_the_phase_is_half_a_turn(void)
{
    for (int i = 0; i < 10; i++) {
        struct linear plant;
        machine_draw(&machine, MACHINE_JITTER, 1, i);
        plant = same_lags();
        plant.dead_steps += 0.5;
        answer_of(&answer, &machine);
        assert_near(1.0,
                    6.283185307179586 /
                        linear_crossing(&plant, -3.141592653589793) /
                        answer_period(&answer),
                    0.04);
    }
}

void test_answer_of_a_position_goes_on_for_ever(void)
{
    double speed;

    machine_draw(&machine, MACHINE_POSITION, 1, 0);
    speed = counts(machine.step_s / machine.damping);
    answer_of(&answer, &machine);

    assert_near(speed, answer.change[answer.count - 1], 0.001 * speed);
    TEST_ASSERT_TRUE(answer.fades == 1.0);
}

void test_draw_every_machine_rests_at_its_setpoint_on_the_scale(void)
{
    for (int i = 0; i < 5 * MACHINES; i++) {
        start_smooth((enum machine_kind)(i % MACHINES), i / MACHINES);
        TEST_ASSERT_TRUE(machine.setpoint >= 0.04 * machine.sensor_max);
        TEST_ASSERT_TRUE(machine.setpoint <= 0.96 * machine.sensor_max);
        for (int step = 0; step < 200; step++) {
            assert_near(machine.setpoint, machine_value(&machine), 0.6);
            machine_drive(&machine, holding());
        }
    }
}

void test_settle_a_heater_loses_what_it_gets(void)
{
    static const enum machine_kind kinds[] = {MACHINE_FURNACE, MACHINE_QUARTER,
                                              MACHINE_OVEN, MACHINE_KETTLE,
                                              MACHINE_HOT_END};

    for (int i = 0; i < 25; i++) {
        double degrees;
        double lost;
        machine_draw(&machine, kinds[i % 5], 1, i);
        degrees = machine.rest[1];
        lost = machine.loss * (degrees - machine.room) +
               machine.radiation * (pow(degrees + 273.15, 4.0) -
                                    pow(machine.room + 273.15, 4.0));
        assert_near(1.0, machine.power * machine.holding / lost, 1e-3);
        assert_near(degrees, machine.rest[2], 1e-3);
    }
}

void test_start_cold_a_heater_is_as_warm_as_the_room(void)
{
    machine_draw(&machine, MACHINE_KETTLE, 1, 0);
    machine_start(&machine, false, 1);

    assert_near(20.0 / 120.0 * 4095.0, machine_value(&machine), 1e-9);
}

void test_drive_a_backlash_leaves_its_play(void)
{
    machine_draw(&machine, MACHINE_STICTION, 1, 0);
    machine_start(&machine, false, 1);
    machine.backlash = 0.05;
    machine.stiction = 0.0;

    machine_drive(&machine, 0.5 * machine.output_max);
    assert_near(0.45, machine.driven, 1e-9);
    machine_drive(&machine, 0.42 * machine.output_max);
    assert_near(0.45, machine.driven, 1e-9);
    machine_drive(&machine, 0.3 * machine.output_max);
    assert_near(0.35, machine.driven, 1e-9);
}

void test_drive_stiction_jumps_when_it_is_overcome(void)
{
    machine_draw(&machine, MACHINE_STICTION, 1, 0);
    machine_start(&machine, false, 1);
    machine.backlash = 0.01;
    machine.stiction = 0.05;

    machine_drive(&machine, 0.04 * machine.output_max);
    assert_near(0.0, machine.driven, 1e-9);
    machine_drive(&machine, 0.06 * machine.output_max);
    assert_near(0.05, machine.driven, 1e-9);
}

void test_drive_half_cycles_and_levels_have_the_mean_and_the_nearest(void)
{
    double sum = 0.0;

    machine_draw(&machine, MACHINE_SSR, 1, 0);
    machine_start(&machine, false, 1);
    for (int step = 0; step < 100; step++) {
        machine_drive(&machine, 0.237 * machine.output_max);
        sum += machine.driven;
    }
    assert_near(23.7, sum, 1.0 / machine.half_cycles);

    machine_draw(&machine, MACHINE_PWM, 1, 0);
    machine_start(&machine, false, 1);
    machine_drive(&machine, 0.34 * machine.output_max);
    assert_near(0.3, machine.driven, 1e-9);
}

void test_read_is_a_count_of_the_scale_and_the_same_for_the_same_seed(void)
{
    static struct machine other;
    bool differs = false;

    machine_draw(&machine, MACHINE_NOISE, 1, 3);
    other = machine;
    machine_start(&machine, true, 5);
    machine_start(&other, true, 5);
    for (int step = 0; step < 3000; step++) {
        const int reading = machine_read(&machine);
        TEST_ASSERT_TRUE(reading >= 0 && reading <= machine.sensor_max);
        TEST_ASSERT_EQUAL(reading, machine_read(&other));
        differs = differs || reading != machine.setpoint;
        machine_drive(&machine, holding());
        machine_drive(&other, holding());
    }
    TEST_ASSERT_TRUE(differs);
}

void test_subject_an_unstable_machine_is_its_linear_plant(void)
{
    const struct subject subject =
        draw_machine_subject(&machine, MACHINE_UNSTABLE, 1, 2);
    double before;

    machine_start(&machine, true, 1);
    machine.smooth = true;
    before = machine_value(&machine);
    sampled_start(&sampled, &subject.plant);
    motion_start(&motion, &sampled);
    for (int step = 0; step < 40; step++) {
        machine_drive(&machine, holding() + 1.0);
        motion_move(&motion, 1.0);
    }
    assert_near(1.0, (machine_value(&machine) - before) / motion_value(&motion),
                0.02);
}

void test_subject_oscillates_in_14_steps_or_more_where_its_rate_is_open(void)
{
    for (int i = 0; i < 3 * MACHINES; i++) {
        const enum machine_kind kind = (enum machine_kind)(i % MACHINES);
        const struct subject subject =
            draw_machine_subject(&machine, kind, 1, i / MACHINES);

        if (kind != MACHINE_QUARTER && kind != MACHINE_OVEN &&
            kind != MACHINE_SSR) {
            TEST_ASSERT_TRUE_MESSAGE(subject.period_steps >= 14.0,
                                     subject.name);
        }
        TEST_ASSERT_TRUE(subject.machine == &machine);
        TEST_ASSERT_EQUAL(machine.setpoint, subject.setpoint);
    }
}
