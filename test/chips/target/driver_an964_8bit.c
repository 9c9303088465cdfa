// SPDX-License-Identifier: MIT
#include "exchange.h"
#include "fixpid_an964_8bit.h"

#define QUESTION an964_8bit_exchange.question
#define ANSWER an964_8bit_exchange.answer

// In object mode the library is built for the object of this name.
FIXPID_DATA struct fixpid_an964_8bit an964_8bit_controller;

union an964_8bit_exchange EXCHANGE_PLACE an964_8bit_exchange;

static uint8_t calls_before_the_step(void)
{
    uint8_t accepted = 0;

    if ((QUESTION.calls & CALL_INIT) != 0u) {
        DRIVER_POISON(an964_8bit_controller);
        if (fixpid_an964_8bit_init(&an964_8bit_controller, &QUESTION.gains)) {
            accepted |= CALL_INIT;
        }
    }
    if ((QUESTION.calls & CALL_RESET) != 0u) {
        fixpid_an964_8bit_reset(&an964_8bit_controller);
    }
    if ((QUESTION.calls & CALL_SET_GAINS) != 0u) {
        if (fixpid_an964_8bit_set_gains(&an964_8bit_controller,
                                        QUESTION.gains.kp, QUESTION.gains.ki,
                                        QUESTION.gains.kd)) {
            accepted |= CALL_SET_GAINS;
        }
    }
    return accepted;
}

// The question ends where the answer begins.
void an964_8bit_reply(void)
{
    const uint8_t accepted = calls_before_the_step();

    ANSWER.output =
        fixpid_an964_8bit_step(&an964_8bit_controller, QUESTION.error);
    ANSWER.proportional =
        fixpid_an964_8bit_proportional(&an964_8bit_controller);
    ANSWER.integral = fixpid_an964_8bit_integral(&an964_8bit_controller);
    ANSWER.derivative = fixpid_an964_8bit_derivative(&an964_8bit_controller);
    ANSWER.accepted = accepted;
    ANSWER.flags = fixpid_an964_8bit_flags(&an964_8bit_controller);
}
