// SPDX-License-Identifier: MIT
// A board and its twin over a wire that is good, and one that is not: pointer
// mode only, as there are two of each.
#include <stdio.h>
#include <string.h>

#include "fixpid_link.h"
#include "fixpid_pid.h"
#include "fixpid_record.h"
#include "link_frames.h"
#include "link_twin.h"
#include "numbers.h"
#include "numbers_control.h"
#include "unity.h"

TEST_SOURCE_FILE("src/link/fixpid_link.c")
TEST_SOURCE_FILE("src/link/fixpid_link_commands.c")
TEST_SOURCE_FILE("src/link/fixpid_link_tracked.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_more.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_state.c")
TEST_SOURCE_FILE("src/pid/fixpid_pid_track.c")
TEST_SOURCE_FILE("src/record/fixpid_record.c")

#ifndef TEST_RANDOM_STEPS
#define TEST_RANDOM_STEPS 60000
#endif
#ifndef TEST_STRIDE
#define TEST_STRIDE 1
#endif

#define STEPS ((unsigned)TEST_RANDOM_STEPS)
#define FEWER_STEPS (STEPS / 10 + 400) // where a difference shows soon

#define PATIENCE 10u // steps without an answer, and a command is sent again

static const struct fixpid_link_board board = {.period_us = 1000,
                                               .manual_steps = 20,
                                               .setpoint_min = -500,
                                               .setpoint_max = 900,
                                               .output_min = -300,
                                               .output_max = 300,
                                               .name = "twin"};
static struct fixpid_pid_config config;
static struct fixpid_pid pid;
static struct fixpid_link link_of_board;
static struct link_twin twin;
static unsigned damage;  // one byte in so many; 0: none
static unsigned no_room; // one frame in so many; 0: none
static bool tracks;      // after each step
static unsigned silence; // steps since the command was sent
static unsigned carried_out;
static int16_t measurement;

void setUp(void)
{
    numbers_seed(964937);
    config = (struct fixpid_pid_config){
        .gains = {512, 70000, 64, 2}, .output_min = -255, .output_max = 255};
    TEST_ASSERT_TRUE(fixpid_pid_init(&pid, &config));
    fixpid_link_init(&link_of_board, 0);
    fixpid_link_allow(&link_of_board, 0x0F);
    link_twin_init(&twin);
    twin.wants_record = true;
    damage = 0;
    no_room = 0;
    tracks = false;
    silence = 0;
    carried_out = 0;
    measurement = 0;
}

void tearDown(void)
{
}

// As records, which have each number and no byte between them.
static void twin_has_config(void)
{
    struct fixpid_record of_board;
    struct fixpid_record of_twin;

    fixpid_record_pack(&of_board, &config);
    fixpid_record_pack(&of_twin, &twin.config);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(of_board.bytes, of_twin.bytes,
                                 FIXPID_RECORD_SIZE);
}

// ---- The wire ----

// Sends a byte, or what becomes of it: nothing, a wrong bit, twice, another.
static void carry(uint8_t byte, void (*take)(uint8_t byte))
{
    unsigned times = 1;

    if (damage != 0 && numbers_below(damage) == 0) {
        switch (numbers_below(4)) {
        case 0:
            times = 0;
            break;
        case 1:
            byte ^= (uint8_t)(1u << numbers_below(8));
            break;
        case 2:
            times = 2;
            break;
        default:
            byte = (uint8_t)numbers_below(256);
            break;
        }
    }
    for (; times != 0; times--) {
        take(byte);
    }
}

static void to_twin(uint8_t byte)
{
    (void)link_twin_receive(&twin, byte);
}

static void send(uint8_t bytes)
{
    if (no_room != 0 && numbers_below(no_room) == 0) {
        if (bytes != 0) {
            fixpid_link_lost(&link_of_board);
        }
        return;
    }
    for (unsigned at = 0; at < bytes; at++) {
        carry(link_of_board.frame[at], to_twin);
    }
}

