// SPDX-License-Identifier: MIT
// The stream, and the three commands that change nothing else.
#include "fixpid_link.h"

#undef FIXPID_BYTES_DATA
#define FIXPID_BYTES_DATA FIXPID_DATA
#include "../common/fixpid_check.h"
#include "../common/fixpid_put.h"
#include "fixpid_link_private.h"
#include "fixpid_record.h"

// First bytes of frames. A step has its flags and this bit, which no flag is.
#define STEP_FRAME 0x08u
#define KEY_FRAME 0x01u
#define ANSWER_FRAME 0x02u
#define HELLO_FRAME 0x03u
#define RECORD_FRAME 0x04u

#define STEP_MASK 0x3FFFu // of the number in a step's frame

#define SETPOINT_AT 8u // in the frame of a step, and in a key frame

#define STEP_BYTES 7u    // of a step's payload without a setpoint
#define ANSWER_BYTES 4u  // of an answer's
#define HELLO_BYTES 14u  // of a hello's without the name
#define CHECKS_BYTES 4u  // behind a command
#define COBS_BYTES 1u    // in front of it
#define NO_COMMAND 0xC0u // a length that none has

// Added to a byte it counts down modulo 256, and no sum wraps below 0.
#define BYTE_MINUS_1 0xFFu

uint8_t fixpid_link_framed(FIXPID_DATA uint8_t *frame, uint8_t bytes)
{
    uint8_t at = (uint8_t)(bytes + 3u);
    uint8_t cobs_offset = 0;

    put(&frame[bytes + 1u], check_of(&frame[1], bytes));
    frame[0] = 0;
    frame[at] = 0;
    // COBS: each 0 but the last one becomes the offset of the next.
    while (at != 0u) {
        at--;
        cobs_offset = (uint8_t)(cobs_offset + 1u);
        if (frame[at] == 0u) {
            frame[at] = cobs_offset;
            cobs_offset = 0;
        }
    }
    return (uint8_t)(bytes + 4u);
}

// Makes an answer of the `bytes` from frame[2] on, with a 0 in front.
static uint8_t answered(FIXPID_DATA struct fixpid_link *self, uint8_t kind,
                        uint8_t bytes)
{
    SELF.count = 0;
    SELF.frame[0] = 0;
    SELF.frame[2] = kind;
    SELF.frame[3] = SELF.bytes[TAG_AT];
    return (uint8_t)(fixpid_link_framed(&SELF.frame[1], bytes) + 1u);
}

void fixpid_link_init(FIXPID_DATA struct fixpid_link *self, int16_t setpoint)
{
    uint8_t at;

    FIXPID_ASSERT(VALID_SELF);
    SELF.steps = 0;
    SELF.setpoint = setpoint;
    SELF.last_sent_setpoint = setpoint;
    SELF.manual = 0;
    SELF.allowed = 0;
    SELF.stream_interval = 0;
    SELF.steps_since_frame = 0;
    SELF.frames_until_key_frame = 0;
    SELF.key_frame_reasons = 0;
    SELF.tag = 0;
    SELF.command = 0;
    SELF.result = DONE;
    SELF.count = 0;
    for (at = 0; at < FIXPID_LINK_COMMAND; at++) {
        SELF.bytes[at] = 0;
        SELF.frame[at] = 0;
    }
}

void fixpid_link_allow(FIXPID_DATA struct fixpid_link *self, uint8_t allowed)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.allowed = allowed;
}

void fixpid_link_changed(FIXPID_DATA struct fixpid_link *self)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.key_frame_reasons |= CHANGED;
}

void fixpid_link_lost(FIXPID_DATA struct fixpid_link *self)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.key_frame_reasons |= LOST;
}

int16_t fixpid_link_setpoint(FIXPID_DATA const struct fixpid_link *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return SELF.setpoint;
}

// The bytes of a command's payload.
static uint8_t bytes_of(uint8_t command)
{
    if (command == WRITE_RECORD) {
        return 2u + FIXPID_RECORD_SIZE;
    }
    if (command == SET_STREAM) {
        return 3;
    }
    if (command == SET_AUTO) {
        return 2;
    }
    if (command < ASK_HELLO) {
        return NO_COMMAND;
    }
    if (command > WRITE_RECORD) {
        return NO_COMMAND;
    }
    return (command < SET_STREAM) ? 2 : 4;
}

