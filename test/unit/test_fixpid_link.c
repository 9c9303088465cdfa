// SPDX-License-Identifier: MIT
// The recorded rows, each sentence of the header, and the edges.
#include <stdio.h>
#include <string.h>

#include "fixpid_link.h"
#include "fixpid_pid.h"
#include "fixpid_record.h"
#include "link_frames.h"
#include "poison.h"
#include "unity.h"
#include "vectors.h"

TEST_SOURCE_FILE("src/link/fixpid_link.c")
TEST_SOURCE_FILE("src/link/fixpid_link_commands.c")
TEST_SOURCE_FILE("src/link/fixpid_link_tracked.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_state.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_track.c")
TEST_SOURCE_FILE("src/record/fixpid_record.c")

#define ALL 0x0F

// Columns of link.csv.
enum {
    RUN,
    EVENT,
    IN,
    IN_WORDS,
    MEASUREMENT = IN_WORDS + 16,
    OUTPUT,
    TAKEN,
    OUT,
    OUT_WORDS,
    SETPOINT = OUT_WORDS + 16,
    FLAGS
};
enum { INIT, ALLOW, RECEIVE, STEP, RESET, LOST, HAND };
#define ROWS 348

FIXPID_DATA struct fixpid_link link_controller;
FIXPID_DATA struct fixpid_pid pid_controller;

static struct fixpid_link_board board;
static struct fixpid_pid_config config;
static int16_t output;
static uint8_t payload[LINK_FRAMES_MAX]; // of the last frame

void setUp(void)
{
    board = (struct fixpid_link_board){.period_us = UINT32_C(0x01020305),
                                       .manual_steps = 3,
                                       .setpoint_min = -100,
                                       .setpoint_max = 900,
                                       .output_min = -300,
                                       .output_max = 400,
                                       .name = "oven 1"};
    config =
        (struct fixpid_pid_config){.gains = {512, UINT32_C(838861), 640, 2},
                                   .output_min = -200,
                                   .output_max = 300,
                                   .integral_min = -150,
                                   .integral_max = 250,
                                   .setpoint_weight_q8 = 128};
    TEST_ASSERT_TRUE(fixpid_pid_init(&pid_controller, &config));
    fixpid_link_init(&link_controller, 100);
}

void tearDown(void)
{
}

// ---- The recorded rows ----

static uint8_t byte_of(const int32_t words[], unsigned at)
{
    return (uint8_t)((uint32_t)words[at / 4] >> (at % 4 * 8));
}

static int16_t word_of(const int32_t words[], unsigned at)
{
    return (int16_t)(byte_of(words, at) |
                     (uint16_t)(byte_of(words, at + 1) << 8));
}

static void init_row(const int32_t words[])
{
    struct fixpid_record record;

    for (unsigned at = 0; at < sizeof record.bytes; at++) {
        record.bytes[at] = byte_of(words, at);
    }
    TEST_ASSERT_TRUE(fixpid_record_unpack(&record, &config));
    board.period_us = (uint16_t)word_of(words, 23) |
                      ((uint32_t)(uint16_t)word_of(words, 25) << 16);
    board.manual_steps = (uint16_t)word_of(words, 27);
    board.setpoint_min = word_of(words, 29);
    board.setpoint_max = word_of(words, 31);
    board.output_min = word_of(words, 33);
    board.output_max = word_of(words, 35);
    for (unsigned at = 0; at < sizeof board.name; at++) {
        board.name[at] = byte_of(words, 37 + at);
    }
    TEST_ASSERT_TRUE(fixpid_pid_init(&pid_controller, &config));
    fixpid_link_init(&link_controller, word_of(words, 47));
}

static uint8_t answer(void)
{
    return fixpid_link_answer(&link_controller, &board, &pid_controller,
                              &config);
}

static unsigned receive_row(const int32_t row[], uint8_t frames[],
                            unsigned *taken)
{
    unsigned count = 0;

    for (unsigned at = 0; at < (unsigned)row[IN]; at++) {
        if (fixpid_link_receive(&link_controller,
                                byte_of(row + IN_WORDS, at))) {
            const uint8_t bytes = answer();

            memcpy(frames + count, link_controller.frame, bytes);
            count += bytes;
            (*taken)++;
        }
    }
    return count;
}

static unsigned step_row(const int32_t row[], uint8_t frames[])
{
    uint8_t bytes;

    output = fixpid_pid_step(&pid_controller, (int16_t)row[SETPOINT],
                             (int16_t)row[MEASUREMENT]);
    bytes = fixpid_link_step(&link_controller, &pid_controller,
                             (int16_t)row[SETPOINT], (int16_t)row[MEASUREMENT],
                             output);
    memcpy(frames, link_controller.frame, bytes);
    TEST_ASSERT_EQUAL(row[OUTPUT], output);
    return bytes;
}

static void other_row(const int32_t row[])
{
    switch (row[EVENT]) {
    case INIT:
        init_row(row + IN_WORDS);
        break;
    case ALLOW:
        fixpid_link_allow(&link_controller, byte_of(row + IN_WORDS, 0));
        break;
    case RESET:
        fixpid_pid_reset(&pid_controller);
        fixpid_link_changed(&link_controller);
        break;
    case HAND:
        fixpid_pid_set_manual(&pid_controller, word_of(row + IN_WORDS, 0));
        fixpid_link_taken(&link_controller);
        break;
    default:
        TEST_ASSERT_EQUAL(LOST, row[EVENT]);
        fixpid_link_lost(&link_controller);
        break;
    }
}

// Puts the library's version into a frame, without the 0 behind it, if that is
// a hello: the rows were recorded with another one.
static void put_version(uint8_t frame[], unsigned count)
{
    uint8_t hello[LINK_FRAMES_MAX];
    const unsigned bytes = link_payload(frame, count, hello);
    uint16_t check;

    if (bytes != 24 || hello[0] != LINK_HELLO) {
        return;
    }
    hello[3] = FIXPID_VERSION_MAJOR;
    hello[4] = FIXPID_VERSION_MINOR;
    hello[5] = FIXPID_VERSION_PATCH;
    check = link_check(hello, bytes);
    hello[bytes] = (uint8_t)check;
    hello[bytes + 1] = (uint8_t)(check >> 8);
    TEST_ASSERT_EQUAL(count + 1, link_stuffed(hello, bytes + 2, frame));
}

// The frames of a row, one behind the other.
static void recorded_frames(const int32_t row[], uint8_t frames[])
{
    unsigned begin = 0;

    for (unsigned at = 0; at < (unsigned)row[OUT]; at++) {
        frames[at] = byte_of(row + OUT_WORDS, at);
        if (frames[at] == 0) {
            put_version(frames + begin, at - begin);
            begin = at + 1;
        }
    }
}

