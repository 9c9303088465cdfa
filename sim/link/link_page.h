// SPDX-License-Identifier: MIT
// The twin for the tuner page, as WebAssembly: bytes of a wire or of a log in;
// steps with their terms, the payloads of all other frames, and what the twin
// counts out. tools/lib/pages/tuner/names.rb reads the lists of names.
#ifndef LINK_PAGE_H
#define LINK_PAGE_H
#include <stdint.h>

#define LIVE_BYTES 4096 // at once

// Numbers of a step.
enum live_step {
    LIVE_NUMBER, // of a step's frame its 14 bits
    LIVE_IS_KEY, // 1: all 32 bits
    LIVE_SETPOINT,
    LIVE_MEASUREMENT,
    LIVE_OUTPUT,
    LIVE_FLAGS,
    LIVE_COMPARED, // 1: the twin has the same; below the twin's terms
    LIVE_P,
    LIVE_I,
    LIVE_D,
    LINK_PAGE_STEP
};

enum live_count {
    LIVE_FRAMES,
    LIVE_SPOILT,
    LIVE_EQUAL,
    LIVE_DIFFERENT,
    LIVE_GAPS,
    LIVE_LEFT_BEGINNING, // not compared, as enum link_twin_reason
    LIVE_LEFT_GAP,
    LIVE_LEFT_THINNED,
    LIVE_LEFT_DIFFERENCE,
    LIVE_LEFT_CHANGED,
    LIVE_WANTS_RECORD,
    LIVE_RUNNING,
    LIVE_WAITING, // 1: a command has no answer yet
    LIVE_FIRST_NUMBER,
    LIVE_FIRST_OUTPUT,
    LIVE_FIRST_OWN_OUTPUT,
    LIVE_FIRST_FLAGS,
    LIVE_FIRST_OWN_FLAGS,
    LIVE_FIRST_STATE,
    LINK_PAGE_COUNTS
};

// The board's configuration, in the order of the header's fields.
enum live_config {
    LIVE_KP,
    LIVE_KI,
    LIVE_KD,
    LIVE_FILTER,
    LIVE_OUTPUT_MIN,
    LIVE_OUTPUT_MAX,
    LIVE_INTEGRAL_MIN,
    LIVE_INTEGRAL_MAX,
    LIVE_WEIGHT,
    LIVE_OPTIONS, // as in a record
    LINK_PAGE_CONFIG
};

// A twin that knows nothing, of a board that may be asked, or of a log.
void live_begin(int asks);

uint8_t *live_bytes(void); // LIVE_BYTES, for all that goes in or out

// Takes the bytes from..to-1 of live_bytes, up to a frame that is no step's;
// returns how many. live_payload then has that frame's payload, of
// live_payload_bytes bytes; 0 of them: all that came were steps.
int live_take(int from, int to);
const uint8_t *live_payload(void);
int live_payload_bytes(void);

// The steps of the last live_take: so many, of LINK_PAGE_STEP each.
int live_steps(void);
const int32_t *live_step_numbers(void);

const int32_t *live_counts(void);

// Begins a command with the value in live_bytes. Returns the bytes to send, in
// live_bytes; the same again until it is answered.
int live_command(int command, int bytes);
void live_forget(void); // it is not repeated any more

// The configuration that the twin has, or 0.
const int32_t *live_config(void);

// The record of that configuration with these gains, into live_bytes; returns
// its bytes, or 0 without a configuration.
int live_record(int kp, uint32_t ki, int kd, int filter);

#endif
