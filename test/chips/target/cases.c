// SPDX-License-Identifier: MIT
#include "cases.h"

#include <stddef.h>
#include <string.h>

#include "fixpid_an937.h"
#include "numbers.h"
#include "numbers_pid.h"
#include "reference.h"
#include "reference_pid.h"
#include "vectors_columns.h"
#include "vectors_pid.h"

static bool first;         // no question has been asked yet
static bool first_row;     // no row has been read yet
static int32_t run;        // of the last row
static int16_t held_error; // the last random error
static uint8_t held_times; // how often it comes again: limits are reached

// The definitions, at power-on like all-zero controllers.
static struct reference_an937 an937 = {.countdown = 1, .period = 1};
static struct an964 {
    struct reference_an964 reference;
    bool ready;
} ten_bits, eight_bits;
static struct reference_pid pid;

static int16_t setpoint; // of the last random step

void cases_begin(uint32_t seed)
{
    numbers_seed(seed);
    first = true;
    first_row = true;
    held_times = 0;
    setpoint = 0;
}

// True for the first row of a run.
static bool fresh(int32_t this_run)
{
    const bool answer = first_row || this_run != run;

    first_row = false;
    run = this_run;
    return answer;
}

// ---- Random numbers ----

// An error of any size, one in eight held for up to a hundred steps.
static int16_t any_error(void)
{
    if (held_times != 0u) {
        held_times--;
    } else {
        held_error = (int16_t)(numbers_int16() / (1 << numbers_below(9)));
        if (numbers_below(8) == 0u) {
            held_times = (uint8_t)numbers_below(100);
        }
    }
    return held_error;
}

// 0..most, the ends and their neighbours often; one in 64 is beyond.
static uint16_t any_gain(uint16_t most)
{
    const uint32_t kind = numbers_below(64);

    if (kind == 0u) {
        return (uint16_t)(most + 1u + numbers_below(4) * 21u);
    }
    if (kind < 16u) {
        return (uint16_t)(most - numbers_below(3));
    }
    if (kind < 24u) {
        return (uint16_t)numbers_below(3);
    }
    if (kind < 32u) {
        return (uint16_t)((1u << numbers_below(10)) & most);
    }
    return (uint16_t)numbers_below(most + 1u);
}

// Calls before a step; most steps have none.
static uint8_t any_calls(uint8_t settings)
{
    const uint32_t kind = numbers_below(128);
    uint8_t calls = 0;

    if (first || kind < 2u) {
        calls = CALL_INIT;
    } else if (kind < 4u) {
        calls = CALL_RESET;
    } else if (kind < 16u) {
        calls = (uint8_t)(numbers_next() & settings);
    }
    first = false;
    return calls;
}

// ---- AN937 ----

static const struct member an937_members[] = {
    {"output", offsetof(struct an937_answer, output), 4},
    {"proportional", offsetof(struct an937_answer, proportional), 4},
    {"integral", offsetof(struct an937_answer, integral), 4},
    {"derivative", offsetof(struct an937_answer, derivative), 4},
    {"accumulated", offsetof(struct an937_answer, accumulated), 4},
    {"accepted", offsetof(struct an937_answer, accepted), 1},
    {"flags", offsetof(struct an937_answer, flags), 1},
    {"stat1", offsetof(struct an937_answer, stat1), 1},
    {"stat2", offsetof(struct an937_answer, stat2), 1},
    {NULL, 0, 0},
};

static uint16_t any_limit(void)
{
    static const uint16_t limits[] = {0,     1,     2,     255,   256,   4000,
                                      32767, 32768, 65534, 65535, 16711, 17};

    return limits[numbers_below(12)];
}

