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

static uint32_t digest_of_progress(uint32_t digest)
{
    struct fixpid_autotune_stage stage;

    fixpid_autotune_progress(&autotune_controller, &stage);
    digest = digest_of(digest, stage.phase, 1);
    digest = digest_of(digest, stage.done, 1);
    return digest_of(digest, stage.period, 1);
}

static void experiment(const struct player_row *row, uint32_t *values)
{
    const int16_t setpoint =
        row->config.reverse ? (int16_t)(row->plant.full_scale - row->setpoint)
                            : row->setpoint;

    values[PLAYER_STEPS] = 0;
    values[PLAYER_OUTPUTS] = PLAYER_DIGEST;
    values[PLAYER_TOLD] = PLAYER_DIGEST;
    plant_start(&plant, &row->plant, row->config.output_rest);
    (void)fixpid_autotune_init(&autotune_controller, &row->config);
    do {
        const int16_t output = fixpid_autotune_step(
            &autotune_controller, setpoint, plant_measure(&plant));

        plant_move(&plant, output);
        values[PLAYER_STEPS]++;
        values[PLAYER_OUTPUTS] =
            digest_of(values[PLAYER_OUTPUTS], (uint16_t)output, 2);
        values[PLAYER_TOLD] = digest_of_progress(values[PLAYER_TOLD]);
    } while (fixpid_autotune_status(&autotune_controller) ==
             FIXPID_AUTOTUNE_RUNNING);
    values[PLAYER_STATUS] = fixpid_autotune_status(&autotune_controller);
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
    values[5] = (uint32_t)(int32_t)model.holding;
    values[6] = model.noise_q4;
    values[7] = model.hysteresis;
}

static void ask_gains(uint8_t rule, uint8_t robustness_q4, uint32_t *values)
{
    struct fixpid_pid_config config;
    bool accepted;

    memset(&config, 0, sizeof config);
    config.setpoint_weight_q8 = PLAYER_WEIGHT_BEFORE;
    config.proportional_on_measurement = true;
    accepted = fixpid_autotune_result(&autotune_controller, rule, robustness_q4,
                                      &config);
    values[0] =
        fixpid_autotune_reason(&autotune_controller, rule, robustness_q4);
    values[1] = config.gains.kp_q8;
    values[2] = config.gains.ki_q24;
    values[3] = config.gains.kd_q8;
    values[4] = config.gains.derivative_filter;
    values[5] = config.setpoint_weight_q8;
    values[6] = config.proportional_on_measurement ? 1u : 0u;
    if (accepted != (values[0] == FIXPID_AUTOTUNE_NO_REASON)) {
        values[0] = UINT32_MAX; // both have the same answer, or it is wrong
    }
}

void player_ask(uint8_t robustness_q4, uint32_t values[PLAYER_VALUES])
{
    const uint8_t robustnesses_q4[] = {FIXPID_AUTOTUNE_QUICK,
                                       FIXPID_AUTOTUNE_SAFE,
                                       FIXPID_AUTOTUNE_CALM, robustness_q4};
    uint32_t *gains = &values[PLAYER_GAINS];

    ask_model(&values[PLAYER_MODEL]);
    for (uint8_t rule = FIXPID_AUTOTUNE_PI; rule <= FIXPID_AUTOTUNE_PID;
         rule++) {
        for (uint8_t i = 0; i < 4u; i++) {
            ask_gains(rule, robustnesses_q4[i], gains);
            gains += PLAYER_GAINS_VALUES;
        }
    }
    ask_gains(FIXPID_AUTOTUNE_PID + 1, FIXPID_AUTOTUNE_SAFE, gains);
}

void player_play(const struct player_row *row, uint32_t values[PLAYER_VALUES])
{
    experiment(row, values);
    player_ask(row->robustness_q4, values);
}
