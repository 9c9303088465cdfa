// SPDX-License-Identifier: MIT
// The autotuner on a chip: it answers whenever chip.cc has asked.
#include "exchange.h"

#include "compiler.h"
#include "configuration.h"

// In object mode the library is built for the object of this name.
FIXPID_DATA struct fixpid_autotune autotune_controller;

union exchange exchange;

#define WEIGHT_BEFORE 128u

// 0 gives the turn to the harness, which sets it to 1 when it has asked.
volatile uint8_t turn;

static struct fixpid_autotune_process model;
static struct fixpid_pid_config gains;
static struct fixpid_autotune_stage stage;

static void clear(void)
{
    model.gain_q8 = 0;
    model.lag_q4 = 0;
    model.dead_q4 = 0;
    model.slope_q24 = 0;
    model.holding = 0;
    model.noise_q4 = 0;
    model.hysteresis = 0;
    gains.gains.kp_q8 = 0;
    gains.gains.ki_q24 = 0;
    gains.gains.kd_q8 = 0;
    gains.gains.derivative_filter = 0;
    gains.setpoint_weight_q8 = WEIGHT_BEFORE;
    gains.proportional_on_measurement = true;
}

static void tell(void)
{
    exchange.answer.model.gain_q8 = model.gain_q8;
    exchange.answer.model.lag_q4 = model.lag_q4;
    exchange.answer.model.dead_q4 = model.dead_q4;
    exchange.answer.model.slope_q24 = model.slope_q24;
    exchange.answer.model.holding = model.holding;
    exchange.answer.model.noise_q4 = model.noise_q4;
    exchange.answer.model.hysteresis = model.hysteresis;
    exchange.answer.ki_q24 = gains.gains.ki_q24;
    exchange.answer.kp_q8 = gains.gains.kp_q8;
    exchange.answer.kd_q8 = gains.gains.kd_q8;
    exchange.answer.weight_q8 = gains.setpoint_weight_q8;
    exchange.answer.derivative_filter = gains.gains.derivative_filter;
    exchange.answer.weightless = gains.proportional_on_measurement ? 1u : 0u;
}

static void tell_progress(void)
{
    fixpid_autotune_progress(&autotune_controller, &stage);
    exchange.answer.phase = stage.phase;
    exchange.answer.done = stage.done;
    exchange.answer.expected = stage.expected;
    exchange.answer.period = stage.period;
}

// The question ends where the answer begins.
static void reply(void)
{
    const uint8_t call = exchange.question.call;
    uint8_t accepted = 0;
    uint8_t reason = 0;
    int16_t output = 0;

    clear();
    if (call == CALL_INIT) {
        accepted = fixpid_autotune_init(&autotune_controller,
                                        &exchange.question.config);
    }
    if (call == CALL_STEP) {
        output = fixpid_autotune_step(&autotune_controller,
                                      exchange.question.setpoint,
                                      exchange.question.measurement);
    }
    if (call == CALL_MODEL) {
        accepted = fixpid_autotune_model(&autotune_controller, &model);
    }
    if (call == CALL_RESULT) {
        accepted =
            fixpid_autotune_result(&autotune_controller, exchange.question.rule,
                                   exchange.question.robustness_q4, &gains);
        reason =
            fixpid_autotune_reason(&autotune_controller, exchange.question.rule,
                                   exchange.question.robustness_q4);
    }
    tell();
    tell_progress();
    exchange.answer.reason = reason;
    exchange.answer.output = output;
    exchange.answer.accepted = accepted;
    exchange.answer.status = fixpid_autotune_status(&autotune_controller);
}

void main(void)
{
    for (;;) {
        turn = 0;
        while (turn == 0u) {
        }
        PORT_CLEAR_WATCHDOG();
        reply();
    }
}