static void an937_ask(union question *question)
{
    struct an937_question *const asked = &question->an937;
    const uint32_t ticks = numbers_below(8);

    asked->calls = any_calls(CALL_SET_GAINS | CALL_SET_LIMIT | CALL_SET_PERIOD |
                             CALL_CLEAR_FLAGS | CALL_STEP_PERCENT);
    if (numbers_below(8) == 0u) {
        asked->calls |= CALL_GETTERS;
    }
    asked->limit = any_limit();
    asked->error = any_error();
    asked->kp_q4 = (uint8_t)any_gain(255);
    asked->ki_q4 = (uint8_t)any_gain(255);
    asked->kd_q4 = (uint8_t)any_gain(255);
    asked->period = numbers_below(4) == 0u ? (uint8_t)numbers_next()
                                           : (uint8_t)numbers_below(5);
    asked->ticks = ticks == 0u ? 2 : (ticks < 5u ? 1 : 0);
}

// A refused controller has gains and a limit of 0 and takes a derivative sample
// with every tick.
static void an937_calls(const struct an937_question *asked, uint8_t *accepted)
{
    const bool legal = asked->limit != 0u && asked->period != 0u;
    struct reference_an937 old;

    if ((asked->calls & CALL_INIT) != 0u) {
        reference_an937_init(&an937, 0, 0, 0, 0, 1);
        if (legal) {
            reference_an937_init(&an937, asked->kp_q4, asked->ki_q4,
                                 asked->kd_q4, asked->limit, asked->period);
            *accepted |= CALL_INIT;
        } else if (asked->period != 0u) {
            an937.period = asked->period;
        }
    }
    if ((asked->calls & CALL_RESET) != 0u) {
        old = an937;
        reference_an937_init(&an937, old.kp, old.ki, old.kd, old.limit,
                             old.period);
    }
    if ((asked->calls & CALL_CLEAR_FLAGS) != 0u) {
        an937.overrun = false;
    }
}

static void an937_settings(const struct an937_question *asked,
                           uint8_t *accepted)
{
    if (an937.limit == 0) {
        return;
    }
    if ((asked->calls & CALL_SET_GAINS) != 0u) {
        an937.kp = asked->kp_q4;
        an937.ki = asked->ki_q4;
        an937.kd = asked->kd_q4;
        *accepted |= CALL_SET_GAINS;
    }
    if ((asked->calls & CALL_SET_LIMIT) != 0u && asked->limit != 0u) {
        an937.limit = asked->limit;
        *accepted |= CALL_SET_LIMIT;
    }
    if ((asked->calls & CALL_SET_PERIOD) != 0u && asked->period != 0u) {
        an937.period = asked->period;
        *accepted |= CALL_SET_PERIOD;
    }
}

static int64_t an937_step(const struct an937_question *asked)
{
    int64_t percent;

    for (uint8_t tick = 0; tick < asked->ticks; tick++) {
        reference_an937_tick(&an937);
    }
    if ((asked->calls & CALL_STEP_PERCENT) == 0u) {
        return reference_an937_step(&an937, asked->error);
    }
    // The driver passes the error's low byte.
    percent = (asked->error & 0xFF) - ((asked->error & 0x80) != 0 ? 256 : 0);
    percent = reference_clamp(percent, -100, 100);
    return reference_clamp(reference_an937_step(&an937, percent * 40) / 1600,
                           -100, 100);
}

static void an937_getters(struct an937_answer *expected)
{
    expected->proportional = (int32_t)an937.proportional;
    expected->integral = (int32_t)an937.integral;
    expected->derivative = (int32_t)an937.derivative;
    expected->accumulated = (int32_t)an937.accumulated;
    expected->flags =
        (uint8_t)((an937.saturated ? FIXPID_AN937_SUM_SATURATED : 0u) |
                  (an937.limited ? FIXPID_AN937_ACCUMULATED_ERROR_LIMITED
                                 : 0u) |
                  (an937.overrun ? FIXPID_AN937_TICK_OVERRUN : 0u));
    expected->stat1 = reference_an937_stat1(&an937);
    expected->stat2 = an937.delta == 0 ? FIXPID_AN937_D_ERR_Z : 0u;
}

