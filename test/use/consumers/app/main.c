// SPDX-License-Identifier: MIT
// A user's program: says which fixpid it got. The header that it was compiled
// with and the library that it was linked with must agree on every limit.
#include <stdio.h>

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

static bool an937_works(void)
{
    const struct fixpid_an937_config config = {
        .kp_q4 = FIXPID_AN937_GAIN(6.0),
        .ki_q4 = FIXPID_AN937_GAIN(5.0),
        .kd_q4 = FIXPID_AN937_GAIN(1.0),
        .accumulated_error_limit = 4000,
        .derivative_period_ticks = 4,
    };
    struct fixpid_an937 pid;

    if (!fixpid_an937_init(&pid, &config)) {
        return false;
    }
    fixpid_an937_tick(&pid);
    return fixpid_an937_step(&pid, 240) == 2880;
}

static bool pid_works(void)
{
    const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(2.0, 2.0 / 10.0, 0, 10, 0),
        .output_max = 255,
    };
    struct fixpid_pid_config kept;
    struct fixpid_record record;
    struct fixpid_pid pid;

    fixpid_record_pack(&record, &config);
    if (!fixpid_record_unpack(&record, &kept) ||
        !fixpid_pid_init(&pid, &kept) || fixpid_pid_step(&pid, 60, 10) != 101) {
        return false;
    }
    fixpid_pid_track(&pid, 91, 0);
    return fixpid_pid_output(&pid) == 91 &&
           fixpid_pid_step(&pid, 60, 10) == 92 &&
           fixpid_pid_step_error(&pid, 50, 0) == 93;
}

static bool small_ones_work(void)
{
    const struct fixpid_tpo_config relay = {.full = 255, .window = 2};
    const struct fixpid_gains_milli typed = {.kp = 2000};
    struct fixpid_pid_gains gains;
    struct fixpid_slew slew;
    struct fixpid_tpo tpo;

    fixpid_slew_init(&slew, FIXPID_SLEW_RATE(30, 10), 0);
    return fixpid_slew_step(&slew, 100) == 3 && fixpid_tpo_init(&tpo, &relay) &&
           fixpid_tpo_step(&tpo, 200) &&
           fixpid_gains_from_milli(&gains, &typed, 10000, 0) &&
           gains.kp_q8 == 512;
}

static bool table_works(void)
{
    static const struct fixpid_table_point points[] = {{0, 0}, {2, -1}};
    static const struct fixpid_table table = FIXPID_TABLE(points);

    return fixpid_table_valid(&table) && fixpid_table_at(&table, 1) == 0 &&
           fixpid_table_at(&table, 9) == -1;
}

static bool guard_works(void)
{
    const struct fixpid_guard_config config = {
        .output_max = 255, .band = 8, .patience = 2, .noisy = true};
    struct fixpid_guard guard;

    if (!fixpid_guard_init(&guard, &config) ||
        fixpid_guard_step(&guard, 500, 20, 255) != 0 ||
        fixpid_guard_step(&guard, 500, 21, 255) != FIXPID_GUARD_NOT_RISING) {
        return false;
    }
    fixpid_guard_acknowledge(&guard);
    return fixpid_guard_flags(&guard) == 0;
}

static bool autotune_works(void)
{
    const struct fixpid_autotune_config config = {
        .output_max = 255,
        .output_rest = 9,
        .measurement_min = -1,
        .measurement_max = 1024,
        .timeout_steps = 1000,
        .cycles = 2,
    };
    struct fixpid_autotune tuner;
    struct fixpid_autotune_process process;
    struct fixpid_autotune_stage stage;
    struct fixpid_autotune_record record;
    struct fixpid_pid_config pid;

    return fixpid_autotune_init(&tuner, &config) &&
           fixpid_autotune_step(&tuner, 60, 10) == 9 &&
           !fixpid_autotune_model(&tuner, &process) &&
           !fixpid_autotune_result(&tuner, FIXPID_AUTOTUNE_PI,
                                   FIXPID_AUTOTUNE_SAFE, &pid) &&
           fixpid_autotune_reason(&tuner, FIXPID_AUTOTUNE_PI,
                                  FIXPID_AUTOTUNE_SAFE) ==
               FIXPID_AUTOTUNE_NOT_DONE &&
           (fixpid_autotune_progress(&tuner, &stage), stage.expected == 13) &&
           !fixpid_autotune_pack(&tuner, &record);
}

static bool an964_limits_agree(void)
{
    const struct fixpid_an964_gains gains = {.kp = 1023, .ki = 16, .kd = 1023};
    struct fixpid_an964 pid;
    int derivative;
    int output = 0;

    if (!fixpid_an964_init(&pid, &gains)) {
        return false;
    }
    fixpid_an964_step(&pid, 1023);
    derivative = fixpid_an964_derivative(&pid);
    for (int step = 0; step < 100; step++) { // until the sum is at its limit
        output = fixpid_an964_step(&pid, 1023);
    }
    return fixpid_an964_integral(&pid) == FIXPID_AN964_SUM_LIMIT / 256 &&
           derivative == FIXPID_AN964_TERM_LIMIT &&
           output == FIXPID_AN964_OUTPUT_LIMIT;
}

static bool an964_8bit_limits_agree(void)
{
    const struct fixpid_an964_8bit_gains gains = {.kp = 32, .ki = 8, .kd = 127};
    struct fixpid_an964_8bit pid;
    int derivative;

    if (!fixpid_an964_8bit_init(&pid, &gains)) {
        return false;
    }
    fixpid_an964_8bit_step(&pid, 127);
    derivative = fixpid_an964_8bit_derivative(&pid);
    for (int step = 0; step < 100; step++) {
        fixpid_an964_8bit_step(&pid, 127);
    }
    return fixpid_an964_8bit_integral(&pid) ==
               FIXPID_AN964_8BIT_SUM_LIMIT / 64 &&
           derivative == FIXPID_AN964_8BIT_TERM_LIMIT;
}

int main(void)
{
    printf("fixpid %d.%d.%d\n", FIXPID_VERSION_MAJOR, FIXPID_VERSION_MINOR,
           FIXPID_VERSION_PATCH);
    printf("limits %d %d %d %d %d\n", FIXPID_AN964_SUM_LIMIT,
           FIXPID_AN964_TERM_LIMIT, FIXPID_AN964_OUTPUT_LIMIT,
           FIXPID_AN964_8BIT_SUM_LIMIT, FIXPID_AN964_8BIT_TERM_LIMIT);
    if (!an937_works() || !pid_works() || !autotune_works() ||
        !small_ones_work() || !guard_works() || !table_works() ||
        !an964_limits_agree() || !an964_8bit_limits_agree()) {
        printf("the library is not the one of the header\n");
        return 1;
    }
    return 0;
}
