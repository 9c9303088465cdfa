// SPDX-License-Identifier: MIT
// A controller and its link: steps, and commands of which some are damaged. All
// frames are answers, and what they must say is known here. With -DCALLS_STREAM
// the firmware only streams, with -DCALLS_TRACKED it tracks after each step.
#include "../../../sim/link/link_frames.h"
#include "calls.h"
#include "fixpid_link.h"
#include "fixpid_record.h"
#include "numbers.h"
#include "numbers_control.h"
#include "numbers_pid.h"

FIXPID_DATA struct fixpid_link wire;

FIXPID_DATA struct fixpid_pid pid;

static struct fixpid_pid_config config;
static struct fixpid_link_board board;
static uint8_t payload[LINK_FRAMES_MAX];
static uint8_t framed[LINK_FRAMES_MAX];
static uint32_t steps;
static uint8_t every;
static uint8_t tag;
static bool has_hand; // the program, until a command or a reset

#ifdef CALLS_STREAM
static uint8_t answer(void)
{
    return fixpid_link_answer_stream(&wire, &board, &config);
}

static void take_hand(void)
{
    // Nobody had it.
}
#else
static uint8_t answer(void)
{
    return fixpid_link_answer(&wire, &board, &pid, &config);
}

static void take_hand(void)
{
    if (numbers_one_in(2)) {
        fixpid_pid_set_manual(&pid, numbers_int16());
        fixpid_link_taken(&wire);
        has_hand = true;
    }
}
#endif

#ifdef CALLS_TRACKED
static uint8_t sent(int16_t setpoint, int16_t measurement, int16_t output)
{
    const int16_t applied = (int16_t)(output / 2);

    fixpid_pid_track(&pid, applied, 3);
    return fixpid_link_step_tracked(&wire, &pid, setpoint, measurement, output,
                                    applied, 3);
}
#else
static uint8_t sent(int16_t setpoint, int16_t measurement, int16_t output)
{
    return fixpid_link_step(&wire, &pid, setpoint, measurement, output);
}
#endif

static void init(void)
{
    numbers_pid_config(&config);
    board.period_us = numbers_next();
    board.manual_steps = (uint16_t)numbers_below(8);
    numbers_pid_range(&board.setpoint_min, &board.setpoint_max);
    numbers_pid_range(&board.output_min, &board.output_max);
    for (uint8_t at = 0; at < FIXPID_LINK_NAME; at++) {
        board.name[at] = (uint8_t)numbers_below(128);
    }
    (void)fixpid_pid_init(&pid, &config);
    fixpid_link_init(&wire, numbers_int16());
    steps = 0;
    every = 0;
    has_hand = false;
}

// The frame's bytes, and those of its payload, which begins at frame[front].
static uint8_t answer_frame(uint8_t front, uint8_t bytes)
{
    uint8_t copy[FIXPID_LINK_FRAME];

    calls_answer(bytes <= FIXPID_LINK_FRAME ? 1u : 0u, 1u);
    if (bytes == 0u) {
        return 0;
    }
    for (uint8_t at = 0; at < bytes; at++) {
        copy[at] = wire.frame[at];
        calls_answer(copy[at], copy[at]);
        // The last byte is 0, and so is the one in front.
        calls_answer(copy[at] == 0u ? 1u : 0u,
                     ((uint8_t)(at + 1u) == bytes) || (at < front) ? 1u : 0u);
    }
    return (uint8_t)link_payload(copy + front, (unsigned)bytes - front - 1u,
                                 payload);
}

// ---- Commands ----

static uint8_t add_value(uint8_t command)
{
    struct fixpid_record record;
    struct fixpid_pid_config wanted;
    const int16_t value = numbers_int16();

    payload[2] = (uint8_t)((uint16_t)value & 0xFFu);
    payload[3] = (uint8_t)((uint16_t)value >> 8);
    if (command == LINK_SET_STREAM) {
        payload[2] = (uint8_t)numbers_below(4);
        return 3;
    }
    if (command == LINK_WRITE) {
        fixpid_record_pack(&record, &config);
        (void)fixpid_record_unpack(&record, &wanted); // SDCC cannot assign it
        numbers_pid_gains(&wanted.gains);
        if (numbers_one_in(3)) {
            numbers_pid_range(&wanted.output_min, &wanted.output_max);
        }
        if (numbers_one_in(4)) {
            wanted.reverse = !wanted.reverse;
        }
        fixpid_record_pack(&record, &wanted);
        for (uint8_t at = 0; at < FIXPID_RECORD_SIZE; at++) {
            payload[2u + at] = record.bytes[at];
        }
        return 2u + FIXPID_RECORD_SIZE;
    }
    return (command < LINK_SET_STREAM) || (command == LINK_SET_AUTO) ? 2 : 4;
}