static void an937_define(const union question *question, union answer *answer)
{
    struct an937_answer *const expected = &answer->an937;

    memset(expected, 0, sizeof *expected);
    an937_calls(&question->an937, &expected->accepted);
    an937_settings(&question->an937, &expected->accepted);
    expected->output = (int32_t)an937_step(&question->an937);
    if ((question->an937.calls & CALL_GETTERS) != 0u) {
        an937_getters(expected);
    }
}

static int32_t with_sign_of(int32_t sign, int32_t magnitude)
{
    return sign < 0 ? -magnitude : magnitude;
}

// Columns: run, kp, ki, kd, error, tick, pid_out, a_error, d_error, prop,
// integ, deriv; the terms are magnitudes.
static void an937_row(const int32_t columns[], union question *question,
                      union answer *answer)
{
    const struct an937_question asked = {
        .limit = 4000,
        .error = (int16_t)columns[AN937_ERROR],
        .kp_q4 = (uint8_t)columns[AN937_KP],
        .ki_q4 = (uint8_t)columns[AN937_KI],
        .kd_q4 = (uint8_t)columns[AN937_KD],
        .period = 4,
        .calls = CALL_GETTERS | (fresh(columns[AN937_RUN]) ? CALL_INIT : 0u),
        .ticks = (uint8_t)columns[AN937_TICK],
    };

    question->an937 = asked;
    an937_define(question, answer); // flags and registers are not recorded
    answer->an937.output = columns[AN937_PID_OUT];
    answer->an937.accumulated = columns[AN937_A_ERROR];
    answer->an937.proportional =
        with_sign_of(columns[AN937_ERROR], columns[AN937_PROP]);
    answer->an937.integral =
        with_sign_of(columns[AN937_A_ERROR], columns[AN937_INTEG]);
    answer->an937.derivative =
        with_sign_of(columns[AN937_D_ERROR], columns[AN937_DERIV]);
}

// ---- AN964, both forms ----

static const struct member an964_members[] = {
    {"output", offsetof(struct an964_answer, output), 2},
    {"proportional", offsetof(struct an964_answer, proportional), 2},
    {"integral", offsetof(struct an964_answer, integral), 2},
    {"derivative", offsetof(struct an964_answer, derivative), 2},
    {"accepted", offsetof(struct an964_answer, accepted), 1},
    {"flags", offsetof(struct an964_answer, flags), 1},
    {NULL, 0, 0},
};

struct gains {
    uint16_t kp, ki, kd;
};

static bool an964_set(struct an964 *self, const struct gains *gains,
                      uint16_t most)
{
    if (!self->ready || gains->kp > most || gains->ki > most ||
        gains->kd > most) {
        return false;
    }
    self->reference.kp = gains->kp;
    self->reference.ki = gains->ki;
    self->reference.kd = gains->kd;
    return true;
}

// `most` is the largest legal gain.
static uint8_t an964_calls(struct an964 *self, uint8_t calls,
                           const struct gains *gains, uint16_t most)
{
    uint8_t accepted = 0;

    if ((calls & (CALL_INIT | CALL_RESET)) != 0u) {
        self->reference.sum = 0;
        memset(self->reference.history, 0, sizeof self->reference.history);
    }
    if ((calls & CALL_INIT) != 0u) {
        self->ready = true;
        self->ready = an964_set(self, gains, most);
        if (self->ready) {
            accepted |= CALL_INIT;
        } else {
            self->reference.kp = 0;
            self->reference.ki = 0;
            self->reference.kd = 0;
        }
    }
    if ((calls & CALL_SET_GAINS) != 0u && an964_set(self, gains, most)) {
        accepted |= CALL_SET_GAINS;
    }
    return accepted;
}

