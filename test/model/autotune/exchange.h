// SPDX-License-Identifier: MIT
// One call of fixpid_autotune, for a chip: the question in, the answer in its
// place. No member has padding before it.
#ifndef EXCHANGE_H
#define EXCHANGE_H
#include "fixpid_autotune.h"

enum call { CALL_INIT, CALL_STEP, CALL_MODEL, CALL_RESULT };

struct question {
    struct fixpid_autotune_config config;
    int16_t setpoint;
    int16_t measurement;
    uint8_t call;
    uint8_t rule;
    uint8_t robustness_q4;
};

// What a call does not give is 0.
struct answer {
    uint32_t ki_q24;
    uint16_t kp_q8;
    uint16_t kd_q8;
    uint16_t weight_q8;
    int16_t output;
    uint8_t derivative_filter;
    uint8_t weightless; // proportional_on_measurement
    uint8_t accepted;
    uint8_t status;
    uint8_t reason;
    uint8_t phase; // of the progress, after each call
    uint8_t done;
    uint8_t expected;
    uint16_t period;
    uint8_t none[2]; // instead of padding
    struct fixpid_autotune_process model;
};

union exchange {
    struct question question;
    struct answer answer;
};

#endif
