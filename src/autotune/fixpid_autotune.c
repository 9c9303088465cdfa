// SPDX-License-Identifier: MIT
#include "fixpid_autotune.h"

#include "../common/fixpid_bits.h"
#include "fixpid_autotune_private.h"

#define SWING_MIN 8u
#define SWING_MAX 16383u
#define TIMEOUT_MIN 2u
#define TIMEOUT_MAX 32767u
#define AVERAGED_MAX 4u

#define NOISE_FILLED 2u // deviations before the first second difference
#define NOISE_STEPS 34u
#define NOISE_MAX 1023u
#define STEPS_MAX 32767u
#define WHOLE_CYCLE 2u // `seen` when the last cycle had both halves
#define TURN_MAX 2047  // 8 cycles of two turns are within 32752

static bool between(uint16_t value, uint16_t least, uint16_t most)
{
    if (value < least) {
        return false;
    }
    return value <= most;
}

static bool ranges_legal(const struct fixpid_autotune_config *config)
{
    if (config->output_min >= config->output_max) {
        return false;
    }
    if (config->measurement_min >= config->measurement_max) {
        return false;
    }
    if (config->output_rest < config->output_min) {
        return false;
    }
    return config->output_rest <= config->output_max;
}

bool fixpid_autotune_legal(const struct fixpid_autotune_config *config)
{
    if (!ranges_legal(config)) {
        return false;
    }
    if (config->swing != 0u) {
        if (!between(config->swing, SWING_MIN, SWING_MAX)) {
            return false;
        }
    }
    if (!between(config->timeout_steps, TIMEOUT_MIN, TIMEOUT_MAX)) {
        return false;
    }
    return between(config->cycles, 1u, AVERAGED_MAX);
}

bool fixpid_autotune_init(FIXPID_DATA struct fixpid_autotune *self,
                          const struct fixpid_autotune_config *config)
{
    bool accepted;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(config != 0);
    accepted = fixpid_autotune_legal(config);
    // SDCC's pic16 port cannot assign a structure.
    SELF.config.output_min = config->output_min;
    SELF.config.output_max = config->output_max;
    SELF.config.output_rest = config->output_rest;
    SELF.config.measurement_min = config->measurement_min;
    SELF.config.measurement_max = config->measurement_max;
    SELF.config.swing = config->swing;
    SELF.config.timeout_steps = config->timeout_steps;
    SELF.config.cycles = config->cycles;
    SELF.config.reverse = config->reverse ? 1u : 0u;
    if (!accepted) {
        SELF.config.cycles = 0;
        SELF.config.output_min = 0;
        SELF.config.output_max = 0;
    }
    fixpid_autotune_reset(self);
    return accepted;
}

void fixpid_autotune_reset(FIXPID_DATA struct fixpid_autotune *self)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.state = FIXPID_AUTOTUNE_REFUSED;
    if (SELF.config.cycles != 0u) {
        SELF.state = PHASE_NOISE;
    }
    fixpid_autotune_clear(&SELF.sums[0]);
    fixpid_autotune_clear(&SELF.sums[1]);
    SELF.output = SELF.config.output_rest;
    SELF.centre = 0;
    SELF.half = 0;
    SELF.elapsed = 0;
    SELF.period = 0;
    SELF.last_period = 0;
    SELF.edge = 0;
    SELF.first_on = 0;
    SELF.first_steps = 0;
    SELF.noise = 0;
    SELF.highest = 0;
    SELF.lowest = 0;
    SELF.side = AT_LOW;
    SELF.seen = 0;
    SELF.averaged = FRESH;
}

uint8_t fixpid_autotune_status(FIXPID_DATA const struct fixpid_autotune *self)
{
    FIXPID_ASSERT(VALID_SELF);
    return (SELF.state >= PHASE_NOISE) ? (uint8_t)FIXPID_AUTOTUNE_RUNNING
                                       : SELF.state;
}

static void measure_noise(FIXPID_DATA struct fixpid_autotune *self,
                          int16_t deviation)
{
    const int32_t bend =
        (int32_t)SELF.lowest - SELF.highest - SELF.highest + deviation;
    uint32_t noise = (uint32_t)((bend < 0) ? -bend : bend);

    if (noise > NOISE_MAX) {
        noise = NOISE_MAX;
    }
    SELF.lowest = SELF.highest;
    SELF.highest = deviation;
    SELF.elapsed++;
    if (SELF.elapsed > NOISE_FILLED) {
        SELF.noise = (uint16_t)(SELF.noise + noise);
    }
    if (SELF.elapsed == NOISE_STEPS) {
        SELF.side = (deviation <= 0) ? AT_HIGH : AT_LOW;
        SELF.elapsed = 0;
        SELF.lowest = deviation;
        fixpid_autotune_start_relay(self);
    }
}