static void an964_step(struct an964 *self, int16_t error,
                       struct an964_answer *expected)
{
    expected->output = (int16_t)reference_an964_step(&self->reference, error);
    expected->proportional = (int16_t)self->reference.proportional;
    expected->integral = (int16_t)self->reference.integral;
    expected->derivative = (int16_t)self->reference.derivative;
    expected->flags =
        (uint8_t)((self->reference.sum_limited ? FIXPID_AN964_SUM_LIMITED
                                               : 0u) |
                  (self->reference.output_limited ? FIXPID_AN964_OUTPUT_LIMITED
                                                  : 0u));
}

static void an964_ask(union question *question)
{
    question->an964.calls = any_calls(CALL_SET_GAINS);
    question->an964.error = any_error();
    question->an964.gains.kp = any_gain(1023);
    question->an964.gains.ki = any_gain(1023);
    question->an964.gains.kd = any_gain(1023);
    question->an964.unused = 0;
}

static void an964_define(const union question *question, union answer *answer)
{
    const struct an964_question *const asked = &question->an964;
    const struct gains gains = {asked->gains.kp, asked->gains.ki,
                                asked->gains.kd};

    ten_bits.reference.form = reference_an964_10bit();
    answer->an964.accepted = an964_calls(&ten_bits, asked->calls, &gains, 1023);
    an964_step(&ten_bits, asked->error, &answer->an964);
}

// Columns: run, kp, ki, kd, error, sum, integral, derivative, out.
static void an964_row(const int32_t columns[], union question *question,
                      union answer *answer)
{
    const struct an964_question asked = {
        .gains = {(uint16_t)columns[AN964_KP], (uint16_t)columns[AN964_KI],
                  (uint16_t)columns[AN964_KD]},
        .error = (int16_t)columns[AN964_ERROR],
        .calls = fresh(columns[AN964_RUN]) ? CALL_INIT : 0u,
    };

    question->an964 = asked;
    an964_define(question, answer); // the flags are not recorded
    answer->an964.output = (int16_t)columns[AN964_OUT];
    answer->an964.proportional = (int16_t)columns[AN964_ERROR];
    answer->an964.integral = (int16_t)columns[AN964_INTEGRAL];
    answer->an964.derivative = (int16_t)columns[AN964_DERIVATIVE];
}

static void an964_8bit_ask(union question *question)
{
    const int64_t error = any_error();

    question->an964_8bit.calls = any_calls(CALL_SET_GAINS);
    question->an964_8bit.error =
        (int8_t)reference_clamp(error, INT8_MIN, INT8_MAX);
    question->an964_8bit.gains.kp = (uint8_t)any_gain(127);
    question->an964_8bit.gains.ki = (uint8_t)any_gain(127);
    question->an964_8bit.gains.kd = (uint8_t)any_gain(127);
}

static void an964_8bit_define(const union question *question,
                              union answer *answer)
{
    const struct an964_8bit_question *const asked = &question->an964_8bit;
    const struct gains gains = {asked->gains.kp, asked->gains.ki,
                                asked->gains.kd};

    eight_bits.reference.form = reference_an964_8bit();
    answer->an964.accepted =
        an964_calls(&eight_bits, asked->calls, &gains, 127);
    an964_step(&eight_bits, asked->error, &answer->an964);
}

// Nothing was recorded of this form: a row of the 10-bit form's inputs, with
// its errors, which are bytes, an eighth of its gains, and the definition's
// answer.
static void an964_8bit_row(const int32_t columns[], union question *question,
                           union answer *answer)
{
    const struct an964_8bit_question asked = {
        .gains = {(uint8_t)(columns[AN964_KP] / 8),
                  (uint8_t)(columns[AN964_KI] / 8),
                  (uint8_t)(columns[AN964_KD] / 8)},
        .error = (int8_t)columns[AN964_ERROR],
        .calls = fresh(columns[AN964_RUN]) ? CALL_INIT : 0u,
    };

    question->an964_8bit = asked;
    an964_8bit_define(question, answer);
}

// ---- The general-purpose controller ----

