// SPDX-License-Identifier: MIT
#include "eva.h"

#include "link/fixpid_link.c"
#include "link/fixpid_link_commands.c"
#include "link/fixpid_link_tracked.c"
#include "pid/fixpid_pid.c"
#include "pid/fixpid_pid_more.c"
#include "pid/fixpid_pid_state.c"
#include "record/fixpid_record.c"

void eva(void)
{
    const struct fixpid_link_board board = {
        .period_us = ANY_UINT32,
        .manual_steps = ANY_UINT16,
        .setpoint_min = ANY_INT16,
        .setpoint_max = ANY_INT16,
        .output_min = ANY_INT16,
        .output_max = ANY_INT16,
    };
    struct fixpid_pid_config config = ANY_CONFIG;
    struct fixpid_pid pid;
    struct fixpid_link c;

    (void)fixpid_pid_init(&pid, &config);
    fixpid_link_init(&c, ANY_INT16);
    while (GOES_ON) {
        const int16_t setpoint = ANY_INT16;
        const int16_t measurement = ANY_INT16;
        const int16_t output = fixpid_pid_step(&pid, setpoint, measurement);

        fixpid_link_allow(&c, ANY_UINT8);
        fixpid_link_changed(&c);
        fixpid_link_taken(&c);
        fixpid_link_lost(&c);
        (void)fixpid_link_receive(&c, ANY_UINT8);
        (void)fixpid_link_answer(&c, &board, &pid, &config);
        (void)fixpid_link_answer_stream(&c, &board, &config);
        (void)fixpid_link_setpoint(&c);
        (void)fixpid_link_step(&c, &pid, setpoint, measurement, output);
        (void)fixpid_link_step_tracked(&c, &pid, setpoint, measurement, output,
                                       ANY_INT16, ANY_UINT8);
    }
}
