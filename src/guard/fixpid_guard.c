// SPDX-License-Identifier: MIT
#include "fixpid_guard.h"

#include "../common/fixpid_difference.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_GUARD_SELF
#define VALID_SELF FIXPID_GUARD_VALID_SELF

#define BAND_MAX 32767u
#define PATIENCE_MIN 2u
#define PATIENCE_MAX 32767u
#define STRIKES 4u
#define SWINGS 12u
#define NEGATIVE 0x8000u
#define MINUS_1 0xFFFFu

// The bits of `state`. A zone is where the reading is. An end of the output has
// the name of the zone that it pushes the reading out of.
#define INSIDE 0x00u
#define BELOW 0x01u
#define ABOVE 0x02u
#define ZONE 0x03u
#define LAST 0x0Cu     // the last zone outside, since the loop was settled
#define LAST_END 0x30u // the last end of the output, inside the band
#define NOISY 0x40u
#define REVERSED 0x80u

static uint16_t counts_apart(int16_t a, int16_t b)
{
    return (a < b) ? fixpid_difference(b, a) : fixpid_difference(a, b);
}

static void take_ranges(FIXPID_DATA struct fixpid_guard *self,
                        const struct fixpid_guard_config *config)
{
    SELF.output_min = config->output_min;
    SELF.output_max = config->output_max;
    SELF.measurement_min = config->measurement_min;
    SELF.measurement_max = config->measurement_max;
    if ((config->measurement_min | config->measurement_max) == 0) {
        SELF.measurement_min = INT16_MIN;
        SELF.measurement_max = INT16_MAX;
    }
    SELF.reach_min = config->reach_min;
    SELF.reach_max = config->reach_max;
    if ((config->reach_min | config->reach_max) == 0) {
        SELF.reach_min = SELF.measurement_min;
        SELF.reach_max = SELF.measurement_max;
    }
}

// True if the readings, reach and band that were taken are legal. A reach of
// more than two bands is not empty.
static bool reach_legal(FIXPID_DATA const struct fixpid_guard *self)
{
    if (SELF.reach_min < SELF.measurement_min) {
        return false;
    }
    if (SELF.reach_max > SELF.measurement_max) {
        return false;
    }
    if (SELF.reach_min > SELF.reach_max) {
        return false;
    }
    if (SELF.band < 1u) {
        return false;
    }
    if (SELF.band > BAND_MAX) {
        return false;
    }
    return fixpid_difference(SELF.reach_max, SELF.reach_min) >
           (uint16_t)(SELF.band << 1);
}

static bool legal(FIXPID_DATA const struct fixpid_guard *self)
{
    if (SELF.output_min >= SELF.output_max) {
        return false;
    }
    if (SELF.patience < PATIENCE_MIN) {
        return false;
    }
    if (SELF.patience > PATIENCE_MAX) {
        return false;
    }
    return reach_legal(self);
}

bool fixpid_guard_init(FIXPID_DATA struct fixpid_guard *self,
                       const struct fixpid_guard_config *config)
{
    uint8_t state = 0;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(config != 0);
    take_ranges(self, config);
    SELF.band = config->band;
    SELF.patience = config->patience;
    if (config->reverse) {
        state = REVERSED;
    }
    if (config->noisy) {
        state |= NOISY;
    }
    SELF.state = state;
    fixpid_guard_reset(self);
    if (!legal(self)) {
        SELF.patience = 0;
        return false;
    }
    return true;
}

void fixpid_guard_reset(FIXPID_DATA struct fixpid_guard *self)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.flags = 0;
    fixpid_guard_acknowledge(self);
    SELF.last = 0;
    SELF.hold = 0;
    SELF.mark = 0;
    SELF.anchor = 0;
    SELF.state &= REVERSED | NOISY;
}

void fixpid_guard_acknowledge(FIXPID_DATA struct fixpid_guard *self)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.flags &= FIXPID_GUARD_SETTLED;
    SELF.count = 0;
    SELF.run = 0;
    SELF.swings = 0;
    SELF.strikes = 0;
}

uint8_t fixpid_guard_flags(FIXPID_DATA const struct fixpid_guard *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return (SELF.patience == 0u) ? FIXPID_GUARD_REFUSED : SELF.flags;
}

