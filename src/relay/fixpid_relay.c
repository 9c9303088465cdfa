// SPDX-License-Identifier: MIT
#include "fixpid_relay.h"

#undef OBJECT
#ifdef FIXPID_RELAY_OBJECT
#define OBJECT FIXPID_RELAY_OBJECT
#endif
#include "../common/fixpid_self.h"

#define RUNNING ((uint8_t)FIXPID_RELAY_RUNNING)
#define DONE ((uint8_t)FIXPID_RELAY_DONE)
#define LAST_RULE ((uint8_t)FIXPID_RELAY_TYREUS_LUYBEN_PID)

#define SIDE_UNKNOWN 0u // before the first step
#define SIDE_HIGH 1u
#define SIDE_LOW 2u

#define HYSTERESIS_MAX 8191u
#define TIMEOUT_MIN 2u
#define TIMEOUT_MAX 32767u
#define CYCLES_MAX 8u
#define CYCLES_SEEN_MAX 24u
#define PERIOD_MIN 6u
#define PERIOD_MAX UINT32_C(65532) // two halves, each below the timeout
#define PID_PERIOD_MIN 20u

#define FOUR_OVER_PI_Q8 UINT32_C(326)
#define ULTIMATE_GAIN_MAX UINT32_C(0x7FFFFF)
#define KI_MIN 8u
#define RATE_TIME_MAX UINT32_C(0x1FFFF)

struct rule {
    uint8_t kp_q8;    // of the ultimate gain
    uint8_t reset_q8; // Tu / Ti
    uint8_t rate_q8;  // Td / Tu
};

static bool within(uint16_t value, uint16_t least, uint16_t most)
{
    if (value < least) {
        return false;
    }
    return value <= most;
}

static bool relay_legal(const struct fixpid_relay_config *config)
{
    if (config->output_min >= config->output_max) {
        return false;
    }
    if (config->measurement_min >= config->measurement_max) {
        return false;
    }
    if (!within(config->hysteresis, 1u, HYSTERESIS_MAX)) {
        return false;
    }
    if (!within(config->timeout_steps, TIMEOUT_MIN, TIMEOUT_MAX)) {
        return false;
    }
    if (!within(config->cycles, 1u, CYCLES_MAX)) {
        return false;
    }
    return (config->options & (uint8_t)~FIXPID_RELAY_REVERSE) == 0u;
}

bool fixpid_relay_init(FIXPID_DATA struct fixpid_relay *self,
                       const struct fixpid_relay_config *config)
{
    bool accepted;

    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(config != 0);
    // SDCC's pic16 port cannot assign a structure.
    SELF.config.output_min = config->output_min;
    SELF.config.output_max = config->output_max;
    SELF.config.output_rest = config->output_rest;
    SELF.config.measurement_min = config->measurement_min;
    SELF.config.measurement_max = config->measurement_max;
    SELF.config.hysteresis = config->hysteresis;
    SELF.config.timeout_steps = config->timeout_steps;
    SELF.config.cycles = config->cycles;
    SELF.config.options = config->options;
    accepted = relay_legal(config);
    if (!accepted) {
        SELF.config.cycles = 0;
        SELF.config.output_rest = 0;
    }
    fixpid_relay_reset(self);
    return accepted;
}

void fixpid_relay_reset(FIXPID_DATA struct fixpid_relay *self)
{
    FIXPID_ASSERT(VALID(self));
    SELF.status = FIXPID_RELAY_REFUSED;
    if (SELF.config.cycles != 0u) {
        SELF.status = FIXPID_RELAY_RUNNING;
    }
    SELF.side = SIDE_UNKNOWN;
    SELF.elapsed = 0;
    SELF.high_steps = 0;
    SELF.highest = 0;
    SELF.lowest = 0;
    SELF.highest_at = 0;
    SELF.lowest_at = 0;
    SELF.error_sum = 0;
    SELF.period_sum = 0;
    SELF.swing_sum = 0;
    SELF.last_period = 0;
    SELF.last_swing = 0;
    SELF.seen = 0;
    SELF.averaged = 0;
}

static bool alike(uint16_t now, uint16_t before)
{
    uint16_t difference = (uint16_t)(now - before);

    if (now < before) {
        difference = (uint16_t)(before - now);
    }
    return difference <= (now / 4u) + 2u;
}

