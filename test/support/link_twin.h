// SPDX-License-Identifier: MIT
// The other end of fixpid_link, as docs/link.md says what it does: it sends
// commands, and has the board's controller once more.
#ifndef LINK_TWIN_H
#define LINK_TWIN_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_link.h"
#include "fixpid_pid.h"
#include "numbers_link.h"

struct link_twin {
    struct fixpid_pid pid;
    struct fixpid_pid_config config;
    struct fixpid_link link;
    bool known;   // config is the board's
    bool running; // pid is the board's
    bool tracked; // the last step was
    bool wants_record;
    uint32_t next;
    int16_t setpoint;
    uint8_t last_tag; // of the last answer
    uint8_t tag;      // counts

    // The command under way, framed, and its payload.
    uint8_t command[LINK_FRAMES_MAX];
    unsigned command_bytes; // 0: there is none
    uint8_t payload[LINK_FRAMES_MAX];
    unsigned payload_bytes;
    uint8_t result; // of the last one

    uint8_t bytes[LINK_FRAMES_MAX]; // since the last 0
    unsigned count;

    // What came of the steps.
    unsigned frames;
    unsigned equal;
    unsigned different;
    unsigned gaps;
    unsigned not_compared;
    unsigned taken_over;
    unsigned keys_compared;
};

void link_twin_init(struct link_twin *self);

// Begins a command; its tag is the next one.
void link_twin_send(struct link_twin *self, uint8_t command,
                    const uint8_t value[], unsigned bytes);

void link_twin_receive(struct link_twin *self, uint8_t byte);

#endif