// What the board takes is what the twin sent, and it is carried out or not.
static void to_board(uint8_t byte)
{
    struct fixpid_pid before;
    struct fixpid_pid_config config_before;
    uint8_t bytes;

    if (!fixpid_link_receive(&link_of_board, byte)) {
        return;
    }
    TEST_ASSERT_EQUAL_HEX8_ARRAY(twin.payload, link_of_board.bytes + 1,
                                 twin.payload_bytes);
    memcpy(&before, &pid, sizeof before);
    memcpy(&config_before, &config, sizeof config);
    bytes = fixpid_link_answer(&link_of_board, &board, &pid, &config);
    if (link_of_board.result != 0) {
        TEST_ASSERT_EQUAL_MEMORY(&before, &pid, sizeof pid);
        TEST_ASSERT_EQUAL_MEMORY(&config_before, &config, sizeof config);
    }
    carried_out++;
    send(bytes);
}

static void transmit(void)
{
    silence = 0;
    for (unsigned at = 0; at < twin.command_bytes; at++) {
        carry(twin.command[at], to_board);
    }
}

// ---- Commands ----

static int16_t between(int low, int high)
{
    return (int16_t)(low + (int)numbers_below((uint32_t)(high - low)));
}

static void send_record(void)
{
    struct fixpid_pid_config wanted = twin.config;
    struct fixpid_record record;

    wanted.gains.kp_q8 = (uint16_t)numbers_below(40000);
    wanted.gains.ki_q24 = numbers_below(3000000);
    wanted.gains.kd_q8 = (uint16_t)numbers_below(600);
    wanted.output_max = between(250, 310);
    if (numbers_below(4) == 0) {
        wanted.integral_min = between(-300, 0);
        wanted.integral_max = between(-100, 300);
    }
    fixpid_record_pack(&record, &wanted);
    link_twin_send(&twin, LINK_WRITE, record.bytes, sizeof record.bytes);
}

static void send_value(void)
{
    static const uint8_t commands[] = {LINK_SET_SETPOINT, LINK_SET_SETPOINT,
                                       LINK_SET_MANUAL, LINK_SET_AUTO,
                                       LINK_SET_SEED};
    const uint8_t command = commands[numbers_below(5)];
    const int16_t value = between(-600, 1000);
    const uint8_t bytes[] = {(uint8_t)value, (uint8_t)((uint16_t)value >> 8)};

    link_twin_send(&twin, command, bytes, command == LINK_SET_AUTO ? 0 : 2);
}

static bool stream_wanted;

// One at a time, and again without an answer.
static void command(void)
{
    const uint8_t each[] = {1};

    if (twin.command_bytes != 0) {
        silence++;
        if (silence % PATIENCE == 0) {
            transmit();
        }
        return;
    }
    if (twin.wants_record) {
        twin.wants_record = false;
        stream_wanted = true;
        link_twin_send(&twin, LINK_ASK_RECORD, each, 0);
    } else if (stream_wanted) {
        stream_wanted = false;
        link_twin_send(&twin, LINK_SET_STREAM, each, 1);
    } else if (numbers_below(60) != 0) {
        return;
    } else if (numbers_below(3) == 0) {
        send_record();
    } else {
        send_value();
    }
    transmit();
}

// ---- The board ----

static void step_board(int16_t setpoint)
{
    const int16_t output = fixpid_pid_step(&pid, setpoint, measurement);
    uint8_t bytes;

    if (tracks) {
        const int16_t applied = (int16_t)(output / 2);

        fixpid_pid_track(&pid, applied, 3);
        bytes = fixpid_link_step_tracked(&link_of_board, &pid, setpoint,
                                         measurement, output, applied, 3);
    } else {
        bytes = fixpid_link_step(&link_of_board, &pid, setpoint, measurement,
                                 output);
    }
    send(bytes);
    measurement =
        (int16_t)(measurement + output / 8 + (int16_t)(numbers_below(21)) - 10 -
                  measurement / 16);
}

static void run(unsigned steps)
{
    for (unsigned i = 0; i < steps; i++) {
        command();
        step_board(fixpid_link_setpoint(&link_of_board));
    }
}

// ---- A good wire ----

void test_twin_is_equal_in_each_step_on_a_good_wire(void)
{
    run(STEPS);
    TEST_ASSERT_EQUAL(0, twin.different);
    TEST_ASSERT_EQUAL(0, twin.gaps);
    // All but the one before the stream, the first of it, and those where a
    // hand let go.
    TEST_ASSERT_EQUAL(STEPS - 1, twin.equal + twin.not_compared);
    TEST_ASSERT_EQUAL(twin.taken_over, twin.not_compared);
    TEST_ASSERT_GREATER_THAN(1, twin.taken_over);
    TEST_ASSERT_LESS_THAN(STEPS / 100, twin.not_compared);
    TEST_ASSERT_GREATER_THAN(STEPS / 256, twin.keys_compared);
    TEST_ASSERT_GREATER_THAN(STEPS / 100, carried_out);
    twin_has_config();
}

