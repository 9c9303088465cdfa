// SPDX-License-Identifier: MIT
// Replays a recorded file of test/support/vectors/ through the public
// interface:
//
//   replay an937 FILE
//   replay an964 FILE
//   replay pid FILE
//   replay track FILE
//   replay step_error FILE
//   replay slew FILE
//   replay tpo FILE
//   replay guard FILE
//   replay gains FILE
//   replay table FILE
//
// Exit status: 0 no row differs, 1 some do, 2 the file or the call is wrong,
// 77 the library was built with other limits than the recording, or without
// what was recorded.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixpid_an937.h"
#include "fixpid_an964.h"
#include "fixpid_gains.h"
#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "fixpid_slew.h"
#include "fixpid_table.h"
#include "fixpid_tpo.h"
#include "vectors.h"
#include "vectors_columns.h"
#include "vectors_pid.h"

#define REPORTED_MAX 10 // differing values; the rest is only counted
#define EXIT_WRONG_FILE 2
#define EXIT_SKIPPED 77

// What was called before the row's step of a slew, a tpo or a guard.
enum {
    EVENT_NOTHING,
    EVENT_INIT,
    EVENT_RESET,
    EVENT_SET_RATES,
    EVENT_ACKNOWLEDGE = EVENT_SET_RATES, // of a guard
    EVENT_SEED
};

static const char *path;
static int row, reported; // the header is row 0

static void stop(const char *why)
{
    fprintf(stderr, "replay: %s, row %d: %s\n", path, row, why);
    exit(EXIT_WRONG_FILE);
}

// True if equal; else says what differs.
static bool same(const char *what, int32_t recorded, int32_t computed)
{
    if (recorded == computed) {
        return true;
    }
    if (reported < REPORTED_MAX) {
        printf("row %d: %s: recorded %" PRId32 ", computed %" PRId32 "\n", row,
               what, recorded, computed);
        reported++;
    }
    return false;
}

static bool an937_row_is_same(const int32_t at[], bool fresh)
{
    static struct fixpid_an937 pid;
    const struct fixpid_an937_config config = {
        .kp_q4 = (uint8_t)at[AN937_KP],
        .ki_q4 = (uint8_t)at[AN937_KI],
        .kd_q4 = (uint8_t)at[AN937_KD],
        .accumulated_error_limit = 4000,
        .derivative_period_ticks = 4,
    };
    const int32_t error = at[AN937_ERROR];
    const int32_t a_error = at[AN937_A_ERROR];
    const int32_t d_error = at[AN937_D_ERROR];
    bool equal = true;

    if (fresh) {
        equal &= same("init", true, fixpid_an937_init(&pid, &config));
    }
    if (at[AN937_TICK] != 0) {
        fixpid_an937_tick(&pid);
    }
    equal &= same("pid_out", at[AN937_PID_OUT],
                  fixpid_an937_step(&pid, (int16_t)error));
    equal &= same("a_error", a_error, fixpid_an937_accumulated_error(&pid));
    equal &= same("d_error * kd", d_error * at[AN937_KD],
                  fixpid_an937_derivative(&pid));
    equal &= same("prop", error < 0 ? -at[AN937_PROP] : at[AN937_PROP],
                  fixpid_an937_proportional(&pid));
    equal &= same("integ", a_error < 0 ? -at[AN937_INTEG] : at[AN937_INTEG],
                  fixpid_an937_integral(&pid));
    equal &= same("deriv", d_error < 0 ? -at[AN937_DERIV] : at[AN937_DERIV],
                  fixpid_an937_derivative(&pid));
    return equal;
}

static bool an964_row_is_same(const int32_t at[], bool fresh)
{
    static struct fixpid_an964 pid;
    const struct fixpid_an964_gains gains = {
        .kp = (uint16_t)at[AN964_KP],
        .ki = (uint16_t)at[AN964_KI],
        .kd = (uint16_t)at[AN964_KD],
    };
    bool equal = true;

    if (fresh) {
        equal &= same("init", true, fixpid_an964_init(&pid, &gains));
    }
    equal &= same("out", at[AN964_OUT],
                  fixpid_an964_step(&pid, (int16_t)at[AN964_ERROR]));
    equal &= same("error", at[AN964_ERROR], fixpid_an964_proportional(&pid));
    // The sum itself has no getter: it shows in the integral term.
    equal &=
        same("sum / 256 * ki / 16", at[AN964_SUM] / 256 * at[AN964_KI] / 16,
             fixpid_an964_integral(&pid));
    equal &= same("integral", at[AN964_INTEGRAL], fixpid_an964_integral(&pid));
    equal &=
        same("derivative", at[AN964_DERIVATIVE], fixpid_an964_derivative(&pid));
    return equal;
}

