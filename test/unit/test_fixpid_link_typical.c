// SPDX-License-Identifier: MIT
// The link of a controller without any of its features: project.yml defines
// FIXPID_PID_FEATURES 0x00 for it.
#include "fixpid_link.h"
#include "fixpid_pid.h"
#include "link_frames.h"
#include "unity.h"

TEST_SOURCE_FILE("src/link/fixpid_link.c")
TEST_SOURCE_FILE("src/link/fixpid_link_commands.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_state.c")
TEST_SOURCE_FILE("src/record/fixpid_record.c")

FIXPID_DATA struct fixpid_link link_controller;
FIXPID_DATA struct fixpid_pid pid_controller;

static const struct fixpid_link_board board = {.period_us = 1000,
                                               .manual_steps = 5,
                                               .setpoint_max = 900,
                                               .output_max = 255};
static struct fixpid_pid_config config;
static uint8_t payload[LINK_FRAMES_MAX];

void setUp(void)
{
    config = (struct fixpid_pid_config){.gains = {512, 4000, 64, 0},
                                        .output_max = 255};
    TEST_ASSERT_TRUE(fixpid_pid_init(&pid_controller, &config));
    fixpid_link_init(&link_controller, 100);
    fixpid_link_allow(&link_controller, 0x0F);
}

void tearDown(void)
{
}

static unsigned gives(uint8_t command, uint8_t tag, uint8_t value,
                      unsigned bytes)
{
    const uint8_t sent[] = {command, tag, value, 0};
    uint8_t framed[LINK_FRAMES_MAX];
    const unsigned count = link_command(sent, bytes, framed);
    uint8_t answer;

    for (unsigned at = 0; at < count; at++) {
        TEST_ASSERT_EQUAL(at == count - 1,
                          fixpid_link_receive(&link_controller, framed[at]));
    }
    answer =
        fixpid_link_answer(&link_controller, &board, &pid_controller, &config);
    return link_payload(link_controller.frame + 1, answer - 2u, payload);
}

void test_hello_says_that_there_are_no_features(void)
{
    TEST_ASSERT_EQUAL(24, gives(LINK_ASK_HELLO, 1, 0, 2));
    TEST_ASSERT_EQUAL_HEX8(0, payload[6]);
}

void test_answer_without_the_feature_by_hand_is_refused(void)
{
    for (uint8_t command = LINK_SET_MANUAL; command <= LINK_SET_SEED;
         command++) {
        gives(command, 1, 7, command == LINK_SET_AUTO ? 2 : 4);
        TEST_ASSERT_EQUAL_HEX8(LINK_REFUSED, payload[3]);
    }
    gives(LINK_SET_SETPOINT, 2, 7, 4);
    TEST_ASSERT_EQUAL_HEX8(LINK_DONE, payload[3]);
    TEST_ASSERT_EQUAL(7, fixpid_link_setpoint(&link_controller));
}

// The controller does not remember its output, which is sent all the same.
void test_step_key_frame_has_the_output_and_no_hand_lets_go(void)
{
    gives(LINK_SET_STREAM, 1, 1, 3);
    for (unsigned i = 0; i < 10; i++) {
        const int16_t output = fixpid_pid_step(&pid_controller, 100, 40);
        const uint8_t bytes = fixpid_link_step(
            &link_controller, &pid_controller, 100, 40, output);

        TEST_ASSERT_EQUAL(i == 0 ? 25 : 7, link_payload(link_controller.frame,
                                                        bytes - 1u, payload));
        TEST_ASSERT_EQUAL(output, link_number(payload + (i == 0 ? 11 : 5), 2));
        TEST_ASSERT_NOT_EQUAL(0, output);
    }
}
