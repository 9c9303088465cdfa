// SPDX-License-Identifier: MIT
// What a next step depends on, as bytes, in a file of its own because SDCC
// links whole object files.
#include "fixpid_pid.h"

#include "../common/fixpid_bytes.h"
#include "fixpid_pid_private.h"

// Where each number begins.
#define OUTPUT_AT 0u
#define FLAGS_AT 2u
#define INTEGRAL_AT 3u // its part of a count, and then
#define COUNTS_AT 5u
#define FRACTION_AT 7u
#define DERIVATIVE_AT 8u
#define FEEDFORWARD_AT 12u
#define PREVIOUS_AT 14u
#define ERROR_AT 16u

#define UNKNOWN_FLAGS                                                          \
    (0xFFu & ~(FIXPID_PID_AT_MAX | FIXPID_PID_AT_MIN |                         \
               FIXPID_PID_INTEGRAL_AT_LIMIT | FIXPID_PID_FIRST | HELD))
#define NO_FEEDFORWARD (HAS_FEEDFORWARD ? 0u : 0xFFFFu)

void fixpid_pid_state(FIXPID_DATA const struct fixpid_pid *self,
                      uint8_t state[])
{
    uint8_t flags;
    uint16_t previous;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(state != 0);
    flags = SELF.status;
    previous = (uint16_t)SELF.previous;
    if ((flags & FIXPID_PID_FIRST) != 0u) {
        previous = 0; // on every machine
    }
    if (REFUSED) {
        flags |= FIXPID_PID_REFUSED;
    }
    put(&state[OUTPUT_AT], (uint16_t)SELF.output);
    state[FLAGS_AT] = flags;
    put32(&state[INTEGRAL_AT], (uint32_t)SELF.integral);
    state[FRACTION_AT] = SELF.integral_fraction;
    put32(&state[DERIVATIVE_AT], (uint32_t)SELF.derivative);
    put(&state[FEEDFORWARD_AT], (uint16_t)SELF.feedforward);
    put(&state[PREVIOUS_AT], previous);
    put(&state[ERROR_AT], (uint16_t)SELF.proportional_error);
}

// True if the integral is within its limits or, while an output is held, the
// output within the output's limits. From `whole_from` on, no part of a count
// may follow `counts`: that is the upper limit of the integral, and any output
// held.
static bool integral_fits(FIXPID_DATA const struct fixpid_pid *self,
                          const uint8_t state[])
{
    const int16_t counts = (int16_t)get(&state[COUNTS_AT]);
    uint16_t part = get(&state[INTEGRAL_AT]);
    int16_t low = SELF.output_min;
    int16_t high = SELF.output_max;
    int16_t whole_from = low;

    if ((state[FLAGS_AT] & HELD) == 0u) {
        part |= state[FRACTION_AT];
        low = SELF.integral_min;
        high = SELF.integral_max;
        whole_from = high;
    }
    if (counts < low) {
        return false;
    }
    if (counts > high) {
        return false;
    }
    if (counts < whole_from) {
        return true;
    }
    return part == 0u;
}

// True if a step can continue from the state.
static bool is_possible(FIXPID_DATA const struct fixpid_pid *self,
                        const uint8_t state[])
{
    const int32_t derivative = (int32_t)get32(&state[DERIVATIVE_AT]);
    uint16_t lacking = get(&state[FEEDFORWARD_AT]);

    // One condition for both, because SDCC warns of a condition that is never
    // true when no feature is missing.
    lacking &= NO_FEEDFORWARD;
    lacking |= state[FLAGS_AT] & UNKNOWN_FLAGS;
    if (lacking != 0u) {
        return false;
    }
    if (derivative > DERIVATIVE_MAX) {
        return false;
    }
    if (derivative < -DERIVATIVE_MAX) {
        return false;
    }
    return integral_fits(self, state);
}

bool fixpid_pid_restore(FIXPID_DATA struct fixpid_pid *self,
                        const uint8_t state[])
{
    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(state != 0);
    if (REFUSED) {
        return false;
    }
    if (!is_possible(self, state)) {
        return false;
    }
    SELF.output = (int16_t)get(&state[OUTPUT_AT]);
    SELF.status = state[FLAGS_AT];
    SELF.integral = (int32_t)get32(&state[INTEGRAL_AT]);
    SELF.integral_fraction = state[FRACTION_AT];
    SELF.derivative = (int32_t)get32(&state[DERIVATIVE_AT]);
    SELF.feedforward = (int16_t)get(&state[FEEDFORWARD_AT]);
    SELF.previous = (int16_t)get(&state[PREVIOUS_AT]);
    if ((SELF.status & FIXPID_PID_FIRST) != 0u) {
        SELF.previous = NO_PREVIOUS;
    }
    SELF.proportional_error = (int16_t)get(&state[ERROR_AT]);
    return true;
}
