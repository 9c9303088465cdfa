// SPDX-License-Identifier: MIT
// One call of the autotuner, as in exchange.h: the question in, the answer in
// its place. No member has padding before it.
#ifndef EXCHANGE_H
#define EXCHANGE_H
#include "fixpid_relay.h"

// As in a trace.
#define CALL_INIT 'i'
#define CALL_RESET 'n'
#define CALL_STEP 's'
#define CALL_RESULT 'r'

struct question {
    struct fixpid_relay_config config;
    int16_t setpoint;
    int16_t measurement;
    uint8_t call;
    uint8_t rule;
};

// What a call does not give is 0.
struct answer {
    uint32_t ki_q24;
    uint16_t kp_q8;
    uint16_t kd_q8;
    int16_t output;
    uint8_t derivative_filter;
    uint8_t accepted;
    uint8_t status;
};

union exchange {
    struct question question;
    struct answer answer;
};

#endif
