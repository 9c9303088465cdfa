// SPDX-License-Identifier: MIT
// The commands that change the controller or its setpoint, in a file of their
// own because SDCC links whole object files.
#include "fixpid_link.h"

#undef FIXPID_BYTES_DATA
#define FIXPID_BYTES_DATA FIXPID_DATA
#include "../common/fixpid_get.h"
#include "fixpid_link_private.h"
#include "fixpid_record.h"

// Parts of a record.
#define LIMITS_AT 10u
#define LIMITS_BYTES 8u
#define KIND_AT 18u // setpoint weight and options
#define KIND_BYTES 3u

// True if some bytes of the received record are those of config's record.
// pre: config's is at RECORD_AT of `frame`
static bool same(FIXPID_DATA const struct fixpid_link *self, uint8_t from,
                 uint8_t bytes)
{
    uint8_t at = from;

    while (at < (uint8_t)(from + bytes)) {
        if (SELF.frame[at + RECORD_AT] != SELF.bytes[at + VALUE_AT]) {
            return false;
        }
        at++;
    }
    return true;
}

// True if the output's limits are a range within the board's.
static bool is_within(const struct fixpid_pid_config *wanted,
                      const struct fixpid_link_board *board)
{
    if (wanted->output_min < board->output_min) {
        return false;
    }
    if (wanted->output_max > board->output_max) {
        return false;
    }
    return wanted->output_min < wanted->output_max;
}

// Sets all gains and limits, or none.
// pre: the output's limits are a range
static bool set_all(FIXPID_DATA struct fixpid_pid *pid_self,
                    const struct fixpid_pid_config *wanted,
                    const struct fixpid_pid_config *now)
{
    if (!fixpid_pid_set_gains(pid_self, &wanted->gains)) {
        return false;
    }
    if (!fixpid_pid_set_integral_limits(pid_self, wanted->integral_min,
                                        wanted->integral_max)) {
        (void)fixpid_pid_set_gains(pid_self, &now->gains);
        return false;
    }
    (void)fixpid_pid_set_limits(pid_self, wanted->output_min,
                                wanted->output_max);
    return true;
}

static uint8_t write_record(FIXPID_DATA struct fixpid_link *self,
                            const struct fixpid_link_board *board,
                            FIXPID_DATA struct fixpid_pid *pid_self,
                            struct fixpid_pid_config *config)
{
    const struct fixpid_record *const record =
        // Deviation 11.3: a record is its bytes.
        (const struct fixpid_record *)&SELF.bytes[VALUE_AT];
    struct fixpid_pid_config wanted;

    if (!fixpid_record_unpack(record, &wanted)) {
        return NOT_ACCEPTED;
    }
    // Deviation 11.3: likewise.
    fixpid_record_pack((struct fixpid_record *)&SELF.frame[RECORD_AT], config);
    if (!same(self, KIND_AT, KIND_BYTES)) {
        return NOT_ACCEPTED;
    }
    if (!is_within(&wanted, board)) {
        return NOT_ACCEPTED;
    }
    if ((SELF.allowed & FIXPID_LINK_LIMITS) == 0u) {
        if (!same(self, LIMITS_AT, LIMITS_BYTES)) {
            return NOT_ALLOWED;
        }
    }
    if (!set_all(pid_self, &wanted, config)) {
        return NOT_ACCEPTED;
    }
    (void)fixpid_record_unpack(record, config); // SDCC cannot assign it
    return DONE;
}

static uint8_t set_setpoint(FIXPID_DATA struct fixpid_link *self,
                            const struct fixpid_link_board *board)
{
    const int16_t value = (int16_t)get(&SELF.bytes[VALUE_AT]);

    if (value < board->setpoint_min) {
        return NOT_ACCEPTED;
    }
    if (value > board->setpoint_max) {
        return NOT_ACCEPTED;
    }
    SELF.setpoint = value;
    return DONE;
}

#if (FIXPID_PID_FEATURES & FIXPID_PID_HAS_MANUAL) != 0
static uint8_t set_hand(FIXPID_DATA struct fixpid_link *self,
                        const struct fixpid_link_board *board,
                        FIXPID_DATA struct fixpid_pid *pid_self)
{
    const int16_t value = (int16_t)get(&SELF.bytes[VALUE_AT]);

    if (SELF.command == SET_SEED) {
        fixpid_pid_seed(pid_self, value);
        return DONE;
    }
    if (SELF.command == SET_AUTO) {
        SELF.manual = 0;
        fixpid_pid_set_auto(pid_self);
        return DONE;
    }
    if (board->manual_steps == 0u) {
        return NOT_ACCEPTED;
    }
    SELF.manual = board->manual_steps;
    fixpid_pid_set_manual(pid_self, value);
    return DONE;
}
#else
FIXPID_INLINE uint8_t set_hand(FIXPID_DATA struct fixpid_link *self,
                               const struct fixpid_link_board *board,
                               FIXPID_DATA struct fixpid_pid *pid_self)
{
    (void)self;
    (void)board;
    (void)pid_self;
    return NOT_ACCEPTED;
}
#endif

// The permission that a command needs.
static uint8_t permission_for(uint8_t command)
{
    if (command == WRITE_RECORD) {
        return FIXPID_LINK_GAINS;
    }
    return (command == SET_SETPOINT) ? FIXPID_LINK_SETPOINT
                                     : FIXPID_LINK_MANUAL;
}

static uint8_t carry_out(FIXPID_DATA struct fixpid_link *self,
                         const struct fixpid_link_board *board,
                         FIXPID_DATA struct fixpid_pid *pid_self,
                         struct fixpid_pid_config *config)
{
    const uint8_t command = SELF.command;

    if ((SELF.allowed & permission_for(command)) == 0u) {
        return NOT_ALLOWED;
    }
    SELF.key_frame_reasons |= COMMANDED;
    if (command == WRITE_RECORD) {
        return write_record(self, board, pid_self, config);
    }
    if (command == SET_SETPOINT) {
        return set_setpoint(self, board);
    }
    return set_hand(self, board, pid_self);
}

void fixpid_link_taken(FIXPID_DATA struct fixpid_link *self)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.manual = 0;
    SELF.key_frame_reasons |= CHANGED;
}

uint8_t fixpid_link_answer(FIXPID_DATA struct fixpid_link *self,
                           const struct fixpid_link_board *board,
                           FIXPID_DATA struct fixpid_pid *pid_self,
                           struct fixpid_pid_config *config)
{
    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(FIXPID_PID_VALID_PID);
    if (SELF.count == WAITS) {
        if (SELF.bytes[COMMAND_AT] > SET_STREAM) {
            if (fixpid_link_is_new(self)) {
                SELF.result = carry_out(self, board, pid_self, config);
            }
            return fixpid_link_reply(self);
        }
    }
    return fixpid_link_answer_stream(self, board, config);
}
