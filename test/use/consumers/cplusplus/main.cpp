// SPDX-License-Identifier: MIT
// A user's program in C++: the headers, the gain as a constant of the language
// and the linkage of every controller.
#include <cstdint>

#include "fixpid_an937.h"
#include "fixpid_an964.h"
#include "fixpid_an964_8bit.h"
#include "fixpid_autotune.h"
#include "fixpid_gains.h"
#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "fixpid_record.h"
#include "fixpid_slew.h"
#include "fixpid_table.h"
#include "fixpid_tpo.h"

static constexpr std::uint8_t kp_q4 = FIXPID_AN937_GAIN(6.0);
static_assert(kp_q4 == 96, "6.0 x 16");
static_assert(FIXPID_AN937_GAIN(0.0) == 0, "the least gain");
static_assert(FIXPID_AN937_GAIN(15.9375) == 255, "the greatest gain");

static const fixpid_an937_config motor = {kp_q4, FIXPID_AN937_GAIN(5.0),
                                          FIXPID_AN937_GAIN(1.0), 4000, 4};

static_assert(FIXPID_PID_KP(2.5) == 640, "2.5 x 256");
static_assert(FIXPID_PID_KI(0.5, 100) == 83886, "0.005 x 2^24");
static_assert(FIXPID_PID_TI(2, 30, 10) == 111848, "2 / 300 x 2^24");
static_assert(FIXPID_PID_KD(0.1, 100, 2) == 640, "2.5 x 256");
static_assert(FIXPID_PID_TD(1.5, 3, 100, 4) == 7200, "28.125 x 256");

static_assert(FIXPID_SLEW_RATE(30, 10) == 196608, "3 x 2^16");

static const fixpid_pid_config valve = {
    FIXPID_PID_GAINS(2, 0, 0, 1, 0), 0, 255, 0, 0, 0, false, false, false};

int main()
{
    const fixpid_an964_gains gains = {1023, 0, 0};
    const fixpid_an964_8bit_gains gains_8bit = {32, 0, 0};
    const fixpid_autotune_config experiment = {0, 255,  9, -1,   1024,
                                               0, 1000, 2, false};
    fixpid_an937 an937;
    fixpid_an964 an964;
    fixpid_an964_8bit an964_8bit;
    fixpid_pid pid;
    fixpid_autotune autotune;
    fixpid_autotune_stage stage;
    fixpid_autotune_process process;
    fixpid_autotune_record experimental;
    const fixpid_tpo_config window = {255, 2, 0, 0};
    const fixpid_gains_milli typed = {2000, 0, 0};
    fixpid_pid_gains gains_typed;
    fixpid_slew slew;
    fixpid_tpo tpo;
    const fixpid_guard_config watched = {0, 255, 0,   1023,  0,
                                         0, 8,   395, false, true};
    static const fixpid_table_point points[] = {{0, 0}, {2, -1}};
    static const fixpid_table line = FIXPID_TABLE(points);
    fixpid_guard guard;

    fixpid_pid_config kept;
    fixpid_record record;

    fixpid_record_pack(&record, &valve);
    if (!fixpid_record_unpack(&record, &kept)) {
        return 1;
    }
    fixpid_slew_init(&slew, FIXPID_SLEW_RATE(30, 10), 0);
    if (!fixpid_tpo_init(&tpo, &window) ||
        !fixpid_gains_from_milli(&gains_typed, &typed, 10000, 0) ||
        gains_typed.kp_q8 != 512) {
        return 1;
    }
    if (!fixpid_an937_init(&an937, &motor) ||
        !fixpid_an964_init(&an964, &gains) ||
        !fixpid_an964_8bit_init(&an964_8bit, &gains_8bit) ||
        !fixpid_pid_init(&pid, &valve) ||
        !fixpid_autotune_init(&autotune, &experiment)) {
        return 1;
    }
    fixpid_autotune_progress(&autotune, &stage);
    if (stage.expected != 13 || fixpid_autotune_model(&autotune, &process) ||
        fixpid_autotune_pack(&autotune, &experimental) ||
        fixpid_autotune_reason(&autotune, FIXPID_AUTOTUNE_PID,
                               FIXPID_AUTOTUNE_CALM) !=
            FIXPID_AUTOTUNE_NOT_DONE) {
        return 1;
    }
    if (!fixpid_guard_init(&guard, &watched)) {
        return 1;
    }
    fixpid_an937_tick(&an937);
    fixpid_pid_track(&pid, 0, 2); // before the first step: nothing
    return fixpid_an937_step(&an937, 240) == 2880 &&
                   fixpid_an964_step(&an964, 100) == 99 &&
                   fixpid_an964_8bit_step(&an964_8bit, 100) == 100 &&
                   fixpid_pid_step(&pid, 100, 50) == 100 &&
                   fixpid_pid_output(&pid) == 100 &&
                   fixpid_pid_step_error(&pid, 50, 0) == 100 &&
                   fixpid_autotune_step(&autotune, 500, 20) == 9 &&
                   fixpid_slew_step(&slew, 100) == 3 &&
                   fixpid_tpo_step(&tpo, 200) &&
                   fixpid_guard_step(&guard, 500, 20, 255) == 0 &&
                   fixpid_table_valid(&line) && fixpid_table_at(&line, 2) == -1
               ? 0
               : 1;
}
