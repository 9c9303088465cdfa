// SPDX-License-Identifier: MIT
// The plants against what their equations say in closed form, and the
// integrator's step against a finer one.
#include <math.h>
#include <stdio.h>

#include "plant.h"
#include "plant_motor.h"
#include "plant_oven.h"
#include "plant_pendulum.h"
#include "plant_process.h"
#include "unity.h"

TEST_SOURCE_FILE("sim/plant/plant_motor.c")
TEST_SOURCE_FILE("sim/plant/plant_oven.c")
TEST_SOURCE_FILE("sim/plant/plant_pendulum.c")
TEST_SOURCE_FILE("sim/plant/plant_process.c")
TEST_INCLUDE_PATH("sim/plant")

static struct pendulum pendulum;
static struct motor motor;
static struct oven oven;
static struct process process;

static void assert_near(double expected, double actual, double tolerance)
{
    char message[100];

    snprintf(message, sizeof message, "expected %.12g, was %.12g, +-%.3g",
             expected, actual, tolerance);
    TEST_ASSERT_TRUE_MESSAGE(fabs(expected - actual) <= tolerance, message);
}

void setUp(void)
{
    pendulum_init(&pendulum, 0.0);
    motor_init(&motor);
    oven_init(&oven, 20.0);
}

void tearDown(void)
{
}

// AN964 Equation 5 (B-16): angle'' = (g / R) angle, from rest a cosh.
void test_pendulum_small_angle_falls_as_equation_5_says(void)
{
    pendulum_init(&pendulum, 1e-6);
    pendulum_advance(&pendulum, 0.0, 1.0);
    assert_near(1e-6 * cosh(sqrt(9.81 / 0.5)), pendulum.state[PENDULUM_ANGLE],
                1e-13);
}

// AN964's worked number: 20 degrees of a 0.5 m pendulum are 6.845 rad/s2 (with
// the small angle itself in place of its sine).
void test_pendulum_acceleration_at_twenty_degrees_is_the_notes(void)
{
    const double angle = 0.349;

    pendulum_init(&pendulum, angle);
    pendulum_advance(&pendulum, 0.0, 1e-3);
    assert_near(6.845 * sin(angle) / angle,
                pendulum.state[PENDULUM_RATE] / 1e-3, 0.005);
}

// AN964 B-15 has an energy: R rate^2 / 2 + g cos(angle), while the base rests.
void test_pendulum_free_fall_keeps_its_energy(void)
{
    const double angle = 0.1;
    double rate;

    pendulum_init(&pendulum, angle);
    pendulum_advance(&pendulum, 0.0, 0.7);
    rate = pendulum.state[PENDULUM_RATE];
    TEST_ASSERT_TRUE(rate > 1.0);
    assert_near(9.81 * cos(angle),
                0.25 * rate * rate + 9.81 * cos(pendulum.state[PENDULUM_ANGLE]),
                1e-8);
}

void test_pendulum_lies_on_the_floor_after_a_fall(void)
{
    pendulum_init(&pendulum, -0.2);
    for (int i = 0; i < 3000; i++) {
        pendulum_advance(&pendulum, 0.0, 1e-3);
    }
    assert_near(-acos(0.0), pendulum.state[PENDULUM_ANGLE], 1e-12);
}

void test_pendulum_base_is_a_first_order_lag_of_drive_and_supply(void)
{
    pendulum.supply = 0.75;
    pendulum_advance(&pendulum, 0.5, 0.15);
    assert_near(6.0 * 0.75 * 0.5 * (1.0 - exp(-1.0)),
                pendulum.state[PENDULUM_SPEED], 1e-9);
}

void test_pendulum_drive_saturates(void)
{
    pendulum_advance(&pendulum, 7.0, 0.15);
    assert_near(6.0 * (1.0 - exp(-1.0)), pendulum.state[PENDULUM_SPEED], 1e-9);
}

void test_motor_speed_settles_where_the_torques_balance(void)
{
    double current, torque;

    motor.load_n_m = 0.05;
    motor_advance(&motor, 0.8, 3.0);
    current = (24.0 * 0.8 - 0.05 * motor.state[MOTOR_SPEED]) / 2.4;
    torque = 0.05 * current - 1e-5 * motor.state[MOTOR_SPEED] - 0.004 - 0.05;
    assert_near(0.0, torque, 1e-9);
    assert_near(current, motor.state[MOTOR_CURRENT], 1e-6);
}

void test_motor_turns_both_ways_alike(void)
{
    double forward;

    motor_advance(&motor, 0.5, 0.1);
    forward = motor.state[MOTOR_SPEED];
    motor_init(&motor);
    motor_advance(&motor, -0.5, 0.1);
    assert_near(-forward, motor.state[MOTOR_SPEED], 1e-12);
}

void test_oven_settles_at_power_times_resistance_above_the_air(void)
{
    oven_advance(&oven, 0.25, 200.0);
    assert_near(20.0 + 0.25 * 160.0 * 2.5, oven.state[OVEN_BODY], 1e-6);
}