static const struct member pid_members[] = {
    {"proportional", offsetof(struct pid_answer, proportional), 4},
    {"integral", offsetof(struct pid_answer, integral), 4},
    {"derivative", offsetof(struct pid_answer, derivative), 4},
    {"output", offsetof(struct pid_answer, output), 2},
    {"last_output", offsetof(struct pid_answer, last_output), 2},
    {"accepted", offsetof(struct pid_answer, accepted), 1},
    {"flags", offsetof(struct pid_answer, flags), 1},
    {NULL, 0, 0},
};

// Any, but half of them below the actuators' ranges.
static int16_t any_applied(void)
{
    const int16_t applied = numbers_int16();

    return (int16_t)(numbers_below(2) == 0u ? applied : applied / 128);
}

// The calls of features that are left out, by FIXPID_PID_FEATURES.
static uint16_t missing_calls(void)
{
    const unsigned missing = ~(unsigned)FIXPID_PID_FEATURES;
    unsigned calls = 0;

    if ((missing & FIXPID_PID_HAS_FEEDFORWARD) != 0u) {
        calls |= CALL_SET_FEEDFORWARD;
    }
    if ((missing & FIXPID_PID_HAS_MANUAL) != 0u) {
        calls |= CALL_SET_MANUAL | CALL_SET_AUTO | CALL_SEED |
                 CALL_SET_MANUAL_AFTER | CALL_SET_AUTO_AFTER | CALL_SEED_AFTER;
    }
    if ((missing & FIXPID_PID_HAS_TRACK) != 0u) {
        calls |= CALL_TRACK | CALL_TRACK_AFTER;
    }
    return (uint16_t)calls;
}

// One call before most of the steps that have any, and often only tracking.
static uint16_t any_pid_calls(void)
{
    const uint32_t kind = numbers_below(128);
    uint16_t calls = 0;

    if (first || kind < 2u) {
        calls = CALL_INIT;
    } else if (kind < 20u) {
        calls = (uint16_t)(1u << numbers_below(15));
    } else if (kind < 22u) {
        calls = (uint16_t)numbers_below(0x8000);
    } else if (kind < 46u) {
        calls = CALL_TRACK_AFTER;
    }
    first = false;
    return calls;
}

static void pid_ask(union question *question)
{
    struct pid_question *const asked = &question->pid;
    struct fixpid_pid_config config;

    numbers_pid_config(&config);
    asked->ki_q24 = config.gains.ki_q24;
    asked->kp_q8 = config.gains.kp_q8;
    asked->kd_q8 = config.gains.kd_q8;
    asked->derivative_filter = config.gains.derivative_filter;
    asked->output_min = config.output_min;
    asked->output_max = config.output_max;
    asked->integral_min = config.integral_min;
    asked->integral_max = config.integral_max;
    asked->setpoint_weight_q8 = config.setpoint_weight_q8;
    asked->options = vectors_pid_options_of(&config);
    asked->calls = (uint16_t)(any_pid_calls() & ~missing_calls());
    asked->value = numbers_int16();
    asked->value_after = numbers_int16();
    asked->applied = any_applied();
    asked->shift_before = (uint8_t)numbers_below(256);
    asked->shift = (uint8_t)numbers_below(numbers_below(4) == 0u ? 256 : 18);
    asked->unused = 0;
    numbers_pid_inputs(&setpoint, &asked->measurement);
    asked->setpoint = setpoint;
}

static struct fixpid_pid_config pid_configuration(
    const struct pid_question *asked)
{
    struct fixpid_pid_config config = {
        .gains = {.ki_q24 = asked->ki_q24,
                  .kp_q8 = asked->kp_q8,
                  .kd_q8 = asked->kd_q8,
                  .derivative_filter = asked->derivative_filter},
        .output_min = asked->output_min,
        .output_max = asked->output_max,
        .integral_min = asked->integral_min,
        .integral_max = asked->integral_max,
        .setpoint_weight_q8 = asked->setpoint_weight_q8,
    };

    vectors_pid_set_options(&config, asked->options);
    return config;
}

