// SPDX-License-Identifier: MIT
#include "fixpid_slew.h"

#undef SELF
#undef VALID_SELF
#define SELF (*self)
#define VALID_SELF (self != 0)

// Offset binary: a Q16.16 plus 2^31. Values in it compare without a sign, and
// the greater minus the less is their distance, below 2^32.
#define OFFSET ((uint32_t)0x80000000u)
#define COUNT_OFFSET 0x8000u // of whole counts
#define HALF_COUNT UINT32_C(0x8000)

static uint32_t offset_q16(int16_t counts)
{
    return ((uint32_t)(uint16_t)counts << 16) ^ OFFSET;
}

// Converting an out-of-range value to int32_t is implementation-defined; all
// supported compilers keep the pattern.
static int32_t value_of(uint32_t offset)
{
    const uint32_t pattern = offset ^ OFFSET;

    return (int32_t)pattern;
}

void fixpid_slew_init(FIXPID_DATA struct fixpid_slew *self, uint32_t rise_q16,
                      uint32_t fall_q16)
{
    fixpid_slew_set_rates(self, rise_q16, fall_q16);
    fixpid_slew_reset(self);
}

void fixpid_slew_reset(FIXPID_DATA struct fixpid_slew *self)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.value = 0;
}

void fixpid_slew_set_rates(FIXPID_DATA struct fixpid_slew *self,
                           uint32_t rise_q16, uint32_t fall_q16)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.rise_q16 = rise_q16;
    SELF.fall_q16 = fall_q16;
}

void fixpid_slew_seed(FIXPID_DATA struct fixpid_slew *self, int16_t value)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.value = value_of(offset_q16(value));
}

int16_t fixpid_slew_step(FIXPID_DATA struct fixpid_slew *self, int16_t target)
{
    const uint32_t goal = offset_q16(target);
    uint32_t value;
    uint16_t counts;

    FIXPID_ASSERT(VALID_SELF);
    value = (uint32_t)SELF.value ^ OFFSET;
    // A rate is added or subtracted only if the goal is farther away than the
    // rate, so the sum stays below the goal and the difference above it.
    if (goal > value) {
        value =
            ((goal - value) > SELF.rise_q16) ? (value + SELF.rise_q16) : goal;
    } else {
        value =
            ((value - goal) > SELF.fall_q16) ? (value - SELF.fall_q16) : goal;
    }
    SELF.value = value_of(value);
    // The value is at most the largest target or seed, which is 2^32 - 2^16 in
    // offset binary.
    counts = (uint16_t)((value + HALF_COUNT) >> 16);
    counts ^= COUNT_OFFSET;
    return (int16_t)counts;
}

int32_t fixpid_slew_value(FIXPID_DATA const struct fixpid_slew *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return SELF.value;
}
