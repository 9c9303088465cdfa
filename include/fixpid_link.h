/* SPDX-License-Identifier: MIT */
#include "fixpid.h"
// fixpid_link: sends the steps of a fixpid_pid over a serial wire and receives
// a few commands. A program on a PC, called the twin, runs the same C code on
// the same inputs. So it knows P, I and D bit for bit, which are not sent.
//
// The module turns calls into bytes and bytes into calls. The application reads
// and writes its UART; nothing here waits, and the steps are the clock. In this
// loop, send(n) writes the first n bytes of link.frame if the UART takes all of
// them at once, and otherwise calls fixpid_link_lost:
//
//   while (uart_get(&byte)) {
//       (void)fixpid_link_receive(&link, byte);
//   }
//   if (uart_room() >= FIXPID_LINK_FRAME) {
//       send(fixpid_link_answer(&link, &board, &pid, &config));
//   }
//   setpoint = fixpid_link_setpoint(&link);
//   output = fixpid_pid_step(&pid, setpoint, measurement);
//   send(fixpid_link_step(&link, &pid, setpoint, measurement, output));
//
// Anyone on the wire can do what fixpid_link_allow allows, which is nothing
// after init. No command goes beyond the board's constants: a setpoint and
// output limits beyond them are refused, gains must be ones that
// fixpid_pid_set_gains accepts, and a manual output ends by itself when the
// other end falls silent. There is no password: a radio needs its own.
//
// Only firmware that calls these functions grows: fixpid_link.c has the stream,
// fixpid_link_commands.c the commands that change something, and
// fixpid_link_tracked.c a stream with fixpid_pid_track. All of them need
// fixpid_pid_state.c and fixpid_record.c.
//
// Any number of them work side by side, each with a wire. Functions of one must
// not interrupt each other; fixpid.h lists the chips on which those of two must
// not either. An interrupt that receives bytes keeps them for the loop.
//
// Framing. A frame is a payload and its CRC-16 (that of fixpid_record, low byte
// first), both encoded by COBS so that no byte is 0, and then a 0. An answer
// also begins with a 0, so that text which the program prints does not corrupt
// it. A command has two more bytes after the CRC: the sum of the payload's
// bytes, and the sum of that sum's values after each byte, both modulo 256.
// Numbers are little-endian. Payloads of the board:
//
//   step    0 flags + 8, 1..2 number modulo 16384, 3..4 measurement,
//           5..6 output, 7..8 setpoint if it is not that of the frame before
//   tracked a step's, and behind it 2 applied, 1 shift
//   key     0 1, 1 reasons, 2 tag of the last command, 3..6 number,
//           7..8 setpoint, 9..10 measurement, 11..12 output,
//           13..24 bytes 2..13 of fixpid_pid_state
//   answer  0 2, 1 tag, 2 command, 3 result: 0 done, 1 not allowed, 2 refused
//   hello   0 3, 1 tag, 2 version, 3..5 the library's version, 6 features,
//           7 allowed, 8..11 period_us, 12..13 manual_steps, 14..23 name
//   record  0 4, 1 tag, 2..24 the record of `config`
//
// The reasons are a sum: 1 the 256th frame since the last key frame, 2 a stream
// begins, 4 a command, 8 changed, 16 lost. Payloads of commands, with the tag
// after the first byte and a number of 16 bits after the tag:
//
//   0x40 hello                      the tag of the last command becomes 0
//   0x41 record
//   0x42 stream, 1 byte every       0 none; else a frame each so many steps,
//                                   from the next on, the first a key frame
//   0x43 setpoint                   needs FIXPID_LINK_SETPOINT
//   0x44 manual                     needs FIXPID_LINK_MANUAL
//   0x45 auto                       likewise
//   0x46 seed                       likewise
//   0x47 write, 23 bytes: a record  needs FIXPID_LINK_GAINS, and for other
//                                   limits FIXPID_LINK_LIMITS
//
// A command with the tag and the first byte of the last command of 0x42..0x47
// gets the same answer and is not carried out again, unless the tag is 0: a
// command without an answer may be repeated. The repetition does not prolong a
// manual output. sim/link/link_twin.h describes the other end.
#ifndef FIXPID_LINK_H
#define FIXPID_LINK_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_pid.h"

FIXPID_C_BEGIN

#define FIXPID_LINK_VERSION 1u
#define FIXPID_LINK_FRAME 30u   // bytes of the longest frame
#define FIXPID_LINK_COMMAND 30u // of the longest command, without its 0
#define FIXPID_LINK_NAME 10u

// What fixpid_link_allow takes: a sum of these.
#define FIXPID_LINK_SETPOINT 0x01u
#define FIXPID_LINK_GAINS 0x02u
#define FIXPID_LINK_LIMITS 0x04u // the output's and the integral's
#define FIXPID_LINK_MANUAL 0x08u // manual, automatic and seed

// Constants of the board.
struct fixpid_link_board {
    uint32_t period_us; // between two steps

    // The other end must repeat its manual output within this many steps, each
    // time as a new command: with another tag, or with tag 0. Otherwise the
    // controller returns to automatic. 0: manual is refused.
    uint16_t manual_steps;

    int16_t setpoint_min;
    int16_t setpoint_max;
    int16_t output_min; // the widest limits that a record may set
    int16_t output_max;
    uint8_t name[FIXPID_LINK_NAME]; // filled up with 0
};