static void slew_event(struct fixpid_slew *slew, const int32_t at[])
{
    const uint32_t rise = (uint32_t)at[SLEW_RISE];
    const uint32_t fall = (uint32_t)at[SLEW_FALL];

    switch (at[SLEW_EVENT]) {
    case EVENT_NOTHING:
        break;
    case EVENT_INIT:
        fixpid_slew_init(slew, rise, fall);
        break;
    case EVENT_RESET:
        fixpid_slew_reset(slew);
        break;
    case EVENT_SET_RATES:
        fixpid_slew_set_rates(slew, rise, fall);
        break;
    case EVENT_SEED:
        fixpid_slew_seed(slew, (int16_t)at[SLEW_SEED]);
        break;
    default:
        stop("has an unknown event");
    }
}

static bool slew_row_is_same(const int32_t at[], bool fresh)
{
    static struct fixpid_slew slew;
    bool equal = true;

    (void)fresh; // is an event of its own
    slew_event(&slew, at);
    equal &= same("output", at[SLEW_OUTPUT],
                  fixpid_slew_step(&slew, (int16_t)at[SLEW_TARGET]));
    equal &= same("value_q16", at[SLEW_VALUE], fixpid_slew_value(&slew));
    return equal;
}

static bool tpo_row_is_same(const int32_t at[], bool fresh)
{
    static struct fixpid_tpo tpo;
    const struct fixpid_tpo_config config = {
        .full = (int16_t)at[TPO_FULL],
        .window = (uint16_t)at[TPO_WINDOW],
        .minimum_on = (uint16_t)at[TPO_MINIMUM_ON],
        .minimum_off = (uint16_t)at[TPO_MINIMUM_OFF],
    };
    bool accepted = true;
    bool equal = true;

    (void)fresh;
    if (at[TPO_EVENT] == EVENT_INIT) {
        accepted = fixpid_tpo_init(&tpo, &config);
    } else if (at[TPO_EVENT] == EVENT_RESET) {
        fixpid_tpo_reset(&tpo);
    }
    equal &= same("accepted", at[TPO_ACCEPTED], accepted);
    equal &=
        same("on", at[TPO_ON], fixpid_tpo_step(&tpo, (int16_t)at[TPO_DUTY]));
    return equal;
}

// A row's options are bits. One with another bit stands for what is refused.
static struct fixpid_guard_config guard_config(const int32_t at[])
{
    const unsigned options = (unsigned)at[GUARD_OPTIONS];
    const struct fixpid_guard_config config = {
        .output_min = (int16_t)at[GUARD_OUTPUT_MIN],
        .output_max = (int16_t)at[GUARD_OUTPUT_MAX],
        .measurement_min = (int16_t)at[GUARD_MEASUREMENT_MIN],
        .measurement_max = (int16_t)at[GUARD_MEASUREMENT_MAX],
        .reach_min = (int16_t)at[GUARD_REACH_MIN],
        .reach_max = (int16_t)at[GUARD_REACH_MAX],
        .band = (uint16_t)at[GUARD_BAND],
        .patience = (options & 0x3Fu) != 0u ? 0u : (uint16_t)at[GUARD_PATIENCE],
        .reverse = (options & 0x80u) != 0u,
        .noisy = (options & 0x40u) != 0u,
    };

    return config;
}

static bool guard_row_is_same(const int32_t at[], bool fresh)
{
    static struct fixpid_guard guard;
    const struct fixpid_guard_config config = guard_config(at);
    bool accepted = true;
    bool equal = true;
    uint8_t flags = 0;

    (void)fresh;
    if (at[GUARD_EVENT] == EVENT_INIT) {
        accepted = fixpid_guard_init(&guard, &config);
    } else if (at[GUARD_EVENT] == EVENT_RESET) {
        fixpid_guard_reset(&guard);
    } else if (at[GUARD_EVENT] == EVENT_ACKNOWLEDGE) {
        fixpid_guard_acknowledge(&guard);
    }
    equal &= same("accepted", at[GUARD_ACCEPTED], accepted);
    equal &= same("flags_before", at[GUARD_FLAGS_BEFORE],
                  fixpid_guard_flags(&guard));
    for (int32_t i = 0; i < at[GUARD_REPEAT]; i++) {
        flags = fixpid_guard_step(&guard, (int16_t)at[GUARD_SETPOINT],
                                  (int16_t)at[GUARD_MEASUREMENT],
                                  (int16_t)at[GUARD_OUTPUT]);
    }
    equal &= same("flags", at[GUARD_FLAGS], flags);
    return equal;
}