static void pid_start(const struct pid_question *asked, uint8_t *accepted)
{
    const struct fixpid_pid_config config = pid_configuration(asked);

    if ((asked->calls & CALL_INIT) != 0u && reference_pid_init(&pid, &config)) {
        *accepted |= CALL_INIT;
    }
    if ((asked->calls & CALL_RESET) != 0u) {
        reference_pid_reset(&pid);
    }
    if ((asked->calls & CALL_SET_GAINS) != 0u &&
        reference_pid_set_gains(&pid, &config.gains)) {
        *accepted |= CALL_SET_GAINS;
    }
}

static void pid_set(const struct pid_question *asked, uint8_t *accepted)
{
    if ((asked->calls & CALL_SET_LIMITS) != 0u &&
        reference_pid_set_limits(&pid, asked->output_min, asked->output_max)) {
        *accepted |= CALL_SET_LIMITS;
    }
    if ((asked->calls & CALL_SET_INTEGRAL_LIMITS) != 0u &&
        reference_pid_set_integral_limits(&pid, asked->integral_min,
                                          asked->integral_max)) {
        *accepted |= CALL_SET_INTEGRAL_LIMITS;
    }
    if ((asked->calls & CALL_SET_FEEDFORWARD) != 0u) {
        reference_pid_set_feedforward(&pid, asked->value);
    }
    if ((asked->calls & CALL_SET_MANUAL) != 0u) {
        reference_pid_set_manual(&pid, asked->value);
    }
    if ((asked->calls & CALL_SET_AUTO) != 0u) {
        reference_pid_set_auto(&pid);
    }
    if ((asked->calls & CALL_SEED) != 0u) {
        reference_pid_seed(&pid, asked->value);
    }
    if ((asked->calls & CALL_TRACK) != 0u) {
        reference_pid_track(&pid, asked->value, asked->shift_before);
    }
}

static void pid_after(const struct pid_question *asked)
{
    if ((asked->calls & CALL_RESET_AFTER) != 0u) {
        reference_pid_reset(&pid);
    }
    if ((asked->calls & CALL_SET_MANUAL_AFTER) != 0u) {
        reference_pid_set_manual(&pid, asked->value_after);
    }
    if ((asked->calls & CALL_SET_AUTO_AFTER) != 0u) {
        reference_pid_set_auto(&pid);
    }
    if ((asked->calls & CALL_SEED_AFTER) != 0u) {
        reference_pid_seed(&pid, asked->value_after);
    }
    if ((asked->calls & CALL_TRACK_AFTER) != 0u) {
        reference_pid_track(&pid, asked->applied, asked->shift);
    }
}

static void pid_define(const union question *question, union answer *answer)
{
    const struct pid_question *const asked = &question->pid;
    struct pid_answer *const expected = &answer->pid;

    expected->accepted = 0;
    pid_start(asked, &expected->accepted);
    pid_set(asked, &expected->accepted);
    expected->output =
        (int16_t)reference_pid_step(&pid, asked->setpoint, asked->measurement);
    pid_after(asked);
    expected->last_output = (int16_t)pid.output;
    expected->unused = 0;
    expected->proportional = (int32_t)reference_pid_proportional(&pid);
    expected->integral = (int32_t)reference_pid_integral(&pid);
    expected->derivative = (int32_t)pid.derivative;
    expected->flags = reference_pid_flags(&pid);
}

// Leaves out of a row's question the calls of missing features. Returns whether
// what was recorded holds: not from such a call on, nor after gains that need
// such a feature, until the next init.
static bool recording_holds(struct pid_question *asked)
{
    static bool holds;
    const struct fixpid_pid_config config = pid_configuration(asked);
    unsigned missing = asked->calls & missing_calls();

    if ((asked->calls & CALL_INIT) != 0u) {
        holds = true;
        missing |= reference_pid_lacks(&config);
    }
    if ((asked->calls & CALL_SET_GAINS) != 0u) {
        missing |= reference_pid_gains_lack(&config.gains);
    }
    asked->calls &= (uint16_t)~missing_calls();
    holds = holds && missing == 0u;
    return holds;
}

