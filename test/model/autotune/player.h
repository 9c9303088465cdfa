// SPDX-License-Identifier: MIT
// Plays a row of test/support/vectors/autotune.csv on the library. Nothing here
// needs files, so that it runs on a chip, too.
#ifndef AUTOTUNE_PLAYER_H
#define AUTOTUNE_PLAYER_H
#include "autotune_plant.h"
#include "fixpid_autotune.h"

struct player_row {
    struct fixpid_autotune_config config;
    struct plant_config plant;
    int16_t setpoint;
    uint8_t robustness_q4;
};

// Everything that comes out, as numbers.
enum player_value {
    PLAYER_STATUS,
    PLAYER_STEPS,
    PLAYER_OUTPUTS, // FNV-1a of all outputs, low byte first
    PLAYER_MODEL,   // 1 if there is one, then its nine fields; else all 0
    PLAYER_RULES = PLAYER_MODEL + 10
};

#define PLAYER_MODEL_FIELDS 9
#define PLAYER_RULES_COUNT 8 // the last one is no rule

// 1 if it has gains, kp, ki, kd, filter, weight, and whether kp acts on the
// measurement; else all 0.
#define PLAYER_RULE_VALUES 7
#define PLAYER_VALUES (PLAYER_RULES + PLAYER_RULES_COUNT * PLAYER_RULE_VALUES)

void player_play(const struct player_row *row, uint32_t values[PLAYER_VALUES]);

// FNV-1a, with all values of one row, low bytes first.
#define PLAYER_DIGEST UINT32_C(2166136261)
uint32_t player_digest(uint32_t digest, const uint32_t values[PLAYER_VALUES]);

#endif
