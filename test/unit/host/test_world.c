// SPDX-License-Identifier: MIT
// The analog inputs of a world, whole and broken, over a scene that is only a
// voltage.
#include "scene.h"
#include "unity.h"

TEST_INCLUDE_PATH("sim/world")

// The project's other tests of the host have a world of their own.
#include "world.c"

#define CHANNEL 5u
#define OTHER 6u

struct world_option scene_options[] = {{"seconds", 10.0, 0.0, 10.0, ""}};
const size_t scene_option_count = 1;
const char *const scene_trace_names[] = {"voltage"};
const size_t scene_trace_count = 1;

static double volts;

void scene_start(void)
{
    volts = 0.25;
}

void scene_update(double time_s)
{
    (void)time_s;
}

void scene_advance(double fraction, double seconds)
{
    (void)fraction;
    (void)seconds;
}

double scene_voltage(uint8_t channel, double *noise)
{
    (void)channel;
    *noise = 0.0;
    return volts;
}

void scene_trace(double *values)
{
    values[0] = volts;
}

void setUp(void)
{
    world_break_input(CHANNEL, WORLD_WHOLE, 0.0);
    world_start(1);
}

void tearDown(void)
{
}

static void reads(double wanted)
{
    const double found = world_voltage(CHANNEL);
    TEST_ASSERT_TRUE(found > wanted - 1e-9 && found < wanted + 1e-9);
}

void test_world_voltage_is_the_scenes(void)
{
    reads(0.25);
}

void test_world_break_input_stuck_reads_what_it_read(void)
{
    reads(0.25);
    world_break_input(CHANNEL, WORLD_STUCK, 0.0);
    volts = 0.75;
    reads(0.25);
    world_break_input(CHANNEL, WORLD_WHOLE, 0.0);
    reads(0.75);
}

void test_world_break_input_reads_a_value_and_no_other_input_does(void)
{
    world_break_input(CHANNEL, WORLD_READS, 1.0);
    reads(1.0);
    TEST_ASSERT_TRUE(world_voltage(OTHER) < 0.26);
}

void test_world_break_input_clipped_reaches_neither_end(void)
{
    world_break_input(CHANNEL, WORLD_CLIPPED, 0.6);
    reads(0.4);
    volts = 0.5;
    reads(0.5);
    volts = 0.9;
    reads(0.6);
}

void test_world_break_input_noisy_has_that_deviation(void)
{
    double sum = 0.0;
    double squares = 0.0;
    world_break_input(CHANNEL, WORLD_NOISY, 0.02);
    for (int i = 0; i < 10000; i++) {
        const double off = world_voltage(CHANNEL) - 0.25;
        sum += off;
        squares += off * off;
    }
    TEST_ASSERT_TRUE(sum / 10000.0 < 0.001 && sum / 10000.0 > -0.001);
    TEST_ASSERT_TRUE(squares / 10000.0 > 0.019 * 0.019);
    TEST_ASSERT_TRUE(squares / 10000.0 < 0.021 * 0.021);
}

void test_world_break_input_moved_goes_up_and_down(void)
{
    world_break_input(CHANNEL, WORLD_MOVED, 2.0); // twice a second
    reads(0.0);
    world_advance(0.125);
    reads(0.5);
    world_advance(0.125);
    reads(1.0);
    world_advance(0.125);
    reads(0.5);
}
