// SPDX-License-Identifier: MIT
#include "exchange.h"
#include "fixpid_an937.h"

#define QUESTION an937_exchange.question
#define ANSWER an937_exchange.answer

// In object mode the library is built for the object of this name.
FIXPID_DATA struct fixpid_an937 FIXPID_AN937_PLACE an937_controller;

union an937_exchange an937_exchange;

// Its members are padded differently on each machine, so it is not a part of
// the question.
static struct fixpid_an937_config config;

static uint8_t accepted;

static void accept(bool good, uint8_t call)
{
    if (good) {
        accepted |= call;
    }
}

static void start(void)
{
    accepted = 0;
    if ((QUESTION.calls & CALL_INIT) != 0u) {
        config.kp_q4 = QUESTION.kp_q4;
        config.ki_q4 = QUESTION.ki_q4;
        config.kd_q4 = QUESTION.kd_q4;
        config.accumulated_error_limit = QUESTION.limit;
        config.derivative_period_ticks = QUESTION.period;
        DRIVER_POISON(an937_controller);
        accept(fixpid_an937_init(&an937_controller, &config), CALL_INIT);
    }
    if ((QUESTION.calls & CALL_RESET) != 0u) {
        fixpid_an937_reset(&an937_controller);
    }
}

static void set(void)
{
    if ((QUESTION.calls & CALL_SET_GAINS) != 0u) {
        accept(fixpid_an937_set_gains(&an937_controller, QUESTION.kp_q4,
                                      QUESTION.ki_q4, QUESTION.kd_q4),
               CALL_SET_GAINS);
    }
    if ((QUESTION.calls & CALL_SET_LIMIT) != 0u) {
        accept(fixpid_an937_set_accumulated_error_limit(&an937_controller,
                                                        QUESTION.limit),
               CALL_SET_LIMIT);
    }
    if ((QUESTION.calls & CALL_SET_PERIOD) != 0u) {
        accept(fixpid_an937_set_derivative_period(&an937_controller,
                                                  QUESTION.period),
               CALL_SET_PERIOD);
    }
    if ((QUESTION.calls & CALL_CLEAR_FLAGS) != 0u) {
        fixpid_an937_clear_flags(&an937_controller);
    }
}

static void step(void)
{
    uint8_t tick;

    for (tick = 0; tick < QUESTION.ticks; tick++) {
        fixpid_an937_tick(&an937_controller);
    }
    if ((QUESTION.calls & CALL_STEP_PERCENT) != 0u) {
        ANSWER.output = fixpid_an937_step_percent(&an937_controller,
                                                  (int8_t)QUESTION.error);
    } else {
        ANSWER.output = fixpid_an937_step(&an937_controller, QUESTION.error);
    }
}

static void get(void)
{
    ANSWER.proportional = fixpid_an937_proportional(&an937_controller);
    ANSWER.integral = fixpid_an937_integral(&an937_controller);
    ANSWER.derivative = fixpid_an937_derivative(&an937_controller);
    ANSWER.accumulated = fixpid_an937_accumulated_error(&an937_controller);
    ANSWER.flags = fixpid_an937_flags(&an937_controller);
    ANSWER.stat1 = fixpid_an937_stat1(&an937_controller);
    ANSWER.stat2 = fixpid_an937_stat2(&an937_controller);
}

static void get_nothing(void)
{
    ANSWER.proportional = 0;
    ANSWER.integral = 0;
    ANSWER.derivative = 0;
    ANSWER.accumulated = 0;
    ANSWER.flags = 0;
    ANSWER.stat1 = 0;
    ANSWER.stat2 = 0;
}

// The question ends where the answer begins: with the step.
void an937_reply(void)
{
    const bool getters = (QUESTION.calls & CALL_GETTERS) != 0u;

    start();
    set();
    step();
    ANSWER.accepted = accepted;
    if (getters) {
        get();
    } else {
        get_nothing();
    }
}

void an937_tick(void)
{
    fixpid_an937_tick(&an937_controller);
}