// A cycle is a half at high and the half at low that ends now. Cycles that are
// not alike start the average again.
static void add_cycle(FIXPID_DATA struct fixpid_relay *self)
{
    // Each half is shorter than the timeout: at most 2 * 32766
    const uint16_t period = (uint16_t)(SELF.high_steps + SELF.elapsed);
    const uint16_t swing =
        (uint16_t)((uint16_t)SELF.highest - (uint16_t)SELF.lowest);

    SELF.seen++;
    if (SELF.seen == 1u) {
        return; // it began where the plant happened to be
    }
    if (!alike(period, SELF.last_period)) {
        SELF.averaged = 0;
    }
    if (!alike(swing, SELF.last_swing)) {
        SELF.averaged = 0;
    }
    if (SELF.averaged == 0u) {
        SELF.period_sum = 0;
        SELF.swing_sum = 0;
    }
    SELF.period_sum += period;
    SELF.swing_sum += swing;
    SELF.averaged++;
    SELF.last_period = period;
    SELF.last_swing = swing;
}

// What the experiment came to with the cycle that was just added.
static uint8_t verdict(FIXPID_DATA const struct fixpid_relay *self)
{
    const uint32_t cycles = SELF.averaged;

    if (cycles != SELF.config.cycles) {
        return (SELF.seen == CYCLES_SEEN_MAX) ? FIXPID_RELAY_IRREGULAR
                                              : FIXPID_RELAY_RUNNING;
    }
    if (SELF.high_steps > (4u * (uint32_t)SELF.elapsed)) {
        return FIXPID_RELAY_IRREGULAR;
    }
    if (SELF.elapsed > (4u * (uint32_t)SELF.high_steps)) {
        return FIXPID_RELAY_IRREGULAR;
    }
    if (SELF.period_sum < (PERIOD_MIN * cycles)) {
        return FIXPID_RELAY_TOO_FAST;
    }
    if (SELF.swing_sum < (4u * cycles * SELF.config.hysteresis)) {
        return FIXPID_RELAY_TOO_SMALL;
    }
    return FIXPID_RELAY_DONE;
}

static void begin_cycle(FIXPID_DATA struct fixpid_relay *self,
                        int16_t measurement)
{
    SELF.highest = measurement;
    SELF.lowest = measurement;
    SELF.highest_at = 0;
    SELF.lowest_at = 0;
    SELF.error_sum = 0;
}

// The error has 17 bits and is not saturated: all that counts is on which side
// of the hysteresis it lies.
static void switch_relay(FIXPID_DATA struct fixpid_relay *self, int32_t error,
                         int16_t measurement)
{
    const int32_t hysteresis = SELF.config.hysteresis;

    if (SELF.side == SIDE_HIGH) {
        if (error < -hysteresis) {
            SELF.side = SIDE_LOW;
            SELF.high_steps = SELF.elapsed;
            SELF.elapsed = 0;
        }
    } else {
        if (error > hysteresis) {
            SELF.side = SIDE_HIGH;
            add_cycle(self);
            SELF.status = verdict(self);
            SELF.elapsed = 0;
            if (SELF.status == RUNNING) { // the result reads the last cycle
                begin_cycle(self, measurement);
            }
        }
    }
    SELF.elapsed++;
}

// What the result wants to know of the cycle.
static void watch_cycle(FIXPID_DATA struct fixpid_relay *self, int32_t error,
                        int16_t measurement)
{
    // Each half is shorter than the timeout: at most 2 * 32766
    uint16_t at = SELF.elapsed;

    if (SELF.side == SIDE_LOW) {
        at = (uint16_t)(at + SELF.high_steps);
    }
    if (measurement > SELF.highest) {
        SELF.highest = measurement;
        SELF.highest_at = at;
    }
    if (measurement < SELF.lowest) {
        SELF.lowest = measurement;
        SELF.lowest_at = at;
    }
    // 65535 * 65532 = 4294639620 < 2^32
    SELF.error_sum += (uint32_t)((error < 0) ? -error : error);
}

static void run_relay(FIXPID_DATA struct fixpid_relay *self, int32_t error,
                      int16_t measurement)
{
    if (SELF.side == SIDE_UNKNOWN) {
        SELF.side = (error >= 0) ? SIDE_HIGH : SIDE_LOW;
        begin_cycle(self, measurement);
    }
    watch_cycle(self, error, measurement);
    switch_relay(self, error, measurement);
}

