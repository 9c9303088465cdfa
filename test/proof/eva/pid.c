// SPDX-License-Identifier: MIT
#include "eva.h"

#include "pid/fixpid_pid.c"
#include "pid/fixpid_pid_check.c"
#include "pid/fixpid_pid_error.c"
#include "pid/fixpid_pid_more.c"
#include "pid/fixpid_pid_state.c"
#include "pid/fixpid_pid_track.c"

static void set_any(struct fixpid_pid *c)
{
    const struct fixpid_pid_gains gains = ANY_GAINS;

    switch (ANY_OF(4)) {
    case 1:
        (void)fixpid_pid_set_gains(c, &gains);
        break;
    case 2:
        (void)fixpid_pid_set_limits(c, ANY_INT16, ANY_INT16);
        break;
    case 3:
        (void)fixpid_pid_set_integral_limits(c, ANY_INT16, ANY_INT16);
        break;
    default:
        fixpid_pid_set_feedforward(c, ANY_INT16);
        break;
    }
}

// Of its own bytes, of which some are any.
static void go_on(struct fixpid_pid *c)
{
    uint8_t state[FIXPID_PID_STATE_SIZE];
    uint8_t at;

    fixpid_pid_state(c, state);
    for (at = 0; at < FIXPID_PID_STATE_SIZE; at++) {
        if (GOES_ON) {
            state[at] = ANY_UINT8;
        }
    }
    (void)fixpid_pid_restore(c, state);
}

static void call_any(struct fixpid_pid *c)
{
    switch (ANY_OF(10)) {
    case 1:
        fixpid_pid_reset(c);
        break;
    case 2:
        set_any(c);
        break;
    case 3:
        fixpid_pid_set_manual(c, ANY_INT16);
        break;
    case 4:
        fixpid_pid_set_auto(c);
        break;
    case 5:
        fixpid_pid_seed(c, ANY_INT16);
        break;
    case 6:
        fixpid_pid_track(c, ANY_INT16, ANY_UINT8);
        break;
    case 7:
        (void)fixpid_pid_step(c, ANY_INT16, ANY_INT16);
        break;
    case 8:
        (void)fixpid_pid_step_error(c, ANY_INT32, ANY_INT32);
        break;
    case 9:
        go_on(c);
        break;
    default:
        (void)fixpid_pid_proportional(c);
        (void)fixpid_pid_integral(c);
        (void)fixpid_pid_derivative(c);
        (void)fixpid_pid_output(c);
        (void)fixpid_pid_flags(c);
        break;
    }
}

void eva(void)
{
    const struct fixpid_pid_config config = ANY_CONFIG;
    struct fixpid_pid c;

    (void)fixpid_pid_check(&config);
    (void)fixpid_pid_init(&c, &config);
    while (GOES_ON) {
        call_any(&c);
    }
}