// Columns: run, kp_q8, ki_q24, kd_q8, filter, output_min, output_max,
// integral_min, integral_max, weight_q8, options, event, value, setpoint,
// measurement, output, p_q8, i_q16, d_q8, status. The event is 0, or the number
// of the call's bit, counted from 1.
static void pid_row(const int32_t columns[], union question *question,
                    union answer *answer)
{
    struct pid_question asked = {
        .ki_q24 = (uint32_t)columns[PID_KI],
        .kp_q8 = (uint16_t)columns[PID_KP],
        .kd_q8 = (uint16_t)columns[PID_KD],
        .output_min = (int16_t)columns[PID_OUTPUT_MIN],
        .output_max = (int16_t)columns[PID_OUTPUT_MAX],
        .integral_min = (int16_t)columns[PID_INTEGRAL_MIN],
        .integral_max = (int16_t)columns[PID_INTEGRAL_MAX],
        .setpoint_weight_q8 = (uint16_t)columns[PID_WEIGHT],
        .value = (int16_t)columns[PID_VALUE],
        .setpoint = (int16_t)columns[PID_SETPOINT],
        .measurement = (int16_t)columns[PID_MEASUREMENT],
        .calls = (uint16_t)((1u << columns[PID_EVENT]) >> 1),
        .derivative_filter = (uint8_t)columns[PID_FILTER],
        .options =
            vectors_pid_options(columns[PID_OPTIONS], columns[PID_WEIGHT]),
    };

    const bool holds = recording_holds(&asked);

    question->pid = asked;
    pid_define(question, answer); // what was accepted is not recorded
    if (!holds) {
        return;
    }
    answer->pid.output = (int16_t)columns[PID_OUTPUT];
    answer->pid.proportional = columns[PID_P];
    answer->pid.integral = columns[PID_I];
    answer->pid.derivative = columns[PID_D];
    answer->pid.flags = (uint8_t)((answer->pid.flags & ~VECTORS_PID_FLAGS) |
                                  (uint8_t)columns[PID_STATUS]);
}

// The limits that were set are the values.
static void track_row(const int32_t columns[], union question *question,
                      union answer *answer)
{
    static const uint16_t calls_after[] = {0,
                                           0,
                                           CALL_RESET_AFTER,
                                           0,
                                           0,
                                           0,
                                           0,
                                           CALL_SET_MANUAL_AFTER,
                                           CALL_SET_AUTO_AFTER,
                                           CALL_SEED_AFTER};
    const bool outputs = columns[TRACK_EVENT] == PID_SET_LIMITS;
    const bool integrals = columns[TRACK_EVENT] == PID_SET_INTEGRAL_LIMITS;
    struct pid_question asked = {
        .ki_q24 = (uint32_t)columns[PID_KI],
        .kp_q8 = (uint16_t)columns[PID_KP],
        .kd_q8 = (uint16_t)columns[PID_KD],
        .output_min = (int16_t)columns[outputs ? TRACK_VALUE : PID_OUTPUT_MIN],
        .output_max = (int16_t)columns[outputs ? TRACK_VALUE2 : PID_OUTPUT_MAX],
        .integral_min =
            (int16_t)columns[integrals ? TRACK_VALUE : PID_INTEGRAL_MIN],
        .integral_max =
            (int16_t)columns[integrals ? TRACK_VALUE2 : PID_INTEGRAL_MAX],
        .setpoint_weight_q8 = (uint16_t)columns[PID_WEIGHT],
        .value = (int16_t)columns[TRACK_VALUE],
        .value_after = (int16_t)columns[TRACK_VALUE3],
        .applied = (int16_t)columns[TRACK_APPLIED],
        .setpoint = (int16_t)columns[TRACK_SETPOINT],
        .measurement = (int16_t)columns[TRACK_MEASUREMENT],
        .calls =
            (uint16_t)(((1u << columns[TRACK_EVENT]) >> 1) |
                       calls_after[columns[TRACK_EVENT2]] |
                       (columns[TRACK_TRACKED] != 0 ? CALL_TRACK_AFTER : 0u)),
        .derivative_filter = (uint8_t)columns[PID_FILTER],
        .options = (uint8_t)columns[PID_OPTIONS],
        .shift_before = (uint8_t)columns[TRACK_VALUE2],
        .shift = (uint8_t)columns[TRACK_SHIFT],
    };
    const bool holds = recording_holds(&asked);
    const uint8_t before = (uint8_t)(asked.calls & 0x1Fu);