// One in 1/256 of a count is seen in the next key frame, though no output has
// changed yet.
void test_twin_sees_a_flipped_bit_of_the_integral(void)
{
    run(300);
    while (twin.next % 256 != 20) {
        run(1);
    }
    fixpid_link_init(&link_of_board, 0); // and no hand is under way
    fixpid_link_allow(&link_of_board, 0);
    twin.command_bytes = 0;
    twin.wants_record = true;
    run(5);
    TEST_ASSERT_EQUAL(0, twin.different);
    pid.integral_fraction ^= 0x01;
    run(260);
    TEST_ASSERT_NOT_EQUAL(0, twin.different);
}

void test_twin_is_equal_where_the_program_has_its_own_setpoint(void)
{
    for (unsigned i = 0; i < FEWER_STEPS; i++) {
        command();
        step_board(
            (int16_t)(fixpid_link_setpoint(&link_of_board) + between(0, 9)));
    }
    TEST_ASSERT_EQUAL(0, twin.different + twin.gaps);
    TEST_ASSERT_GREATER_THAN(FEWER_STEPS / 10 * 9, twin.equal);
}

void test_twin_takes_over_what_the_program_changed(void)
{
    run(100);
    for (unsigned i = 0; i < 20; i++) {
        fixpid_pid_reset(&pid);
        fixpid_pid_set_feedforward(&pid, (int16_t)i);
        fixpid_link_changed(&link_of_board);
        run(30);
    }
    TEST_ASSERT_EQUAL(0, twin.different + twin.gaps);
    TEST_ASSERT_GREATER_OR_EQUAL(20, twin.taken_over);
}

void test_twin_asks_for_what_the_program_changed_where_it_can(void)
{
    twin.asks = true;
    run(100);
    for (unsigned i = 0; i < 20; i++) {
        config.gains.kp_q8 = (uint16_t)(100 + 40 * i);
        TEST_ASSERT_TRUE(fixpid_pid_set_gains(&pid, &config.gains));
        fixpid_link_changed(&link_of_board);
        run(30);
    }
    TEST_ASSERT_EQUAL(0, twin.different + twin.gaps);
    twin_has_config();
    TEST_ASSERT_GREATER_OR_EQUAL(20, twin.by_reason[LINK_TWIN_CHANGED]);
    TEST_ASSERT_GREATER_THAN(20 * 20, twin.equal);
}

void test_log_waits_for_a_record_where_the_program_changed_gains(void)
{
    unsigned equal;

    run(300);
    equal = twin.equal;
    fixpid_pid_reset(&pid);
    fixpid_link_changed(&link_of_board);
    run(300);
    TEST_ASSERT_GREATER_THAN(290, twin.equal - equal);
    TEST_ASSERT_FALSE(twin.unsure);
    config.gains.kp_q8 = 90;
    TEST_ASSERT_TRUE(fixpid_pid_set_gains(&pid, &config.gains));
    fixpid_link_changed(&link_of_board);
    twin.command_bytes = 0; // nobody asks
    for (unsigned i = 0; i < 300; i++) {
        step_board(100);
    }
    TEST_ASSERT_EQUAL(0, twin.different);
    TEST_ASSERT_GREATER_THAN(1, twin.by_reason[LINK_TWIN_CHANGED]);
    TEST_ASSERT_TRUE(twin.wants_record);
    equal = twin.equal;
    run(300);
    TEST_ASSERT_EQUAL(0, twin.different);
    TEST_ASSERT_GREATER_THAN(250, twin.equal - equal);
}

// ---- What it says ----

void test_first_difference_has_both_answers(void)
{
    unsigned steps = 1000;

    run(1000);
    pid.integral += INT32_C(3) << 16; // three counts
    for (; twin.different == 0; steps++) {
        run(1); // where the output is limited both are equal
    }
    TEST_ASSERT_EQUAL(twin.first.own_output + 3, twin.first.output);
    TEST_ASSERT_EQUAL(steps - 1, twin.first.number);
    run(1000);
    TEST_ASSERT_EQUAL(steps - 1, twin.first.number);
    TEST_ASSERT_FALSE(twin.first.state);
    TEST_ASSERT_GREATER_THAN(0, twin.by_reason[LINK_TWIN_DIFFERENCE]);
}

