// SPDX-License-Identifier: MIT
// With FIXPID_ASSERT as assert: every function of every controller stops a
// caller whose pointer is wrong, and no other caller. Wrong is a null pointer,
// or, in object mode, any controller but the program's one.
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fixpid_an937.h"
#include "fixpid_an964.h"
#include "fixpid_an964_8bit.h"
#include "fixpid_autotune.h"
#include "fixpid_gains.h"
#include "fixpid_pid.h"
#include "fixpid_record.h"
#include "fixpid_relay.h"
#include "fixpid_slew.h"
#include "fixpid_tpo.h"

struct fixpid_an937 an937;
struct fixpid_an964 an964;
struct fixpid_an964_8bit an964_8bit;
struct fixpid_pid pid;
struct fixpid_relay relay;
struct fixpid_autotune autotune;
static struct fixpid_slew slew;
static struct fixpid_tpo tpo;

#ifdef FIXPID_AN937_OBJECT
static struct fixpid_an937 second_an937;
static struct fixpid_an964 second_an964;
static struct fixpid_an964_8bit second_an964_8bit;
static struct fixpid_pid second_pid;
static struct fixpid_relay second_relay;
static struct fixpid_autotune second_autotune;
#define WRONG(controller) (&second_##controller)
#else
#define WRONG(controller) NULL
#endif

static const struct fixpid_an937_config config = {96, 80, 16, 4000, 4};
static const struct fixpid_an964_gains gains = {600, 40, 100};
static const struct fixpid_an964_8bit_gains gains_8bit = {75, 5, 12};
static const struct fixpid_autotune_config experiment = {0, 255,  0, -1, 1024,
                                                         0, 1000, 2, 0};
static struct fixpid_autotune_model model;
static struct fixpid_pid_config whole;
static const struct fixpid_relay_config simple = {0, 255,  0, 0, 1023,
                                                  4, 1000, 3, 0};
static struct fixpid_pid_gains tuned;

static const struct fixpid_pid_config valve = {
    FIXPID_PID_GAINS(2, 0.5, 0.1, 10, 1), 0, 255, -32767, 32767, 256, 0};

static const struct fixpid_tpo_config window = {255, 10, 1, 1};
static const struct fixpid_gains_milli typed = {2000, 500, 100};
static struct fixpid_gains_milli shown;
static struct fixpid_record record;
static struct fixpid_pid_config unpacked;

#define CALLS 85

