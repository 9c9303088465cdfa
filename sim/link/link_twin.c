// SPDX-License-Identifier: MIT
#include "link_twin.h"

#include <string.h>

#include "fixpid_record.h"

// Where the state is in a key frame: from its byte 0 on, but for the last four.
#define STATE_AT 11
#define STATE_SENT 14
#define NUMBER_MASK 0x3FFFu

// So many equal distances above 1 behind each other, and the stream is thinned
// out: where one of ten frames is lost, that comes once in 10^8 steps.
#define STRIDES 8u

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

// What the board did, in order, with the very bytes. A tag comes again after
// 255 others, of which the twin may have seen none.
static void replay(struct link_twin *self)
{
    fixpid_link_init(&self->link, 0);
    fixpid_link_allow(&self->link, 0xFF);
    for (unsigned at = 0; at < self->command_bytes; at++) {
        if (fixpid_link_receive(&self->link, self->command[at])) {
            (void)fixpid_link_answer(&self->link, &any_board, &self->pid,
                                     &self->config);
        }
    }
}

static bool is_own(const struct link_twin *self,
                   const struct fixpid_record *record)
{
    struct fixpid_record own;
    bool equal = self->known;

    fixpid_record_pack(&own, &self->config);
    for (unsigned at = 0; at < FIXPID_RECORD_SIZE; at++) {
        equal = equal && own.bytes[at] == record->bytes[at];
    }
    return equal;
}

// One that is known already changes nothing.
static void take_record(struct link_twin *self, const uint8_t payload[])
{
    struct fixpid_record record;

    memcpy(record.bytes, payload + 2, sizeof record.bytes);
    self->unsure = false;
    if (is_own(self, &record)) {
        self->wants_record = false;
        return;
    }
    self->known = fixpid_record_unpack(&record, &self->config) &&
                  fixpid_pid_init(&self->pid, &self->config);
    self->wants_record = !self->known;
    self->running = false;
}

static void doubt(struct link_twin *self)
{
    self->known = false;
    self->running = false;
    self->unsure = false;
    self->wants_record = true;
    self->reason = LINK_TWIN_GAP;
}

// True if it is the answer to the command under way, and not to one before that
// was sent twice.
static bool is_expected(const struct link_twin *self, uint8_t command,
                        uint8_t tag)
{
    return self->command_bytes != 0 && tag == self->payload[1] &&
           command == self->payload[0];
}

// An answer to nothing comes twice, or another program asked: in a log. What
// that wrote is not known here; what its hand did is in the next key frame.
static void overhear(struct link_twin *self, const uint8_t payload[],
                     bool again)
{
    if (again || payload[3] != LINK_DONE) {
        return;
    }
    if (payload[2] == LINK_WRITE) {
        doubt(self);
    } else if (payload[2] > LINK_SET_SETPOINT) {
        self->running = false;
        self->reason = LINK_TWIN_GAP;
    } else {
        // the stream and the setpoint are no part of the controller
    }
}