// pre: the reading is beyond reach
static void watch_range(FIXPID_DATA struct fixpid_guard *self, int16_t reading)
{
    uint8_t alarm = FIXPID_GUARD_SENSOR_LOW;

    if (reading >= SELF.measurement_min) {
        if (reading <= SELF.measurement_max) {
            SELF.strikes = 0;
            return;
        }
        alarm = FIXPID_GUARD_SENSOR_HIGH;
    }
    SELF.strikes = (uint8_t)(SELF.strikes + 1u);
    if (SELF.strikes == STRIKES) {
        SELF.strikes = 0;
        SELF.flags |= alarm;
    }
}

// True if a reading that has been equal for `patience` steps counts one more
// step toward an alarm.
static bool should_have_moved(FIXPID_DATA const struct fixpid_guard *self,
                              int16_t output)
{
    uint16_t quarter;

    if ((SELF.state & NOISY) != 0u) {
        return true;
    }
    quarter =
        (uint16_t)(fixpid_difference(SELF.output_max, SELF.output_min) >> 2);
    return counts_apart(output, SELF.hold) > quarter;
}

// pre: the reading is the last one, and within reach
static void watch_equal(FIXPID_DATA struct fixpid_guard *self, int16_t output)
{
    uint16_t run = SELF.run;

    if (run >= SELF.patience) {
        if (!should_have_moved(self, output)) {
            return;
        }
    }
    run = (uint16_t)(run + 1u);
    if (run == SELF.patience) {
        SELF.hold = output;
    }
    if (run == (uint16_t)(SELF.patience << 1)) {
        run = 0;
        SELF.flags |= FIXPID_GUARD_FROZEN;
    }
    SELF.run = run;
}

static bool is_within_reach(FIXPID_DATA const struct fixpid_guard *self,
                            int16_t reading)
{
    if (reading < SELF.reach_min) {
        return false;
    }
    return reading <= SELF.reach_max;
}

// A working sensor can also give each reading within reach.
static void watch_reading(FIXPID_DATA struct fixpid_guard *self,
                          int16_t reading, int16_t output)
{
    if (is_within_reach(self, reading)) {
        SELF.strikes = 0;
        if (reading == SELF.last) {
            watch_equal(self, output);
            return;
        }
    } else {
        watch_range(self, reading);
    }
    SELF.last = reading;
    SELF.run = 0;
}

static uint8_t end_of(FIXPID_DATA const struct fixpid_guard *self,
                      int16_t output)
{
    uint8_t end = BELOW;

    if (output < SELF.output_max) {
        if (output > SELF.output_min) {
            return INSIDE;
        }
        end = ABOVE;
    }
    if ((SELF.state & REVERSED) != 0u) {
        end ^= ZONE;
    }
    return end;
}

static int16_t goal_of(FIXPID_DATA const struct fixpid_guard *self,
                       int16_t setpoint)
{
    if (setpoint < SELF.reach_min) {
        return SELF.reach_min;
    }
    if (setpoint > SELF.reach_max) {
        return SELF.reach_max;
    }
    return setpoint;
}

static uint8_t zone_of(FIXPID_DATA const struct fixpid_guard *self,
                       int16_t goal, int16_t reading)
{
    uint16_t band = SELF.band;

    if ((SELF.state & ZONE) != INSIDE) {
        band >>= 1;
    }
    if (counts_apart(reading, goal) <= band) {
        return INSIDE;
    }
    return (reading < goal) ? BELOW : ABOVE;
}

static void watch_swing(FIXPID_DATA struct fixpid_guard *self, int16_t setpoint,
                        uint8_t last, uint8_t now)
{
    if (counts_apart(setpoint, SELF.anchor) > SELF.band) {
        SELF.anchor = setpoint;
        SELF.swings = 0;
    } else if ((last ^ now) == LAST) { // from one side to the other
        SELF.swings = (uint8_t)(SELF.swings + 1u);
        if (SELF.swings == SWINGS) {
            SELF.swings = 0;
            SELF.flags |= FIXPID_GUARD_OSCILLATING;
        }
    } else {
        // It is on the side on which it was, or was settled.
    }
}