void test_first_difference_may_be_in_the_state_alone(void)
{
    run(1000);
    pid.integral_fraction ^= 0x01;
    run(1);
    TEST_ASSERT_EQUAL(0, twin.different);
    run(1000);
    TEST_ASSERT_TRUE(twin.first.state);
    TEST_ASSERT_EQUAL(twin.first.own_output, twin.first.output);
}

void test_first_difference_may_be_in_the_flags_alone(void)
{
    int16_t output;

    run(1000);
    output = fixpid_pid_step(&pid, 0, measurement);
    pid.status ^= FIXPID_PID_AT_MAX;
    send(fixpid_link_step(&link_of_board, &pid, 0, measurement, output));
    TEST_ASSERT_EQUAL(1, twin.different);
    TEST_ASSERT_EQUAL(twin.first.own_output, twin.first.output);
    TEST_ASSERT_EQUAL(twin.first.own_flags ^ FIXPID_PID_AT_MAX,
                      twin.first.flags);
}

static unsigned reasons(void)
{
    unsigned sum = 0;

    for (unsigned at = 0; at < LINK_TWIN_REASONS; at++) {
        sum += twin.by_reason[at];
    }
    return sum;
}

void test_each_frame_is_counted_once(void)
{
    unsigned frames = 0;

    damage = 1000;
    for (unsigned i = 0; i < 10000; i++) {
        const unsigned before = twin.frames;

        step_board(fixpid_link_setpoint(&link_of_board));
        frames += twin.frames - before;
        command();
    }
    TEST_ASSERT_EQUAL(frames, twin.equal + twin.not_compared);
    TEST_ASSERT_EQUAL(twin.not_compared, reasons());
    TEST_ASSERT_NOT_EQUAL(0, twin.by_reason[LINK_TWIN_GAP]);
    TEST_ASSERT_NOT_EQUAL(0, twin.by_reason[LINK_TWIN_BEGINNING]);
    TEST_ASSERT_EQUAL(0, twin.by_reason[LINK_TWIN_THINNED]);
    TEST_ASSERT_NOT_EQUAL(0, twin.spoilt);
}

void test_thinned_stream_is_not_compared_and_said_to_be_thinned(void)
{
    const uint8_t third[] = {3};

    run(100);
    while (twin.command_bytes != 0) {
        run(1);
    }
    link_twin_send(&twin, LINK_SET_STREAM, third, 1);
    transmit();
    for (unsigned i = 0; i < 300; i++) {
        step_board(0);
    }
    // Nine equal distances show it.
    TEST_ASSERT_GREATER_THAN(85, twin.by_reason[LINK_TWIN_THINNED]);
    TEST_ASSERT_EQUAL(0, twin.different);
}

void test_record_that_is_known_does_not_stop_comparing(void)
{
    const uint8_t none[] = {0};

    run(50);
    while (twin.command_bytes != 0) {
        run(1);
    }
    for (unsigned i = 0; i < 10; i++) {
        const unsigned before = twin.equal;

        link_twin_send(&twin, LINK_ASK_RECORD, none, 0);
        transmit();
        step_board(0);
        TEST_ASSERT_EQUAL(before + 1, twin.equal);
    }
}

// Hello is sent twice, as its answer is late; the second answer comes when the
// record is asked for.
void test_answer_that_comes_twice_does_not_end_the_next_command(void)
{
    const uint8_t none[] = {0};
    uint8_t frame[FIXPID_LINK_FRAME];

    link_twin_send(&twin, LINK_ASK_HELLO, none, 0);
    transmit();
    TEST_ASSERT_EQUAL(0, twin.command_bytes);
    memcpy(frame, link_of_board.frame, sizeof frame);
    link_twin_send(&twin, LINK_ASK_RECORD, none, 0);
    for (unsigned at = 0; at < sizeof frame; at++) {
        (void)link_twin_receive(&twin, frame[at]);
    }
    TEST_ASSERT_NOT_EQUAL(0, twin.command_bytes);
    transmit();
    TEST_ASSERT_EQUAL(0, twin.command_bytes);
}

