// SPDX-License-Identifier: MIT
// A user's program: says which fixpid it got. The header that it was compiled
// with and the library that it was linked with must agree on every limit.
#include <stdio.h>

#include "fixpid_an937.h"
#include "fixpid_an964.h"
#include "fixpid_an964_8bit.h"
#include "fixpid_pid.h"
#include "fixpid_record.h"

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
    if (!an937_works() || !pid_works() || !an964_limits_agree() ||
        !an964_8bit_limits_agree()) {
        printf("the library is not the one of the header\n");
        return 1;
    }
    return 0;
}