static void call(int number, bool wrong)
{
    struct fixpid_an937 *const a = wrong ? WRONG(an937) : &an937;
    struct fixpid_an964 *const b = wrong ? WRONG(an964) : &an964;
    struct fixpid_an964_8bit *const c = wrong ? WRONG(an964_8bit) : &an964_8bit;
    struct fixpid_pid *const d = wrong ? WRONG(pid) : &pid;
    struct fixpid_relay *const e = wrong ? WRONG(relay) : &relay;
    struct fixpid_autotune *const h = wrong ? WRONG(autotune) : &autotune;
    struct fixpid_slew *const f = wrong ? NULL : &slew; // no object mode
    struct fixpid_tpo *const g = wrong ? NULL : &tpo;

    // clang-format off
    switch (number) {
    case 0: fixpid_an937_init(a, &config); break;
    case 1: fixpid_an937_reset(a); break;
    case 2: fixpid_an937_set_gains(a, 1, 2, 3); break;
    case 3: fixpid_an937_set_accumulated_error_limit(a, 1); break;
    case 4: fixpid_an937_set_derivative_period(a, 1); break;
    case 5: fixpid_an937_tick(a); break;
    case 6: fixpid_an937_step(a, 1); break;
    case 7: fixpid_an937_step_percent(a, 1); break;
    case 8: fixpid_an937_proportional(a); break;
    case 9: fixpid_an937_integral(a); break;
    case 10: fixpid_an937_derivative(a); break;
    case 11: fixpid_an937_accumulated_error(a); break;
    case 12: fixpid_an937_stat1(a); break;
    case 13: fixpid_an937_stat2(a); break;
    case 14: fixpid_an937_flags(a); break;
    case 15: fixpid_an937_clear_flags(a); break;
    case 16: fixpid_an964_init(b, &gains); break;
    case 17: fixpid_an964_reset(b); break;
    case 18: fixpid_an964_set_gains(b, 1, 2, 3); break;
    case 19: fixpid_an964_step(b, 1); break;
    case 20: fixpid_an964_proportional(b); break;
    case 21: fixpid_an964_integral(b); break;
    case 22: fixpid_an964_derivative(b); break;
    case 23: fixpid_an964_flags(b); break;
    case 24: fixpid_an964_8bit_init(c, &gains_8bit); break;
    case 25: fixpid_an964_8bit_reset(c); break;
    case 26: fixpid_an964_8bit_set_gains(c, 1, 2, 3); break;
    case 27: fixpid_an964_8bit_step(c, 1); break;
    case 28: fixpid_an964_8bit_proportional(c); break;
    case 29: fixpid_an964_8bit_integral(c); break;
    case 30: fixpid_an964_8bit_derivative(c); break;
    case 31: fixpid_an964_8bit_flags(c); break;
    case 32: // a missing configuration instead of a wrong controller
        fixpid_an937_init(&an937, wrong ? NULL : &config);
        break;
    case 33: fixpid_pid_init(d, &valve); break;
    case 34: fixpid_pid_reset(d); break;
    case 35: fixpid_pid_set_gains(d, &valve.gains); break;
    case 36: fixpid_pid_set_limits(d, 0, 1); break;
    case 37: fixpid_pid_set_integral_limits(d, 0, 1); break;
    case 38: fixpid_pid_set_feedforward(d, 1); break;
    case 39: fixpid_pid_set_manual(d, 1); break;
    case 40: fixpid_pid_set_auto(d); break;
    case 41: fixpid_pid_seed(d, 1); break;
    case 42: fixpid_pid_step(d, 1, 2); break;
    case 43: fixpid_pid_proportional(d); break;
    case 44: fixpid_pid_integral(d); break;
    case 45: fixpid_pid_derivative(d); break;
    case 46: fixpid_pid_flags(d); break;
    case 47: fixpid_pid_init(&pid, wrong ? NULL : &valve); break;
    case 48: fixpid_pid_set_gains(&pid, wrong ? NULL : &valve.gains); break;
    case 49: fixpid_relay_init(e, &simple); break;
    case 50: fixpid_relay_reset(e); break;
    case 51: fixpid_relay_step(e, 1, 2); break;
    case 52: fixpid_relay_status(e); break;
    case 53: fixpid_relay_result(e, 0, &tuned); break;
    case 54: fixpid_relay_init(&relay, wrong ? NULL : &simple); break;
    case 55: // nowhere to put the gains
        fixpid_relay_result(&relay, 0, wrong ? NULL : &tuned);
        break;
    case 56: fixpid_pid_track(d, 1, 2); break;
    case 57: fixpid_pid_output(d); break;
    case 58: fixpid_slew_init(f, 1, 2); break;
    case 59: fixpid_slew_reset(f); break;
    case 60: fixpid_slew_set_rates(f, 1, 2); break;
    case 61: fixpid_slew_seed(f, 1); break;
    case 62: fixpid_slew_step(f, 1); break;
    case 63: fixpid_slew_value(f); break;
    case 64: fixpid_tpo_init(g, &window); break;
    case 65: fixpid_tpo_init(&tpo, wrong ? NULL : &window); break;
    case 66: fixpid_tpo_reset(g); break;
    case 67: fixpid_tpo_step(g, 1); break;
    case 68:
        fixpid_gains_from_milli(wrong ? NULL : &tuned, &typed, 1000, 0);
        break;
    case 69:
        fixpid_gains_from_milli(&tuned, wrong ? NULL : &typed, 1000, 0);
        break;
    case 70:
        fixpid_gains_to_milli(wrong ? NULL : &shown, &valve.gains, 1000);
        break;
    case 71:
        fixpid_gains_to_milli(&shown, wrong ? NULL : &valve.gains, 1000);
        break;
    case 72: fixpid_record_pack(wrong ? NULL : &record, &valve); break;
    case 73: fixpid_record_pack(&record, wrong ? NULL : &valve); break;
    case 74: fixpid_record_unpack(wrong ? NULL : &record, &unpacked); break;
    case 75: fixpid_record_unpack(&record, wrong ? NULL : &unpacked); break;
    case 76: fixpid_autotune_init(h, &experiment); break;
    case 77: fixpid_autotune_reset(h); break;
    case 78: fixpid_autotune_step(h, 1, 2); break;
    case 79: fixpid_autotune_status(h); break;
    case 80: fixpid_autotune_model(h, &model); break;
    case 81: fixpid_autotune_result(h, 0, 16, &whole); break;
    case 82:
        fixpid_autotune_init(&autotune, wrong ? NULL : &experiment);
        break;
    case 83: // nowhere to put the model
        fixpid_autotune_model(&autotune, wrong ? NULL : &model);
        break;
    case 84:
        fixpid_autotune_result(&autotune, 0, 16, wrong ? NULL : &whole);
        break;
    default: exit(1);
    }
    // clang-format on
}

// How a process ends that makes this one call: its wait status.
static int outcome(int number, bool wrong)
{
    int status = -1;
    const pid_t child = fork();

    if (child == 0) {
        call(number, wrong);
        _exit(0);
    }
    if (child < 0 || waitpid(child, &status, 0) != child) {
        perror("assert");
        exit(1);
    }
    return status;
}

int main(void)
{
    int failed = 0;

    for (int number = 0; number < CALLS; number++) {
        const int right = outcome(number, false);
        const int wrong = outcome(number, true);

        if (!WIFEXITED(right) || WEXITSTATUS(right) != 0) {
            printf("call %d stops a caller that is right\n", number);
            failed++;
        }
        if (!WIFSIGNALED(wrong) || WTERMSIG(wrong) != SIGABRT) {
            printf("call %d does not stop a caller that is wrong\n", number);
            failed++;
        }
    }
    return failed == 0 ? 0 : 1;
}