// ---- Another's log ----

// Commands were sent by a program whose bytes are not here.
static void another_sends(uint8_t command, const uint8_t value[],
                          unsigned bytes)
{
    static uint8_t tag = 200;
    uint8_t payload[LINK_FRAMES_MAX] = {command, ++tag};
    uint8_t framed[LINK_FRAMES_MAX];
    unsigned count;

    memcpy(payload + 2, value, bytes);
    count = link_command(payload, bytes + 2, framed);
    for (unsigned at = 0; at < count; at++) {
        if (fixpid_link_receive(&link_of_board, framed[at])) {
            send(fixpid_link_answer(&link_of_board, &board, &pid, &config));
        }
    }
}

static void step_times(unsigned steps)
{
    while (steps != 0) {
        step_board(fixpid_link_setpoint(&link_of_board));
        steps--;
    }
}

static void begin_log(void)
{
    const uint8_t each[] = {1};

    another_sends(LINK_ASK_RECORD, each, 0);
    another_sends(LINK_SET_STREAM, each, 1);
    step_times(100);
    TEST_ASSERT_EQUAL(99, twin.equal);
}

void test_log_goes_on_behind_a_setpoint_and_a_hand(void)
{
    const uint8_t value[] = {100, 0};

    begin_log();
    another_sends(LINK_SET_SETPOINT, value, 2);
    step_times(100);
    TEST_ASSERT_EQUAL(199, twin.equal);
    another_sends(LINK_SET_MANUAL, value, 2);
    step_times(5);
    another_sends(LINK_SET_AUTO, value, 0);
    step_times(95);
    TEST_ASSERT_EQUAL(0, twin.different);
    TEST_ASSERT_EQUAL(297, twin.equal); // but for two key frames
}

void test_log_is_not_compared_behind_a_write_until_its_record_comes(void)
{
    struct fixpid_pid_config wanted = config;
    struct fixpid_record record;

    begin_log();
    wanted.gains.kp_q8 = 77;
    fixpid_record_pack(&record, &wanted);
    another_sends(LINK_WRITE, record.bytes, sizeof record.bytes);
    step_times(1000);
    TEST_ASSERT_EQUAL(99, twin.equal);
    TEST_ASSERT_EQUAL(0, twin.different);
    another_sends(LINK_ASK_RECORD, record.bytes, 0);
    step_times(1000);
    TEST_ASSERT_GREATER_THAN(800, twin.equal);
    TEST_ASSERT_EQUAL(0, twin.different);
}

// A tag comes again after 255 others, of which the twin has carried out none.
void test_same_tag_and_command_later_are_carried_out_again(void)
{
    struct fixpid_record record;
    struct fixpid_pid_config wanted = config;
    const uint8_t beyond[] = {0xFF, 0x7F};

    run(50);
    while (twin.command_bytes != 0) {
        run(1);
    }
    for (uint16_t kp = 300; kp < 302; kp++) {
        wanted.gains.kp_q8 = kp;
        fixpid_record_pack(&record, &wanted);
        link_twin_send(&twin, LINK_WRITE, record.bytes, sizeof record.bytes);
        transmit();
        step_times(1);
        for (unsigned i = 0; i < 254; i++) {
            link_twin_send(&twin, LINK_SET_SETPOINT, beyond, 2);
            transmit();
            step_times(1);
        }
    }
    TEST_ASSERT_EQUAL(301, config.gains.kp_q8);
    TEST_ASSERT_EQUAL(301, twin.config.gains.kp_q8);
    TEST_ASSERT_EQUAL(0, twin.different);
}

// ---- Tracked ----

void test_twin_is_equal_in_each_tracked_step(void)
{
    tracks = true;
    run(FEWER_STEPS);
    TEST_ASSERT_EQUAL(0, twin.different);
    TEST_ASSERT_EQUAL(0, twin.gaps);
    TEST_ASSERT_EQUAL(FEWER_STEPS - 1, twin.equal + twin.not_compared);
    TEST_ASSERT_LESS_THAN(FEWER_STEPS / 30, twin.not_compared);
}

void test_twin_sees_a_step_that_was_tracked_otherwise(void)
{
    tracks = true;
    run(300);
    TEST_ASSERT_EQUAL(0, twin.different);
    pid.integral += INT32_C(1) << 16;
    run(300);
    TEST_ASSERT_NOT_EQUAL(0, twin.different);
}

