// SPDX-License-Identifier: MIT
// What a test asks of a controller, and what the controller answers: one step
// with the calls that come before it, and those of fixpid_pid after it. Whoever
// asks fills in the question, lets the controller's driver reply, and reads the
// answer in its place: a PIC16F684 in pointer mode has no room for both.
//
// No compiler pads these structures: on a little-endian machine the bytes on
// the chip are the bytes on the host. For others test/chips/families writes
// them member by member.
#ifndef EXCHANGE_H
#define EXCHANGE_H
#include <stdint.h>
#if !defined(__SDCC_pic14) && !defined(__SDCC_pic16) &&                        \
    !defined(__SDCC_pdk14) && !defined(__SDCC_pdk15)
#include <string.h>
#endif

#include "fixpid_an964.h"
#include "fixpid_an964_8bit.h"
#include "fixpid_pid.h"

// Bits of `calls`, made in this order before the step. An answer's `accepted`
// has those bits whose calls returned true.
#define CALL_INIT 0x01u
#define CALL_RESET 0x02u
#define CALL_SET_GAINS 0x04u
#define CALL_SET_LIMIT 0x08u    // AN937: the accumulated error's limit
#define CALL_SET_PERIOD 0x10u   // AN937: the derivative period
#define CALL_CLEAR_FLAGS 0x20u  // AN937
#define CALL_STEP_PERCENT 0x40u // AN937: the step is the note's 8-bit one
#define CALL_GETTERS 0x80u      // AN937: else 0 is answered, which is faster

#define CALL_SET_LIMITS 0x0008u // these: general-purpose controller
#define CALL_SET_INTEGRAL_LIMITS 0x0010u
#define CALL_SET_FEEDFORWARD 0x0020u
#define CALL_SET_MANUAL 0x0040u
#define CALL_SET_AUTO 0x0080u
#define CALL_SEED 0x0100u
#define CALL_TRACK 0x0200u       // with value and shift_before
#define CALL_RESET_AFTER 0x0400u // these: after the step, in this order
#define CALL_SET_MANUAL_AFTER 0x0800u
#define CALL_SET_AUTO_AFTER 0x1000u
#define CALL_SEED_AFTER 0x2000u
#define CALL_TRACK_AFTER 0x4000u // with applied and shift

struct an937_question {
    uint16_t limit;
    int16_t error;
    uint8_t kp_q4;
    uint8_t ki_q4;
    uint8_t kd_q4;
    uint8_t period;
    uint8_t calls;
    uint8_t ticks;
};

struct an937_answer {
    int32_t output;
    int32_t proportional;
    int32_t integral;
    int32_t derivative;
    int32_t accumulated;
    uint8_t accepted;
    uint8_t flags;
    uint8_t stat1;
    uint8_t stat2;
};

struct an964_question {
    struct fixpid_an964_gains gains;
    int16_t error;
    uint8_t calls;
    uint8_t unused;
};

struct an964_8bit_question {
    struct fixpid_an964_8bit_gains gains;
    int8_t error;
    uint8_t calls;
};

// Of both forms of AN964.
struct an964_answer {
    int16_t output;
    int16_t proportional;
    int16_t integral;
    int16_t derivative;
    uint8_t accepted;
    uint8_t flags;
};

struct pid_question {
    uint32_t ki_q24;
    uint16_t kp_q8;
    uint16_t kd_q8;
    int16_t output_min;
    int16_t output_max;
    int16_t integral_min;
    int16_t integral_max;
    uint16_t setpoint_weight_q8;
    int16_t value; // feed-forward, or output by hand, to start from, or applied
    int16_t value_after; // output by hand or to start from
    int16_t applied;
    int16_t setpoint;
    int16_t measurement;
    uint16_t calls;
    uint8_t derivative_filter;
    uint8_t options; // bits, as in the rows
    uint8_t shift_before;
    uint8_t shift;
    uint16_t unused;
};

struct pid_answer {
    int32_t proportional;
    int32_t integral;
    int32_t derivative;
    int16_t output;
    int16_t last_output; // after all calls
    uint8_t accepted;
    uint8_t flags;
    uint16_t unused;
};

// Where what asks has its variables: on a PIC16 in bank 1, since the
// controllers fill bank 0.
#if defined(__SDCC_pic14)
#define EXCHANGE_PLACE __at(0xA0)
#define TICKS_TOLD_PLACE __at(0xB0)
#else
#define EXCHANGE_PLACE
#define TICKS_TOLD_PLACE
#endif

// A driver calls it before init, which must set every member of the object. On
// a PIC and a Padauk the harness fills it from outside: there is no room for a
// loop.
#if defined(__SDCC_pic14) || defined(__SDCC_pic16) || defined(__SDCC_pdk14) || \
    defined(__SDCC_pdk15)
#define DRIVER_POISON(object)
#else
#define DRIVER_POISON(object) ((void)memset(&(object), 0xA5, sizeof(object)))
#endif

union an937_exchange {
    struct an937_question question;
    struct an937_answer answer;
};

union an964_exchange {
    struct an964_question question;
    struct an964_answer answer;
};

union an964_8bit_exchange {
    struct an964_8bit_question question;
    struct an964_answer answer;
};

union pid_exchange {
    struct pid_question question;
    struct pid_answer answer;
};

extern union an937_exchange an937_exchange;
extern union an964_exchange EXCHANGE_PLACE an964_exchange;
extern union an964_8bit_exchange EXCHANGE_PLACE an964_8bit_exchange;
extern union pid_exchange pid_exchange;

// The drivers: they answer the question with the library's controller.
void an937_reply(void);
void an964_reply(void);
void an964_8bit_reply(void);
void pid_reply(void);

// fixpid_an937_tick, which an interrupt may call on a PIC18.
void an937_tick(void);

#endif