// A measurement at its limits says more than a relay that does not switch.
static void watch_limits(FIXPID_DATA struct fixpid_relay *self,
                         int16_t measurement)
{
    if (SELF.elapsed >= SELF.config.timeout_steps) {
        SELF.status = FIXPID_RELAY_NO_OSCILLATION;
    }
    if (measurement <= SELF.config.measurement_min) {
        SELF.status = FIXPID_RELAY_SATURATED;
    }
    if (measurement >= SELF.config.measurement_max) {
        SELF.status = FIXPID_RELAY_SATURATED;
    }
}

int16_t fixpid_relay_step(FIXPID_DATA struct fixpid_relay *self,
                          int16_t setpoint, int16_t measurement)
{
    int32_t error = (int32_t)setpoint - measurement;

    FIXPID_ASSERT(VALID(self));
    if ((SELF.config.options & FIXPID_RELAY_REVERSE) != 0u) {
        error = -error;
    }
    if (SELF.status == RUNNING) {
        watch_limits(self, measurement);
    }
    if (SELF.status == RUNNING) {
        run_relay(self, error, measurement);
    }
    if (SELF.status != RUNNING) {
        return SELF.config.output_rest;
    }
    if (SELF.side == SIDE_HIGH) {
        return SELF.config.output_max;
    }
    return SELF.config.output_min;
}

uint8_t fixpid_relay_status(FIXPID_DATA const struct fixpid_relay *self)
{
    FIXPID_ASSERT(VALID(self));
    return SELF.status;
}

// kp in Q16; 0 if it is far beyond the range of kp.
static uint32_t proportional_q16(FIXPID_DATA const struct fixpid_relay *self,
                                 uint8_t kp_q8)
{
    const uint16_t relay_counts = (uint16_t)((uint16_t)SELF.config.output_max -
                                             (uint16_t)SELF.config.output_min);
    // 326 * 16 * 65535 * 8 = 2734644480 < 2^32; a swing_sum is at least 4
    const uint32_t ultimate_gain_q12 =
        FOUR_OVER_PI_Q8 * 16u * relay_counts * SELF.averaged / SELF.swing_sum;

    if (ultimate_gain_q12 > ULTIMATE_GAIN_MAX) {
        return 0;
    }
    return (ultimate_gain_q12 * kp_q8) / 16u; // 2^23 * 116 < 2^30
}

// 16 dividend / divisor, of which 16 dividend would not fit. The divisor is
// below 2^20 here, and so is a remainder of it.
static uint32_t sixteenfold(uint32_t dividend, uint32_t divisor)
{
    return ((dividend / divisor) * 16u) +
           (((dividend % divisor) * 16u) / divisor);
}

// The period is at least 6 steps, 96 in Q4, so this is at most
// 973063680 / 96 * 16 = 162177280, below the largest that fixpid_pid takes.
static uint32_t integral_q24(uint32_t kp_q16, uint8_t reset_q8,
                             uint32_t period_q4)
{
    // 65535 * 256 / 2 = 8388480 is above kp_q16, 8388480 * 116 = 973063680
    return sixteenfold(kp_q16 * reset_q8, period_q4);
}

// The mean error of the last cycle against its swing, for the form that it has.
static bool serves_pi(FIXPID_DATA const struct fixpid_relay *self,
                      uint16_t turning, uint16_t uneven)
{
    const uint16_t period = SELF.last_period;
    // At least two periods and less than 2^18
    const uint32_t steps = (2u * (uint32_t)period) + turning + uneven;
    const int32_t reach =
        (2 * (int32_t)SELF.last_swing) - (3 * (int32_t)SELF.config.hysteresis);

    if (turning > (uint16_t)((period / 2u) + (period / 16u))) {
        return true;
    }
    // error_sum is at most 65535 times the period: 16 * 65535 / 2 = 524280
    return (int32_t)sixteenfold(SELF.error_sum, steps) < reach;
}

static bool serves_pid(uint16_t period, uint16_t turning, uint16_t uneven)
{
    if (period < PID_PERIOD_MIN) {
        return false;
    }
    if (uneven >= (period / 3u)) {
        return false;
    }
    return turning < (uint16_t)((period / 2u) - (period / 20u));
}