static void play(const int32_t row[], unsigned number)
{
    uint8_t frames[64];
    uint8_t expected[64];
    unsigned bytes = 0;
    unsigned taken = 0;
    char text[32];

    snprintf(text, sizeof text, "row %u", number);
    if (row[EVENT] == RECEIVE) {
        bytes = receive_row(row, frames, &taken);
    } else if (row[EVENT] == STEP) {
        bytes = step_row(row, frames);
    } else {
        other_row(row);
    }
    TEST_ASSERT_EQUAL_MESSAGE(row[TAKEN], taken, text);
    TEST_ASSERT_EQUAL_MESSAGE(row[OUT], bytes, text);
    recorded_frames(row, expected);
    for (unsigned at = 0; at < bytes; at++) {
        TEST_ASSERT_EQUAL_HEX8_MESSAGE(expected[at], frames[at], text);
    }
    if (row[EVENT] != STEP) {
        TEST_ASSERT_EQUAL_MESSAGE(row[SETPOINT],
                                  fixpid_link_setpoint(&link_controller), text);
    }
    TEST_ASSERT_EQUAL_HEX8_MESSAGE(row[FLAGS],
                                   fixpid_pid_flags(&pid_controller), text);
}

void test_recorded_rows_are_equal_bit_for_bit(void)
{
    int32_t row[VECTORS_COLUMNS_MAX];
    unsigned rows = 0;

    VECTORS_OPEN(link);
    while (vectors_next(row)) {
        rows++;
        play(row, rows);
    }
    TEST_ASSERT_EQUAL(ROWS, rows);
}

// ---- What the tests below say ----

static bool received(const uint8_t bytes[], unsigned count)
{
    bool whole = false;

    for (unsigned at = 0; at < count; at++) {
        TEST_ASSERT_FALSE(whole);
        whole = fixpid_link_receive(&link_controller, bytes[at]);
    }
    return whole;
}

static bool sent(const uint8_t command[], unsigned count)
{
    uint8_t framed[LINK_FRAMES_MAX];

    return received(framed, link_command(command, count, framed));
}

// The payload of an answer, which has a 0 in front.
static unsigned answered(void)
{
    const uint8_t bytes = answer();

    if (bytes == 0) {
        return 0;
    }
    TEST_ASSERT_EQUAL_HEX8(0, link_controller.frame[0]);
    TEST_ASSERT_EQUAL_HEX8(0, link_controller.frame[bytes - 1]);
    return link_payload(link_controller.frame + 1, bytes - 2u, payload);
}

static void result_is(uint8_t tag, uint8_t command, uint8_t result)
{
    const uint8_t expected[] = {LINK_ANSWER, tag, command, result};

    TEST_ASSERT_EQUAL(4, answered());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, payload, 4);
}

// A command of a value of 16 bits, or of none, and what it is answered.
static void gives(uint8_t command, uint8_t tag, int16_t value, uint8_t result)
{
    const uint8_t bytes[] = {command, tag, (uint8_t)value,
                             (uint8_t)((uint16_t)value >> 8)};
    unsigned count = 4;

    if (command == LINK_SET_STREAM) {
        count = 3;
    } else if (command == LINK_SET_AUTO) {
        count = 2;
    }
    TEST_ASSERT_TRUE(sent(bytes, count));
    result_is(tag, command, result);
}

static void writes(uint8_t tag, const struct fixpid_pid_config *wanted,
                   uint8_t result)
{
    struct fixpid_record record;
    uint8_t bytes[2 + FIXPID_RECORD_SIZE] = {LINK_WRITE, tag};

    fixpid_record_pack(&record, wanted);
    memcpy(bytes + 2, record.bytes, sizeof record.bytes);
    TEST_ASSERT_TRUE(sent(bytes, sizeof bytes));
    result_is(tag, LINK_WRITE, result);
}

static unsigned framed_step(int16_t setpoint, int16_t measurement)
{
    uint8_t bytes;

    output = fixpid_pid_step(&pid_controller, setpoint, measurement);
    bytes = fixpid_link_step(&link_controller, &pid_controller, setpoint,
                             measurement, output);
    if (bytes == 0) {
        return 0;
    }
    TEST_ASSERT_EQUAL_HEX8(0, link_controller.frame[bytes - 1]);
    return link_payload(link_controller.frame, bytes - 1u, payload);
}

static unsigned step(void)
{
    return framed_step(fixpid_link_setpoint(&link_controller), 40);
}

static void key_for(uint8_t why)
{
    TEST_ASSERT_EQUAL(25, step());
    TEST_ASSERT_EQUAL_HEX8(LINK_KEY, payload[0]);
    TEST_ASSERT_EQUAL_HEX8(why, payload[1]);
}

static void stream(uint8_t every)
{
    gives(LINK_SET_STREAM, 0, every, LINK_DONE);
}

// With a stream, and its key frame gone.
static void begin(uint8_t allowed)
{
    fixpid_link_allow(&link_controller, allowed);
    stream(1);
    key_for(LINK_BEGAN);
}

// ---- From the board ----

static void init_object(void)
{
    fixpid_link_init(&link_controller, 100);
}

void test_init_sets_every_member(void)
{
    TEST_ASSERT_EQUAL(
        POISON_PADDING(struct fixpid_link, frame),
        poison_left(&link_controller, sizeof link_controller, init_object));
}

void test_step_without_a_stream_has_no_frame(void)
{
    TEST_ASSERT_EQUAL(0, step());
    TEST_ASSERT_EQUAL(0, answer());
}

void test_step_is_the_flags_number_measurement_and_output(void)
{
    begin(0);
    TEST_ASSERT_EQUAL(7, framed_step(100, -5));
    TEST_ASSERT_EQUAL_HEX8(fixpid_pid_flags(&pid_controller) + 8, payload[0]);
    TEST_ASSERT_EQUAL(1, link_number(payload + 1, 2));
    TEST_ASSERT_EQUAL(-5, (int16_t)link_number(payload + 3, 2));
    TEST_ASSERT_EQUAL(output, (int16_t)link_number(payload + 5, 2));
}

void test_step_has_the_setpoint_only_if_it_is_another_one(void)
{
    begin(0);
    TEST_ASSERT_EQUAL(9, framed_step(-2, 40));
    TEST_ASSERT_EQUAL(-2, (int16_t)link_number(payload + 7, 2));
    TEST_ASSERT_EQUAL(7, framed_step(-2, 41));
    TEST_ASSERT_EQUAL(9, framed_step(100, 41));
}

void test_step_has_all_flags_and_its_bit(void)
{
    begin(0);
    framed_step(32767, -32768);
    TEST_ASSERT_EQUAL_HEX8(LINK_STEP + FIXPID_PID_AT_MAX +
                               FIXPID_PID_INTEGRAL_AT_LIMIT,
                           payload[0]);
}

void test_step_number_is_sent_modulo_16384_and_whole_in_a_key_frame(void)
{
    begin(0);
    link_controller.steps = 16383;
    TEST_ASSERT_EQUAL(7, step());
    TEST_ASSERT_EQUAL(16383, link_number(payload + 1, 2));
    TEST_ASSERT_EQUAL(7, step());
    TEST_ASSERT_EQUAL(0, link_number(payload + 1, 2));
    fixpid_link_lost(&link_controller);
    TEST_ASSERT_EQUAL(25, step());
    TEST_ASSERT_EQUAL(16385, link_number(payload + 3, 4));
    step();
    TEST_ASSERT_EQUAL(16386 - 16384, link_number(payload + 1, 2));
}

