// SPDX-License-Identifier: MIT
// The straightforward form in the place of the library, as far as the search
// needs it: steps, and what is set before them.
#include <string.h>

#include "exchange.h"
#include "plain_c_an937.h"

#define QUESTION an937_exchange.question
#define ANSWER an937_exchange.answer

union an937_exchange an937_exchange;

static struct plain_c_an937 plain;

static void start(void)
{
    const struct fixpid_an937_config config = {QUESTION.kp_q4, QUESTION.ki_q4,
                                               QUESTION.kd_q4, QUESTION.limit,
                                               QUESTION.period};

    if (config.accumulated_error_limit != 0u &&
        config.derivative_period_ticks != 0u) {
        plain_c_an937_init(&plain, &config);
    }
}

static void set(void)
{
    if ((QUESTION.calls & CALL_SET_GAINS) != 0u) {
        plain.config.kp_q4 = QUESTION.kp_q4;
        plain.config.ki_q4 = QUESTION.ki_q4;
        plain.config.kd_q4 = QUESTION.kd_q4;
    }
    if ((QUESTION.calls & CALL_SET_LIMIT) != 0u && QUESTION.limit != 0u) {
        plain.config.accumulated_error_limit = QUESTION.limit;
    }
    if ((QUESTION.calls & CALL_SET_PERIOD) != 0u && QUESTION.period != 0u) {
        plain.config.derivative_period_ticks = QUESTION.period;
    }
}

void an937_reply(void)
{
    int32_t output;

    if ((QUESTION.calls & CALL_INIT) != 0u) {
        start();
    }
    set();
    for (uint8_t tick = 0; tick < QUESTION.ticks; tick++) {
        plain_c_an937_tick(&plain);
    }
    output = plain_c_an937_step(&plain, QUESTION.error);
    memset(&ANSWER, 0, sizeof ANSWER);
    ANSWER.output = output;
}
