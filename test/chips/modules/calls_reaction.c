// SPDX-License-Identifier: MIT
#include "calls_reaction.h"
#include "calls.h"
#include "numbers.h"
#include "numbers_control.h"
#include "numbers_reaction.h"

#ifndef CALLS_PART
#include "rows_reaction.h"
#endif

#ifdef CALLS_DEFINED
#include "reference_reaction.h"
static struct reference_reaction reference;
#define DEFINE(call) (call)
#else
#define DEFINE(call) ((void)0)
#endif

#define REVERSE 0x80u
#define HEATING 9u // of a state, and above

FIXPID_DATA struct fixpid_reaction reaction;

static struct fixpid_reaction_config config;

static void init(void)
{
    const uint32_t accepted =
        fixpid_reaction_init(&reaction, &config) ? 1u : 0u;

    calls_answer(accepted, DEFINED(reference_reaction_init(&reference, &config),
                                   accepted));
}

static void reset(void)
{
    fixpid_reaction_reset(&reaction);
    DEFINE(reference_reaction_reset(&reference));
}

// Through the function that its kind is metered by.
static int16_t call_step(int16_t measurement)
{
#ifdef CALLS_BY_KIND
    if (reaction.state >= HEATING) {
        if (reaction.blocks >= 8u) {
            return reaction_halving_step(&reaction, measurement);
        }
        if (reaction.left == 1u) {
            return reaction_block_step(&reaction, measurement);
        }
    } else if (reaction.state == FIXPID_REACTION_RUNNING) {
        if (reaction.left == 1u) {
            return reaction_last_listening_step(&reaction, measurement);
        }
    }
    return reaction_ordinary_step(&reaction, measurement);
#else
    return fixpid_reaction_step(&reaction, measurement);
#endif
}

static int16_t step(int16_t measurement)
{
    const int16_t output = call_step(measurement);
    const uint8_t status = fixpid_reaction_status(&reaction);
    const uint8_t progress = fixpid_reaction_progress(&reaction);

    calls_answer((uint16_t)output, DEFINED((uint16_t)reference_reaction_step(
                                               &reference, measurement),
                                           (uint16_t)output));
    calls_answer(status, DEFINED(reference.status, status));
    calls_answer(progress,
                 DEFINED(reference_reaction_progress(&reference), progress));
    return output;
}

static void ask_model(void)
{
    struct fixpid_reaction_process given = {0, 0, 0};
    struct fixpid_reaction_process defined = {0, 0, 0};
    const uint32_t found = fixpid_reaction_model(&reaction, &given) ? 1u : 0u;

    calls_answer(
        found, DEFINED(reference_reaction_model(&reference, &defined), found));
    calls_answer(given.slope_q24, DEFINED(defined.slope_q24, given.slope_q24));
    calls_answer(given.dead_q4, DEFINED(defined.dead_q4, given.dead_q4));
    calls_answer(given.noise_q4, DEFINED(defined.noise_q4, given.noise_q4));
    (void)defined;
}

static void ask_gains(uint8_t rule, uint8_t robustness_q4)
{
    struct fixpid_pid_gains given = {0, 0, 0, 0};
    struct fixpid_pid_gains defined = {0, 0, 0, 0};
    const uint32_t found =
        fixpid_reaction_result(&reaction, rule, robustness_q4, &given) ? 1u
                                                                       : 0u;

    calls_answer(found, DEFINED(reference_reaction_result(
                                    &reference, rule, robustness_q4, &defined),
                                found));
    calls_answer(given.kp_q8, DEFINED(defined.kp_q8, given.kp_q8));
    calls_answer(given.ki_q24, DEFINED(defined.ki_q24, given.ki_q24));
    calls_answer(given.kd_q8, DEFINED(defined.kd_q8, given.kd_q8));
    calls_answer(given.derivative_filter,
                 DEFINED(defined.derivative_filter, given.derivative_filter));
    (void)defined;
}

static void ask_results(uint8_t robustness_q4)
{
    ask_model();
    for (uint8_t rule = 0; rule < 3u; rule++) {
        ask_gains(rule, FIXPID_REACTION_SAFE);
        ask_gains(rule, robustness_q4);
    }
}

#ifdef CALLS_PART
void calls_rows(void)
{
    // there is no room for them
}
#else
// A difference of no reading stands for a call of reset.
static void play(uint16_t from, uint16_t to)
{
    int16_t reading = 0;

    for (uint16_t at = from; at < to; at++) {
        if (rows_readings_times[at] == 0u) {
            reset();
        }
        for (uint16_t i = 0; i < rows_readings_times[at]; i++) {
            reading = (int16_t)((uint16_t)reading +
                                (uint16_t)rows_readings_value[at]);
            (void)step(reading);
        }
    }
}

void calls_rows(void)
{
    for (uint16_t row = 0; row < ROWS; row++) {
        config.output_rest = rows_output_rest[row];
        config.output_drive = rows_output_drive[row];
        config.measurement_stop = rows_measurement_stop[row];
        config.timeout_steps = rows_timeout_steps[row];
        config.reverse = (rows_options[row] & REVERSE) != 0u;
        init();
        play(rows_readings_from[row], rows_readings_from[row + 1u]);
        ask_results(rows_robustness_q4[row]);
    }
}
#endif

void calls_random(uint32_t count)
{
    uint32_t steps = 0;

    while (steps < count) {
        numbers_reaction_config(&config);
        init();
        do {
            if (numbers_one_in(2000)) {
                reset();
            }
            numbers_reaction_move(step(numbers_reaction_measure()));
            steps++;
        } while (fixpid_reaction_status(&reaction) == FIXPID_REACTION_RUNNING);
        ask_results((uint8_t)(7u + numbers_below(59)));
    }
}
