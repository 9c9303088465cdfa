// SPDX-License-Identifier: MIT
// The host port over a world that is only a clock, a voltage and a drive.
#include <stdlib.h>

#include "host.h"
#include "port.h"
#include "unity.h"
#include "world.h"

TEST_SOURCE_FILE("port/port_wait_ticks.c")
TEST_SOURCE_FILE("sim/host/port_host.c")
TEST_INCLUDE_PATH("sim/host")
TEST_INCLUDE_PATH("sim/world")
TEST_INCLUDE_PATH("port/pic/pic16f684")

static double now_s, voltage, drive;
static bool running;

void world_start(uint32_t seed)
{
    (void)seed;
    now_s = 0.0;
    drive = 0.0;
}

void world_advance(double seconds)
{
    now_s += seconds;
}

double world_time_s(void)
{
    return now_s;
}

bool world_running(void)
{
    return running;
}

double world_voltage(uint8_t channel)
{
    return channel == PORT_ANGLE ? voltage : 0.0;
}

void world_drive(double fraction)
{
    drive = fraction;
}

const char *const *world_trace_names(size_t *count)
{
    *count = 0;
    return NULL;
}

void world_trace(double *values)
{
    (void)values;
}

void host_probe(struct host_terms *terms)
{
    (void)terms;
}

void setUp(void)
{
    running = true;
    drive = 1.0;
    port_init();
}

void tearDown(void)
{
}

void test_port_running_ends_with_the_scenario(void)
{
    TEST_ASSERT_TRUE(port_running());
    running = false;
    TEST_ASSERT_FALSE(port_running());
}

void test_port_wait_tick_returns_once_per_tick(void)
{
    for (int i = 1; i <= 2560; i++) {
        TEST_ASSERT_EQUAL_UINT8(1, port_wait_tick());
        TEST_ASSERT_TRUE(now_s > i / 256.0 - 1e-6 && now_s < i / 256.0 + 1e-4);
    }
}

void test_port_wait_tick_after_a_long_turn_counts_what_was_missed(void)
{
    world_advance(3.5 / 256.0);
    TEST_ASSERT_EQUAL_UINT8(3, port_wait_tick());
    TEST_ASSERT_EQUAL_UINT8(1, port_wait_tick());
}

void test_port_wait_ticks_returns_with_the_last_of_them(void)
{
    static const uint8_t waits[] = {1, 2, 100, 255};
    double last_s = 0.0;

    for (int i = 0; i < 4; i++) {
        last_s += waits[i] / 256.0;
        TEST_ASSERT_EQUAL_UINT8(waits[i], port_wait_ticks(waits[i]));
        TEST_ASSERT_TRUE(now_s > last_s - 1e-6 && now_s < last_s + 1e-4);
    }
}

void test_port_wait_ticks_0_waits_for_one(void)
{
    TEST_ASSERT_EQUAL_UINT8(1, port_wait_ticks(0));
    TEST_ASSERT_TRUE(now_s > 1.0 / 256.0 - 1e-6);
}

void test_port_wait_ticks_counts_from_the_last_ones_taken(void)
{
    world_advance(3.5 / 256.0);
    TEST_ASSERT_EQUAL_UINT8(4, port_wait_ticks(4));
    TEST_ASSERT_TRUE(now_s < 4.1 / 256.0);
    world_advance(7.0 / 256.0);
    TEST_ASSERT_EQUAL_UINT8(7, port_wait_ticks(4));
}

void test_port_wait_ticks_saturates_at_255(void)
{
    world_advance(300.0 / 256.0);
    TEST_ASSERT_EQUAL_UINT8(255, port_wait_ticks(3));
    TEST_ASSERT_EQUAL_UINT8(1, port_wait_ticks(1));
}

void test_port_ticks_counts_and_does_not_wait(void)
{
    TEST_ASSERT_EQUAL_UINT8(0, port_ticks());
    world_advance(2.0 / 256.0);
    TEST_ASSERT_EQUAL_UINT8(2, port_ticks());
    TEST_ASSERT_EQUAL_UINT8(0, port_ticks());
}

void test_port_ticks_saturates_at_255(void)
{
    world_advance(300.0 / 256.0);
    TEST_ASSERT_EQUAL_UINT8(255, port_ticks());
    TEST_ASSERT_EQUAL_UINT8(0, port_ticks());
}

