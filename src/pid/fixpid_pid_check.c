// SPDX-License-Identifier: MIT
// Which field fixpid_pid_init refuses. It is in a file of its own, because SDCC
// links whole object files, and not what init itself asks, which need not tell
// one field from another.
#include "fixpid_pid.h"

#include "fixpid_pid_private.h"

static enum fixpid_pid_problem gains_problem(
    const struct fixpid_pid_gains *gains)
{
    if (gains->kp_q8 > FIXPID_PID_KP_MAX) {
        return FIXPID_PID_BAD_KP_Q8;
    }
    if (gains->ki_q24 > FIXPID_PID_KI_MAX) {
        return FIXPID_PID_BAD_KI_Q24;
    }
    if (gains->kd_q8 > FIXPID_PID_KD_MAX) {
        return FIXPID_PID_BAD_KD_Q8;
    }
    if (gains->derivative_filter > FIXPID_PID_FILTER_MAX) {
        return FIXPID_PID_BAD_DERIVATIVE_FILTER;
    }
    return FIXPID_PID_OK;
}

// What this firmware lacks. With all features it asks nothing, because
// SDCC would warn of conditions that are never true.
#if (FIXPID_PID_FEATURES & (FIXPID_PID_HAS_WEIGHT | FIXPID_PID_HAS_REVERSE |   \
                            FIXPID_PID_HAS_DERIVATIVE_ON_ERROR)) ==            \
    (FIXPID_PID_HAS_WEIGHT | FIXPID_PID_HAS_REVERSE |                          \
     FIXPID_PID_HAS_DERIVATIVE_ON_ERROR)
FIXPID_INLINE enum fixpid_pid_problem feature_problem(
    const struct fixpid_pid_config *config)
{
    (void)config;
    return FIXPID_PID_OK;
}
#else
static bool lacks(unsigned feature, bool wanted)
{
    if (!wanted) {
        return false;
    }
    return (FEATURES & feature) == 0u;
}

static enum fixpid_pid_problem feature_problem(
    const struct fixpid_pid_config *config)
{
    if (lacks(FIXPID_PID_HAS_WEIGHT,
              (uint8_t)config->setpoint_weight_q8 != 0u)) {
        return FIXPID_PID_BAD_SETPOINT_WEIGHT_Q8;
    }
    if (lacks(FIXPID_PID_HAS_REVERSE, config->reverse)) {
        return FIXPID_PID_BAD_REVERSE;
    }
    if (lacks(FIXPID_PID_HAS_DERIVATIVE_ON_ERROR,
              config->derivative_on_error)) {
        return FIXPID_PID_BAD_DERIVATIVE_ON_ERROR;
    }
    if (lacks(FIXPID_PID_HAS_WEIGHT, config->proportional_on_measurement)) {
        return FIXPID_PID_BAD_PROPORTIONAL_ON_MEASUREMENT;
    }
    return FIXPID_PID_OK;
}
#endif

enum fixpid_pid_problem fixpid_pid_check(const struct fixpid_pid_config *config)
{
    enum fixpid_pid_problem problem;
    uint16_t weight_most = WEIGHT_ONE;

    FIXPID_ASSERT(config != 0);
    problem = gains_problem(&config->gains);
    if (problem != FIXPID_PID_OK) {
        return problem;
    }
    if (config->output_min >= config->output_max) {
        return FIXPID_PID_BAD_OUTPUT_MAX;
    }
    if (config->integral_min == INT16_MIN) {
        return FIXPID_PID_BAD_INTEGRAL_MIN;
    }
    if (config->integral_min > config->integral_max) {
        return FIXPID_PID_BAD_INTEGRAL_MAX;
    }
    if (config->proportional_on_measurement) {
        weight_most = 0;
    }
    if (config->setpoint_weight_q8 > weight_most) {
        return FIXPID_PID_BAD_SETPOINT_WEIGHT_Q8;
    }
    return feature_problem(config);
}
