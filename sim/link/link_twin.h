// SPDX-License-Identifier: MIT
// The other end of fixpid_link: it sends commands, and has the board's
// controller once more. The tuner page has it as WebAssembly: link_page.h.
//
// A twin has a fixpid_pid, its configuration and a fixpid_link, with everything
// allowed. It counts tags from 1 to 255, begins with hello, has one command
// under way and repeats it until it is answered.
//
// 1. It gives the record of the board's configuration to fixpid_pid_init. From
//    a key frame it makes a step with the setpoint and measurement there, takes
//    fixpid_pid_state, puts the key frame's bytes 11 to 24 over its bytes 0 to
//    13, and calls fixpid_pid_restore.
// 2. For a step's frame with the next number it makes one step: output and
//    flags must be equal. Another number is a gap: it waits for a key frame.
// 3. A key frame with the next number is compared likewise, and the state's
//    bytes 2 to 13, too. With reason 8 (changed) nothing is compared, and it
//    asks for the record as in 5. A log goes on from the state, as in 1; if a
//    step differs there before a key frame was equal, the gains are others, and
//    it waits for a record.
// 4. When the answer to a command says done, it gives the command's bytes to
//    its own fixpid_link_receive and fixpid_link_answer. In a log, with answers
//    to commands of somebody else, it waits for a record behind a write, and
//    for a key frame behind an output by hand.
// 5. If a key frame's tag is not that of the last answer, or a command other
//    than stream is answered during a gap, it asks for the record again, and
//    then for the stream. A record that is as the one it has changes nothing.
// 6. Behind a tracked step it calls fixpid_pid_track with what came. A key
//    frame does not say what was applied in its step: there it takes the
//    integral from it, and compares output, flags, derivative and feed-forward.
//
// It says "different" only where no frame is missing between, and counts the
// steps that it did not compare. If only each n-th step is sent, it has a plot
// and compares nothing.
#ifndef LINK_TWIN_H
#define LINK_TWIN_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_link.h"
#include "fixpid_pid.h"
#include "link_frames.h"

// Why a frame was not compared.
enum link_twin_reason {
    LINK_TWIN_BEGINNING,  // no record or no key frame has come yet
    LINK_TWIN_GAP,        // a frame before it is missing, or an answer
    LINK_TWIN_THINNED,    // only each n-th step has a frame
    LINK_TWIN_DIFFERENCE, // the last one that was compared is different
    LINK_TWIN_CHANGED,    // the program changed the controller
    LINK_TWIN_REASONS
};

// A step that was different: the board's answer, and the twin's own.
struct link_twin_difference {
    uint32_t number;
    int16_t output;
    int16_t own_output;
    uint8_t flags;
    uint8_t own_flags;
    bool state; // both are equal, and a key frame's state is not
};

struct link_twin {
    struct fixpid_pid pid;
    struct fixpid_pid_config config;
    struct fixpid_link link;
    bool known;   // config is the board's
    bool running; // pid is the board's
    bool tracked; // the last step was
    bool wants_record;
    bool asks;   // the record may be asked for: no log
    bool unsure; // the program changed something, which may be gains
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

    uint8_t frame[LINK_FRAMES_MAX]; // the last whole one's payload
    unsigned frame_bytes;
    unsigned spoilt; // what stood between two 0 and was none

    // What came of the steps.
    unsigned frames;
    unsigned equal;
    unsigned different;
    unsigned gaps;
    unsigned not_compared;
    unsigned by_reason[LINK_TWIN_REASONS]; // the same, apart
    unsigned taken_over;
    unsigned keys_compared;

    bool compared; // the last step was, and it was equal
    enum link_twin_reason reason;
    unsigned stride;  // from the step before the last one to that
    unsigned strides; // so many before it were equal, and above 1
    uint32_t last;    // number of the last step that came
    struct link_twin_difference first;
};

void link_twin_init(struct link_twin *self);

// Begins a command; its tag is the next one.
void link_twin_send(struct link_twin *self, uint8_t command,
                    const uint8_t value[], unsigned bytes);

// True if the byte ends a whole frame: `frame` has its payload.
bool link_twin_receive(struct link_twin *self, uint8_t byte);

#endif