void test_port_ticks_polled_forever_lets_time_pass(void)
{
    unsigned ticks = 0;

    while (now_s < 1.0) {
        ticks += port_ticks();
    }
    TEST_ASSERT_UINT_WITHIN(1, 256, ticks);
}

void test_port_read_every_code_is_where_the_converter_has_it(void)
{
    for (uint16_t code = 0; code <= 1023; code++) {
        voltage = code / 1024.0;
        TEST_ASSERT_EQUAL_UINT16(code, port_read(PORT_ANGLE));
        voltage = (code + 0.999) / 1024.0;
        TEST_ASSERT_EQUAL_UINT16(code, port_read(PORT_ANGLE));
    }
    voltage = 1.0;
    TEST_ASSERT_EQUAL_UINT16(1023, port_read(PORT_ANGLE));
    TEST_ASSERT_EQUAL_UINT16(0, port_read(PORT_KD));
}

// docs/migrating.md: AN964's program loses the two low duty bits.
void test_port_drive_every_duty_count_reaches_the_bridge(void)
{
    for (int16_t duty = -PORT_DRIVE_FULL; duty <= PORT_DRIVE_FULL; duty++) {
        const bool made = abs(duty) >= PORT_DRIVE_LEAST;

        port_drive(duty);
        TEST_ASSERT_TRUE(drive ==
                         (made ? (double)duty / PORT_DRIVE_FULL : 0.0));
    }
}

void test_port_drive_beyond_full_is_limited_on_both_sides(void)
{
    port_drive(PORT_DRIVE_FULL + 1);
    TEST_ASSERT_TRUE(drive == 1.0);
    port_drive(INT16_MIN);
    TEST_ASSERT_TRUE(drive == -1.0);
    port_drive(INT16_MAX);
    TEST_ASSERT_TRUE(drive == 1.0);
}

void test_port_init_leaves_the_drive_off(void)
{
    port_drive(100);
    port_init();
    TEST_ASSERT_TRUE(drive == 0.0);
}

static int looks;
static double longest_s, looked_s;

static void look(void)
{
    looks++;
    longest_s = now_s - looked_s > longest_s ? now_s - looked_s : longest_s;
    looked_s = now_s;
}

void test_host_watch_looks_four_times_a_tick(void)
{
    looks = 0;
    longest_s = 0.0;
    looked_s = now_s;
    host_watch = look;
    (void)port_wait_ticks(10);
    (void)port_read(PORT_ANGLE);
    port_drive(0);
    host_watch = NULL;
    TEST_ASSERT_GREATER_THAN_INT(40, looks);
    TEST_ASSERT_TRUE(longest_s <= 0.25 / 256.0 + 1e-9);
}

void test_host_shift_ticks_adds_and_removes_ticks(void)
{
    host_shift_ticks(2.0);
    TEST_ASSERT_EQUAL_UINT8(2, port_ticks());
    host_shift_ticks(0.0);
    TEST_ASSERT_EQUAL_UINT8(0, port_ticks());
    TEST_ASSERT_EQUAL_UINT8(1, port_wait_tick());
    TEST_ASSERT_TRUE(now_s > 3.0 / 256.0 - 1e-6); // two had been told before
}

void test_host_shift_ticks_by_half_makes_a_tick_late(void)
{
    host_shift_ticks(-0.5);
    TEST_ASSERT_EQUAL_UINT8(1, port_wait_tick());
    TEST_ASSERT_TRUE(now_s > 1.5 / 256.0 - 1e-6 && now_s < 1.6 / 256.0);
}

void test_host_fed_is_when_a_tick_was_told(void)
{
    (void)port_wait_tick();
    const double told_s = now_s;
    (void)port_ticks();
    TEST_ASSERT_TRUE(host_fed_s() == told_s);
}

void test_host_reset_switches_off_and_leaves_the_world(void)
{
    (void)port_wait_ticks(5);
    port_drive(100);
    host_reset();
    TEST_ASSERT_TRUE(drive == 0.0);
    TEST_ASSERT_EQUAL_INT16(0, host_drive_counts());
    const double before_s = now_s;
    port_init();
    TEST_ASSERT_TRUE(now_s == before_s);
    TEST_ASSERT_EQUAL_UINT8(1, port_wait_tick());
}

void test_host_drive_asked_is_before_the_limit(void)
{
    port_drive(300);
    TEST_ASSERT_EQUAL_INT16(300, host_drive_asked());
    TEST_ASSERT_EQUAL_INT16(PORT_DRIVE_FULL, host_drive_counts());
}
