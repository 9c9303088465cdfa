// SPDX-License-Identifier: MIT
// The definition of fixpid_pid in 64-bit arithmetic, written from its manual
// and not from src/. Recorded rows, random operations and chips compare with
// it.
#ifndef REFERENCE_PID_H
#define REFERENCE_PID_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_pid.h"

// An all-zero one is refused, like the controller.
struct reference_pid {
    bool accepted, reverse, on_error;
    int64_t kp, ki, kd, filter, weight;
    int64_t ki_divisor; // ki / ki_divisor per step: 2^24, 2^16 or 2^8
    int64_t output_min, output_max, integral_min, integral_max;

    int64_t integral;   // x 2^24
    int64_t derivative; // x 2^8
    int64_t proportional_error, previous, feedforward, held;
    int64_t output; // of the last step, or as track was told since
    bool seen, seeded, manual, at_max, at_min, integral_at_limit;
};

// The features that a configuration needs and FIXPID_PID_FEATURES leaves out,
// and those that its gains do.
unsigned reference_pid_lacks(const struct fixpid_pid_config *config);
unsigned reference_pid_gains_lack(const struct fixpid_pid_gains *gains);

bool reference_pid_init(struct reference_pid *self,
                        const struct fixpid_pid_config *config);
void reference_pid_reset(struct reference_pid *self);
bool reference_pid_set_gains(struct reference_pid *self,
                             const struct fixpid_pid_gains *gains);
bool reference_pid_set_limits(struct reference_pid *self, int64_t low,
                              int64_t high);
bool reference_pid_set_integral_limits(struct reference_pid *self, int64_t low,
                                       int64_t high);
void reference_pid_set_feedforward(struct reference_pid *self, int64_t value);
void reference_pid_set_manual(struct reference_pid *self, int64_t output);
void reference_pid_set_auto(struct reference_pid *self);
void reference_pid_seed(struct reference_pid *self, int64_t output);
int64_t reference_pid_step(struct reference_pid *self, int64_t setpoint,
                           int64_t measurement);
int64_t reference_pid_step_error(struct reference_pid *self, int64_t error,
                                 int64_t rise);
void reference_pid_track(struct reference_pid *self, int64_t applied,
                         int64_t shift);

// What the getters return.
int64_t reference_pid_proportional(const struct reference_pid *self);
int64_t reference_pid_integral(const struct reference_pid *self);
uint8_t reference_pid_flags(const struct reference_pid *self);

#endif
