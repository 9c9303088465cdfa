// SPDX-License-Identifier: MIT
// The random plants against what their equations say in closed form, and the
// judge against loops whose stability and Ms are known.
#include <math.h>
#include <stdio.h>

#include "chance.h"
#include "design.h"
#include "families.h"
#include "families_batch.h"
#include "judge.h"
#include "linear.h"
#include "unity.h"

TEST_SOURCE_FILE("sim/random_plants/answer.c")
TEST_SOURCE_FILE("sim/random_plants/chance.c")
TEST_SOURCE_FILE("sim/random_plants/families.c")
TEST_SOURCE_FILE("sim/random_plants/families_batch.c")
TEST_SOURCE_FILE("sim/random_plants/judge.c")
TEST_SOURCE_FILE("sim/random_plants/linear.c")
TEST_SOURCE_FILE("sim/random_plants/machine.c")
TEST_SOURCE_FILE("sim/random_plants/machine_kinds.c")
TEST_INCLUDE_PATH("sim/random_plants")

#define HALF_TURN 3.141592653589793

static struct subject subject;
static struct sampled sampled;
static struct motion motion;
static struct judge judge;

static void assert_near(double expected, double actual, double tolerance)
{
    char message[100];

    snprintf(message, sizeof message, "expected %.12g, was %.12g, +-%.3g",
             expected, actual, tolerance);
    TEST_ASSERT_TRUE_MESSAGE(fabs(expected - actual) <= tolerance, message);
}

void setUp(void)
{
    subject = (struct subject){.period_steps = 20.0};
}

void tearDown(void)
{
}

// ki and kp alone.
static bool is_stable(double kp, double ki)
{
    const struct design design = {true, kp, ki, 0.0, 0};

    return judge_sensitivity(&judge, &design) < HUGE_VAL;
}

static void judge_it(void)
{
    judge_start(&judge, &subject, JUDGE_FINE);
}

// Of one section: gain / (level + s).
static void first_order(double gain, double level)
{
    linear_add(&subject.plant,
               (struct section){{gain, 0.0}, {level, 1.0, 0.0}});
}

void test_motion_a_lag_behind_a_dead_time_with_a_fraction_is_exact(void)
{
    linear_lag(&subject.plant, 10.0);
    subject.plant.dead_steps = 2.3;
    sampled_start(&sampled, &subject.plant);
    motion_start(&motion, &sampled);

    for (int step = 1; step < 40; step++) {
        motion_move(&motion, 1.0);
        assert_near((step < 3) ? 0.0 : 1.0 - exp(-(step - 2.3) / 10.0),
                    motion_value(&motion), 1e-12);
    }
}

// 1 / (1 + 2 z s + s^2) from rest, z = 0.5.
void test_motion_an_oscillatory_plant_is_exact(void)
{
    const double speed = sqrt(0.75);

    linear_add(&subject.plant, (struct section){{1.0, 0.0}, {1.0, 1.0, 1.0}});
    sampled_start(&sampled, &subject.plant);
    motion_start(&motion, &sampled);

    for (int step = 1; step < 20; step++) {
        motion_move(&motion, 1.0);
        assert_near(
            1.0 - (exp(-step / 2.0) *
                   (cos(speed * step) + (0.5 / speed * sin(speed * step)))),
            motion_value(&motion), 1e-12);
    }
}

// (1 - s) / (1 + s) answers a step with -1 at once.
void test_motion_what_comes_at_once_counts_only_where_it_is_asked_for(void)
{
    linear_add(&subject.plant, (struct section){{1.0, -1.0}, {1.0, 1.0, 0.0}});
    sampled_start(&sampled, &subject.plant);
    motion_start(&motion, &sampled);
    motion_move(&motion, 1.0);
    assert_near(2.0 - (2.0 * exp(-1.0)), motion_value(&motion), 1e-12);

    subject.plant.at_once = true;
    sampled_start(&sampled, &subject.plant);
    motion_start(&motion, &sampled);
    motion_move(&motion, 1.0);
    assert_near(1.0 - (2.0 * exp(-1.0)), motion_value(&motion), 1e-12);
}

