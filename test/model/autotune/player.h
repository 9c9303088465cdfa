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
    PLAYER_TOLD,    // the same of phase, done, low byte of the period of all
    PLAYER_MODEL,   // 1 if there is one, then its seven fields; else all 0
    PLAYER_GAINS = PLAYER_MODEL + 8
};

#define PLAYER_MODEL_FIELDS 7

// What is asked for, with the last one of no rule: PI at 8, 16, 32 and the
// row's own robustness, PID likewise, and rule 2 at 16.
#define PLAYER_GAINS_COUNT 9

// The reason; kp, ki, kd and filter, 0 if there are none; the setpoint weight
// and whether kp acts on the measurement, which both were set otherwise.
#define PLAYER_GAINS_VALUES 7
#define PLAYER_VALUES (PLAYER_GAINS + PLAYER_GAINS_COUNT * PLAYER_GAINS_VALUES)

// What the weight was set to, and what a result makes it.
#define PLAYER_WEIGHT_BEFORE 128u
#define PLAYER_WEIGHT 256u

void player_play(const struct player_row *row, uint32_t values[PLAYER_VALUES]);

// Of an experiment that is over: all from PLAYER_MODEL on.
void player_ask(uint8_t robustness_q4, uint32_t values[PLAYER_VALUES]);

// FNV-1a, with all values of one row, low bytes first.
#define PLAYER_DIGEST UINT32_C(2166136261)
uint32_t player_digest(uint32_t digest, const uint32_t values[PLAYER_VALUES]);

#endif