static void enter(FIXPID_DATA struct fixpid_guard *self, uint8_t zone,
                  int16_t setpoint, int16_t reading)
{
    const uint8_t last = SELF.state & LAST;
    const uint8_t now = (uint8_t)(zone << 2);

    SELF.mark = reading;
    SELF.count = 0;
    SELF.state = (uint8_t)((SELF.state & (uint8_t)~ZONE) | zone);
    if (zone != INSIDE) {
        SELF.flags &= (uint8_t)~FIXPID_GUARD_SETTLED;
        watch_swing(self, setpoint, last, now);
        SELF.state = (uint8_t)((SELF.state & (uint8_t)~LAST) | now);
    }
}

static void raise_alarm(FIXPID_DATA struct fixpid_guard *self, uint8_t end)
{
    SELF.count = 0;
    if (end == BELOW) {
        SELF.flags |= FIXPID_GUARD_NOT_RISING;
    } else {
        SELF.flags |= FIXPID_GUARD_NOT_FALLING;
    }
}

static void watch_outside(FIXPID_DATA struct fixpid_guard *self, uint8_t zone,
                          int16_t reading, uint8_t end)
{
    // The reading is nearer than the mark by upper - lower.
    int16_t upper = reading;
    int16_t lower = SELF.mark;

    if (zone != BELOW) {
        upper = lower;
        lower = reading;
    }
    if (upper < lower) {
        SELF.mark = reading;
    } else if (fixpid_difference(upper, lower) >= SELF.band) {
        SELF.mark = reading;
        SELF.count = 0;
        return;
    } else {
        // That is no progress yet.
    }
    if (end == zone) {
        SELF.count = (uint16_t)(SELF.count + 1u);
        if (SELF.count == SELF.patience) {
            raise_alarm(self, end);
        }
    }
}

// At an end, inside: steps count downward from 0, and watch_rest upward again.
static void watch_end(FIXPID_DATA struct fixpid_guard *self, uint8_t end)
{
    const uint8_t state =
        (uint8_t)((SELF.state & (uint8_t)~LAST_END) | (uint8_t)(end << 4));
    uint16_t count = SELF.count;

    if ((count & NEGATIVE) == 0u) {
        count = 0;
    }
    if (SELF.state != state) {
        SELF.state = state;
        count = 0;
    }
    count = (uint16_t)(count + MINUS_1);
    SELF.count = count;
    if ((uint16_t)(count + SELF.patience) == 0u) {
        raise_alarm(self, end);
    }
}

static void watch_rest(FIXPID_DATA struct fixpid_guard *self)
{
    SELF.count = (uint16_t)(SELF.count + 1u);
    if (SELF.count == SELF.patience) {
        SELF.count = 0;
        SELF.swings = 0;
        SELF.state &= (uint8_t)~LAST;
        SELF.flags |= FIXPID_GUARD_SETTLED;
    }
}

static void watch_zone(FIXPID_DATA struct fixpid_guard *self, uint8_t zone,
                       int16_t reading, uint8_t end)
{
    if (zone != INSIDE) {
        watch_outside(self, zone, reading, end);
    } else if (end != INSIDE) {
        watch_end(self, end);
    } else {
        watch_rest(self);
    }
}

// True if the output may stay at an end inside the band: the setpoint is beyond
// reach, or the reading is the setpoint.
static bool may_rest(int16_t setpoint, int16_t goal, int16_t reading)
{
    if (goal != setpoint) {
        return true;
    }
    return goal == reading;
}

uint8_t fixpid_guard_step(FIXPID_DATA struct fixpid_guard *self,
                          int16_t setpoint, int16_t measurement, int16_t output)
{
    int16_t goal;
    uint8_t zone;
    uint8_t end;

    FIXPID_ASSERT(VALID_SELF);
    if (SELF.patience == 0u) {
        return FIXPID_GUARD_REFUSED;
    }
    watch_reading(self, measurement, output);
    end = end_of(self, output);
    goal = goal_of(self, setpoint);
    zone = zone_of(self, goal, measurement);
    if (zone == INSIDE) {
        if (may_rest(setpoint, goal, measurement)) {
            end = INSIDE;
        }
    }
    if (zone != (SELF.state & ZONE)) {
        enter(self, zone, setpoint, measurement);
    }
    watch_zone(self, zone, measurement, end);
    return SELF.flags;
}