// True if behind the bytes there are their CRC, the sum of all bytes, and the
// sum of these sums. The CRC alone lets one of 65536 pass that have wrong bytes
// far apart. The check of a record does not help: it is the same polynomial.
static bool checks_fit(FIXPID_DATA const uint8_t *bytes, uint8_t count)
{
    const uint16_t check = check_of(bytes, count);
    FIXPID_DATA const uint8_t *next = bytes;
    uint8_t sum = 0;
    uint8_t sums = 0;
    uint8_t left;

    for (left = count; left != 0u; left--) {
        sum = (uint8_t)(sum + *next);
        sums = (uint8_t)(sums + sum);
        next++;
    }
    if (next[0] != (uint8_t)(check & 0xFFu)) {
        return false;
    }
    if (next[1] != (uint8_t)(check >> 8)) {
        return false;
    }
    if (next[2] != sum) {
        return false;
    }
    return next[3] == sums;
}

// True if the `count` bytes are a command: the way from one 0 to the next comes
// to their end, they are as many as its first byte says, and all checks fit.
// Then it begins at COMMAND_AT.
static bool is_whole(FIXPID_DATA struct fixpid_link *self, uint8_t count)
{
    uint8_t left = SELF.bytes[0];
    uint8_t bytes;
    uint8_t at;

    for (at = 1; at < count; at++) {
        if (left == 1u) {
            left = SELF.bytes[at];
            SELF.bytes[at] = 0;
        } else {
            left = (uint8_t)(left + BYTE_MINUS_1);
        }
    }
    if (left != 1u) {
        return false;
    }
    bytes = bytes_of(SELF.bytes[COMMAND_AT]);
    if (count != (uint8_t)(bytes + CHECKS_BYTES + COBS_BYTES)) {
        return false;
    }
    return checks_fit(&SELF.bytes[COMMAND_AT], bytes);
}

bool fixpid_link_receive(FIXPID_DATA struct fixpid_link *self, uint8_t byte)
{
    uint8_t count;

    FIXPID_ASSERT(VALID_SELF);
    count = SELF.count;
    if (count == WAITS) {
        return false;
    }
    if (byte != 0u) {
        // One more than fit is too many, and so are more than that.
        if (count <= FIXPID_LINK_COMMAND) {
            SELF.count = (uint8_t)(count + 1u);
        }
        if (count < FIXPID_LINK_COMMAND) {
            SELF.bytes[count] = byte;
        }
        return false;
    }
    SELF.count = 0;
    if (count > FIXPID_LINK_COMMAND) {
        return false;
    }
    if (!is_whole(self, count)) {
        return false;
    }
    SELF.count = WAITS;
    return true;
}

bool fixpid_link_is_new(FIXPID_DATA struct fixpid_link *self)
{
    const uint8_t command = SELF.bytes[COMMAND_AT];
    const uint8_t tag = SELF.bytes[TAG_AT];

    if (tag != 0u) {
        if ((uint8_t)((tag ^ SELF.tag) | (command ^ SELF.command)) == 0u) {
            return false;
        }
    }
    SELF.tag = tag;
    SELF.command = command;
    return true;
}

uint8_t fixpid_link_reply(FIXPID_DATA struct fixpid_link *self)
{
    SELF.frame[4] = SELF.command;
    SELF.frame[5] = SELF.result;
    return answered(self, ANSWER_FRAME, ANSWER_BYTES);
}

static uint8_t hello(FIXPID_DATA struct fixpid_link *self,
                     const struct fixpid_link_board *board)
{
    uint8_t at;

    SELF.tag = 0; // after a hello, tags begin anew
    SELF.frame[4] = FIXPID_LINK_VERSION;
    SELF.frame[5] = FIXPID_VERSION_MAJOR;
    SELF.frame[6] = FIXPID_VERSION_MINOR;
    SELF.frame[7] = FIXPID_VERSION_PATCH;
    SELF.frame[8] = FIXPID_PID_FEATURES;
    SELF.frame[9] = SELF.allowed;
    put(&SELF.frame[10], (uint16_t)(board->period_us & 0xFFFFu));
    put(&SELF.frame[12], (uint16_t)(board->period_us >> 16));
    put(&SELF.frame[14], board->manual_steps);
    for (at = 0; at < FIXPID_LINK_NAME; at++) {
        SELF.frame[at + 16u] = board->name[at];
    }
    return answered(self, HELLO_FRAME, HELLO_BYTES + FIXPID_LINK_NAME);
}

static uint8_t set_stream(FIXPID_DATA struct fixpid_link *self)
{
    if (SELF.command != SET_STREAM) {
        return NOT_ALLOWED;
    }
    SELF.stream_interval = SELF.bytes[VALUE_AT];
    // The next step has a frame.
    SELF.steps_since_frame = (uint8_t)(SELF.stream_interval + BYTE_MINUS_1);
    SELF.key_frame_reasons |= STREAM_BEGAN;
    return DONE;
}