    question->pid = asked;
    pid_define(question, answer);
    if (!holds) {
        return;
    }
    // An event that has a result is one of these.
    if ((before & (CALL_INIT | CALL_SET_GAINS | CALL_SET_LIMITS |
                   CALL_SET_INTEGRAL_LIMITS)) != 0u) {
        answer->pid.accepted = columns[TRACK_ACCEPTED] != 0 ? before : 0u;
    }
    answer->pid.output = (int16_t)columns[TRACK_OUTPUT];
    answer->pid.last_output = (int16_t)columns[TRACK_LAST_OUTPUT];
    answer->pid.proportional = columns[TRACK_P];
    answer->pid.integral = columns[TRACK_I];
    answer->pid.derivative = columns[TRACK_D];
    answer->pid.flags = (uint8_t)columns[TRACK_STATUS];
}

static const struct recording an937_recordings[] = {
    {"an937_firmware", 2000, an937_row}, {NULL, 0, NULL}};
static const struct recording an964_recordings[] = {
    {"an964_firmware", 2000, an964_row}, {NULL, 0, NULL}};
static const struct recording an964_8bit_recordings[] = {
    {"an964_firmware", 2000, an964_8bit_row}, {NULL, 0, NULL}};
static const struct recording pid_recordings[] = {
    {"pid_definition", 2000, pid_row},
    {"track", 1000, track_row},
    {"rest", 600, track_row},
    {NULL, 0, NULL}};

// The size of an object without padding at its end.
#define UP_TO(type, last) (offsetof(type, last) + sizeof(((type *)0)->last))

// On the chips whose memory is filled, an int and `previous` have 16 bits.
#define PID_SIZE (UP_TO(struct fixpid_pid, output) - sizeof(int) + 2u)

const struct controller controllers[CONTROLLERS] = {
    {"an937", sizeof(struct an937_question), sizeof(struct an937_answer),
     offsetof(struct an937_question, calls),
     UP_TO(struct fixpid_an937, step_flags), an937_members, an937_recordings,
     an937_ask, an937_define},
    {"an964", sizeof(struct an964_question), sizeof(struct an964_answer),
     offsetof(struct an964_question, calls), UP_TO(struct fixpid_an964, ready),
     an964_members, an964_recordings, an964_ask, an964_define},
    {"an964_8bit", sizeof(struct an964_8bit_question),
     sizeof(struct an964_answer), offsetof(struct an964_8bit_question, calls),
     UP_TO(struct fixpid_an964_8bit, ready), an964_members,
     an964_8bit_recordings, an964_8bit_ask, an964_8bit_define},
    {"pid", sizeof(struct pid_question), sizeof(struct pid_answer),
     offsetof(struct pid_question, calls), PID_SIZE, pid_members,
     pid_recordings, pid_ask, pid_define},
};

const struct controller *controller_named(const char *name)
{
    for (unsigned number = 0; number < CONTROLLERS; number++) {
        if (strcmp(controllers[number].name, name) == 0) {
            return &controllers[number];
        }
    }
    return NULL;
}