// This is private except `frame`, and open only so that the application can
// allocate it: 79 bytes, 80 where a number of 32 bits is aligned.
struct fixpid_link {
    uint32_t steps;
    int16_t setpoint;
    int16_t last_sent_setpoint; // which the other end knows
    uint16_t manual; // steps left of the other end's manual output; 0: none
    uint8_t allowed;
    uint8_t stream_interval; // steps from frame to frame; 0: no frames
    uint8_t steps_since_frame;
    uint8_t frames_until_key_frame; // 0: 256
    uint8_t key_frame_reasons;      // 0: the next frame is no key frame
    uint8_t tag;                    // of the last command of 0x42..0x47,
    uint8_t command;                // its first byte
    uint8_t result;                 // and what was answered
    uint8_t count;                  // of `bytes`, or private
    uint8_t bytes[FIXPID_LINK_COMMAND];
    uint8_t frame[FIXPID_LINK_FRAME]; // to be sent
};

// No stream, nothing allowed, the next step is number 0. The setpoint is any
// int16_t, until a command changes it.
void fixpid_link_init(FIXPID_DATA struct fixpid_link *self, int16_t setpoint);

// Sets what commands may do from now on, in place of the earlier permission. A
// jumper, a menu or a temperature may decide it, and it may change at any time.
// A manual output that came before keeps its time.
void fixpid_link_allow(FIXPID_DATA struct fixpid_link *self, uint8_t allowed);

// Call it after the program itself has changed the controller other than by a
// step: by new gains or limits, a feed-forward, a reset, or a track without
// fixpid_link_step_tracked. The next frame is a key frame. If gains or limits
// changed, change `config` as well. A manual output of the other end stays in
// force and ends after its time.
void fixpid_link_changed(FIXPID_DATA struct fixpid_link *self);

// The same after the program itself has taken manual control, at a switch or
// for an alarm: call it after the program's own fixpid_pid_set_manual, set_auto
// or seed. The time of the other end's manual output ends here, so that it
// cannot make the controller automatic later. A new manual command takes
// control back: to prevent that, first allow none. Firmware that only streams
// calls fixpid_link_changed.
void fixpid_link_taken(FIXPID_DATA struct fixpid_link *self);

// Call it if a frame was not sent because the UART had no room. The next frame
// is a key frame.
void fixpid_link_lost(FIXPID_DATA struct fixpid_link *self);

// Takes a byte from the wire. True if it ends a whole command, which then
// waits: until it is answered, further bytes are ignored and steps have no
// frame. Bytes up to a 0 that are not a whole command change nothing.
bool fixpid_link_receive(FIXPID_DATA struct fixpid_link *self, uint8_t byte);

// Carries out the waiting command, completely or not at all, and returns how
// many bytes of `frame` are the answer; 0 if no command waits. Call it between
// two steps.
//
// `config` is what the controller runs with: what init was given, with the
// program's changes since. A written record changes it. A command without
// permission is not allowed. A command with permission is refused, and changes
// nothing, for
//   setpoint  a value outside setpoint_min..setpoint_max
//   manual    manual_steps of 0, or firmware without FIXPID_PID_HAS_MANUAL; the
//             same holds for auto and seed
//   write     bytes that are no record; other options or another setpoint
//             weight than config's, which need an init; output limits beyond
//             the board's, or with the lower not below the upper; limits other
//             than config's without permission (not allowed); gains or limits
//             of the integral that fixpid_pid's setters refuse
uint8_t fixpid_link_answer(FIXPID_DATA struct fixpid_link *self,
                           const struct fixpid_link_board *board,
                           FIXPID_DATA struct fixpid_pid *pid_self,
                           struct fixpid_pid_config *config);

// The same for firmware that only streams: hello, record and stream are carried
// out, and all other commands are not allowed. Call one of the two functions;
// firmware that calls this one does not need fixpid_link_commands.c.
uint8_t fixpid_link_answer_stream(FIXPID_DATA struct fixpid_link *self,
                                  const struct fixpid_link_board *board,
                                  const struct fixpid_pid_config *config);

// The setpoint of init or of the last command. The program may step with
// another one, such as a ramp's or its own.
int16_t fixpid_link_setpoint(FIXPID_DATA const struct fixpid_link *self);

// Call it after each step, with the step's inputs and output. Returns how many
// bytes of `frame` to send; 0 without a stream, in steps between those that
// have a frame, and while a command waits. It also returns the controller to
// automatic manual_steps steps after the other end's last manual output, unless
// fixpid_link_taken was called since.
uint8_t fixpid_link_step(FIXPID_DATA struct fixpid_link *self,
                         FIXPID_DATA struct fixpid_pid *pid_self,
                         int16_t setpoint, int16_t measurement, int16_t output);

// The same after fixpid_pid_track(pid, applied, shift), for a program that
// tracks after each step: with a slew rate behind the controller, or a cascade.
// `output` is what the step returned. A frame is three bytes longer. The other
// end tracks in the same way, so that no key frame is needed; a key frame has
// the state after the tracking.
uint8_t fixpid_link_step_tracked(FIXPID_DATA struct fixpid_link *self,
                                 FIXPID_DATA struct fixpid_pid *pid_self,
                                 int16_t setpoint, int16_t measurement,
                                 int16_t output, int16_t applied,
                                 uint8_t shift);

// Object mode, for firmware with one link: compile the application and
// fixpid_link*.c with -DFIXPID_LINK_OBJECT=name, and define that object at file
// scope, not static. Calls stay as they are; the pointer is ignored.
// FIXPID_LINK_PLACE may put it at an address. Sources that disagree about the
// object or its place do not link.
#ifdef FIXPID_LINK_OBJECT
extern FIXPID_DATA struct fixpid_link FIXPID_LINK_PLACE FIXPID_LINK_OBJECT;
#endif

FIXPID_C_END

#endif