void test_step_number_counts_steps_without_a_frame(void)
{
    step();
    step();
    begin(0);
    TEST_ASSERT_EQUAL(2, link_number(payload + 3, 4));
}

void test_step_number_goes_round_at_32_bits(void)
{
    begin(0);
    link_controller.steps = UINT32_MAX;
    step();
    step();
    TEST_ASSERT_EQUAL(0, link_number(payload + 1, 2));
}

void test_key_frame_is_the_state_but_for_the_output(void)
{
    uint8_t state[FIXPID_PID_STATE_SIZE];

    fixpid_link_allow(&link_controller, ALL);
    gives(LINK_SET_SETPOINT, 7, 250, LINK_DONE);
    stream(1);
    fixpid_pid_set_feedforward(&pid_controller, -3);
    TEST_ASSERT_EQUAL(25, framed_step(250, -20));
    fixpid_pid_state(&pid_controller, state);
    TEST_ASSERT_EQUAL_HEX8(LINK_BEGAN | LINK_COMMANDED, payload[1]);
    TEST_ASSERT_EQUAL_HEX8(0, payload[2]); // stream's
    TEST_ASSERT_EQUAL(0, link_number(payload + 3, 4));
    TEST_ASSERT_EQUAL(250, link_number(payload + 7, 2));
    TEST_ASSERT_EQUAL(-20, (int16_t)link_number(payload + 9, 2));
    TEST_ASSERT_EQUAL(output, (int16_t)link_number(payload + 11, 2));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(state + 2, payload + 13, 12);
}

void test_key_frame_has_all_32_bits_of_the_number(void)
{
    begin(0);
    link_controller.steps = UINT32_C(0x87654321);
    fixpid_link_lost(&link_controller);
    key_for(LINK_LOST);
    TEST_ASSERT_EQUAL_HEX32(0x87654321, link_number(payload + 3, 4));
}

void test_key_frame_has_the_tag_of_the_last_command(void)
{
    begin(ALL);
    gives(LINK_SET_SETPOINT, 201, 10, LINK_DONE);
    key_for(LINK_COMMANDED);
    TEST_ASSERT_EQUAL_HEX8(201, payload[2]);
}

void test_key_frame_tells_the_setpoint(void)
{
    begin(0);
    fixpid_link_changed(&link_controller);
    TEST_ASSERT_EQUAL(25, framed_step(5, 40));
    TEST_ASSERT_EQUAL(7, framed_step(5, 40));
}

void test_key_frame_is_each_256th(void)
{
    begin(0);
    for (unsigned round = 0; round < 2; round++) {
        for (unsigned i = 1; i < 256; i++) {
            TEST_ASSERT_EQUAL(7, step());
        }
        key_for(LINK_IN_TURN);
    }
}

void test_key_frame_in_turn_counts_from_the_last_one(void)
{
    begin(0);
    for (unsigned i = 0; i < 100; i++) {
        step();
    }
    fixpid_link_changed(&link_controller);
    key_for(LINK_CHANGED);
    for (unsigned i = 1; i < 256; i++) {
        TEST_ASSERT_EQUAL(7, step());
    }
    key_for(LINK_IN_TURN);
}

void test_key_frame_in_turn_may_have_another_reason_too(void)
{
    begin(0);
    for (unsigned i = 1; i < 256; i++) {
        step();
    }
    fixpid_link_lost(&link_controller);
    fixpid_link_changed(&link_controller);
    key_for(LINK_IN_TURN | LINK_LOST | LINK_CHANGED);
    TEST_ASSERT_EQUAL(7, step());
}

void test_lost_a_key_frame_without_room_comes_again(void)
{
    begin(0);
    fixpid_link_lost(&link_controller); // the one of begin
    key_for(LINK_LOST);
    TEST_ASSERT_EQUAL(7, step());
}

void test_reason_stays_until_a_key_frame(void)
{
    fixpid_link_changed(&link_controller);
    step();
    step();
    stream(2);
    key_for(LINK_CHANGED | LINK_BEGAN);
}

void test_stream_of_3_has_each_third_step_and_the_next_one_first(void)
{
    step();
    stream(3);
    key_for(LINK_BEGAN);
    for (unsigned round = 0; round < 2; round++) {
        TEST_ASSERT_EQUAL(0, step());
        TEST_ASSERT_EQUAL(0, step());
        TEST_ASSERT_EQUAL(7, step());
    }
}

void test_stream_of_255_has_each_255th(void)
{
    stream(255);
    key_for(LINK_BEGAN);
    for (unsigned i = 1; i < 255; i++) {
        TEST_ASSERT_EQUAL(0, step());
    }
    TEST_ASSERT_EQUAL(7, step());
    TEST_ASSERT_EQUAL(255, link_number(payload + 1, 2));
}

void test_stream_ends_with_0_and_may_begin_again(void)
{
    begin(0);
    stream(0);
    TEST_ASSERT_EQUAL(0, step());
    stream(1);
    key_for(LINK_BEGAN);
}

void test_hello_says_what_the_board_is(void)
{
    const uint8_t hello[] = {LINK_ASK_HELLO, 9};

    fixpid_link_allow(&link_controller, FIXPID_LINK_GAINS);
    TEST_ASSERT_TRUE(sent(hello, 2));
    TEST_ASSERT_EQUAL(24, answered());
    TEST_ASSERT_EQUAL_HEX8(LINK_HELLO, payload[0]);
    TEST_ASSERT_EQUAL_HEX8(9, payload[1]);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_LINK_VERSION, payload[2]);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_VERSION_MAJOR, payload[3]);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_VERSION_MINOR, payload[4]);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_VERSION_PATCH, payload[5]);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_FEATURES, payload[6]);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_LINK_GAINS, payload[7]);
    TEST_ASSERT_EQUAL_HEX32(0x01020305, link_number(payload + 8, 4));
    TEST_ASSERT_EQUAL(3, link_number(payload + 12, 2));
    TEST_ASSERT_EQUAL_STRING("oven 1", (const char *)payload + 14);
    TEST_ASSERT_EQUAL_HEX8(0, payload[23]);
}

void test_record_is_that_of_config(void)
{
    const uint8_t ask[] = {LINK_ASK_RECORD, 10};
    struct fixpid_record record;

    fixpid_record_pack(&record, &config);
    TEST_ASSERT_TRUE(sent(ask, 2));
    TEST_ASSERT_EQUAL(25, answered());
    TEST_ASSERT_EQUAL_HEX8(LINK_RECORD, payload[0]);
    TEST_ASSERT_EQUAL_HEX8(10, payload[1]);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(record.bytes, payload + 2, 23);
}

void test_hello_and_record_are_no_reason_for_a_key_frame(void)
{
    const uint8_t hello[] = {LINK_ASK_HELLO, 9};
    const uint8_t ask[] = {LINK_ASK_RECORD, 10};

    begin(ALL);
    sent(hello, 2);
    answered();
    sent(ask, 2);
    answered();
    TEST_ASSERT_EQUAL(7, step());
}

