// SPDX-License-Identifier: MIT
// What the sources of fixpid_link share.
#include "fixpid_link.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_LINK_SELF
#define VALID_SELF FIXPID_LINK_VALID_SELF

#ifndef FIXPID_LINK_PRIVATE_H
#define FIXPID_LINK_PRIVATE_H

// First bytes of commands.
#define ASK_HELLO 0x40u
#define ASK_RECORD 0x41u
#define SET_STREAM 0x42u
#define SET_SETPOINT 0x43u
#define SET_MANUAL 0x44u
#define SET_AUTO 0x45u
#define SET_SEED 0x46u
#define WRITE_RECORD 0x47u

// Results.
#define DONE 0u
#define NOT_ALLOWED 1u
#define NOT_ACCEPTED 2u

// Why there is a key frame.
#define IN_TURN 1u
#define STREAM_BEGAN 2u
#define COMMANDED 4u
#define CHANGED 8u
#define LOST 16u

// `count` while a whole command waits in `bytes`. It begins there at COMMAND_AT
// and has its tag and its value behind it.
#define WAITS 0xFFu
#define COMMAND_AT 1u
#define TAG_AT 2u
#define VALUE_AT 3u

// Of a step's frame, as fixpid_link_begin leaves it: the payload's bytes, and
// where the output is, with the measurement before it.
#define KEY_BYTES 25u
#define KEY_OUTPUT_AT 12u
#define STEP_OUTPUT_AT 6u

// Where an answer's record is in `frame`.
#define RECORD_AT 4u

#define fixpid_link_is_new FIXPID_SUFFIXED(link, is_new)
#define fixpid_link_reply FIXPID_SUFFIXED(link, reply)
#define fixpid_link_begin FIXPID_SUFFIXED(link, begin)
#define fixpid_link_framed FIXPID_SUFFIXED(link, framed)

// True if the command that waits has not been carried out yet; it then is the
// last one.
bool fixpid_link_is_new(FIXPID_DATA struct fixpid_link *self);

// Makes the answer with the result; returns its bytes. Nothing waits any more.
uint8_t fixpid_link_reply(FIXPID_DATA struct fixpid_link *self);

// A step, with its payload from frame[1] on but for the measurement and the
// output; returns the payload's bytes, 0 if the step has no frame.
uint8_t fixpid_link_begin(FIXPID_DATA struct fixpid_link *self,
                          FIXPID_DATA struct fixpid_pid *pid_self,
                          int16_t setpoint);

// Makes a frame of the `bytes` from frame[1] on; returns its bytes.
// pre: bytes is within 1..FIXPID_LINK_FRAME - 4
uint8_t fixpid_link_framed(FIXPID_DATA uint8_t *frame, uint8_t bytes);

#endif
