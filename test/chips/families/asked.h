// SPDX-License-Identifier: MIT
// The controller that a program is built for, by its name:
// -DCONTROLLER=an964 and -DASKED_AN964.
#ifndef ASKED_H
#define ASKED_H
#include "exchange.h"
#include "fixpid_an937.h"

#define ASKED_JOINED(a, b) ASKED_JOINED_(a, b)
#define ASKED_JOINED_(a, b) a##b

#define REPLY ASKED_JOINED(CONTROLLER, _reply)
#define EXCHANGE ASKED_JOINED(CONTROLLER, _exchange)
#define QUESTION_SIZE sizeof(EXCHANGE.question)
#define ANSWER_SIZE sizeof(EXCHANGE.answer)

// The function of the library; its driver calls metered_step instead.
#if defined(ASKED_AN937)
#define STEP fixpid_an937_step
#define STEP_RESULT int32_t
#define STEP_PARAMETERS FIXPID_DATA struct fixpid_an937 *self, int16_t error
#define STEP_ARGUMENTS self, error
#elif defined(ASKED_AN964)
#define STEP fixpid_an964_step
#define STEP_RESULT int16_t
#define STEP_PARAMETERS FIXPID_DATA struct fixpid_an964 *self, int16_t error
#define STEP_ARGUMENTS self, error
#elif defined(ASKED_AN964_8BIT)
#define STEP fixpid_an964_8bit_step
#define STEP_RESULT int16_t
#define STEP_PARAMETERS FIXPID_DATA struct fixpid_an964_8bit *self, int8_t error
#define STEP_ARGUMENTS self, error
#elif defined(ASKED_PID)
#define STEP fixpid_pid_step
#define STEP_RESULT int16_t
#define STEP_PARAMETERS                                                        \
    FIXPID_DATA struct fixpid_pid *self, int16_t setpoint, int16_t measurement
#define STEP_ARGUMENTS self, setpoint, measurement
#else
#error "which controller?"
#endif

#endif