// ---- What is a command ----

void test_receive_command_waits_until_it_is_answered(void)
{
    const uint8_t hello[] = {LINK_ASK_HELLO, 9};
    const uint8_t ask[] = {LINK_ASK_RECORD, 10};

    begin(0);
    TEST_ASSERT_TRUE(sent(hello, 2));
    TEST_ASSERT_FALSE(sent(ask, 2));
    TEST_ASSERT_EQUAL(0, step());
    TEST_ASSERT_EQUAL(0, step());
    TEST_ASSERT_EQUAL(24, answered());
    TEST_ASSERT_EQUAL(0, answer());
    key_for(LINK_LOST);
    TEST_ASSERT_EQUAL(3, link_number(payload + 3, 4));
}

void test_step_in_which_a_command_waits_keeps_other_reasons(void)
{
    const uint8_t hello[] = {LINK_ASK_HELLO, 9};

    begin(0);
    fixpid_link_changed(&link_controller);
    TEST_ASSERT_TRUE(sent(hello, 2));
    step();
    answered();
    key_for(LINK_LOST | LINK_CHANGED);
}

void test_manual_that_lets_go_keeps_other_reasons(void)
{
    begin(FIXPID_LINK_MANUAL);
    board.manual_steps = 1;
    gives(LINK_SET_MANUAL, 1, 77, LINK_DONE);
    step();
    fixpid_link_lost(&link_controller);
    key_for(LINK_LOST | LINK_CHANGED);
}

void test_manual_that_lets_go_without_a_stream_keeps_other_reasons(void)
{
    fixpid_link_allow(&link_controller, ALL);
    board.manual_steps = 1;
    fixpid_link_lost(&link_controller);
    gives(LINK_SET_MANUAL, 1, 77, LINK_DONE);
    step();
    stream(1);
    key_for(LINK_LOST | LINK_CHANGED | LINK_COMMANDED | LINK_BEGAN);
}

void test_step_in_which_a_command_waits_without_a_stream_is_not_lost(void)
{
    const uint8_t hello[] = {LINK_ASK_HELLO, 9};

    TEST_ASSERT_TRUE(sent(hello, 2));
    step();
    answered();
    stream(1);
    key_for(LINK_BEGAN);
}

void test_receive_31_bytes_are_no_command(void)
{
    uint8_t bytes[32];

    memset(bytes, 0x31, sizeof bytes);
    bytes[31] = 0;
    TEST_ASSERT_FALSE(received(bytes, 32));
    TEST_ASSERT_EQUAL(0, answer());
    gives(LINK_SET_STREAM, 1, 1, LINK_DONE);
}

// Without its last byte it would be the longest command.
void test_receive_one_byte_behind_the_longest_command_spoils_it(void)
{
    struct fixpid_record record;
    uint8_t bytes[2 + FIXPID_RECORD_SIZE] = {LINK_WRITE, 1};
    uint8_t framed[LINK_FRAMES_MAX];
    unsigned count;

    fixpid_record_pack(&record, &config);
    memcpy(bytes + 2, record.bytes, sizeof record.bytes);
    count = link_command(bytes, sizeof bytes, framed);
    TEST_ASSERT_EQUAL(FIXPID_LINK_COMMAND + 1, count);
    TEST_ASSERT_TRUE(received(framed, count));
    answer();
    framed[count - 1] = 1;
    framed[count] = 0;
    TEST_ASSERT_FALSE(received(framed, count + 1));
}

void test_receive_any_number_of_bytes_before_a_0_are_no_command(void)
{
    const uint8_t ask[] = {LINK_ASK_RECORD, 10};

    // Around the longest command, and where a count of 8 bits goes round.
    for (unsigned count = 0; count < 300; count += count == 40 ? 200 : 1) {
        for (unsigned i = 0; i < count; i++) {
            TEST_ASSERT_FALSE(
                fixpid_link_receive(&link_controller, (uint8_t)(1 + i % 255)));
        }
        TEST_ASSERT_FALSE(fixpid_link_receive(&link_controller, 0));
    }
    TEST_ASSERT_TRUE(sent(ask, 2));
}

void test_receive_text_behind_a_command_spoils_it_not_the_next(void)
{
    uint8_t framed[LINK_FRAMES_MAX];
    const uint8_t ask[] = {LINK_ASK_RECORD, 10};
    const unsigned count = link_command(ask, 2, framed);

    memcpy(framed + count - 1, "hi", 3);
    TEST_ASSERT_FALSE(received(framed, count + 2));
    TEST_ASSERT_TRUE(sent(ask, 2));
}

// Longer and shorter than its first byte says, with good checks.
void test_receive_command_of_another_length_is_none(void)
{
    static const uint8_t bytes[] = {2, 2, 3, 4, 4, 2, 4, 25};

    for (uint8_t kind = 0; kind < 8; kind++) {
        for (unsigned count = 1; count < 26; count++) {
            uint8_t command[26] = {(uint8_t)(0x40 + kind), 1, 1, 1, 1};

            TEST_ASSERT_EQUAL(count == bytes[kind], sent(command, count));
            answer();
        }
    }
}

void test_receive_another_first_byte_is_no_command(void)
{
    static const uint8_t lengths[] = {2, 3, 4, 25}; // that a command has

    for (unsigned first = 0; first < 256; first++) {
        for (unsigned i = 0; i < sizeof lengths; i++) {
            uint8_t command[26] = {(uint8_t)first, 1, 1, 1, 1};

            if (first < 0x40 || first > 0x47) {
                TEST_ASSERT_FALSE(sent(command, lengths[i]));
            }
        }
    }
}

// What a command leaves in memory is no part of the next.
void test_receive_checks_alone_are_no_command(void)
{
    uint8_t framed[LINK_FRAMES_MAX];
    const uint8_t none[1] = {0};
    const uint8_t ask[] = {LINK_ASK_RECORD, 10};

    TEST_ASSERT_TRUE(sent(ask, 2));
    answer();
    TEST_ASSERT_FALSE(received(framed, link_command(none, 0, framed)));
    TEST_ASSERT_FALSE(fixpid_link_receive(&link_controller, 0));
    TEST_ASSERT_FALSE(fixpid_link_receive(&link_controller, 0));
}

// Each bit of a command, and each byte by each other one where it is short.
void test_receive_any_wrong_byte_is_noticed(void)
{
    const uint8_t command[] = {LINK_SET_SETPOINT, 1, 0, 2};
    uint8_t framed[LINK_FRAMES_MAX];
    const unsigned count = link_command(command, 4, framed);

    for (unsigned at = 0; at < count; at++) {
        for (unsigned other = 1; other < 256; other++) {
            framed[at] ^= (uint8_t)other;
            for (unsigned i = 0; i < count; i++) {
                TEST_ASSERT_FALSE(
                    fixpid_link_receive(&link_controller, framed[i]));
            }
            fixpid_link_receive(&link_controller, 0);
            framed[at] ^= (uint8_t)other;
        }
    }
    TEST_ASSERT_TRUE(received(framed, count));
}

