// SPDX-License-Identifier: MIT
// Objects whose bytes are any, or a good one's with some bits turned over: what
// the sanitizers see is undefined, and each step stays within its limits as
// they stand in the object.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixpid_an937.h"
#include "fixpid_an964.h"
#include "fixpid_an964_8bit.h"
#include "fixpid_autotune.h"
#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "fixpid_reaction.h"
#include "fixpid_slew.h"
#include "fixpid_tpo.h"
#include "fuzz.h"
#include "numbers.h"

#define STEPS 8

static struct fixpid_an937 an937;
static struct fixpid_an964 an964;
static struct fixpid_an964_8bit an964_8bit;
static struct fixpid_pid pid;
static struct fixpid_autotune autotune;
static struct fixpid_reaction reaction;
static struct fixpid_slew slew;
static struct fixpid_tpo tpo;
static struct fixpid_guard guard;

// What is not even a range answers with one of its ends.
static void within(int32_t low, int32_t high, int32_t answer)
{
    if (low <= high ? answer < low || answer > high
                    : answer != low && answer != high) {
        fprintf(stderr, "%ld, defined as %ld to %ld\n", (long)answer, (long)low,
                (long)high);
        abort();
    }
}

// Any bytes, or up to 3 bits turned over.
static void spoil(void *object, size_t size)
{
    uint8_t *const bytes = object;
    uint32_t bits = numbers_below(4);

    if (bits == 0u) {
        numbers_fill(object, size);
    }
    for (; bits != 0u; bits--) {
        bytes[numbers_below((uint32_t)size)] ^=
            (uint8_t)(1u << numbers_below(8));
    }
}

static void an937_steps(void)
{
    spoil(&an937, sizeof an937);
    for (unsigned i = 0; i < STEPS; i++) {
        if (numbers_below(2) == 0u) {
            fixpid_an937_tick(&an937);
        }
        within(-1048575, 1048575, fixpid_an937_step(&an937, numbers_int16()));
        within(-100, 100,
               fixpid_an937_step_percent(&an937, (int8_t)numbers_int16()));
        (void)fixpid_an937_proportional(&an937);
        (void)fixpid_an937_integral(&an937);
        (void)fixpid_an937_derivative(&an937);
        (void)fixpid_an937_accumulated_error(&an937);
        (void)fixpid_an937_stat1(&an937);
        (void)fixpid_an937_stat2(&an937);
    }
}

static void an964_steps(void)
{
    spoil(&an964, sizeof an964);
    spoil(&an964_8bit, sizeof an964_8bit);
    for (unsigned i = 0; i < STEPS; i++) {
        within(-1000, 1000, fixpid_an964_step(&an964, numbers_int16()));
        (void)fixpid_an964_integral(&an964);
        (void)fixpid_an964_derivative(&an964);
        within(-504, 504,
               fixpid_an964_8bit_step(&an964_8bit, (int8_t)numbers_int16()));
        (void)fixpid_an964_8bit_integral(&an964_8bit);
        (void)fixpid_an964_8bit_derivative(&an964_8bit);
    }
}

// A controller goes on from some bytes, or nothing of it changes.
static void pid_state(void)
{
    struct fixpid_pid before;
    uint8_t state[FIXPID_PID_STATE_SIZE];

    memcpy(&before, &pid, sizeof pid);
    fixpid_pid_state(&pid, state);
    spoil(state, sizeof state);
    if (!fixpid_pid_restore(&pid, state) &&
        (memcmp(&before, &pid, sizeof pid) != 0)) {
        fprintf(stderr, "a refused state changed the controller\n");
        abort();
    }
}

static void pid_call(void)
{
    const int16_t value = numbers_int16();

    switch (numbers_below(16)) {
    case 0:
        fixpid_pid_set_manual(&pid, value);
        break;
    case 1:
        fixpid_pid_set_auto(&pid);
        break;
    case 2:
        fixpid_pid_seed(&pid, value);
        break;
    case 3:
        fixpid_pid_set_feedforward(&pid, value);
        break;
    case 4:
        fixpid_pid_track(&pid, value, (uint8_t)numbers_below(17));
        break;
    case 5:
        (void)fixpid_pid_set_limits(&pid, value, numbers_int16());
        break;
    case 6:
        (void)fixpid_pid_set_integral_limits(&pid, value, numbers_int16());
        break;
    case 7:
        spoil(&pid, sizeof pid);
        break;
    case 8:
        within(pid.output_min, pid.output_max,
               fixpid_pid_step_error(&pid, (int32_t)value * 2,
                                     (int32_t)value * 65536));
        break;
    case 9:
        pid_state();
        break;
    default:
        break;
    }
}