// ---- A bad wire ----

// One byte of a hundred is lost, turned, doubled or another, both ways.
void test_damage_nothing_is_taken_that_was_not_sent(void)
{
    damage = 100;
    run(STEPS);
    TEST_ASSERT_EQUAL(0, twin.different);
    TEST_ASSERT_GREATER_THAN(STEPS / 200, carried_out);
    TEST_ASSERT_GREATER_THAN(STEPS / 200, twin.gaps);
    TEST_ASSERT_GREATER_THAN(STEPS / 20, twin.equal);
    damage = 0;
    run(600);
    TEST_ASSERT_EQUAL(0, twin.different);
    twin_has_config();
}

void test_damage_that_is_seldom_leaves_most_steps_compared(void)
{
    damage = 20000;
    run(STEPS);
    TEST_ASSERT_EQUAL(0, twin.different);
    TEST_ASSERT_NOT_EQUAL(0, twin.gaps);
    TEST_ASSERT_GREATER_THAN(STEPS * 3 / 4, twin.equal);
}

// A frame that has no room costs itself, a key frame, too.
void test_lost_frames_cost_only_themselves(void)
{
    unsigned lost = 0;

    run(100);
    no_room = 50;
    for (unsigned i = 0; i < FEWER_STEPS; i++) {
        const unsigned before = twin.frames;

        run(1);
        lost += twin.frames == before ? 1 : 0;
    }
    TEST_ASSERT_EQUAL(0, twin.different);
    TEST_ASSERT_GREATER_THAN(FEWER_STEPS / 250, lost);
    TEST_ASSERT_GREATER_THAN(FEWER_STEPS / 5 * 4, twin.equal);
}

// The board has carried it out, and the twin does not know.
static void write_without_answer(void)
{
    struct fixpid_pid_config wanted = config;
    struct fixpid_record record;

    wanted.gains.kp_q8 = 7;
    fixpid_record_pack(&record, &wanted);
    link_twin_send(&twin, LINK_WRITE, record.bytes, sizeof record.bytes);
    for (unsigned at = 0; at < twin.command_bytes; at++) {
        if (fixpid_link_receive(&link_of_board, twin.command[at])) {
            (void)fixpid_link_answer(&link_of_board, &board, &pid, &config);
        }
    }
    TEST_ASSERT_EQUAL(0, link_of_board.result);
    TEST_ASSERT_EQUAL(7, config.gains.kp_q8);
}

// A command is done, its answer is lost, and so are some steps. It is repeated
// and answered again: the twin, which has not done it, asks for the record.
void test_twin_does_not_go_on_with_old_gains_after_a_gap(void)
{
    run(100);
    write_without_answer();
    // The key frame is lost on the wire, and the next step shows it.
    (void)fixpid_link_step(&link_of_board, &pid, 0, 0,
                           fixpid_pid_step(&pid, 0, 0));
    step_board(0);
    TEST_ASSERT_FALSE(twin.running);
    transmit();
    TEST_ASSERT_EQUAL(0, twin.command_bytes);
    run(FEWER_STEPS);
    TEST_ASSERT_EQUAL(0, twin.different);
    TEST_ASSERT_GREATER_THAN(FEWER_STEPS / 10 * 9, twin.equal);
    twin_has_config();
}

// The same, and the next key frame comes before the repeated command.
void test_twin_does_not_take_a_key_frame_of_a_command_it_knows_not(void)
{
    run(100);
    write_without_answer();
    run(FEWER_STEPS);
    TEST_ASSERT_EQUAL(0, twin.different);
    TEST_ASSERT_GREATER_THAN(FEWER_STEPS / 10 * 9, twin.equal);
    twin_has_config();
}

// ---- One wrong byte at each place ----

#define FRAMES 12

static unsigned good;
static struct link_twin reader;

static void count_commands(uint8_t byte)
{
    if (fixpid_link_receive(&link_of_board, byte)) {
        good++;
        (void)fixpid_link_answer(&link_of_board, &board, &pid, &config);
    }
}

static void count_frames(uint8_t byte)
{
    (void)link_twin_receive(&reader, byte);
    good = reader.frames;
}

enum { LOST, TWICE, BEHIND_A_0, ANOTHER };