// Each of the four bytes behind the payload counts: here three are right.
void test_receive_each_check_is_asked(void)
{
    for (unsigned byte = 0; byte < 4; byte++) {
        uint8_t framed[LINK_FRAMES_MAX];
        const uint8_t command[] = {LINK_SET_SETPOINT, 1, 5, 2};
        const unsigned count = link_command(command, 4, framed);

        framed[5 + byte] ^= 0x55; // none of them is 0, nor becomes it
        TEST_ASSERT_NOT_EQUAL(0, framed[5 + byte]);
        TEST_ASSERT_FALSE(received(framed, count));
    }
}

// The sums notice what the CRC does not: a payload of the same CRC.
void test_receive_two_commands_of_one_crc_are_told_apart(void)
{
    const uint8_t one[] = {LINK_SET_SETPOINT, 1, 0x80, 0x80};
    const uint8_t other[] = {LINK_SET_SETPOINT, 2, 0xB0, 0xE3};
    uint8_t framed[LINK_FRAMES_MAX];
    uint8_t mixed[LINK_FRAMES_MAX];

    TEST_ASSERT_EQUAL(10, link_command(one, 4, framed));
    TEST_ASSERT_EQUAL(10, link_command(other, 4, mixed));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(framed + 5, mixed + 5, 2);
    TEST_ASSERT_NOT_EQUAL(0, memcmp(framed + 7, mixed + 7, 2));
    memcpy(mixed + 7, framed + 7, 2);
    TEST_ASSERT_FALSE(received(mixed, 10));
    TEST_ASSERT_TRUE(received(framed, 10));
}

// ---- Commands ----

void test_answer_nothing_is_allowed_after_init(void)
{
    static const uint8_t commands[] = {LINK_SET_SETPOINT, LINK_SET_MANUAL,
                                       LINK_SET_AUTO, LINK_SET_SEED};
    struct fixpid_pid before;

    stream(1);
    key_for(LINK_BEGAN);
    memcpy(&before, &pid_controller, sizeof before);
    for (unsigned i = 0; i < 4; i++) {
        gives(commands[i], 1, 200, LINK_NOT_ALLOWED);
    }
    writes(1, &config, LINK_NOT_ALLOWED);
    TEST_ASSERT_EQUAL_MEMORY(&before, &pid_controller, sizeof before);
    TEST_ASSERT_EQUAL(100, fixpid_link_setpoint(&link_controller));
    TEST_ASSERT_EQUAL(7, step());
}

// Each permission allows its commands, and no others.
void test_allow_each_permission_is_asked_alone(void)
{
    for (uint8_t allowed = 0; allowed < 16; allowed++) {
        const uint8_t by_hand =
            (allowed & 8) != 0 ? LINK_DONE : LINK_NOT_ALLOWED;

        fixpid_link_allow(&link_controller, allowed);
        gives(LINK_SET_SETPOINT, 0, 1,
              (allowed & 1) != 0 ? LINK_DONE : LINK_NOT_ALLOWED);
        gives(LINK_SET_MANUAL, 0, 1, by_hand);
        gives(LINK_SET_AUTO, 0, 1, by_hand);
        gives(LINK_SET_SEED, 0, 1, by_hand);
        writes(0, &config, (allowed & 2) != 0 ? LINK_DONE : LINK_NOT_ALLOWED);
        config.output_max--;
        writes(0, &config, (allowed & 2) != 0 ? LINK_DONE : LINK_NOT_ALLOWED);
    }
}

void test_setpoint_within_its_range_is_taken_at_both_ends(void)
{
    begin(FIXPID_LINK_SETPOINT);
    gives(LINK_SET_SETPOINT, 1, -100, LINK_DONE);
    TEST_ASSERT_EQUAL(-100, fixpid_link_setpoint(&link_controller));
    gives(LINK_SET_SETPOINT, 2, 900, LINK_DONE);
    TEST_ASSERT_EQUAL(900, fixpid_link_setpoint(&link_controller));
    gives(LINK_SET_SETPOINT, 3, 901, LINK_REFUSED);
    gives(LINK_SET_SETPOINT, 4, -101, LINK_REFUSED);
    TEST_ASSERT_EQUAL(900, fixpid_link_setpoint(&link_controller));
    key_for(LINK_COMMANDED);
    TEST_ASSERT_EQUAL_HEX8(4, payload[2]);
}

void test_answer_refused_command_is_a_reason_too(void)
{
    begin(FIXPID_LINK_SETPOINT);
    gives(LINK_SET_SETPOINT, 1, 901, LINK_REFUSED);
    key_for(LINK_COMMANDED);
}

void test_answer_same_tag_and_command_is_not_carried_out_again(void)
{
    begin(FIXPID_LINK_SETPOINT);
    gives(LINK_SET_SETPOINT, 1, 600, LINK_DONE);
    gives(LINK_SET_SETPOINT, 1, 300, LINK_DONE);
    TEST_ASSERT_EQUAL(600, fixpid_link_setpoint(&link_controller));
}

void test_answer_a_new_permission_needs_a_new_tag(void)
{
    gives(LINK_SET_SETPOINT, 1, 600, LINK_NOT_ALLOWED);
    gives(LINK_SET_SETPOINT, 1, 600, LINK_NOT_ALLOWED);
    fixpid_link_allow(&link_controller, FIXPID_LINK_SETPOINT);
    gives(LINK_SET_SETPOINT, 1, 600, LINK_NOT_ALLOWED);
    gives(LINK_SET_SETPOINT, 2, 600, LINK_DONE);
}

void test_answer_repeated_command_is_no_reason(void)
{
    begin(FIXPID_LINK_SETPOINT);
    gives(LINK_SET_SETPOINT, 1, 600, LINK_DONE);
    key_for(LINK_COMMANDED);
    gives(LINK_SET_SETPOINT, 1, 600, LINK_DONE);
    TEST_ASSERT_EQUAL(7, step());
}

void test_answer_repeated_stream_does_not_begin_again(void)
{
    gives(LINK_SET_STREAM, 5, 1, LINK_DONE);
    key_for(LINK_BEGAN);
    gives(LINK_SET_STREAM, 5, 1, LINK_DONE);
    TEST_ASSERT_EQUAL(7, step());
}

void test_answer_tag_of_another_command_is_carried_out(void)
{
    fixpid_link_allow(&link_controller, ALL);
    gives(LINK_SET_SETPOINT, 1, 901, LINK_REFUSED);
    gives(LINK_SET_SEED, 1, 50, LINK_DONE);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_SEEDED,
                           fixpid_pid_flags(&pid_controller) & 0x20);
    gives(LINK_SET_SETPOINT, 1, 7, LINK_DONE);
    TEST_ASSERT_EQUAL(7, fixpid_link_setpoint(&link_controller));
}

void test_answer_tag_0_is_always_carried_out(void)
{
    fixpid_link_allow(&link_controller, ALL);
    gives(LINK_SET_SETPOINT, 0, 1, LINK_DONE);
    gives(LINK_SET_SETPOINT, 0, 2, LINK_DONE);
    TEST_ASSERT_EQUAL(2, fixpid_link_setpoint(&link_controller));
}