// What an answer must say, but for the result.
static void answer_command(uint8_t command, uint8_t value)
{
    const uint8_t kind = command == LINK_ASK_HELLO    ? LINK_HELLO
                         : command == LINK_ASK_RECORD ? LINK_RECORD
                                                      : LINK_ANSWER;
    const uint8_t bytes = kind == LINK_HELLO    ? 24
                          : kind == LINK_RECORD ? 25
                                                : 4;
    const bool new = wire.tag != tag || wire.command != command;

    calls_answer(answer_frame(1, answer()), bytes);
    calls_answer(payload[0], kind);
    calls_answer(payload[1], tag);
    if (kind == LINK_ANSWER) {
        calls_answer(payload[2], command);
        has_hand =
            has_hand && (command < LINK_SET_MANUAL || command == LINK_WRITE);
        if (command == LINK_SET_STREAM && (new || tag == 0u)) {
            calls_answer(payload[3], LINK_DONE);
            every = value;
        }
    }
}

static void command(void)
{
    const uint8_t kind = (uint8_t)(LINK_ASK_HELLO + numbers_below(8));
    uint8_t bytes;
    uint8_t count;
    uint8_t value;
    bool taken = false;

    if (!numbers_one_in(4)) {
        tag = (uint8_t)numbers_below(256);
    }
    payload[0] = kind;
    payload[1] = tag;
    bytes = add_value(kind);
    value = payload[2];
    count = (uint8_t)link_command(payload, bytes, framed);
    for (uint8_t at = 0; at < count; at++) {
        calls_answer(taken ? 1u : 0u, 0u);
        taken = fixpid_link_receive(&wire, framed[at]);
    }
    calls_answer(taken ? 1u : 0u, 1u);
    if (taken) {
        answer_command(kind, value);
        if (kind == LINK_SET_MANUAL) {
            take_hand();
        }
    }
}

// A command of which a bit is wrong is none.
static void damaged_command(void)
{
    uint8_t count;
    uint8_t bit;

    payload[0] = LINK_SET_SETPOINT;
    payload[1] = (uint8_t)numbers_below(256);
    payload[2] = (uint8_t)numbers_below(256);
    payload[3] = (uint8_t)numbers_below(256);
    count = (uint8_t)link_command(payload, 4, framed);
    bit = (uint8_t)numbers_below(8u * count);
    framed[bit / 8u] ^= (uint8_t)(1u << (bit % 8u));
    for (uint8_t at = 0; at < count; at++) {
        calls_answer(fixpid_link_receive(&wire, framed[at]) ? 1u : 0u, 0u);
    }
    calls_answer(fixpid_link_receive(&wire, 0) ? 1u : 0u, 0u);
}

// ---- Steps ----

static void answer_step(uint8_t frame, int16_t setpoint, int16_t measurement,
                        int16_t output)
{
    const uint8_t bytes = answer_frame(0, frame);
    const bool key = bytes == 25;
    const uint8_t at = key ? 9 : 3;

    if (frame == 0u) {
        calls_answer(every == 1u ? 1u : 0u, 0u);
        return;
    }
    calls_answer(every == 0u ? 1u : 0u, 0u);
    calls_answer(link_number(payload + (key ? 3 : 1), key ? 4 : 2),
                 key ? steps : steps & 0x3FFFu);
    calls_answer(link_number(payload + at, 2), (uint16_t)measurement);
    calls_answer(link_number(payload + at + 2, 2), (uint16_t)output);
    if (bytes != 7 && bytes != 10) {
        calls_answer(link_number(payload + 7, 2), (uint16_t)setpoint);
    }
}

static void step(void)
{
    int16_t setpoint = fixpid_link_setpoint(&wire);
    int16_t measurement = 0;
    int16_t output;

    numbers_pid_inputs(&setpoint, &measurement);
    output = fixpid_pid_step(&pid, setpoint, measurement);
    answer_step(sent(setpoint, measurement, output), setpoint, measurement,
                output);
    calls_answer(fixpid_pid_flags(&pid), fixpid_pid_flags(&pid));
    if (has_hand) {
        calls_answer(fixpid_pid_flags(&pid) & FIXPID_PID_MANUAL,
                     FIXPID_PID_MANUAL);
    }
    steps++;
}

void calls_rows(void)
{
    // A chip has no room for them.
}

static void program_call(void)
{
    switch (numbers_below(8)) {
    case 0:
        init();
        break;
    case 1:
        fixpid_link_lost(&wire);
        break;
    case 2:
        fixpid_pid_reset(&pid);
        fixpid_link_changed(&wire);
        has_hand = false;
        break;
    default:
        fixpid_link_allow(&wire, (uint8_t)numbers_below(16));
        break;
    }
}

static void random_call(void)
{
    switch (numbers_below(16)) {
    case 0:
        program_call();
        break;
    case 1:
        damaged_command();
        break;
    case 2:
    case 3:
    case 4:
        command();
        break;
    default:
        step();
        break;
    }
}

void calls_random(uint32_t count)
{
    init();
    for (uint32_t i = 0; i < count; i++) {
        random_call();
    }
}
