// SPDX-License-Identifier: MIT
// fixpid_link against its header: any bytes from the wire, in any state. The
// CRC is one of which is known only that equal bytes have an equal one; its
// equation is for the proof of fixpid_record. What fixpid_pid does is for its
// own proofs: here its functions leave any controller.
#include "pid_config.h"

#include "fixpid_link.h"
#include "fixpid_record.h"

struct fixpid_link c; // of any bytes, where a proof begins
struct fixpid_pid pid;
static struct fixpid_pid_config config;
struct fixpid_link nondet_link(void);
struct fixpid_pid nondet_pid(void);
struct fixpid_link_board nondet_board(void);

#define FIXPID_CHECK_H
static uint16_t check; // of whatever is asked
static uint16_t check_of(const uint8_t bytes[], uint8_t count)
{
    pre(count <= FIXPID_LINK_FRAME);
    pre(__CPROVER_r_ok(bytes, count));
    return check;
}

// How often the controller was changed.
static unsigned changes;

static bool changed(bool it_does)
{
    changes += it_does ? 1u : 0u;
    return it_does;
}

uint8_t fixpid_pid_flags(const struct fixpid_pid *self)
{
    pre(self == &pid);
    return nondet_uint8();
}

void fixpid_pid_state(const struct fixpid_pid *self, uint8_t state[])
{
    pre(self == &pid);
    for (unsigned at = 0; at < FIXPID_PID_STATE_SIZE; at++) {
        state[at] = nondet_uint8();
    }
}

// Legal gains are a bit here, so that the old ones are set again.
static bool gains_are_legal;
static bool integral_is_legal;

bool fixpid_pid_set_gains(struct fixpid_pid *self,
                          const struct fixpid_pid_gains *gains)
{
    pre(self == &pid);
    if (gains == &config.gains) {
        changes--;
        return true;
    }
    return changed(gains_are_legal);
}

bool fixpid_pid_set_integral_limits(struct fixpid_pid *self, int16_t low,
                                    int16_t high)
{
    (void)low;
    (void)high;
    pre(self == &pid);
    return changed(integral_is_legal);
}

static struct fixpid_link_board board;

bool fixpid_pid_set_limits(struct fixpid_pid *self, int16_t low, int16_t high)
{
    pre(self == &pid);
    claim(low < high);
    claim(low >= board.output_min);
    claim(high <= board.output_max);
    return changed(true);
}

void fixpid_pid_set_manual(struct fixpid_pid *self, int16_t output)
{
    (void)output;
    pre(self == &pid);
    (void)changed(true);
}

void fixpid_pid_set_auto(struct fixpid_pid *self)
{
    pre(self == &pid);
    (void)changed(true);
}

void fixpid_pid_seed(struct fixpid_pid *self, int16_t output)
{
    (void)output;
    pre(self == &pid);
    (void)changed(true);
}

#include "link/fixpid_link.c"
#include "link/fixpid_link_commands.c"
#include "link/fixpid_link_tracked.c"
#include "record/fixpid_record.c"

static void begin(void)
{
    c = nondet_link();
    config = any_config();
    board = nondet_board();
    gains_are_legal = any_bool;
    integral_is_legal = any_bool;
    changes = 0;
    check = nondet_uint16();
}

// A frame has one 0, its last byte, and each other 0 is the way to the next.
// The length is a constant each time, which the solver is fast at.
static void prove_frame_of(uint8_t bytes)
{
    const unsigned end = bytes + 3u;
    uint8_t plain[FIXPID_LINK_FRAME] = {0};
    unsigned next = end;

    begin();
    for (unsigned i = 1; i < end; i++) {
        plain[i] = (i <= bytes) ? c.frame[i]
                                : (uint8_t)(check >> (8u * (i - bytes - 1u)));
    }
    claim(fixpid_link_framed(c.frame, bytes) == end + 1u);
    claim(c.frame[end] == 0u);
    for (unsigned i = end; i-- > 0u;) {
        claim(c.frame[i] == ((plain[i] == 0u) ? next - i : (unsigned)plain[i]));
        if (plain[i] == 0u) {
            next = i;
        }
    }
}

void prove_framed(void)
{
    prove_frame_of(7);
    prove_frame_of(12);
    prove_frame_of(25);
}