static void take_wrong(uint8_t byte, unsigned kind, unsigned other,
                       void (*take)(uint8_t byte))
{
    if (kind == TWICE) {
        take(byte);
        take(byte);
    } else if (kind == BEHIND_A_0) {
        take(0);
        take(byte);
    } else if (kind == ANOTHER) {
        take((uint8_t)(byte ^ other));
    } else {
        // it is lost
    }
}

static unsigned whole_ones(const uint8_t bytes[], unsigned count, unsigned at,
                           unsigned kind, unsigned other,
                           void (*take)(uint8_t byte))
{
    good = 0;
    fixpid_link_init(&link_of_board, 0);
    link_twin_init(&reader);
    for (unsigned i = 0; i < count; i++) {
        if (i == at) {
            take_wrong(bytes[i], kind, other, take);
        } else {
            take(bytes[i]);
        }
    }
    return good;
}

// The fewest whole ones, whatever becomes of one byte.
static unsigned fewest(const uint8_t bytes[], unsigned count,
                       void (*take)(uint8_t byte))
{
    unsigned least = FRAMES;

    TEST_ASSERT_EQUAL(FRAMES, whole_ones(bytes, count, count, LOST, 0, take));
    for (unsigned at = 0; at < count; at++) {
        for (unsigned kind = LOST; kind <= ANOTHER; kind++) {
            for (unsigned other = 1; other < 256;
                 other += kind == ANOTHER ? TEST_STRIDE : 256) {
                const unsigned now =
                    whole_ones(bytes, count, at, kind, other, take);

                least = now < least ? now : least;
            }
        }
    }
    return least;
}

void test_one_wrong_byte_costs_at_most_two_commands(void)
{
    uint8_t bytes[FRAMES * 12];
    unsigned count = 0;

    for (unsigned i = 0; i < FRAMES; i++) {
        const uint8_t payload[] = {LINK_SET_SETPOINT, (uint8_t)(i + 1),
                                   (uint8_t)numbers_below(256),
                                   (uint8_t)(i % 2)};

        count += link_command(payload, 4, bytes + count);
    }
    TEST_ASSERT_EQUAL(FRAMES - 2, fewest(bytes, count, count_commands));
}

void test_one_wrong_byte_costs_at_most_two_frames(void)
{
    uint8_t bytes[FRAMES * FIXPID_LINK_FRAME];
    unsigned count = 0;

    link_of_board.stream_interval = 1;
    for (unsigned i = 0; i < FRAMES; i++) {
        uint8_t frame;

        if (i % 4 == 0) {
            fixpid_link_lost(&link_of_board); // a key frame
        }
        frame = fixpid_link_step(
            &link_of_board, &pid, 0, (int16_t)i,
            fixpid_pid_step(&pid, 0, (int16_t)numbers_below(400)));
        memcpy(bytes + count, link_of_board.frame, frame);
        count += frame;
    }
    TEST_ASSERT_EQUAL(FRAMES - 2, fewest(bytes, count, count_frames));
}

// The worst kind: the length stays, and 2 to 5 bytes of a record are others.
void test_damage_of_several_bytes_of_a_record_is_noticed(void)
{
    for (unsigned i = 0; i < STEPS; i++) {
        uint8_t payload[25] = {LINK_WRITE, 1};
        uint8_t framed[LINK_FRAMES_MAX];
        unsigned count;

        for (unsigned at = 2; at < 25; at++) {
            payload[at] = (uint8_t)(1 + numbers_below(255));
        }
        count = link_command(payload, 25, framed);
        for (unsigned left = 2 + numbers_below(4); left != 0; left--) {
            framed[1 + numbers_below(count - 2)] =
                (uint8_t)(1 + numbers_below(255));
        }
        for (unsigned at = 0; at < count; at++) {
            if (fixpid_link_receive(&link_of_board, framed[at])) {
                TEST_ASSERT_EQUAL_HEX8_ARRAY(payload, link_of_board.bytes + 1,
                                             25);
                (void)fixpid_link_answer(&link_of_board, &board, &pid, &config);
            }
        }
    }
}

void test_rubbish_is_no_command(void)
{
    for (uint32_t i = 0; i < UINT32_C(20) * STEPS; i++) {
        TEST_ASSERT_FALSE(fixpid_link_receive(
            &link_of_board,
            (uint8_t)(numbers_below(6) == 0 ? 0 : numbers_below(256))));
    }
}
