// SPDX-License-Identifier: MIT
// The straightforward form in the place of the library, as far as the search
// needs it: steps, and what is set before them.
#include <string.h>

#include "exchange.h"
#include "plain_c_an964_8bit.h"

#define GAIN_MAX 127u
#define QUESTION an964_8bit_exchange.question
#define ANSWER an964_8bit_exchange.answer

union an964_8bit_exchange an964_8bit_exchange;

static struct plain_c_an964_8bit plain;

void an964_8bit_reply(void)
{
    const uint8_t gains =
        QUESTION.gains.kp | QUESTION.gains.ki | QUESTION.gains.kd;
    int32_t output;

    if ((QUESTION.calls & CALL_INIT) != 0u) {
        memset(&plain, 0, sizeof plain);
    }
    if ((QUESTION.calls & (CALL_INIT | CALL_SET_GAINS)) != 0u &&
        gains <= GAIN_MAX) {
        plain.gains = QUESTION.gains;
    }
    output = plain_c_an964_8bit_step(&plain, QUESTION.error);
    memset(&ANSWER, 0, sizeof ANSWER);
    ANSWER.output = (int16_t)output;
}