void test_hello_makes_the_tag_0_so_that_the_next_1_is_new(void)
{
    const uint8_t hello[] = {LINK_ASK_HELLO, 1};

    fixpid_link_allow(&link_controller, ALL);
    gives(LINK_SET_SETPOINT, 1, 1, LINK_DONE);
    TEST_ASSERT_TRUE(sent(hello, 2));
    answered();
    gives(LINK_SET_SETPOINT, 1, 2, LINK_DONE);
    TEST_ASSERT_EQUAL(2, fixpid_link_setpoint(&link_controller));
}

void test_record_leaves_the_tag(void)
{
    const uint8_t ask[] = {LINK_ASK_RECORD, 2};

    fixpid_link_allow(&link_controller, ALL);
    gives(LINK_SET_SETPOINT, 1, 1, LINK_DONE);
    TEST_ASSERT_TRUE(sent(ask, 2));
    answered();
    gives(LINK_SET_SETPOINT, 1, 2, LINK_DONE);
    TEST_ASSERT_EQUAL(1, fixpid_link_setpoint(&link_controller));
}

// ---- By hand ----

void test_manual_lets_go_after_manual_steps(void)
{
    begin(FIXPID_LINK_MANUAL);
    gives(LINK_SET_MANUAL, 1, 77, LINK_DONE);
    for (unsigned i = 0; i < 3; i++) {
        TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_MANUAL,
                               fixpid_pid_flags(&pid_controller) & 0x40);
        step();
        TEST_ASSERT_EQUAL(77, output);
    }
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_pid_flags(&pid_controller) & 0x40);
    key_for(LINK_CHANGED);
    TEST_ASSERT_EQUAL(77, output);
    for (unsigned i = 0; i < 10; i++) {
        TEST_ASSERT_EQUAL(7, step());
    }
}

void test_manual_again_counts_anew(void)
{
    begin(FIXPID_LINK_MANUAL);
    gives(LINK_SET_MANUAL, 1, 77, LINK_DONE);
    step();
    step();
    gives(LINK_SET_MANUAL, 2, 78, LINK_DONE);
    step();
    step();
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_MANUAL,
                           fixpid_pid_flags(&pid_controller) & 0x40);
    step();
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_pid_flags(&pid_controller) & 0x40);
}

// A repeated frame is not a hand that speaks.
void test_manual_repeated_does_not_count_anew(void)
{
    begin(FIXPID_LINK_MANUAL);
    gives(LINK_SET_MANUAL, 1, 77, LINK_DONE);
    step();
    gives(LINK_SET_MANUAL, 1, 77, LINK_DONE);
    step();
    step();
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_pid_flags(&pid_controller) & 0x40);
}

// The other end sends an output by hand each 10 of 200 steps, where it has 50
// steps. Returns after how many of them the controller is by hand.
static unsigned steps_by_hand(uint8_t tag, uint8_t next_tag)
{
    unsigned by_hand = 0;

    board.manual_steps = 50;
    fixpid_link_allow(&link_controller, FIXPID_LINK_MANUAL);
    for (unsigned i = 0; i < 200; i++) {
        if (i % 10 == 0) {
            gives(LINK_SET_MANUAL, tag, 77, LINK_DONE);
            tag = (uint8_t)(tag + next_tag);
        }
        step();
        by_hand += (fixpid_pid_flags(&pid_controller) & FIXPID_PID_MANUAL) / 64;
    }
    return by_hand;
}

void test_manual_repeated_for_long_is_answered_and_lets_go(void)
{
    TEST_ASSERT_EQUAL(49, steps_by_hand(7, 0));
}

void test_manual_of_another_tag_each_time_holds(void)
{
    TEST_ASSERT_EQUAL(200, steps_by_hand(7, 1));
}

void test_manual_of_tag_0_each_time_holds(void)
{
    TEST_ASSERT_EQUAL(200, steps_by_hand(0, 0));
}

void test_manual_lets_go_without_a_stream_and_while_a_command_waits(void)
{
    const uint8_t hello[] = {LINK_ASK_HELLO, 9};

    fixpid_link_allow(&link_controller, ALL);
    gives(LINK_SET_MANUAL, 1, 77, LINK_DONE);
    step();
    sent(hello, 2);
    step();
    step();
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_pid_flags(&pid_controller) & 0x40);
}

void test_manual_steps_of_0_refuses_it(void)
{
    begin(FIXPID_LINK_MANUAL);
    board.manual_steps = 0;
    gives(LINK_SET_MANUAL, 1, 77, LINK_REFUSED);
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_pid_flags(&pid_controller) & 0x40);
}

void test_manual_steps_of_65535_are_counted(void)
{
    fixpid_link_allow(&link_controller, FIXPID_LINK_MANUAL);
    board.manual_steps = 65535;
    gives(LINK_SET_MANUAL, 1, 77, LINK_DONE);
    for (unsigned i = 0; i < 65534u; i++) {
        step();
    }
    TEST_ASSERT_EQUAL_HEX8(0x40, fixpid_pid_flags(&pid_controller) & 0x40);
    step();
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_pid_flags(&pid_controller) & 0x40);
}

void test_auto_ends_it_at_once(void)
{
    begin(FIXPID_LINK_MANUAL);
    gives(LINK_SET_MANUAL, 1, 77, LINK_DONE);
    gives(LINK_SET_AUTO, 2, 0, LINK_DONE);
    TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_SEEDED,
                           fixpid_pid_flags(&pid_controller) & 0x60);
    key_for(LINK_COMMANDED);
    TEST_ASSERT_EQUAL(77, output);
    for (unsigned i = 0; i < 5; i++) { // the hand's time has ended
        TEST_ASSERT_EQUAL(7, step());
    }
}

void test_seed_moves_the_output_once(void)
{
    begin(FIXPID_LINK_MANUAL);
    gives(LINK_SET_SEED, 1, -120, LINK_DONE);
    key_for(LINK_COMMANDED);
    TEST_ASSERT_EQUAL(-120, output);
    for (unsigned i = 0; i < 5; i++) {
        TEST_ASSERT_EQUAL(7, step());
    }
}

void test_manual_stays_within_the_output_limits(void)
{
    begin(FIXPID_LINK_MANUAL);
    gives(LINK_SET_MANUAL, 1, 32767, LINK_DONE);
    step();
    TEST_ASSERT_EQUAL(300, output);
}

// ---- The program's hand ----

// The other end has the hand for 50 steps; then 20 are gone.
static void begin_handover(void)
{
    begin(FIXPID_LINK_MANUAL);
    board.manual_steps = 50;
    gives(LINK_SET_MANUAL, 1, 100, LINK_DONE);
    for (unsigned i = 0; i < 20; i++) {
        step();
        TEST_ASSERT_EQUAL(100, output);
    }
}