static bool gains_row_is_same(const int32_t at[], bool fresh)
{
    const struct fixpid_gains_milli milli = {
        .kp = (uint32_t)at[GAINS_KP_MILLI],
        .ki = (uint32_t)at[GAINS_KI_MILLI],
        .kd = (uint32_t)at[GAINS_KD_MILLI],
    };
    const uint32_t rate = (uint32_t)at[GAINS_RATE];
    struct fixpid_pid_gains gains = {0, 0, 0, 0};
    struct fixpid_gains_milli back = {0, 0, 0};
    const bool accepted = fixpid_gains_from_milli(&gains, &milli, rate,
                                                  (uint8_t)at[GAINS_FILTER]);
    const bool back_accepted =
        accepted && fixpid_gains_to_milli(&back, &gains, rate);
    bool equal = true;

    (void)fresh;
    equal &= same("accepted", at[GAINS_ACCEPTED], accepted);
    equal &= same("kp_q8", at[GAINS_KP], gains.kp_q8);
    equal &= same("ki_q24", at[GAINS_KI], (int32_t)gains.ki_q24);
    equal &= same("kd_q8", at[GAINS_KD], gains.kd_q8);
    equal &= same("back_accepted", at[GAINS_BACK_ACCEPTED], back_accepted);
    equal &= same("kp_back", at[GAINS_KP_BACK], (int32_t)back.kp);
    equal &= same("ki_back", at[GAINS_KI_BACK], (int32_t)back.ki);
    equal &= same("kd_back", at[GAINS_KD_BACK], (int32_t)back.kd);
    return equal;
}

static bool table_row_is_same(const int32_t at[], bool fresh)
{
    static struct fixpid_table_point points[255];
    static struct fixpid_table table = {points, 0};
    const int32_t x = at[TABLE_X];
    const int32_t y = at[TABLE_Y];

    if (fresh) {
        table.count = 0;
    }
    switch (at[TABLE_KIND]) {
    case TABLE_POINT:
        points[table.count].x = (int16_t)x;
        points[table.count].y = (int16_t)y;
        table.count++;
        return true;
    case TABLE_VERDICT:
        return same("count", x, table.count) &&
               same("valid", y, fixpid_table_valid(&table));
    case TABLE_LOOKUP:
        return same("y", y, fixpid_table_at(&table, (int16_t)x));
    default:
        stop("has an unknown kind");
    }
    return false;
}

// The rows of fixpid_pid and of what folds its gains need all of its features,
// but for tracking.
#if (FIXPID_PID_FEATURES | FIXPID_PID_HAS_TRACK) == FIXPID_PID_ALL
#define PID_IS_WHOLE true

static struct fixpid_pid_config pid_config(const int32_t at[])
{
    struct fixpid_pid_config config;

    vectors_pid_config(&config, at);
    return config;
}

static bool pid_event(struct fixpid_pid *pid, const int32_t at[])
{
    struct fixpid_pid_config config = pid_config(at);
    const int16_t value = (int16_t)at[PID_VALUE];

    vectors_pid_set_options(
        &config, vectors_pid_options(at[PID_OPTIONS], at[PID_WEIGHT]));
    switch (at[PID_EVENT]) {
    case PID_NOTHING:
        return true;
    case PID_INIT:
        return fixpid_pid_init(pid, &config);
    case PID_RESET:
        fixpid_pid_reset(pid);
        return true;
    case PID_SET_GAINS:
        return fixpid_pid_set_gains(pid, &config.gains);
    case PID_SET_LIMITS:
        return fixpid_pid_set_limits(pid, config.output_min, config.output_max);
    case PID_SET_INTEGRAL_LIMITS:
        return fixpid_pid_set_integral_limits(pid, config.integral_min,
                                              config.integral_max);
    case PID_SET_FEEDFORWARD:
        fixpid_pid_set_feedforward(pid, value);
        return true;
    case PID_SET_MANUAL:
        fixpid_pid_set_manual(pid, value);
        return true;
    case PID_SET_AUTO:
        fixpid_pid_set_auto(pid);
        return true;
    case PID_SEED:
        fixpid_pid_seed(pid, value);
        return true;
    default:
        stop("has an unknown event");
    }
    return false;
}