uint8_t fixpid_link_answer_stream(FIXPID_DATA struct fixpid_link *self,
                                  const struct fixpid_link_board *board,
                                  const struct fixpid_pid_config *config)
{
    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(board != 0);
    FIXPID_ASSERT(config != 0);
    if (SELF.count != WAITS) {
        return 0;
    }
    if (SELF.bytes[COMMAND_AT] == ASK_HELLO) {
        return hello(self, board);
    }
    if (SELF.bytes[COMMAND_AT] == ASK_RECORD) {
        // Deviation 11.3: a record is its bytes.
        fixpid_record_pack((struct fixpid_record *)&SELF.frame[RECORD_AT],
                           config);
        return answered(self, RECORD_FRAME, 2u + FIXPID_RECORD_SIZE);
    }
    if (fixpid_link_is_new(self)) {
        SELF.result = set_stream(self);
    }
    return fixpid_link_reply(self);
}

// True if the step has a frame.
static bool is_due(FIXPID_DATA struct fixpid_link *self)
{
    SELF.steps_since_frame = (uint8_t)(SELF.steps_since_frame + 1u);
    if (SELF.stream_interval == 0u) {
        return false;
    }
    if (SELF.count == WAITS) {
        SELF.key_frame_reasons |= LOST;
        return false;
    }
    if (SELF.steps_since_frame < SELF.stream_interval) {
        return false;
    }
    SELF.steps_since_frame = 0;
    SELF.frames_until_key_frame =
        (uint8_t)(SELF.frames_until_key_frame + BYTE_MINUS_1);
    if (SELF.frames_until_key_frame == 0u) {
        SELF.key_frame_reasons |= IN_TURN;
    }
    return true;
}

// The part of a payload that only a key frame has. The state fills the frame to
// its end; the checks overwrite the part of it that is not sent.
static void begin_key(FIXPID_DATA struct fixpid_link *self,
                      FIXPID_DATA const struct fixpid_pid *pid_self)
{
    fixpid_pid_state(pid_self, &SELF.frame[KEY_OUTPUT_AT]);
    SELF.frame[1] = KEY_FRAME;
    SELF.frame[2] = SELF.key_frame_reasons;
    SELF.frame[3] = SELF.tag;
    put(&SELF.frame[4], (uint16_t)(SELF.steps & 0xFFFFu));
    put(&SELF.frame[6], (uint16_t)(SELF.steps >> 16));
    SELF.key_frame_reasons = 0;
    SELF.frames_until_key_frame = 0;
}

#if (FIXPID_PID_FEATURES & FIXPID_PID_HAS_MANUAL) != 0
// Back to automatic when the other end has been silent for too long.
static void watch_hand(FIXPID_DATA struct fixpid_link *self,
                       FIXPID_DATA struct fixpid_pid *pid_self)
{
    if (SELF.manual != 0u) {
        SELF.manual--;
        if (SELF.manual == 0u) {
            fixpid_pid_set_auto(pid_self);
            SELF.key_frame_reasons |= CHANGED;
        }
    }
}
#else
FIXPID_INLINE void watch_hand(FIXPID_DATA struct fixpid_link *self,
                              FIXPID_DATA struct fixpid_pid *pid_self)
{
    (void)self;
    (void)pid_self;
}
#endif

uint8_t fixpid_link_begin(FIXPID_DATA struct fixpid_link *self,
                          FIXPID_DATA struct fixpid_pid *pid_self,
                          int16_t setpoint)
{
    uint8_t bytes = 0;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(FIXPID_PID_VALID_PID);
    if (is_due(self)) {
        bytes = KEY_BYTES;
        if (SELF.key_frame_reasons != 0u) {
            begin_key(self, pid_self);
        } else {
            SELF.frame[1] = fixpid_pid_flags(pid_self) | STEP_FRAME;
            put(&SELF.frame[2], (uint16_t)(SELF.steps & STEP_MASK));
            bytes = STEP_BYTES;
            if (setpoint != SELF.last_sent_setpoint) {
                bytes = STEP_BYTES + 2u;
            }
        }
        put(&SELF.frame[SETPOINT_AT], (uint16_t)setpoint);
        SELF.last_sent_setpoint = setpoint;
    }
    SELF.steps++; // wraps
    watch_hand(self, pid_self);
    return bytes;
}

uint8_t fixpid_link_step(FIXPID_DATA struct fixpid_link *self,
                         FIXPID_DATA struct fixpid_pid *pid_self,
                         int16_t setpoint, int16_t measurement, int16_t output)
{
    const uint8_t bytes = fixpid_link_begin(self, pid_self, setpoint);
    const uint8_t at = (bytes == KEY_BYTES) ? KEY_OUTPUT_AT : STEP_OUTPUT_AT;

    if (bytes == 0u) {
        return 0;
    }
    put(&SELF.frame[at - 2u], (uint16_t)measurement);
    put(&SELF.frame[at], (uint16_t)output); // not what was applied
    return fixpid_link_framed(SELF.frame, bytes);
}
