// SPDX-License-Identifier: MIT
#include "exchange.h"
#include "fixpid_an964.h"

#define QUESTION an964_exchange.question
#define ANSWER an964_exchange.answer

// In object mode the library is built for the object of this name.
FIXPID_DATA struct fixpid_an964 an964_controller;

union an964_exchange EXCHANGE_PLACE an964_exchange;

// The question ends where the answer begins: `calls` is where `accepted` will
// be, and keeps what was. One function, because a PIC16F684 in pointer mode has
// no byte to spare, and SDCC shares none between two.
void an964_reply(void)
{
    QUESTION.calls &= (uint8_t)(CALL_INIT | CALL_RESET | CALL_SET_GAINS);
    if ((QUESTION.calls & CALL_INIT) != 0u) {
        DRIVER_POISON(an964_controller);
        if (!fixpid_an964_init(&an964_controller, &QUESTION.gains)) {
            QUESTION.calls &= (uint8_t)~CALL_INIT;
        }
    }
    if ((QUESTION.calls & CALL_RESET) != 0u) {
        fixpid_an964_reset(&an964_controller);
        QUESTION.calls &= (uint8_t)~CALL_RESET;
    }
    if ((QUESTION.calls & CALL_SET_GAINS) != 0u) {
        if (!fixpid_an964_set_gains(&an964_controller, QUESTION.gains.kp,
                                    QUESTION.gains.ki, QUESTION.gains.kd)) {
            QUESTION.calls &= (uint8_t)~CALL_SET_GAINS;
        }
    }
    ANSWER.output = fixpid_an964_step(&an964_controller, QUESTION.error);
    ANSWER.proportional = fixpid_an964_proportional(&an964_controller);
    ANSWER.integral = fixpid_an964_integral(&an964_controller);
    ANSWER.derivative = fixpid_an964_derivative(&an964_controller);
    ANSWER.flags = fixpid_an964_flags(&an964_controller);
}
