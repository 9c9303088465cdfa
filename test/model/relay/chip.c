// SPDX-License-Identifier: MIT
// The autotuner on a chip: it answers whenever chip.cc has asked.
#include "exchange.h"

#include "compiler.h"
#include "configuration.h"

// In object mode the library is built for the object of this name.
FIXPID_DATA struct fixpid_relay relay_controller;

union exchange exchange;

// 0 gives the turn to the harness, which sets it to 1 when it has asked.
volatile uint8_t turn;

static struct fixpid_pid_gains gains;

// The question ends where the answer begins.
static void reply(void)
{
    const uint8_t call = exchange.question.call;
    uint8_t accepted = 0;
    int16_t output = 0;

    gains.ki_q24 = 0;
    gains.kp_q8 = 0;
    gains.kd_q8 = 0;
    gains.derivative_filter = 0;
    if (call == CALL_INIT) {
        accepted =
            fixpid_relay_init(&relay_controller, &exchange.question.config);
    }
    if (call == CALL_RESET) {
        fixpid_relay_reset(&relay_controller);
    }
    if (call == CALL_STEP) {
        output =
            fixpid_relay_step(&relay_controller, exchange.question.setpoint,
                              exchange.question.measurement);
    }
    if (call == CALL_RESULT) {
        accepted = fixpid_relay_result(&relay_controller,
                                       exchange.question.rule, &gains);
    }
    exchange.answer.ki_q24 = gains.ki_q24;
    exchange.answer.kp_q8 = gains.kp_q8;
    exchange.answer.kd_q8 = gains.kd_q8;
    exchange.answer.output = output;
    exchange.answer.derivative_filter = gains.derivative_filter;
    exchange.answer.accepted = accepted;
    exchange.answer.status = fixpid_relay_status(&relay_controller);
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