// Any byte in any state: what is not the end of a command changes only what was
// received.
void prove_receive(void)
{
    struct fixpid_link was;
    const uint8_t byte = nondet_uint8();
    bool whole;

    begin();
    was = c;
    whole = fixpid_link_receive(&c, byte);
    claim(whole == ((was.count != 0xFFu) && (c.count == 0xFFu)));
    if (whole) {
        claim(byte == 0u);
        claim(inside(c.bytes[1], 0x40, 0x47));
        claim(inside(was.count, 7, FIXPID_LINK_COMMAND));
    }
    if (was.count == 0xFFu) {
        claim(c.count == 0xFFu);
    }
    claim(c.steps == was.steps);
    claim(c.setpoint == was.setpoint);
    claim(c.manual == was.manual);
    claim(c.allowed == was.allowed);
    claim(c.every == was.every);
    claim(c.why == was.why);
    claim(c.tag == was.tag);
    claim(c.result == was.result);
    for (unsigned at = 0; at < FIXPID_LINK_FRAME; at++) {
        claim(c.frame[at] == was.frame[at]);
    }
}

// Whatever waits: nothing changes without permission, or if it is refused, and
// no limit of the board is passed.
void prove_answer(void)
{
    struct fixpid_link was;
    struct fixpid_pid_config config_was;
    uint8_t bytes;
    uint8_t kind;

    begin();
    was = c;
    config_was = config;
    kind = was.bytes[1];
    assume(kind >= 0x40u);
    assume(kind <= 0x47u);
    bytes = fixpid_link_answer(&c, &board, &pid, &config);
    claim(bytes <= FIXPID_LINK_FRAME);
    claim((bytes == 0u) == (was.count != 0xFFu));
    claim((bytes == 0u) || (c.count == 0u));
    if ((kind <= 0x41u) || (bytes == 0u) || (c.result != 0u)) {
        claim(changes == 0u);
        claim(same_config(&config, &config_was));
        claim(c.setpoint == was.setpoint);
    }
    claim((was.allowed & 1u) != 0u || c.setpoint == was.setpoint);
    claim((was.allowed & 2u) != 0u || same_config(&config, &config_was));
    claim((was.allowed & 10u) != 0u || changes == 0u);
    if ((was.allowed & 4u) == 0u) {
        claim(config.output_min == config_was.output_min);
        claim(config.output_max == config_was.output_max);
        claim(config.integral_min == config_was.integral_min);
        claim(config.integral_max == config_was.integral_max);
    }
    claim((c.setpoint == was.setpoint) ||
          inside(c.setpoint, board.setpoint_min, board.setpoint_max));
    claim(c.allowed == was.allowed);
    claim(c.steps == was.steps);
}

// A step counts, a hand's time ends by itself, and a payload has one of the
// lengths of the header.
void prove_begin(void)
{
    struct fixpid_link was;
    const int16_t setpoint = nondet_int16();
    uint8_t bytes;

    begin();
    was = c;
    bytes = fixpid_link_begin(&c, &pid, setpoint);
    claim((bytes == 0u) || (bytes == 7u) || (bytes == 9u) || (bytes == 25u));
    claim((was.every != 0u) || (bytes == 0u));
    claim((was.count != 0xFFu) || (bytes == 0u));
    claim((bytes == 0u) || (bytes == 25u) || (was.why == 0u));
    claim((bytes != 7u) || (setpoint == was.told));
    claim((bytes != 25u) || (c.why == 0u) || (was.manual == 1u));
    claim(c.steps == (uint32_t)(was.steps + 1u));
    claim(c.manual == ((was.manual == 0u) ? 0u : was.manual - 1u));
    claim(changes == ((was.manual == 1u) ? 1u : 0u));
    claim(c.setpoint == was.setpoint);
}

// Without a stream a step has no frame, and leaves the last one.
void prove_step(void)
{
    struct fixpid_link was;
    uint8_t bytes;

    begin();
    c.every = 0;
    was = c;
    bytes = any_bool ? fixpid_link_step(&c, &pid, nondet_int16(),
                                        nondet_int16(), nondet_int16())
                     : fixpid_link_step_tracked(&c, &pid, nondet_int16(),
                                                nondet_int16(), nondet_int16(),
                                                nondet_int16(), nondet_uint8());
    claim(bytes == 0u);
    for (unsigned at = 0; at < FIXPID_LINK_FRAME; at++) {
        claim(c.frame[at] == was.frame[at]);
    }
}