// Reads the last cycle: the steps from each switch to the extreme after it,
// both together, and the difference of its halves. A setpoint that moved may
// make the first less than nothing: it is kept in 16 bits.
static bool serves(FIXPID_DATA const struct fixpid_relay *self, uint8_t rule)
{
    const uint16_t high_steps = SELF.high_steps;
    const uint16_t low_steps = (uint16_t)(SELF.last_period - high_steps);
    const int32_t turns = (int32_t)SELF.highest_at + (int32_t)SELF.lowest_at -
                          (int32_t)high_steps;
    const uint16_t turning = (uint16_t)turns;
    uint16_t uneven = (uint16_t)(low_steps - high_steps);

    if (high_steps > low_steps) {
        uneven = (uint16_t)(high_steps - low_steps);
    }
    if (rule == (uint8_t)FIXPID_RELAY_TYREUS_LUYBEN_PI) {
        return serves_pi(self, turning, uneven);
    }
    return serves_pid(SELF.last_period, turning, uneven);
}

static bool tune_derivative(struct fixpid_pid_gains *gains,
                            uint32_t rate_time_q4)
{
    uint16_t lag = (uint16_t)(rate_time_q4 / 128u); // steps, an eighth of Td
    uint32_t kd_q8;

    gains->derivative_filter = 0;
    while (lag > 1u) {
        lag /= 2u;
        gains->derivative_filter++;
    }
    if (gains->derivative_filter > FIXPID_PID_FILTER_MAX) {
        gains->derivative_filter = FIXPID_PID_FILTER_MAX;
    }
    // 32767 * 131071 = 4294803457 < 2^32
    kd_q8 = (gains->kp_q8 * rate_time_q4) >> (4u + gains->derivative_filter);
    gains->kd_q8 = (uint16_t)kd_q8;
    return kd_q8 <= FIXPID_PID_KD_MAX;
}

// Whether nothing is divided by zero, nor by a period that no cycles have:
// flipped bits may have made an experiment done.
static bool swings_make_sense(FIXPID_DATA const struct fixpid_relay *self)
{
    if (SELF.averaged == 0u) {
        return false;
    }
    if (SELF.period_sum < (PERIOD_MIN * (uint32_t)SELF.averaged)) {
        return false;
    }
    if (SELF.period_sum > (PERIOD_MAX * SELF.averaged)) {
        return false;
    }
    if (SELF.swing_sum == 0u) {
        return false;
    }
    return SELF.last_period != 0u;
}

// False if a gain is out of its range.
static bool apply(FIXPID_DATA const struct fixpid_relay *self,
                  const struct rule *rule, struct fixpid_pid_gains *gains)
{
    // (16 * 8 * 65532 + 4) / 8 < 2^20
    const uint32_t period_q4 =
        ((SELF.period_sum * 16u) + (SELF.averaged / 2u)) / SELF.averaged;
    const uint32_t rate_time_q4 = (period_q4 * rule->rate_q8) / 256u;
    const uint32_t kp_q16 = proportional_q16(self, rule->kp_q8);
    const uint32_t kp_q8 = (kp_q16 + 128u) / 256u;

    if (kp_q8 == 0u) {
        return false;
    }
    if (kp_q8 > FIXPID_PID_KP_MAX) {
        return false;
    }
    gains->kp_q8 = (uint16_t)kp_q8;
    gains->ki_q24 = integral_q24(kp_q16, rule->reset_q8, period_q4);
    if (gains->ki_q24 < KI_MIN) {
        return false;
    }
    if (rate_time_q4 > RATE_TIME_MAX) {
        return false;
    }
    return tune_derivative(gains, rate_time_q4);
}

bool fixpid_relay_result(FIXPID_DATA const struct fixpid_relay *self,
                         uint8_t rule, struct fixpid_pid_gains *gains)
{
    static const struct rule rules[] = {
        {80, 116, 0},   // TYREUS_LUYBEN_PI
        {116, 116, 41}, // TYREUS_LUYBEN_PID
    };
    struct fixpid_pid_gains tuned;

    FIXPID_ASSERT(VALID(self));
    FIXPID_ASSERT(gains != 0);
    if (SELF.status != DONE) {
        return false;
    }
    if (rule > LAST_RULE) {
        return false;
    }
    if (!swings_make_sense(self)) {
        return false;
    }
    if (!serves(self, rule)) {
        return false;
    }
    if (!apply(self, &rules[rule], &tuned)) {
        return false;
    }
    gains->kp_q8 = tuned.kp_q8;
    gains->ki_q24 = tuned.ki_q24;
    gains->kd_q8 = tuned.kd_q8;
    gains->derivative_filter = tuned.derivative_filter;
    return true;
}
