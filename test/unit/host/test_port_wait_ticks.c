// SPDX-License-Identifier: MIT
// port_wait_ticks over ticks that come as a test says.
#include "port.h"
#include "unity.h"

TEST_SOURCE_FILE("port/port_wait_ticks.c")
TEST_INCLUDE_PATH("port/pic/pic16f684")

static uint8_t coming; // with each wait
static int waits;

uint8_t port_wait_tick(void)
{
    waits++;
    return coming;
}

void setUp(void)
{
    waits = 0;
}

void tearDown(void)
{
}

void test_port_wait_ticks_waits_tick_by_tick(void)
{
    coming = 1;
    TEST_ASSERT_EQUAL_UINT8(255, port_wait_ticks(255));
    TEST_ASSERT_EQUAL_INT(255, waits);
}

void test_port_wait_ticks_tells_what_came_beyond_n(void)
{
    coming = 7;
    TEST_ASSERT_EQUAL_UINT8(14, port_wait_ticks(10));
    TEST_ASSERT_EQUAL_INT(2, waits);
}

void test_port_wait_ticks_saturates_where_a_wait_passes_255(void)
{
    coming = 128;
    TEST_ASSERT_EQUAL_UINT8(255, port_wait_ticks(129));
    coming = 127;
    TEST_ASSERT_EQUAL_UINT8(254, port_wait_ticks(128));
    coming = 85;
    TEST_ASSERT_EQUAL_UINT8(255, port_wait_ticks(200));
    coming = 255;
    TEST_ASSERT_EQUAL_UINT8(255, port_wait_ticks(255));
}
