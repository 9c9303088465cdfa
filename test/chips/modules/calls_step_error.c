// SPDX-License-Identifier: MIT
// fixpid_pid's two steps by turns: recorded ones, and random ones of which some
// calls are exact, so that both steps would do the same. Before each one the
// state is taken out and restored. A PIC18F4520 has no room for the rows:
// -DCALLS_WITHOUT_ROWS.
#include "calls.h"
#include "fixpid_pid.h"
#include "numbers.h"
#include "numbers_control.h"
#include "numbers_pid.h"
#include "vectors_pid.h"

#ifdef CALLS_DEFINED
#include "reference_pid.h"
static struct reference_pid reference;
#define DEFINE(call) (call)
#else
#define DEFINE(call) ((void)0)
#endif

FIXPID_DATA struct fixpid_pid pid_errors;

static struct fixpid_pid_config config;
static int16_t measurement; // of the last random step

static void set(uint8_t event, int16_t value, int16_t value2)
{
    bool good = true;

    switch (event) {
    case PID_INIT:
        good = fixpid_pid_init(&pid_errors, &config);
        DEFINE(reference_pid_init(&reference, &config));
        break;
    case PID_RESET:
        fixpid_pid_reset(&pid_errors);
        DEFINE(reference_pid_reset(&reference));
        break;
    case PID_SET_GAINS:
        good = fixpid_pid_set_gains(&pid_errors, &config.gains);
        DEFINE(reference_pid_set_gains(&reference, &config.gains));
        break;
    case PID_SET_LIMITS:
        good = fixpid_pid_set_limits(&pid_errors, value, value2);
        DEFINE(reference_pid_set_limits(&reference, value, value2));
        break;
    case PID_SET_INTEGRAL_LIMITS:
        good = fixpid_pid_set_integral_limits(&pid_errors, value, value2);
        DEFINE(reference_pid_set_integral_limits(&reference, value, value2));
        break;
    default:
        break;
    }
    calls_answer(good ? 1u : 0u, good ? 1u : 0u);
}

static void call(uint8_t event, int16_t value, int16_t value2)
{
    switch (event) {
    case PID_SET_FEEDFORWARD:
        fixpid_pid_set_feedforward(&pid_errors, value);
        DEFINE(reference_pid_set_feedforward(&reference, value));
        break;
    case PID_SET_MANUAL:
        fixpid_pid_set_manual(&pid_errors, value);
        DEFINE(reference_pid_set_manual(&reference, value));
        break;
    case PID_SET_AUTO:
        fixpid_pid_set_auto(&pid_errors);
        DEFINE(reference_pid_set_auto(&reference));
        break;
    case PID_SEED:
        fixpid_pid_seed(&pid_errors, value);
        DEFINE(reference_pid_seed(&reference, value));
        break;
    case PID_TRACK:
        fixpid_pid_track(&pid_errors, value, (uint8_t)value2);
        DEFINE(reference_pid_track(&reference, value, (uint8_t)value2));
        break;
    default:
        set(event, value, value2);
        break;
    }
}

static void answer(int32_t given, uint32_t defined)
{
    calls_answer((uint32_t)given, defined);
}

// As if another controller went on: all that a reset leaves are the settings.
static void go_on(void)
{
    uint8_t state[FIXPID_PID_STATE_SIZE];

    fixpid_pid_state(&pid_errors, state);
    if ((state[2] & FIXPID_PID_REFUSED) == 0u) {
        fixpid_pid_reset(&pid_errors);
        (void)fixpid_pid_restore(&pid_errors, state);
    }
}

#define ANSWER(given, definition)                                              \
    answer((given), DEFINED((definition), (uint32_t)(given)))

// What can be read after a step, and what the step returned.
static void answer_all(int16_t output)
{
    ANSWER(output, reference.output);
    ANSWER(fixpid_pid_proportional(&pid_errors),
           reference_pid_proportional(&reference));
    ANSWER(fixpid_pid_integral(&pid_errors),
           reference_pid_integral(&reference));
    ANSWER(fixpid_pid_derivative(&pid_errors), reference.derivative);
    ANSWER(fixpid_pid_flags(&pid_errors), reference_pid_flags(&reference));
}

static void step(int16_t setpoint, int16_t now)
{
    go_on();
    DEFINE((void)reference_pid_step(&reference, setpoint, now));
    answer_all(fixpid_pid_step(&pid_errors, setpoint, now));
}

static void step_error(int32_t error, int32_t rise)
{
    go_on();
    DEFINE((void)reference_pid_step_error(&reference, error, rise));
    answer_all(fixpid_pid_step_error(&pid_errors, error, rise));
}

#ifdef CALLS_WITHOUT_ROWS
void calls_rows(void)
{
    // there are none
}
#else
#include "rows_step_error.h"

static void configure(uint16_t row)
{
    config.gains.kp_q8 = rows_kp_q8[row];
    config.gains.ki_q24 = rows_ki_q24[row];
    config.gains.kd_q8 = rows_kd_q8[row];
    config.gains.derivative_filter = rows_filter[row];
    config.output_min = rows_output_min[row];
    config.output_max = rows_output_max[row];
    config.integral_min = rows_integral_min[row];
    config.integral_max = rows_integral_max[row];
    config.setpoint_weight_q8 = rows_weight_q8[row];
    vectors_pid_set_options(&config, rows_options[row]);
}

void calls_rows(void)
{
    for (uint16_t row = 0; row < ROWS; row++) {
        configure(row);
        call(rows_event[row], rows_value[row], rows_value2[row]);
        if (rows_by_error[row] != 0u) {
            step_error(rows_first[row], rows_second[row]);
        } else {
            step((int16_t)rows_first[row], (int16_t)rows_second[row]);
        }
        if (rows_tracked[row] != 0u) {
            call(PID_TRACK, rows_applied[row], rows_shift[row]);
        }
    }
}

#endif

static void random_call(uint8_t event)
{
    const int16_t value = numbers_int16();

    if (event == PID_INIT) {
        numbers_pid_config(&config);
    }
    if ((event == PID_INIT) || (event == PID_RESET)) {
        measurement = 0;
    }
    numbers_pid_gains(&config.gains);
    call(event, value, numbers_int16());
}

// Any difference, half of them small.
static int32_t any_difference(void)
{
    const int16_t small = (int16_t)(numbers_int16() / 64);
    const uint32_t any = (uint32_t)(uint16_t)numbers_int16() << 16;

    return numbers_one_in(2) ? small
                             : (int32_t)(any | (uint16_t)numbers_int16());
}

static void random_step(int16_t *setpoint)
{
    const int16_t last = measurement;
    int32_t error;

    numbers_pid_inputs(setpoint, &measurement);
    switch (numbers_below(4)) {
    case 0:
        step(*setpoint, measurement);
        break;
    case 1:
        error = any_difference();
        step_error(error, any_difference());
        break;
    default:
        step_error((int32_t)*setpoint - measurement,
                   (int32_t)measurement - last);
        break;
    }
}

void calls_random(uint32_t count)
{
    int16_t setpoint = 0;

    random_call(PID_INIT);
    for (uint32_t i = 0; i < count; i++) {
        if (numbers_one_in(16)) {
            random_call((uint8_t)(1u + numbers_below(10)));
        }
        random_step(&setpoint);
    }
}