void test_motion_at_rest_stays_there(void)
{
    linear_lag(&subject.plant, 10.0);
    linear_lag(&subject.plant, 3.0);
    linear_amplify(&subject.plant, 4.0);
    subject.plant.dead_steps = 5.5;
    sampled_start(&sampled, &subject.plant);
    motion_start(&motion, &sampled);
    motion_rest(&motion, 2.0);

    for (int step = 0; step < 20; step++) {
        assert_near(8.0, motion_value(&motion), 1e-10);
        motion_move(&motion, 2.0);
    }
}

void test_motion_falls_as_the_other_plant(void)
{
    struct sampled slower;
    struct linear slow = {.count = 0};

    linear_lag(&subject.plant, 10.0);
    linear_lag(&slow, 30.0);
    sampled_start(&sampled, &subject.plant);
    sampled_start(&slower, &slow);
    motion_start(&motion, &sampled);
    motion.falling = &slower;
    motion_rest(&motion, 1.0);

    motion_move(&motion, 0.0);
    assert_near(exp(-1.0 / 30.0), motion_value(&motion), 1e-12);
    motion_move(&motion, 2.0);
    assert_near(2.0 - ((2.0 - exp(-1.0 / 30.0)) * exp(-0.1)),
                motion_value(&motion), 1e-12);
}

// (1 - a) / (z - a) / z^2
void test_response_of_a_lag_is_its_pulse_transfer_function(void)
{
    const double kept = exp(-0.1);
    const double radians = 0.7;
    const double complex turn = cexp(I * radians);
    double complex expected = (1.0 - kept) / (turn - kept) / (turn * turn);

    linear_lag(&subject.plant, 10.0);
    subject.plant.dead_steps = 2.0;
    sampled_start(&sampled, &subject.plant);

    expected -= sampled_response(&sampled, radians);
    assert_near(0.0, cabs(expected), 1e-12);
}

// With b / (z - a) and an integral alone, z^2 + (b ki - a - 1) z + a: stable
// while b ki < 2 (1 + a), beyond which the sign changes with every step.
void test_sensitivity_a_loop_that_changes_sign_with_every_step_is_unstable(void)
{
    const double kept = exp(-1.0);
    const double limit = 2.0 * (1.0 + kept) / (1.0 - kept);

    first_order(1.0, 1.0);
    judge_it();

    TEST_ASSERT_TRUE(is_stable(0.0, 0.99 * limit));
    TEST_ASSERT_FALSE(is_stable(0.0, 1.01 * limit));
}

// With 1 / (z - 1) / z and next to no integral, z^2 - z + kp: two poles leave
// the circle at kp = 1.
void test_sensitivity_a_loop_that_oscillates_more_and_more_is_unstable(void)
{
    linear_integrate(&subject.plant);
    subject.plant.dead_steps = 1.0;
    judge_it();

    TEST_ASSERT_TRUE(is_stable(0.98, 1e-4));
    TEST_ASSERT_FALSE(is_stable(1.02, 1e-4));
}

// With b / (z - a), a > 1, and next to no integral: stable for b kp > a - 1.
void test_sensitivity_an_unstable_plant_needs_enough_gain(void)
{
    const double grown = exp(0.1);
    const double least = (grown - 1.0) / ((grown - 1.0) / 0.1);

    first_order(1.0, -0.1);
    subject.plant.unstable = true;
    judge_it();

    TEST_ASSERT_TRUE(is_stable(1.05 * least, 1e-5));
    TEST_ASSERT_FALSE(is_stable(0.95 * least, 1e-5));
    TEST_ASSERT_FALSE(is_stable(1e-6, 1e-7));
}

// The controller's zero takes the lag away and leaves g / (z - 1), whose
// sensitivity is largest at z = -1: 2 / (2 - g).
void test_sensitivity_of_a_lag_that_is_cancelled_is_known(void)
{
    const double kept = exp(-0.1);
    const double loop = 0.8;
    const double both = loop / (1.0 - kept); // kp + ki
    const struct design design = {true, both * kept, both * (1.0 - kept), 0.0,
                                  0};

    linear_lag(&subject.plant, 10.0);
    judge_it();

    assert_near(2.0 / (2.0 - loop), judge_sensitivity(&judge, &design), 1e-9);
}

