// SPDX-License-Identifier: MIT
// The logic of examples/watched/ with the port and its UART mocked.
#include "mock_port.h"
#include "mock_port_uart.h"
#include "unity.h"

#include <string.h>

#include "fixpid_record.h"
#include "link_frames.h"

TEST_SOURCE_FILE("src/link/fixpid_link.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_state.c")
TEST_SOURCE_FILE("src/record/fixpid_record.c")
TEST_INCLUDE_PATH("port/pic/pic18f4520")
TEST_INCLUDE_PATH("examples/watched")

int application_main(void);
#define main application_main
#include "watched.c"
#undef main

#define KEY_AT_SETPOINT 7
#define KEY_AT_MEASUREMENT 9

static uint8_t sent[256]; // of the last pass
static unsigned sent_bytes;
static uint8_t arriving[LINK_FRAMES_MAX];
static unsigned arriving_bytes;
static unsigned arrived;
static uint8_t room;
static int passes_left;
static int16_t duty;

static void put(uint8_t byte, int calls)
{
    (void)calls;
    sent[sent_bytes] = byte;
    sent_bytes++;
}

static uint8_t has_room(int calls)
{
    (void)calls;
    return room;
}

static uint8_t waiting(int calls)
{
    (void)calls;
    return (uint8_t)(arriving_bytes - arrived);
}

static uint8_t get(int calls)
{
    (void)calls;
    arrived++;
    return arriving[arrived - 1];
}

static bool running(int calls)
{
    (void)calls;
    passes_left--;
    return passes_left >= 0;
}

static uint16_t convert(uint8_t channel, int calls)
{
    (void)calls;
    return channel == PORT_SETPOINT ? 500 : 300;
}

static void drive(int16_t value, int calls)
{
    (void)calls;
    duty = value;
}

void setUp(void)
{
    sent_bytes = 0;
    arriving_bytes = 0;
    arrived = 0;
    room = PORT_UART_OUT;
    duty = 0;
    port_init_Ignore();
    port_uart_init_Ignore();
    port_wait_ticks_IgnoreAndReturn(CONTROL_PERIOD_TICKS);
    port_running_Stub(running);
    port_read_Stub(convert);
    port_drive_Stub(drive);
    port_uart_put_Stub(put);
    port_uart_room_Stub(has_room);
    port_uart_waiting_Stub(waiting);
    port_uart_get_Stub(get);
}

void tearDown(void)
{
}

static void power_on(int passes)
{
    passes_left = passes;
    TEST_ASSERT_EQUAL_INT(0, application_main());
}

// One pass more, as if the loop had gone on.
static void pass(void)
{
    sent_bytes = 0;
    control();
    serve();
}

static void arrives(uint8_t command, uint8_t tag, uint8_t value, unsigned bytes)
{
    const uint8_t payload[] = {command, tag, value, 0};

    arriving_bytes = link_command(payload, bytes + 2, arriving);
    arrived = 0;
}

// Of the frame that was sent, without the 0 in front of an answer.
static unsigned payload_of(uint8_t payload[], unsigned front)
{
    return link_payload(sent + front, sent_bytes - front - 1, payload);
}

void test_main_drives_and_sends_nothing_without_a_stream(void)
{
    power_on(3);
    TEST_ASSERT_GREATER_THAN_INT16(0, duty);
    TEST_ASSERT_EQUAL_UINT(0, sent_bytes);
}

void test_main_answers_a_stream_and_sends_each_step_from_a_key_frame_on(void)
{
    uint8_t payload[LINK_FRAMES_MAX];

    arrives(LINK_SET_STREAM, 1, 1, 1);
    power_on(1);
    TEST_ASSERT_EQUAL_UINT(4, payload_of(payload, 1));
    TEST_ASSERT_EQUAL_HEX8(LINK_ANSWER, payload[0]);
    TEST_ASSERT_EQUAL_HEX8(LINK_DONE, payload[3]);
    pass();
    TEST_ASSERT_EQUAL_UINT(FIXPID_LINK_FRAME - 1, sent_bytes);
    TEST_ASSERT_NOT_EQUAL(0, payload_of(payload, 0));
    TEST_ASSERT_EQUAL_HEX8(LINK_KEY, payload[0]);
    TEST_ASSERT_EQUAL_UINT(500, link_number(payload + KEY_AT_SETPOINT, 2));
    TEST_ASSERT_EQUAL_UINT(300, link_number(payload + KEY_AT_MEASUREMENT, 2));
    pass();
    TEST_ASSERT_EQUAL_UINT(7, payload_of(payload, 0));
    TEST_ASSERT_EQUAL_HEX8(LINK_STEP, payload[0] & LINK_STEP);
}

void test_main_sends_the_record_of_its_configuration(void)
{
    uint8_t payload[LINK_FRAMES_MAX];
    struct fixpid_record record;

    arrives(LINK_ASK_RECORD, 1, 0, 0);
    power_on(1);
    fixpid_record_pack(&record, &config);
    TEST_ASSERT_EQUAL_UINT(2 + FIXPID_RECORD_SIZE, payload_of(payload, 1));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(record.bytes, payload + 2, FIXPID_RECORD_SIZE);
}

void test_main_says_its_period_and_its_name(void)
{
    uint8_t payload[LINK_FRAMES_MAX];

    arrives(LINK_ASK_HELLO, 1, 0, 0);
    power_on(1);
    TEST_ASSERT_EQUAL_UINT(24, payload_of(payload, 1));
    TEST_ASSERT_EQUAL_UINT(CONTROL_PERIOD_TICKS * 1000u,
                           link_number(payload + 8, 4));
    TEST_ASSERT_EQUAL_STRING_LEN("motor", payload + 14, 6);
}

void test_main_does_not_let_a_setpoint_in(void)
{
    uint8_t payload[LINK_FRAMES_MAX];

    arrives(LINK_SET_SETPOINT, 1, 100, 2);
    power_on(1);
    TEST_ASSERT_EQUAL_UINT(4, payload_of(payload, 1));
    TEST_ASSERT_EQUAL_HEX8(LINK_NOT_ALLOWED, payload[3]);
}

// The step is lost, the answer waits, and the next frame has the state.
void test_main_without_room_drops_a_step_and_then_sends_a_key_frame(void)
{
    uint8_t payload[LINK_FRAMES_MAX];

    arrives(LINK_SET_STREAM, 1, 1, 1);
    power_on(1);
    pass();
    room = 10;
    pass();
    TEST_ASSERT_EQUAL_UINT(0, sent_bytes);
    room = PORT_UART_OUT;
    pass();
    TEST_ASSERT_NOT_EQUAL(0, payload_of(payload, 0));
    TEST_ASSERT_EQUAL_HEX8(LINK_KEY, payload[0]);
    TEST_ASSERT_EQUAL_HEX8(LINK_LOST, payload[1]);
}

void test_main_without_room_for_the_longest_frame_lets_a_command_wait(void)
{
    room = FIXPID_LINK_FRAME - 1;
    arrives(LINK_ASK_HELLO, 1, 0, 0);
    power_on(1);
    TEST_ASSERT_EQUAL_UINT(0, sent_bytes);
    room = FIXPID_LINK_FRAME;
    pass();
    TEST_ASSERT_EQUAL_UINT(FIXPID_LINK_FRAME, sent_bytes + 1);
}