static void take_answer(struct link_twin *self, const uint8_t payload[])
{
    const uint8_t command = payload[2];
    const bool again = payload[1] == self->last_tag;

    self->last_tag = payload[1];
    if (!is_expected(self, command, payload[1])) {
        overhear(self, payload, again);
        return;
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

static void leave_out(struct link_twin *self)
{
    self->not_compared++;
    self->by_reason[self->reason]++;
    self->compared = false;
}

// With gains that the program may have changed it says nothing.
static void differ(struct link_twin *self,
                   const struct link_twin_difference *found)
{
    if (self->unsure) {
        doubt(self);
        self->reason = LINK_TWIN_CHANGED;
        leave_out(self);
        return;
    }
    if (self->different == 0) {
        self->first = *found;
    }
    self->different++;
    self->running = false;
    self->compared = false;
    self->reason = LINK_TWIN_DIFFERENCE;
}

// Makes the step of number `next`; its output and flags must be these.
static void judge(struct link_twin *self, int16_t measurement, int16_t output,
                  uint8_t flags)
{
    const int16_t own =
        fixpid_pid_step(&self->pid, self->setpoint, measurement);
    const struct link_twin_difference found = {
        .number = self->next,
        .output = output,
        .own_output = own,
        .flags = flags,
        .own_flags = fixpid_pid_flags(&self->pid)};

    self->next++;
    if (own == output && found.own_flags == flags) {
        self->equal++;
        self->compared = true;
    } else {
        differ(self, &found);
    }
}

static void take_over(struct link_twin *self, const uint8_t payload[])
{
    uint8_t state[FIXPID_PID_STATE_SIZE];

    fixpid_pid_state(&self->pid, state);
    memcpy(state, payload + STATE_AT, STATE_SENT);
    (void)fixpid_pid_restore(&self->pid, state); // it takes any bytes
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
    leave_out(self);
}

// What a tracking moves is only known of a step's frame: in a stream of those
// the integral is taken from a key frame.
static void compare_state(struct link_twin *self, const uint8_t payload[])
{
    uint8_t state[FIXPID_PID_STATE_SIZE];
    bool equal = true;

    fixpid_pid_state(&self->pid, state);
    for (unsigned at = self->tracked ? 8 : 3; at < STATE_SENT; at++) {
        equal = equal && state[at] == payload[STATE_AT + at];
    }
    if (!equal) {
        const struct link_twin_difference found = {
            .number = self->next - 1,
            .output = (int16_t)link_number(payload + STATE_AT, 2),
            .own_output = (int16_t)link_number(state, 2),
            .flags = payload[STATE_AT + 2],
            .own_flags = state[2],
            .state = true};

        self->equal--; // by its output and flags alone it was
        differ(self, &found);
    }
    self->unsure = false; // with other gains it was different
    self->keys_compared++;
    if (self->tracked) {
        take_over(self, payload);
    }
}

// A step with this number, of which the bits of `mask` are known.
static void come(struct link_twin *self, uint32_t number, uint32_t mask)
{
    const unsigned stride = (number - self->last) & NUMBER_MASK;

    if (self->running && number != (self->next & mask)) {
        self->running = false;
        self->gaps++;
        self->reason = LINK_TWIN_GAP;
    }
    self->strides =
        stride > 1 && stride == self->stride ? self->strides + 1 : 0;
    if (!self->running && self->strides >= STRIDES) {
        self->reason = LINK_TWIN_THINNED;
    } else if (self->reason == LINK_TWIN_THINNED) {
        self->reason = LINK_TWIN_GAP;
    } else {
        // it is what it was
    }
    self->stride = stride;
    self->last = number;
}

// The gains may be others, too: who can ask does, and a log goes on with those
// that it has while they fit.
static void program_changed(struct link_twin *self)
{
    if (self->asks) {
        doubt(self);
    }
    self->unsure = !self->asks;
    self->running = false;
    self->reason = LINK_TWIN_CHANGED;
}

static void take_key(struct link_twin *self, const uint8_t payload[])
{
    const int16_t measurement = (int16_t)link_number(payload + 9, 2);

    if (payload[2] != self->last_tag) {
        doubt(self);
    }
    come(self, link_number(payload + 3, 4), UINT32_MAX);
    self->setpoint = (int16_t)link_number(payload + 7, 2);
    if (self->known && (payload[1] & LINK_CHANGED) != 0) {
        program_changed(self);
    }
    if (!self->known) {
        leave_out(self);
        return;
    }
    if (!self->running) {
        begin_from(self, payload, measurement);
        return;
    }
    judge(self, measurement, (int16_t)link_number(payload + 11, 2),
          payload[13]);
    if (self->running) {
        compare_state(self, payload);
    }
}

static void take_step(struct link_twin *self, const uint8_t payload[],
                      unsigned bytes)
{
    const unsigned with_setpoint = (bytes == 9 || bytes == 12) ? 2 : 0;
    const uint8_t *const behind = payload + 7 + with_setpoint;

    come(self, link_number(payload + 1, 2), NUMBER_MASK);
    if (with_setpoint != 0) {
        self->setpoint = (int16_t)link_number(payload + 7, 2);
    }
    if (!self->running) {
        leave_out(self);
        return;
    }
    judge(self, (int16_t)link_number(payload + 3, 2),
          (int16_t)link_number(payload + 5, 2),
          payload[0] & (uint8_t)~LINK_STEP);
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
        const bool is_hello = payload[0] == LINK_HELLO;

        if (is_hello) {
            self->last_tag = 0;
        } else {
            take_record(self, payload);
        }
        if (is_expected(self, is_hello ? LINK_ASK_HELLO : LINK_ASK_RECORD,
                        payload[1])) {
            self->command_bytes = 0;
        }
    }
}

// The bytes that a payload with this first one has; a step's are 7, and more
// with a setpoint and after a tracking.
static bool is_long_enough(uint8_t kind, unsigned bytes)
{
    static const uint8_t length[] = {[LINK_KEY] = 25,
                                     [LINK_ANSWER] = 4,
                                     [LINK_HELLO] = 24,
                                     [LINK_RECORD] = 25};

    if ((kind & LINK_STEP) != 0) {
        return bytes == 7 || bytes == 9 || bytes == 10 || bytes == 12;
    }
    return kind < sizeof length && length[kind] == bytes;
}

bool link_twin_receive(struct link_twin *self, uint8_t byte)
{
    unsigned count = self->count;
    unsigned bytes;

    if (byte != 0) {
        if (count < LINK_FRAMES_MAX) {
            self->bytes[count] = byte;
            self->count++;
        }
        return false;
    }
    self->count = 0;
    bytes = link_payload(self->bytes, count, self->frame);
    self->frame_bytes = bytes;
    if (bytes == 0 || !is_long_enough(self->frame[0], bytes)) {
        self->spoilt += count != 0 ? 1 : 0;
        return false;
    }
    take(self, self->frame, bytes);
    return true;
}