static bool pid_row_is_same(const int32_t at[], bool fresh)
{
    static struct fixpid_pid pid;
    bool equal = true;

    (void)fresh; // is an event of its own
    equal &= same("event", true, pid_event(&pid, at));
    equal &= same("output", at[PID_OUTPUT],
                  fixpid_pid_step(&pid, (int16_t)at[PID_SETPOINT],
                                  (int16_t)at[PID_MEASUREMENT]));
    equal &= same("p_q8", at[PID_P], fixpid_pid_proportional(&pid));
    equal &= same("i_q16", at[PID_I], fixpid_pid_integral(&pid));
    equal &= same("d_q8", at[PID_D], fixpid_pid_derivative(&pid));
    equal &= same("flags", at[PID_STATUS],
                  fixpid_pid_flags(&pid) & VECTORS_PID_FLAGS);
    return equal;
}

#else
#define PID_IS_WHOLE false

static bool pid_row_is_same(const int32_t at[], bool fresh)
{
    (void)at;
    (void)fresh;
    return false;
}
#endif

#if FIXPID_PID_FEATURES == FIXPID_PID_ALL
#define TRACK_IS_BUILT true

// Some of these were refused, and the limits are arguments.
static bool track_event(struct fixpid_pid *pid, const int32_t at[])
{
    const struct fixpid_pid_config config = pid_config(at);
    const int16_t value = (int16_t)at[TRACK_VALUE];
    const int16_t value2 = (int16_t)at[TRACK_VALUE2];

    switch (at[TRACK_EVENT]) {
    case PID_INIT:
        return fixpid_pid_init(pid, &config);
    case PID_SET_LIMITS:
        return fixpid_pid_set_limits(pid, value, value2);
    case PID_SET_INTEGRAL_LIMITS:
        return fixpid_pid_set_integral_limits(pid, value, value2);
    case PID_TRACK:
        fixpid_pid_track(pid, value, (uint8_t)value2);
        return true;
    default:
        return pid_event(pid, at);
    }
}

static void track_after_step(struct fixpid_pid *pid, const int32_t at[])
{
    int32_t event[PID_COLUMNS];

    memcpy(event, at, sizeof event);
    event[PID_EVENT] = at[TRACK_EVENT2];
    event[PID_VALUE] = at[TRACK_VALUE3];
    (void)pid_event(pid, event);
    if (at[TRACK_TRACKED] != 0) {
        fixpid_pid_track(pid, (int16_t)at[TRACK_APPLIED],
                         (uint8_t)at[TRACK_SHIFT]);
    }
}

static bool track_row_is_same(const int32_t at[], bool fresh)
{
    static struct fixpid_pid pid;
    bool equal = true;

    (void)fresh; // is an event of its own
    equal &= same("accepted", at[TRACK_ACCEPTED], track_event(&pid, at));
    equal &= same("output", at[TRACK_OUTPUT],
                  fixpid_pid_step(&pid, (int16_t)at[TRACK_SETPOINT],
                                  (int16_t)at[TRACK_MEASUREMENT]));
    track_after_step(&pid, at);
    equal &=
        same("last_output", at[TRACK_LAST_OUTPUT], fixpid_pid_output(&pid));
    equal &= same("p_q8", at[TRACK_P], fixpid_pid_proportional(&pid));
    equal &= same("i_q16", at[TRACK_I], fixpid_pid_integral(&pid));
    equal &= same("d_q8", at[TRACK_D], fixpid_pid_derivative(&pid));
    equal &= same("flags", at[TRACK_STATUS], fixpid_pid_flags(&pid));
    return equal;
}

static int16_t either_step(struct fixpid_pid *pid, const int32_t at[])
{
    const int32_t first = at[BY_ERROR_FIRST];
    const int32_t second = at[BY_ERROR_SECOND];

    return at[BY_ERROR] != 0
               ? fixpid_pid_step_error(pid, first, second)
               : fixpid_pid_step(pid, (int16_t)first, (int16_t)second);
}