static void stays_by_hand_at(int16_t value, unsigned steps)
{
    for (unsigned i = 0; i < steps; i++) {
        TEST_ASSERT_EQUAL(7, step());
        TEST_ASSERT_EQUAL(value, output);
        TEST_ASSERT_EQUAL_HEX8(FIXPID_PID_MANUAL,
                               fixpid_pid_flags(&pid_controller) & 0x40);
    }
}

static void is_automatic_after(int16_t value, unsigned steps)
{
    stays_by_hand_at(value, steps - 1u);
    step();
    TEST_ASSERT_EQUAL_HEX8(0, fixpid_pid_flags(&pid_controller) & 0x40);
}

void test_taken_the_hand_of_the_program_stays(void)
{
    begin_handover();
    fixpid_pid_set_manual(&pid_controller, 0);
    fixpid_link_taken(&link_controller);
    key_for(LINK_CHANGED);
    stays_by_hand_at(0, 100);
}

void test_taken_keeps_other_reasons_and_needs_no_hand_before(void)
{
    begin(0);
    fixpid_link_lost(&link_controller);
    fixpid_pid_set_manual(&pid_controller, 60);
    fixpid_link_taken(&link_controller);
    key_for(LINK_LOST | LINK_CHANGED);
    stays_by_hand_at(60, 100);
}

void test_taken_hand_is_taken_back_by_a_command_only_while_it_is_allowed(void)
{
    begin_handover();
    fixpid_link_allow(&link_controller, 0);
    fixpid_pid_set_manual(&pid_controller, 0);
    fixpid_link_taken(&link_controller);
    gives(LINK_SET_MANUAL, 2, 100, LINK_NOT_ALLOWED);
    key_for(LINK_CHANGED);
    stays_by_hand_at(0, 100);
    fixpid_link_allow(&link_controller, FIXPID_LINK_MANUAL);
    gives(LINK_SET_MANUAL, 3, 100, LINK_DONE);
    key_for(LINK_COMMANDED);
    is_automatic_after(100, 49);
}

// Else a program that changes its feed-forward in each step would keep the hand
// of an end that is gone.
void test_changed_leaves_the_other_end_its_time(void)
{
    begin_handover();
    fixpid_pid_set_feedforward(&pid_controller, 3);
    fixpid_link_changed(&link_controller);
    key_for(LINK_CHANGED);
    is_automatic_after(100, 29);
}

// Who takes the permission away wants no output that nobody ends.
void test_allow_without_manual_leaves_the_other_end_its_time(void)
{
    begin_handover();
    fixpid_link_allow(&link_controller, 0);
    is_automatic_after(100, 30);
}

// ---- A record ----

static struct fixpid_pid twin;
static struct fixpid_pid_config wanted;

// Refused, and nothing changed.
static void write_refused(uint8_t result)
{
    const struct fixpid_pid_config before = config;

    memcpy(&twin, &pid_controller, sizeof twin);
    writes(0, &wanted, result);
    TEST_ASSERT_EQUAL_MEMORY(&twin, &pid_controller, sizeof twin);
    TEST_ASSERT_EQUAL_MEMORY(&before, &config, sizeof before);
}

static void begin_writing(uint8_t allowed)
{
    memset(&wanted, 0, sizeof wanted);
    begin(allowed);
    wanted = config;
}

void test_write_sets_gains_without_permission_for_limits(void)
{
    begin_writing(FIXPID_LINK_GAINS);
    wanted.gains.kp_q8 = 300;
    wanted.gains.ki_q24 = 1000;
    wanted.gains.kd_q8 = 3;
    wanted.gains.derivative_filter = 1;
    writes(1, &wanted, LINK_DONE);
    TEST_ASSERT_EQUAL(300, config.gains.kp_q8);
    TEST_ASSERT_EQUAL(1000, config.gains.ki_q24);
    TEST_ASSERT_EQUAL(3, config.gains.kd_q8);
    TEST_ASSERT_EQUAL(1, config.gains.derivative_filter);
    memcpy(&twin, &pid_controller, sizeof twin);
    TEST_ASSERT_TRUE(fixpid_pid_set_gains(&pid_controller, &wanted.gains));
    TEST_ASSERT_EQUAL_MEMORY(&twin, &pid_controller, sizeof twin);
    key_for(LINK_COMMANDED);
}

void test_write_sets_all_limits(void)
{
    begin_writing(FIXPID_LINK_GAINS | FIXPID_LINK_LIMITS);
    wanted.output_min = -300;
    wanted.output_max = 400;
    wanted.integral_min = -10;
    wanted.integral_max = 20;
    writes(1, &wanted, LINK_DONE);
    TEST_ASSERT_EQUAL(-300, config.output_min);
    TEST_ASSERT_EQUAL(400, config.output_max);
    TEST_ASSERT_EQUAL(-10, config.integral_min);
    TEST_ASSERT_EQUAL(20, config.integral_max);
    TEST_ASSERT_EQUAL(400, (framed_step(32767, -32768), output));
    TEST_ASSERT_EQUAL(-300, (framed_step(-32768, 32767), output));
    TEST_ASSERT_EQUAL(-10, pid_controller.integral_min);
    TEST_ASSERT_EQUAL(20, pid_controller.integral_max);
}

// Each limit alone needs the permission.
void test_write_other_limits_are_not_allowed_without_it(void)
{
    begin_writing(FIXPID_LINK_GAINS);
    wanted.output_min++;
    write_refused(LINK_NOT_ALLOWED);
    wanted = config;
    wanted.output_max--;
    write_refused(LINK_NOT_ALLOWED);
    wanted = config;
    wanted.integral_min++;
    write_refused(LINK_NOT_ALLOWED);
    wanted = config;
    wanted.integral_max--;
    write_refused(LINK_NOT_ALLOWED);
    wanted = config;
    wanted.integral_max = (int16_t)(wanted.integral_max ^ 0x100);
    write_refused(LINK_NOT_ALLOWED);
}

// The board's limits stay the board's, and are asked before the permission.
void test_write_limits_beyond_the_board_are_refused(void)
{
    begin_writing(0);
    for (uint8_t allowed = 0; allowed < 2; allowed++) {
        fixpid_link_allow(
            &link_controller,
            (uint8_t)(FIXPID_LINK_GAINS + allowed * FIXPID_LINK_LIMITS));
        wanted = config;
        wanted.output_min = -301;
        write_refused(LINK_REFUSED);
        wanted = config;
        wanted.output_max = 401;
        write_refused(LINK_REFUSED);
        wanted = config;
        wanted.output_min = wanted.output_max = 5;
        write_refused(LINK_REFUSED);
        wanted.output_min = 6;
        write_refused(LINK_REFUSED);
    }
    wanted.output_min = 4;
    writes(1, &wanted, LINK_DONE);
}

void test_write_other_options_or_weight_are_refused(void)
{
    begin_writing(ALL);
    wanted.reverse = true;
    write_refused(LINK_REFUSED);
    wanted = config;
    wanted.derivative_on_error = true;
    write_refused(LINK_REFUSED);
    wanted = config;
    wanted.proportional_on_measurement = true;
    write_refused(LINK_REFUSED);
    wanted = config;
    wanted.setpoint_weight_q8++;
    write_refused(LINK_REFUSED);
    wanted.setpoint_weight_q8 = 128 + 256;
    write_refused(LINK_REFUSED);
}

