// SPDX-License-Identifier: MIT
#include "exchange.h"
#include "fixpid_pid.h"

#define QUESTION pid_exchange.question
#define ANSWER pid_exchange.answer

// In object mode the library is built for the object of this name.
FIXPID_DATA struct fixpid_pid FIXPID_PID_PLACE pid_controller;

union pid_exchange pid_exchange;

// Its members are padded differently on each machine, so it is not a part of
// the question.
static struct fixpid_pid_config config;

static uint8_t accepted;

// Whether the library has a feature: its functions have no declaration else.
#define WITH(feature) ((FIXPID_PID_FEATURES & (feature)) != 0)

static bool called(uint16_t call)
{
    return (QUESTION.calls & call) != 0u;
}

static void accept(bool good, uint8_t call)
{
    if (good) {
        accepted |= call;
    }
}

static void configure(void)
{
    config.gains.ki_q24 = QUESTION.ki_q24;
    config.gains.kp_q8 = QUESTION.kp_q8;
    config.gains.kd_q8 = QUESTION.kd_q8;
    config.gains.derivative_filter = QUESTION.derivative_filter;
    config.output_min = QUESTION.output_min;
    config.output_max = QUESTION.output_max;
    config.integral_min = QUESTION.integral_min;
    config.integral_max = QUESTION.integral_max;
    config.setpoint_weight_q8 = QUESTION.setpoint_weight_q8;
    config.reverse = (QUESTION.options & 0x80u) != 0u;
    config.derivative_on_error = (QUESTION.options & 0x40u) != 0u;
    config.proportional_on_measurement = (QUESTION.options & 0x20u) != 0u;
    if ((QUESTION.options & 0x1Fu) != 0u) { // a row that is refused
        config.setpoint_weight_q8 = 0xFFFFu;
    }
}

static void start(void)
{
    accepted = 0;
    configure();
    if (called(CALL_INIT)) {
        DRIVER_POISON(pid_controller);
        accept(fixpid_pid_init(&pid_controller, &config), CALL_INIT);
    }
    if (called(CALL_RESET)) {
        fixpid_pid_reset(&pid_controller);
    }
    if (called(CALL_SET_GAINS)) {
        accept(fixpid_pid_set_gains(&pid_controller, &config.gains),
               CALL_SET_GAINS);
    }
}

static void set(void)
{
    if (called(CALL_SET_LIMITS)) {
        accept(fixpid_pid_set_limits(&pid_controller, QUESTION.output_min,
                                     QUESTION.output_max),
               CALL_SET_LIMITS);
    }
    if (called(CALL_SET_INTEGRAL_LIMITS)) {
        accept(fixpid_pid_set_integral_limits(&pid_controller,
                                              QUESTION.integral_min,
                                              QUESTION.integral_max),
               CALL_SET_INTEGRAL_LIMITS);
    }
}

#if WITH(FIXPID_PID_HAS_FEEDFORWARD)
static void feed_forward(void)
{
    if (called(CALL_SET_FEEDFORWARD)) {
        fixpid_pid_set_feedforward(&pid_controller, QUESTION.value);
    }
}
#else
#define feed_forward() ((void)0)
#endif

#if WITH(FIXPID_PID_HAS_MANUAL)
static void choose_mode(void)
{
    if (called(CALL_SET_MANUAL)) {
        fixpid_pid_set_manual(&pid_controller, QUESTION.value);
    }
    if (called(CALL_SET_AUTO)) {
        fixpid_pid_set_auto(&pid_controller);
    }
    if (called(CALL_SEED)) {
        fixpid_pid_seed(&pid_controller, QUESTION.value);
    }
}

static void choose_mode_after(void)
{
    if (called(CALL_SET_MANUAL_AFTER)) {
        fixpid_pid_set_manual(&pid_controller, QUESTION.value_after);
    }
    if (called(CALL_SET_AUTO_AFTER)) {
        fixpid_pid_set_auto(&pid_controller);
    }
    if (called(CALL_SEED_AFTER)) {
        fixpid_pid_seed(&pid_controller, QUESTION.value_after);
    }
}
#else
#define choose_mode() ((void)0)
#define choose_mode_after() ((void)0)
#endif

#if WITH(FIXPID_PID_HAS_TRACK)
static void track(void)
{
    if (called(CALL_TRACK)) {
        fixpid_pid_track(&pid_controller, QUESTION.value,
                         QUESTION.shift_before);
    }
}

static int16_t track_after(int16_t output)
{
    (void)output;
    if (called(CALL_TRACK_AFTER)) {
        fixpid_pid_track(&pid_controller, QUESTION.applied, QUESTION.shift);
    }
    return fixpid_pid_output(&pid_controller);
}
#else
#define track() ((void)0)

// What the controller would remember.
static int16_t track_after(int16_t output)
{
    return called(CALL_RESET_AFTER) ? 0 : output;
}
#endif

// The question ends where the answer begins: after the last call.
void pid_reply(void)
{
    int16_t output;
    int16_t last_output;

    start();
    set();
    feed_forward();
    choose_mode();
    track();
    output = fixpid_pid_step(&pid_controller, QUESTION.setpoint,
                             QUESTION.measurement);
    if (called(CALL_RESET_AFTER)) {
        fixpid_pid_reset(&pid_controller);
    }
    choose_mode_after();
    last_output = track_after(output);
    ANSWER.output = output;
    ANSWER.last_output = last_output;
    ANSWER.unused = 0;
    ANSWER.accepted = accepted;
    ANSWER.proportional = fixpid_pid_proportional(&pid_controller);
    ANSWER.integral = fixpid_pid_integral(&pid_controller);
    ANSWER.derivative = fixpid_pid_derivative(&pid_controller);
    ANSWER.flags = fixpid_pid_flags(&pid_controller);
}
