// SPDX-License-Identifier: MIT
// A program at the other end of a board's wire, whatever carries the bytes: it
// begins a stream, sends commands of which it knows what the board must answer,
// and asks for the record after them. For a while one byte in a hundred is
// lost, turned or doubled, both ways. link_twin makes each step again.
#ifndef LINK_SESSION_H
#define LINK_SESSION_H
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "link_twin.h"

enum { LINK_CLEAN, LINK_NOISY, LINK_CLEAN_AGAIN, LINK_PARTS };

struct link_session {
    struct link_twin twin;
    uint8_t allowed; // as the board's fixpid_link_allow was told

    unsigned long steps;            // of the board, so far
    unsigned long ends[LINK_PARTS]; // of each part, in those
    unsigned part;
    struct link_twin at[LINK_PARTS]; // the twin when that part began

    uint8_t out[2 * LINK_FRAMES_MAX]; // on the way to the board
    unsigned out_count;
    unsigned out_at;
    unsigned silence; // steps since then

    bool asked;                     // hello was
    bool begun;                     // the stream
    bool trusts;                    // `config` is what the first record said
    const struct link_order *order; // the one under way
    unsigned next_order;
    struct fixpid_pid_config config; // what the board must run with
    struct fixpid_pid_config sent;   // what it runs with if it says done
    int16_t setpoint;                // likewise
    bool setpoint_known;

    unsigned done; // commands that were carried out
    unsigned not_allowed;
    unsigned refused;
    unsigned records; // that were compared
    unsigned wrong;   // answers, records and setpoints
    unsigned spoilt;  // bytes
};

// The parts take so many steps of the board each.
void link_session_init(struct link_session *self, uint8_t allowed,
                       unsigned long clean, unsigned long noisy,
                       unsigned long again);

bool link_session_over(const struct link_session *self);

// The board takes a step.
void link_session_step(struct link_session *self);

// The board has sent a byte.
void link_session_take(struct link_session *self, uint8_t byte);

// The next byte to the board; false if there is none.
bool link_session_give(struct link_session *self, uint8_t *byte);

// Says in a line for each part what came of it, and in one for each thing that
// should not be what that is. True if there is none.
bool link_session_good(const struct link_session *self, FILE *to);

#endif