// A derivative of one step whose filter is off is kd (1 - 1 / z): with kp, ki
// and 1 / (z - 1), and kd = kp, the loop at z = -1 is known.
void test_sensitivity_knows_the_derivative_and_its_filter(void)
{
    // At z = -1: C = kp + ki / 2 + 2 kd / (1 + kept), P = -1 / 2.
    const struct design plain = {true, 0.5, 1e-6, 0.5, 0};
    const struct design filtered = {true, 0.5, 1e-6, 0.5, 1};

    linear_integrate(&subject.plant);
    judge_it();

    assert_near(1.0 / (1.0 - 0.75), judge_sensitivity(&judge, &plain), 1e-5);
    assert_near(1.0 / (1.0 - (0.25 + (1.0 / 3.0))),
                judge_sensitivity(&judge, &filtered), 1e-5);
}

// No other PI controller with this Ms has a larger ki.
void test_best_has_the_wanted_ms_and_no_neighbour_is_better(void)
{
    struct design best;

    linear_lag(&subject.plant, 10.0);
    subject.plant.dead_steps = 5.0;
    judge_it();
    best = judge_best(&judge, 20.0, 1.6);

    TEST_ASSERT_TRUE(best.found);
    assert_near(1.6, judge_sensitivity(&judge, &best), 0.01);
    for (int i = 1; i < 40; i++) {
        const double kp = best.kp * 0.05 * i;
        const struct design other = {true, kp, best.ki * 1.1, 0.0, 0};
        TEST_ASSERT_TRUE(judge_sensitivity(&judge, &other) > 1.6);
    }
}

// All but those that would have to be stretched too far.
void test_draw_every_family_has_its_phase_at_its_period(void)
{
    for (int family = 0; family <= FAMILY_AT_ONCE; family++) {
        int there = 0;
        for (long number = 0; number < 100; number++) {
            const struct subject drawn =
                draw_subject(1, number, (enum family)family);
            const double step = 2.0 * HALF_TURN / drawn.period_steps;
            const double phase = linear_phase(&drawn.plant, step);
            if (fabs(phase + HALF_TURN - (step / 2.0)) < 1e-6) {
                there++;
            }
        }
        TEST_ASSERT_GREATER_OR_EQUAL_MESSAGE(85, there,
                                             family_name((enum family)family));
    }
}

void test_draw_unstable_plants_can_be_simulated(void)
{
    for (long number = 0; number < 500; number++) {
        subject = draw_subject(1, number, FAMILY_UNSTABLE);
        sampled_start(&sampled, &subject.plant);

        TEST_ASSERT_TRUE(subject.plant.unstable);
        TEST_ASSERT_TRUE(sampled.transition[0][0] > 1.0);
        TEST_ASSERT_TRUE(sampled.transition[0][0] < 2.0);
    }
}

void test_draw_circumstances_are_those_of_the_family(void)
{
    for (long number = 0; number < 200; number++) {
        const struct subject low = draw_subject(1, number, FAMILY_HOLDING_LOW);
        const struct subject high =
            draw_subject(1, number, FAMILY_HOLDING_HIGH);

        TEST_ASSERT_TRUE(low.holding >= 0.03 && low.holding <= 0.05);
        TEST_ASSERT_TRUE(high.holding >= 0.93 && high.holding <= 0.97);
        TEST_ASSERT_FALSE(low.plant.integrating || high.plant.integrating);
        TEST_ASSERT_TRUE(draw_subject(1, number, FAMILY_LOAD).load_at > 0);
        TEST_ASSERT_TRUE(draw_subject(1, number, FAMILY_HEATER).cooling >= 2.0);
        TEST_ASSERT_TRUE(draw_subject(1, number, FAMILY_BACKLASH).backlash >
                         0.0);
        TEST_ASSERT_EQUAL(255,
                          draw_subject(1, number, FAMILY_COARSE).output_max);
    }
}

void test_draw_another_seed_draws_others_and_the_same_the_same(void)
{
    const struct subject one = draw_subject(1, 7, FAMILY_BALANCED);
    const struct subject same = draw_subject(1, 7, FAMILY_BALANCED);
    const struct subject other = draw_subject(2, 7, FAMILY_BALANCED);

    TEST_ASSERT_EQUAL_UINT64(one.chance.state, same.chance.state);
    TEST_ASSERT_TRUE(one.period_steps == same.period_steps);
    TEST_ASSERT_TRUE(one.chance.state != other.chance.state);
    TEST_ASSERT_TRUE(one.period_steps != other.period_steps);
}