// A deviation counts for the side whose output led to it. The one after a
// switch is free of the noise that made the relay switch.
static void add_deviation(FIXPID_DATA struct fixpid_autotune *self,
                          int16_t deviation)
{
    FIXPID_DATA struct fixpid_autotune_sums *const sums =
        fixpid_autotune_sums_of_phase(self);

    sums->all = fixpid_add32(sums->all, deviation); // within 32767^2
    sums->steps++;
    if (SELF.side == AT_HIGH) {
        sums->on = fixpid_add32(sums->on, deviation);
        sums->on_steps++;
    }
    if (SELF.elapsed == 1u) {
        int16_t turn = deviation;

        if (turn > TURN_MAX) {
            turn = TURN_MAX;
        }
        if (turn < -TURN_MAX) {
            turn = -TURN_MAX;
        }
        if (SELF.side == AT_HIGH) {
            turn = (int16_t)-turn;
        }
        // 32752 at most in a relay that measures; before, nobody needs it
        sums->rise = (int16_t)fixpid_add32(sums->rise, turn);
    }
    if (sums->steps == STEPS_MAX) {
        fixpid_autotune_finish(self, FIXPID_AUTOTUNE_TOO_SLOW);
    }
}

static void turn_relay(FIXPID_DATA struct fixpid_autotune *self,
                       int16_t deviation)
{
    if (SELF.side == AT_HIGH) {
        if (deviation > (int16_t)SELF.edge) {
            SELF.side = AT_LOW;
            SELF.elapsed = 0;
            fixpid_autotune_drive(self);
        }
    } else {
        if (deviation < (int16_t)fixpid_negated(SELF.edge)) {
            SELF.side = AT_HIGH;
            fixpid_autotune_end_cycle(self, deviation);
        }
    }
    SELF.elapsed++;
}

// As long as a cycle was. The first one may have lacked a half.
static uint16_t longest_cycle(FIXPID_DATA const struct fixpid_autotune *self)
{
    if (SELF.seen < WHOLE_CYCLE) {
        return (uint16_t)(SELF.config.timeout_steps >> 4);
    }
    return SELF.last_period;
}

static void step_relay(FIXPID_DATA struct fixpid_autotune *self,
                       int16_t deviation)
{
    if (deviation > SELF.highest) {
        SELF.highest = deviation;
    }
    if (deviation < SELF.lowest) {
        SELF.lowest = deviation;
    }
    if (SELF.elapsed != 0u) {
        SELF.period++;
        if (SELF.averaged != FRESH) {
            add_deviation(self, deviation);
        }
    }
    if (SELF.state >= PHASE_NOISE) {
        turn_relay(self, deviation);
    }
    if (SELF.state >= PHASE_CENTRE) {
        if ((SELF.elapsed >> 2) > longest_cycle(self)) {
            fixpid_autotune_lose_cycle(self);
        }
    }
}

// The status with which this measurement ends the experiment, or RUNNING. A
// measurement at its limit comes before a relay that does not switch.
static uint8_t watch_ends(FIXPID_DATA const struct fixpid_autotune *self,
                          int16_t measurement)
{
    if (measurement <= SELF.config.measurement_min) {
        return FIXPID_AUTOTUNE_SATURATED;
    }
    if (measurement >= SELF.config.measurement_max) {
        return FIXPID_AUTOTUNE_SATURATED;
    }
    if (SELF.elapsed >= SELF.config.timeout_steps) {
        return FIXPID_AUTOTUNE_NO_OSCILLATION;
    }
    return FIXPID_AUTOTUNE_RUNNING;
}

// measurement - setpoint, within 32767
static int16_t deviation_from(int16_t setpoint, int16_t measurement)
{
    const uint16_t from = (uint16_t)setpoint;
    const uint16_t to = (uint16_t)measurement;
    const uint16_t difference = (uint16_t)(to - from);

    // it has the wrong sign
    if ((((to ^ from) & (to ^ difference)) & FIXPID_SIGN_BIT) != 0u) {
        return (measurement < 0) ? -INT16_MAX : INT16_MAX;
    }
    if (difference == FIXPID_SIGN_BIT) {
        return -INT16_MAX;
    }
    return (int16_t)difference;
}

// Within the range as it stands, also if a bit of the output was flipped.
static int16_t limited_output(FIXPID_DATA const struct fixpid_autotune *self)
{
    if (SELF.output > SELF.config.output_max) {
        return SELF.config.output_max;
    }
    if (SELF.output < SELF.config.output_min) {
        return SELF.config.output_min;
    }
    return SELF.output;
}

int16_t fixpid_autotune_step(FIXPID_DATA struct fixpid_autotune *self,
                             int16_t setpoint, int16_t measurement)
{
    FIXPID_ASSERT(VALID_SELF);
    if (SELF.state >= PHASE_NOISE) {
        const uint8_t status = watch_ends(self, measurement);

        if (status != (uint8_t)FIXPID_AUTOTUNE_RUNNING) {
            fixpid_autotune_finish(self, status);
        } else {
            int16_t deviation = deviation_from(setpoint, measurement);

            if (SELF.config.reverse != 0u) {
                deviation = (int16_t)-deviation;
            }
            if (SELF.state == PHASE_NOISE) {
                measure_noise(self, deviation);
            } else {
                step_relay(self, deviation);
            }
        }
    }
    return limited_output(self);
}