void test_write_gains_that_set_gains_refuses_are_refused(void)
{
    begin_writing(ALL);
    wanted.gains.kp_q8 = 32768;
    write_refused(LINK_REFUSED);
    wanted = config;
    wanted.gains.ki_q24 = FIXPID_PID_KI_MAX + 1u;
    write_refused(LINK_REFUSED);
    wanted = config;
    wanted.gains.kd_q8 = FIXPID_PID_KD_MAX + 1u;
    write_refused(LINK_REFUSED);
    wanted = config;
    wanted.gains.derivative_filter = 8;
    write_refused(LINK_REFUSED);
}

// The gains were good, and are as before.
void test_write_integral_limits_that_are_refused_leave_the_gains(void)
{
    begin_writing(ALL);
    wanted.gains.kp_q8 = 1;
    wanted.integral_min = 30;
    wanted.integral_max = 20;
    write_refused(LINK_REFUSED);
    wanted.integral_min = -32768;
    write_refused(LINK_REFUSED);
}

void test_write_to_a_refused_controller_is_refused(void)
{
    begin_writing(ALL);
    pid_controller.output_max = pid_controller.output_min;
    write_refused(LINK_REFUSED);
}

void test_write_what_is_no_record_is_refused(void)
{
    struct fixpid_record record;
    uint8_t bytes[2 + FIXPID_RECORD_SIZE] = {LINK_WRITE, 3};

    begin(ALL);
    fixpid_record_pack(&record, &config);
    memcpy(bytes + 2, record.bytes, sizeof record.bytes);
    bytes[24] ^= 1;
    TEST_ASSERT_TRUE(sent(bytes, sizeof bytes));
    result_is(3, LINK_WRITE, LINK_REFUSED);
}

// ---- Any bytes ----

// Among them such as lead from 0 to 0 to the byte behind the longest command.
void test_receive_and_answer_any_bytes_of_the_object_are_safe(void)
{
    for (unsigned count = 0; count < 256; count++) {
        for (unsigned left = 0; left < 256; left += 15) {
            fixpid_link_init(&link_controller, 1);
            memset(link_controller.bytes, (int)left,
                   sizeof link_controller.bytes);
            link_controller.count = (uint8_t)count;
            link_controller.frame[0] = 0xA5;
            fixpid_link_receive(&link_controller, 7);
            fixpid_link_receive(&link_controller, 0);
            TEST_ASSERT_EQUAL_HEX8(0xA5, link_controller.frame[0]);
            TEST_ASSERT_LESS_OR_EQUAL(FIXPID_LINK_FRAME, answer());
        }
    }
}

// ---- Stream only ----

static unsigned stream_answered(void)
{
    const uint8_t bytes =
        fixpid_link_answer_stream(&link_controller, &board, &config);

    return bytes == 0
               ? 0
               : link_payload(link_controller.frame + 1, bytes - 2u, payload);
}

void test_answer_stream_gives_hello_record_and_stream(void)
{
    const uint8_t hello[] = {LINK_ASK_HELLO, 1};
    const uint8_t ask[] = {LINK_ASK_RECORD, 2};
    const uint8_t begins[] = {LINK_SET_STREAM, 3, 1};

    TEST_ASSERT_EQUAL(0, stream_answered());
    sent(hello, 2);
    TEST_ASSERT_EQUAL(24, stream_answered());
    sent(ask, 2);
    TEST_ASSERT_EQUAL(25, stream_answered());
    sent(begins, 3);
    TEST_ASSERT_EQUAL(4, stream_answered());
    TEST_ASSERT_EQUAL_HEX8(LINK_DONE, payload[3]);
    key_for(LINK_BEGAN);
}

void test_answer_stream_allows_nothing_else(void)
{
    fixpid_link_allow(&link_controller, ALL);
    for (uint8_t command = LINK_SET_SETPOINT; command < LINK_WRITE; command++) {
        const uint8_t bytes[] = {command, command, 0, 0};

        TEST_ASSERT_TRUE(sent(bytes, command == LINK_SET_AUTO ? 2 : 4));
        TEST_ASSERT_EQUAL(4, stream_answered());
        TEST_ASSERT_EQUAL_HEX8(command, payload[1]);
        TEST_ASSERT_EQUAL_HEX8(command, payload[2]);
        TEST_ASSERT_EQUAL_HEX8(LINK_NOT_ALLOWED, payload[3]);
    }
    TEST_ASSERT_EQUAL(100, fixpid_link_setpoint(&link_controller));
}

// ---- Tracked steps ----

static unsigned tracked_step(int16_t setpoint, int16_t applied, uint8_t shift)
{
    uint8_t bytes;

    output = fixpid_pid_step(&pid_controller, setpoint, 40);
    fixpid_pid_track(&pid_controller, applied, shift);
    bytes = fixpid_link_step_tracked(&link_controller, &pid_controller,
                                     setpoint, 40, output, applied, shift);
    return bytes < 2 ? bytes
                     : link_payload(link_controller.frame, bytes - 1u, payload);
}

void test_step_tracked_without_a_stream_has_no_frame(void)
{
    TEST_ASSERT_EQUAL(0, tracked_step(100, 1, 2));
}

void test_step_tracked_has_what_was_applied_and_the_shift(void)
{
    begin(0);
    TEST_ASSERT_EQUAL(10, tracked_step(100, -300, 5));
    TEST_ASSERT_EQUAL(output, (int16_t)link_number(payload + 5, 2));
    TEST_ASSERT_EQUAL(-300, (int16_t)link_number(payload + 7, 2));
    TEST_ASSERT_EQUAL_HEX8(5, payload[9]);
    TEST_ASSERT_EQUAL(12, tracked_step(101, 500, 255));
    TEST_ASSERT_EQUAL(101, (int16_t)link_number(payload + 7, 2));
    TEST_ASSERT_EQUAL(500, (int16_t)link_number(payload + 9, 2));
    TEST_ASSERT_EQUAL_HEX8(255, payload[11]);
}

void test_step_tracked_is_no_reason_and_a_key_frame_has_the_state_after(void)
{
    uint8_t state[FIXPID_PID_STATE_SIZE];

    begin(0);
    for (unsigned i = 1; i < 256; i++) {
        TEST_ASSERT_EQUAL(10, tracked_step(100, (int16_t)i, 1));
    }
    TEST_ASSERT_EQUAL(25, tracked_step(100, 7, 1));
    TEST_ASSERT_EQUAL_HEX8(LINK_IN_TURN, payload[1]);
    fixpid_pid_state(&pid_controller, state);
    TEST_ASSERT_EQUAL(7, link_number(state, 2));
    TEST_ASSERT_EQUAL(output, (int16_t)link_number(payload + 11, 2));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(state + 2, payload + 13, 12);
    TEST_ASSERT_EQUAL(10, tracked_step(100, 7, 1));
}