void test_oven_dead_time_passes_before_anything_warms(void)
{
    oven_advance(&oven, 1.0, 0.349);
    assert_near(20.0, oven.state[OVEN_BODY], 0.0);
    oven_advance(&oven, 1.0, 0.5);
    TEST_ASSERT_TRUE(oven.state[OVEN_BODY] > 20.5);
}

void test_oven_cannot_cool(void)
{
    oven_advance(&oven, -1.0, 10.0);
    assert_near(20.0, oven.state[OVEN_BODY], 0.0);
}

// Half the step changes every plant's hardest second by a millionth of the
// sensor's last bit at most: the step is small enough.
void test_integrator_half_the_step_changes_nothing_that_is_seen(void)
{
    struct pendulum fine_pendulum;
    struct motor fine_motor;

    pendulum_init(&pendulum, 0.14);
    fine_pendulum = pendulum;
    fine_pendulum.longest_step_s /= 2.0;
    fine_motor = motor;
    fine_motor.longest_step_s /= 2.0;
    for (int i = 0; i < 256; i++) {
        const double drive = (i / 4) % 2 == 0 ? 1.0 : -1.0;
        pendulum_advance(&pendulum, drive, 1.0 / 256.0);
        pendulum_advance(&fine_pendulum, drive, 1.0 / 256.0);
        motor_advance(&motor, drive, 1.0 / 256.0);
        motor_advance(&fine_motor, drive, 1.0 / 256.0);
    }
    assert_near(fine_pendulum.state[PENDULUM_ANGLE],
                pendulum.state[PENDULUM_ANGLE], 1e-3 * 1e-6);
    assert_near(fine_motor.state[MOTOR_SPEED], motor.state[MOTOR_SPEED],
                0.47 * 1e-6);
}

static void decay(const void *plant, const double *state, double *rates)
{
    (void)plant;
    rates[0] = -state[0];
}

// Fourth order: half the step leaves a sixteenth of the error.
void test_integrator_is_of_fourth_order(void)
{
    double coarse = 1.0;
    double fine = 1.0;

    plant_integrate(decay, NULL, &coarse, 1, 1.0, 0.1);
    plant_integrate(decay, NULL, &fine, 1, 1.0, 0.05);
    assert_near(16.0, (coarse - exp(-1.0)) / (fine - exp(-1.0)), 1.0);
}

static void process_moves(int steps, double drive)
{
    for (int i = 0; i < steps; i++) {
        process_move(&process, drive);
    }
}

void test_process_lag_steps_as_an_exponential_after_its_dead_time(void)
{
    process = (struct process){
        .a1 = 2.0, .a0 = 1.0, .gain = 50.0, .dead_time_s = 0.35};
    process_start(&process, 0.1, 2.0);
    assert_near(0.35, process_dead_s(&process), 0.05);
    process.dead_time_s = 0.3;
    process_start(&process, 0.1, 2.0);
    assert_near(0.3, process_dead_s(&process), 1e-12);

    process_moves(3, 1.0);
    assert_near(0.0, process.state[PROCESS_VALUE], 0.0);
    process_moves(20, 1.0);
    assert_near(50.0 * (1.0 - exp(-1.0)), process.state[PROCESS_VALUE], 1e-5);
}

void test_process_oscillates_with_its_damping(void)
{
    // 2 rad/s, and a1 is 2 * 0.2 * 0.5.
    process = (struct process){.a2 = 0.25, .a1 = 0.2, .a0 = 1.0, .gain = 10.0};
    process_start(&process, 0.01, 0.5);
    process_moves(300, 1.0);

    const double fast = 2.0 * sqrt(1.0 - 0.04);
    const double envelope = exp(-0.2 * 2.0 * 3.0);
    const double wave =
        cos(fast * 3.0) + ((0.2 / sqrt(1.0 - 0.04)) * sin(fast * 3.0));
    assert_near(10.0 * (1.0 - (envelope * wave)), process.state[PROCESS_VALUE],
                1e-6);
}

void test_process_integrates_behind_its_lag(void)
{
    process = (struct process){.a2 = 0.5, .a1 = 1.0, .gain = 4.0};
    process_start(&process, 0.05, 0.5);
    process_moves(100, 0.5);
    assert_near(4.0 * 0.5 * (5.0 - (0.5 * (1.0 - exp(-10.0)))),
                process.state[PROCESS_VALUE], 1e-5);
}

void test_process_start_forgets_what_was_on_its_way(void)
{
    process =
        (struct process){.a1 = 1.0, .a0 = 1.0, .gain = 1.0, .dead_time_s = 1.0};
    process_start(&process, 0.1, 1.0);
    process_moves(5, 1.0);
    process_start(&process, 0.1, 1.0);
    process_moves(20, 0.0);
    assert_near(0.0, process.state[PROCESS_VALUE], 0.0);
}