static bool step_error_row_is_same(const int32_t at[], bool fresh)
{
    static struct fixpid_pid pid;
    bool equal = true;

    (void)fresh; // is an event of its own
    equal &= same("accepted", at[TRACK_ACCEPTED], track_event(&pid, at));
    equal &= same("output", at[BY_ERROR_OUTPUT], either_step(&pid, at));
    if (at[BY_ERROR_TRACKED] != 0) {
        fixpid_pid_track(&pid, (int16_t)at[BY_ERROR_APPLIED],
                         (uint8_t)at[BY_ERROR_SHIFT]);
    }
    equal &=
        same("last_output", at[BY_ERROR_LAST_OUTPUT], fixpid_pid_output(&pid));
    equal &= same("p_q8", at[BY_ERROR_P], fixpid_pid_proportional(&pid));
    equal &= same("i_q16", at[BY_ERROR_I], fixpid_pid_integral(&pid));
    equal &= same("d_q8", at[BY_ERROR_D], fixpid_pid_derivative(&pid));
    equal &= same("flags", at[BY_ERROR_STATUS], fixpid_pid_flags(&pid));
    return equal;
}
#else
#define TRACK_IS_BUILT false
#define step_error_row_is_same pid_row_is_same
#define track_row_is_same pid_row_is_same
#endif

static int replay(const char *name, int rows, unsigned columns,
                  bool (*row_is_same)(const int32_t at[], bool fresh))
{
    int32_t at[VECTORS_COLUMNS_MAX];
    int32_t run = -1;
    int different = 0;

    vectors_open_file(path);
    while (vectors_next(at)) {
        row++;
        if (vectors_columns != columns) {
            stop("does not have the columns of this recording");
        }
        different += row_is_same(at, at[0] != run) ? 0 : 1;
        run = at[0];
    }
    if (row != rows) {
        stop("is not the last one that is expected");
    }
    printf("%d rows of %s: %d different\n", row, name, different);
    return different == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

// Whether the rows need a feature that fixpid_pid is built without.
static bool lacks_feature(const char *name)
{
    if (strcmp(name, "track") == 0 || strcmp(name, "rest") == 0 ||
        strcmp(name, "step_error") == 0) {
        return !TRACK_IS_BUILT;
    }
    return !PID_IS_WHOLE &&
           (strcmp(name, "pid") == 0 || strcmp(name, "gains") == 0);
}

int main(int argc, char *argv[])
{
    const bool limits_of_the_note = FIXPID_AN964_SUM_LIMIT == 30000 &&
                                    FIXPID_AN964_TERM_LIMIT == 120 &&
                                    FIXPID_AN964_OUTPUT_LIMIT == 1000;

    path = argc == 3 ? argv[2] : "";
    if (argc == 3 && strcmp(argv[1], "an937") == 0) {
        return replay("an937", 2000, AN937_COLUMNS, an937_row_is_same);
    }
    if (argc == 3 && strcmp(argv[1], "an964") == 0) {
        if (limits_of_the_note) {
            return replay("an964", 2000, AN964_COLUMNS, an964_row_is_same);
        }
        printf("an964: skipped, recorded with other limits\n");
        return EXIT_SKIPPED;
    }
    if (argc == 3 && lacks_feature(argv[1])) {
        printf("%s: skipped, fixpid_pid is built without a feature\n", argv[1]);
        return EXIT_SKIPPED;
    }
    if (argc == 3 && strcmp(argv[1], "pid") == 0) {
        return replay("pid", 2000, PID_COLUMNS, pid_row_is_same);
    }
    if (argc == 3 && strcmp(argv[1], "track") == 0) {
        return replay("track", 1000, TRACK_COLUMNS, track_row_is_same);
    }
    if (argc == 3 && strcmp(argv[1], "rest") == 0) {
        return replay("rest", 600, TRACK_COLUMNS, track_row_is_same);
    }
    if (argc == 3 && strcmp(argv[1], "step_error") == 0) {
        return replay("step_error", 500, BY_ERROR_COLUMNS,
                      step_error_row_is_same);
    }
    if (argc == 3 && strcmp(argv[1], "slew") == 0) {
        return replay("slew", 1000, SLEW_COLUMNS, slew_row_is_same);
    }
    if (argc == 3 && strcmp(argv[1], "tpo") == 0) {
        return replay("tpo", 1000, TPO_COLUMNS, tpo_row_is_same);
    }
    if (argc == 3 && strcmp(argv[1], "guard") == 0) {
        return replay("guard", 1000, GUARD_COLUMNS, guard_row_is_same);
    }
    if (argc == 3 && strcmp(argv[1], "gains") == 0) {
        return replay("gains", 1000, GAINS_COLUMNS, gains_row_is_same);
    }
    if (argc == 3 && strcmp(argv[1], "table") == 0) {
        return replay("table", 800, TABLE_COLUMNS, table_row_is_same);
    }
    fprintf(stderr, "usage: replay an937|an964|pid|track|step_error|slew|tpo|"
                    "guard|gains|table FILE\n");
    return EXIT_WRONG_FILE;
}
