// SPDX-License-Identifier: MIT A guard's configuration for a plant that a tuner
// has measured. It has its own file because SDCC links whole object files.
#include "fixpid_guard.h"

#include "../common/fixpid_difference.h"

#define BAND_MAX 32767u
#define RULE_PATIENCE_MIN 4u
#define PATIENCE_MAX 32767u
#define NOISE_MIN_Q4 16u // a count
#define BANDS 20u
#define NOISY_PATIENCE_MIN 16u

// fixpid_autotune's mark of a plant without a static gain.
#define INTEGRATING ((uint32_t)0xFFFFFFFFu)

#define TOP_BIT ((uint32_t)0x80000000u)

// 64 bits, in two words: SDCC has no such integers for a PIC.
struct two_words {
    uint32_t high;
    uint32_t low;
};

// value = floor(value / divisor). pre: divisor >= 1
static void divide_wide(struct two_words *value, uint32_t divisor)
{
    uint32_t rest = 0; // below the divisor before and after each turn
    uint8_t turn;

    // The quotient's bits enter `low` as the value's leave `high`.
    for (turn = 64; turn != 0u; turn--) {
        // 2 rest + bit needs 33 bits, these do not: it is at least the divisor
        // where the one is at least the other.
        uint32_t more = rest;                  // <= divisor
        const uint32_t lacks = divisor - rest; // >= 1

        if ((value->high & TOP_BIT) != 0u) {
            more++;
        }
        value->high = (value->high & ~TOP_BIT) << 1;
        if ((value->low & TOP_BIT) != 0u) {
            value->high++;
        }
        value->low = (value->low & ~TOP_BIT) << 1;
        if (more >= lacks) {
            rest = more - lacks;
            value->low++;
        } else {
            rest += more;
        }
    }
}

// ceil(2 K)
static uint32_t two_gains(uint32_t gain_q8)
{
    uint32_t gains = gain_q8 >> 7;

    if (gain_q8 == INTEGRATING) {
        return 0;
    }
    if ((gain_q8 & 0x7Fu) != 0u) {
        gains++;
    }
    return gains;
}

static uint32_t band_for(const struct fixpid_guard_model *model)
{
    const uint32_t swing = two_gains(model->gain_q8);
    uint32_t band;

    if (model->band != 0u) {
        return model->band;
    }
    band = (((uint32_t)model->noise_q4 + 1u) >> 1) + 4u; // ceil(8 s + 4)
    return (swing > band) ? swing : band;
}

// Below 2^23. pre: band <= BAND_MAX
static uint32_t counts_in(uint8_t bands, uint16_t band)
{
    return (uint32_t)band * bands;
}

// In eighths, less one: ceil(a / b) = floor((a - 1) / b) + 1.
// pre: none is 0, and band <= BAND_MAX
static uint32_t way_for(uint32_t slope_q24, uint16_t range, uint16_t band,
                        uint8_t bands)
{
    // 8 bands * band / (slope_q24 / 2^24 * range), and 8 bands * band < 2^26
    const uint32_t a = (counts_in(bands, band) << 3) - 1u;
    struct two_words way;

    way.high = a >> 8;
    way.low = ((a & 0xFFu) << 24) | UINT32_C(0xFFFFFF);
    divide_wide(&way, slope_q24);
    divide_wide(&way, range);
    return (way.high == 0u) ? way.low : UINT32_MAX;
}

// 0: more than PATIENCE_MAX
static uint16_t patience_for(uint32_t dead_q4, uint32_t way)
{
    uint32_t patience;

    if (((dead_q4 | way) & TOP_BIT) != 0u) {
        return 0;
    }
    // 2 L is dead_q4 eighths of a step, and the sum is below 2^32.
    patience = ((dead_q4 + way) >> 3) + 1u;
    if (patience > PATIENCE_MAX) {
        return 0;
    }
    return (patience < RULE_PATIENCE_MIN) ? RULE_PATIENCE_MIN
                                          : (uint16_t)patience;
}

static bool write_rule(struct fixpid_guard_config *config,
                       const struct fixpid_guard_model *model, uint32_t band)
{
    const uint8_t bands = (model->bands != 0u) ? model->bands : BANDS;
    uint16_t patience;

    if (config->output_min >= config->output_max) {
        return false;
    }
    if (model->slope_q24 == 0u) {
        return false;
    }
    if (band > BAND_MAX) {
        return false;
    }
    patience = patience_for(
        model->dead_q4,
        way_for(model->slope_q24,
                fixpid_difference(config->output_max, config->output_min),
                (uint16_t)band, bands));
    if (patience == 0u) {
        return false;
    }
    config->band = (uint16_t)band;
    config->patience = patience;
    config->noisy = false;
    if (model->noise_q4 >= NOISE_MIN_Q4) {
        config->noisy = patience >= NOISY_PATIENCE_MIN;
    }
    return true;
}

bool fixpid_guard_from_model(struct fixpid_guard_config *config,
                             const struct fixpid_guard_model *model)
{
    FIXPID_ASSERT(config != 0);
    FIXPID_ASSERT(model != 0);
    return write_rule(config, model, band_for(model));
}
