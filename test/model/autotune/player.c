// SPDX-License-Identifier: MIT
#include "player.h"

#include <string.h>

// In object mode the library is built for the object of this name.
FIXPID_DATA struct fixpid_autotune autotune_controller;

static struct plant plant;

static uint32_t digest_of(uint32_t digest, uint32_t value, uint8_t bytes)
{
    for (uint8_t i = 0; i < bytes; i++) {
        digest = (digest ^ ((value >> (8u * i)) & 255u)) * UINT32_C(16777619);
    }
    return digest;
}

uint32_t player_digest(uint32_t digest, const uint32_t values[PLAYER_VALUES])
{
    for (uint8_t i = 0; i < PLAYER_VALUES; i++) {
        digest = digest_of(digest, values[i], 4);
    }
    return digest;
}

static void experiment(const struct player_row *row, uint32_t *values)
{
    const bool reverse = (row->config.options & FIXPID_AUTOTUNE_REVERSE) != 0u;
    const int16_t setpoint =
        reverse ? (int16_t)(row->plant.full_scale - row->setpoint)
                : row->setpoint;
    uint32_t digest = PLAYER_DIGEST;
    uint32_t steps = 0;

    plant_start(&plant, &row->plant);
    (void)fixpid_autotune_init(&autotune_controller, &row->config);
    do {
        const int16_t output = fixpid_autotune_step(
            &autotune_controller, setpoint, plant_measure(&plant));

        digest = digest_of(digest, (uint16_t)output, 2);
        plant_move(&plant, output);
        steps++;
    } while (fixpid_autotune_status(&autotune_controller) ==
             FIXPID_AUTOTUNE_RUNNING);
    values[PLAYER_STATUS] = fixpid_autotune_status(&autotune_controller);
    values[PLAYER_STEPS] = steps;
    values[PLAYER_OUTPUTS] = digest;
}

static void ask_model(uint32_t *values)
{
    struct fixpid_autotune_process model;

    memset(&model, 0, sizeof model);
    values[0] = fixpid_autotune_model(&autotune_controller, &model);
    values[1] = model.gain_q8;
    values[2] = model.lag_q4;
    values[3] = model.dead_q4;
    values[4] = model.slope_q24;
    values[5] = model.ultimate_q8;
    values[6] = model.period_q4;
    values[7] = (uint32_t)(int32_t)model.holding;
    values[8] = model.noise_q4;
    values[9] = model.hysteresis;
}

static void ask_result(uint8_t rule, uint8_t robustness_q4, uint32_t *values)
{
    struct fixpid_pid_config config;

    memset(&config, 0, sizeof config);
    values[0] = fixpid_autotune_result(&autotune_controller, rule,
                                       robustness_q4, &config);
    values[1] = config.gains.kp_q8;
    values[2] = config.gains.ki_q24;
    values[3] = config.gains.kd_q8;
    values[4] = config.gains.derivative_filter;
    values[5] = config.setpoint_weight_q8;
    values[6] = config.proportional_on_measurement ? 1u : 0u;
}

void player_play(const struct player_row *row, uint32_t values[PLAYER_VALUES])
{
    experiment(row, values);
    ask_model(&values[PLAYER_MODEL]);
    for (uint8_t rule = 0; rule < PLAYER_RULES_COUNT; rule++) {
        ask_result(rule, row->robustness_q4,
                   &values[PLAYER_RULES + rule * PLAYER_RULE_VALUES]);
    }
}
