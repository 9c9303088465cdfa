// SPDX-License-Identifier: MIT
// Any configuration of a fixpid_pid, and whether two are the same.
#ifndef PID_CONFIG_H
#define PID_CONFIG_H
#include "prove.h"

#include "fixpid_pid.h"

struct fixpid_pid_config nondet_pid_config(void);

static struct fixpid_pid_config any_config(void)
{
    struct fixpid_pid_config config = nondet_pid_config();

    config.reverse = any_bool;
    config.derivative_on_error = any_bool;
    config.proportional_on_measurement = any_bool;
    return config;
}

static bool same_limits(const struct fixpid_pid_config *a,
                        const struct fixpid_pid_config *b)
{
    return (a->output_min == b->output_min) &&
           (a->output_max == b->output_max) &&
           (a->integral_min == b->integral_min) &&
           (a->integral_max == b->integral_max);
}

// What only an init sets.
static bool same_kind(const struct fixpid_pid_config *a,
                      const struct fixpid_pid_config *b)
{
    return (a->setpoint_weight_q8 == b->setpoint_weight_q8) &&
           (a->reverse == b->reverse) &&
           (a->derivative_on_error == b->derivative_on_error) &&
           (a->proportional_on_measurement == b->proportional_on_measurement);
}

static bool same_config(const struct fixpid_pid_config *a,
                        const struct fixpid_pid_config *b)
{
    return (a->gains.kp_q8 == b->gains.kp_q8) &&
           (a->gains.ki_q24 == b->gains.ki_q24) &&
           (a->gains.kd_q8 == b->gains.kd_q8) &&
           (a->gains.derivative_filter == b->gains.derivative_filter) &&
           same_limits(a, b) && same_kind(a, b);
}

#endif