static void pid_steps(void)
{
    spoil(&pid, sizeof pid);
    for (unsigned i = 0; i < STEPS; i++) {
        const int16_t setpoint = numbers_int16();

        pid_call();
        within(pid.output_min, pid.output_max,
               fixpid_pid_step(&pid, setpoint, numbers_int16()));
        (void)fixpid_pid_proportional(&pid);
        (void)fixpid_pid_integral(&pid);
        (void)fixpid_pid_derivative(&pid);
    }
}

static void gains_are_legal(const struct fixpid_pid_gains *gains)
{
    within(0, FIXPID_PID_KP_MAX, gains->kp_q8);
    within(0, FIXPID_PID_KI_MAX, (int32_t)gains->ki_q24);
    within(0, FIXPID_PID_KD_MAX, gains->kd_q8);
    within(0, FIXPID_PID_FILTER_MAX, gains->derivative_filter);
}

// Whatever was measured, the gains are legal, or there are none and a reason.
static void ask_autotune(void)
{
    struct fixpid_autotune_process process;
    struct fixpid_autotune_stage stage;
    struct fixpid_pid_config config = {.output_max = 1};

    fixpid_autotune_progress(&autotune, &stage);
    (void)fixpid_autotune_model(&autotune, &process);
    for (uint8_t rule = 0; rule < 3u; rule++) {
        const uint8_t robustness_q4 = (uint8_t)numbers_below(80);
        const bool found =
            fixpid_autotune_result(&autotune, rule, robustness_q4, &config);
        const uint8_t reason =
            fixpid_autotune_reason(&autotune, rule, robustness_q4);

        within(found ? FIXPID_AUTOTUNE_NO_REASON : FIXPID_AUTOTUNE_NOT_DONE,
               found ? FIXPID_AUTOTUNE_NO_REASON
                     : FIXPID_AUTOTUNE_GAIN_TOO_SMALL,
               reason);
        gains_are_legal(&config.gains);
    }
}

// An object that was packed comes back as it was, as far as it is asked.
static void autotune_record(void)
{
    struct fixpid_autotune_record record = {{0}};
    struct fixpid_autotune_record again;

    if (fixpid_autotune_pack(&autotune, &record) &&
        fixpid_autotune_unpack(&autotune, &record)) {
        (void)fixpid_autotune_pack(&autotune, &again);
        for (unsigned i = 0; i < sizeof record.bytes; i++) {
            within(record.bytes[i], record.bytes[i], again.bytes[i]);
        }
    }
    if (numbers_below(4) == 0u) {
        spoil(&record, sizeof record);
        (void)fixpid_autotune_unpack(&autotune, &record);
    }
}

static void autotune_steps(void)
{
    spoil(&autotune, sizeof autotune);
    if (numbers_below(2) == 0u) {
        autotune.state = FIXPID_AUTOTUNE_DONE;
    }
    ask_autotune();
    autotune_record();
    ask_autotune();
    for (unsigned i = 0; i < STEPS; i++) {
        const int16_t setpoint = numbers_int16();

        within(autotune.config.output_min, autotune.config.output_max,
               fixpid_autotune_step(&autotune, setpoint, numbers_int16()));
    }
}

static void reaction_steps(void)
{
    struct fixpid_reaction_process process;
    struct fixpid_pid_gains gains;

    spoil(&reaction, sizeof reaction);
    for (unsigned i = 0; i < STEPS; i++) {
        const int16_t output = fixpid_reaction_step(&reaction, numbers_int16());

        if (output != reaction.output_rest && output != 0) {
            within(reaction.output_drive, reaction.output_drive, output);
        }
        within(0, 100, fixpid_reaction_progress(&reaction));
    }
    (void)fixpid_reaction_model(&reaction, &process);
    (void)fixpid_reaction_result(&reaction, (uint8_t)numbers_below(2),
                                 (uint8_t)numbers_below(66), &gains);
}

static void other_steps(void)
{
    spoil(&slew, sizeof slew);
    spoil(&tpo, sizeof tpo);
    spoil(&guard, sizeof guard);
    for (unsigned i = 0; i < STEPS; i++) {
        const int16_t setpoint = numbers_int16();
        const int16_t measurement = numbers_int16();

        (void)fixpid_slew_step(&slew, numbers_int16());
        (void)fixpid_tpo_step(&tpo, numbers_int16());
        (void)fixpid_guard_step(&guard, setpoint, measurement, numbers_int16());
        (void)fixpid_guard_flags(&guard);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static void (*const kinds[])(void) = {an937_steps,    an964_steps,
                                          pid_steps,      autotune_steps,
                                          reaction_steps, other_steps};

    numbers_from(data, size);
    while (numbers_are_left()) {
        kinds[numbers_below(sizeof kinds / sizeof kinds[0])]();
    }
    return 0;
}
