// SPDX-License-Identifier: MIT
#include "link_twin.h"

#include <string.h>

#include "fixpid_record.h"

// Where the state is in a key frame: from its byte 0 on, but for the last four.
#define STATE_AT 11
#define STATE_SENT 14
#define NUMBER_MASK 0x3FFFu

// The board has decided already.
static const struct fixpid_link_board any_board = {.period_us = 1,
                                                   .manual_steps = 1,
                                                   .setpoint_min = INT16_MIN,
                                                   .setpoint_max = INT16_MAX,
                                                   .output_min = INT16_MIN,
                                                   .output_max = INT16_MAX};

void link_twin_init(struct link_twin *self)
{
    memset(self, 0, sizeof *self);
    fixpid_link_init(&self->link, 0);
    fixpid_link_allow(&self->link, 0xFF);
}

void link_twin_send(struct link_twin *self, uint8_t command,
                    const uint8_t value[], unsigned bytes)
{
    self->tag = (uint8_t)(self->tag % 255 + 1);
    self->payload[0] = command;
    self->payload[1] = self->tag;
    memcpy(self->payload + 2, value, bytes);
    self->payload_bytes = bytes + 2;
    self->command_bytes =
        link_command(self->payload, self->payload_bytes, self->command);
}

// What the board did, in order, with the very bytes.
static void replay(struct link_twin *self)
{
    for (unsigned at = 0; at < self->command_bytes; at++) {
        if (fixpid_link_receive(&self->link, self->command[at])) {
            (void)fixpid_link_answer(&self->link, &any_board, &self->pid,
                                     &self->config);
        }
    }
}

static void take_record(struct link_twin *self, const uint8_t payload[])
{
    struct fixpid_record record;

    memcpy(record.bytes, payload + 2, sizeof record.bytes);
    self->known = fixpid_record_unpack(&record, &self->config) &&
                  fixpid_pid_init(&self->pid, &self->config);
    self->wants_record = !self->known;
    self->running = false;
}

static void doubt(struct link_twin *self)
{
    self->known = false;
    self->running = false;
    self->wants_record = true;
}

static void take_answer(struct link_twin *self, const uint8_t payload[])
{
    const uint8_t command = payload[2];

    self->last_tag = payload[1];
    if (self->command_bytes == 0 || payload[1] != self->payload[1] ||
        command != self->payload[0]) {
        return; // that of one which came twice
    }
    self->result = payload[3];
    if (command != LINK_SET_STREAM) {
        if (!self->running) {
            doubt(self);
        } else if (payload[3] == LINK_DONE) {
            replay(self);
        }
    }
    self->command_bytes = 0;
}

static bool steps_equal(struct link_twin *self, int16_t measurement,
                        int16_t output, uint8_t flags)
{
    const int16_t own =
        fixpid_pid_step(&self->pid, self->setpoint, measurement);

    return own == output && fixpid_pid_flags(&self->pid) == flags;
}

static void judge(struct link_twin *self, bool equal)
{
    self->next++;
    if (equal) {
        self->equal++;
    } else {
        self->different++;
        self->running = false;
    }
}

static void take_over(struct link_twin *self, const uint8_t payload[])
{
    uint8_t state[FIXPID_PID_STATE_SIZE];

    fixpid_pid_state(&self->pid, state);
    memcpy(state, payload + STATE_AT, STATE_SENT);
    if (!fixpid_pid_restore(&self->pid, state)) {
        self->different++;
    }
    self->taken_over++;
}

// A step that cannot be compared: the state behind it is taken.
static void begin_from(struct link_twin *self, const uint8_t payload[],
                       int16_t measurement)
{
    (void)fixpid_pid_step(&self->pid, self->setpoint, measurement);
    take_over(self, payload);
    self->next = link_number(payload + 3, 4) + 1;
    self->running = true;
    self->not_compared++;
}

// What a tracking moves is only known of a step's frame: in a stream of those
// the integral is taken from a key frame.
static void compare_state(struct link_twin *self, const uint8_t payload[])
{
    uint8_t state[FIXPID_PID_STATE_SIZE];
    const unsigned from = self->tracked ? 8 : 3;

    fixpid_pid_state(&self->pid, state);
    if (memcmp(state + from, payload + STATE_AT + from, STATE_SENT - from) !=
        0) {
        self->different++;
    }
    self->keys_compared++;
    if (self->tracked) {
        take_over(self, payload);
    }
}

static void take_key(struct link_twin *self, const uint8_t payload[])
{
    const int16_t measurement = (int16_t)link_number(payload + 9, 2);
    const bool in_order =
        self->running && link_number(payload + 3, 4) == self->next;

    if (payload[2] != self->last_tag) {
        doubt(self);
    }
    if (!self->known) {
        self->not_compared++;
        return;
    }
    self->setpoint = (int16_t)link_number(payload + 7, 2);
    if (!in_order || (payload[1] & LINK_CHANGED) != 0) {
        self->gaps += (self->running && !in_order) ? 1 : 0;
        begin_from(self, payload, measurement);
        return;
    }
    judge(self,
          steps_equal(self, measurement, (int16_t)link_number(payload + 11, 2),
                      payload[13]));
    compare_state(self, payload);
}

static void take_step(struct link_twin *self, const uint8_t payload[],
                      unsigned bytes)
{
    const unsigned with_setpoint = (bytes == 9 || bytes == 12) ? 2 : 0;
    const uint8_t *const behind = payload + 7 + with_setpoint;

    if (self->running &&
        link_number(payload + 1, 2) != (self->next & NUMBER_MASK)) {
        self->running = false;
        self->gaps++;
    }
    if (!self->running) {
        self->not_compared++;
        return;
    }
    if (with_setpoint != 0) {
        self->setpoint = (int16_t)link_number(payload + 7, 2);
    }
    judge(self, steps_equal(self, (int16_t)link_number(payload + 3, 2),
                            (int16_t)link_number(payload + 5, 2),
                            payload[0] & (uint8_t)~LINK_STEP));
    self->tracked = bytes >= 10;
    if (self->tracked) {
        fixpid_pid_track(&self->pid, (int16_t)link_number(behind, 2),
                         behind[2]);
    }
}

static void take(struct link_twin *self, const uint8_t payload[],
                 unsigned bytes)
{
    self->frames++;
    if ((payload[0] & LINK_STEP) != 0) {
        take_step(self, payload, bytes);
    } else if (payload[0] == LINK_KEY) {
        take_key(self, payload);
    } else if (payload[0] == LINK_ANSWER) {
        take_answer(self, payload);
    } else {
        if (payload[0] == LINK_HELLO) {
            self->last_tag = 0;
        } else {
            take_record(self, payload);
        }
        self->command_bytes = 0;
    }
}

void link_twin_receive(struct link_twin *self, uint8_t byte)
{
    uint8_t payload[LINK_FRAMES_MAX];

    if (byte != 0) {
        if (self->count < LINK_FRAMES_MAX) {
            self->bytes[self->count] = byte;
            self->count++;
        }
        return;
    }
    {
        const unsigned bytes = link_payload(self->bytes, self->count, payload);

        self->count = 0;
        if (bytes != 0) {
            take(self, payload, bytes);
        }
    }
}
