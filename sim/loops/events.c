// SPDX-License-Identifier: MIT
// Bumps of the output when something is changed, and what is left of an
// integral after a million steps there and back.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "loops.h"

#define AT_REST 700.0
#define WATCHED_STEPS 20

static void rest(struct loop *loop, int steps)
{
    for (int i = 0; i < steps; i++) {
        loop_step(loop, AT_REST);
    }
}

// The steps after an event that has just happened.
static void watch(struct loop *loop, const char *event)
{
    const double before = loop->output;
    double first = 0.0;
    double largest = 0.0;

    for (int i = 0; i < WATCHED_STEPS; i++) {
        const double last = loop->output;
        loop_step(loop, AT_REST);
        if (i == 0) {
            first = loop->output;
        }
        largest = fmax(largest, fabs(loop->output - last));
    }
    (void)printf("%s;%g;%g;%g\n", event, before, first, largest);
}

static void change_gains(struct loop *loop)
{
    const struct fixpid_pid_gains gains =
        loop_config(&trials[0].gains, 1.0, 0.0, 255.0).gains;
    struct fixpid_pid_gains other = gains;

    other.ki_q24 *= 4u;
    (void)fixpid_pid_set_gains(&loop->pid, &other);
    watch(loop, "ki x 4");
    other = gains;
    other.kp_q8 = (uint16_t)(other.kp_q8 * 3u);
    (void)fixpid_pid_set_gains(&loop->pid, &other);
    watch(loop, "kp x 3");
    (void)fixpid_pid_set_gains(&loop->pid, &gains);
    watch(loop, "gains back");
}

static void change_modes(struct loop *loop)
{
    loop_set_manual(loop, loop->output);
    watch(loop, "to manual at the same output");
    loop_set_manual(loop, 120.0);
    rest(loop, 100);
    loop_set_auto(loop);
    watch(loop, "to automatic, 189 counts off");
    rest(loop, 600);
    fixpid_pid_seed(&loop->pid, (int16_t)loop->output);
    watch(loop, "seed with the same output");
}

static void change_limits(struct loop *loop)
{
    loop_set_limits(loop, 0.0, 150.0);
    watch(loop, "limits to 0..150, below the need");
    loop_set_limits(loop, 0.0, 255.0);
    watch(loop, "limits back to 0..255");
}

// Integral at 255, limits lowered to 0..100, an error of -10: how many steps
// the output stays at its limit.
static int leaves_lowered_limit(void)
{
    const struct pid_double_gains gains = {1.0, 0.05, 0.0, 0};
    const struct fixpid_pid_config config =
        loop_config(&gains, 1.0, 0.0, 255.0);
    struct fixpid_pid pid;
    int steps = 0;

    (void)fixpid_pid_init(&pid, &config);
    for (int i = 0; i < 2000; i++) {
        (void)fixpid_pid_step(&pid, 100, 90);
    }
    (void)fixpid_pid_set_limits(&pid, 0, 100);
    do {
        steps++;
    } while (fixpid_pid_step(&pid, 90, 100) == 100 && steps < 100000);
    return steps;
}

// What a setpoint's step of 100 adds to the output at once.
static int kick(bool derivative_on_error)
{
    const struct pid_double_gains gains = {1.0, 0.01, 2.0, 0};
    struct fixpid_pid_config config = loop_config(&gains, 1.0, -1000.0, 1000.0);
    struct fixpid_pid pid;

    config.derivative_on_error = derivative_on_error;
    (void)fixpid_pid_init(&pid, &config);
    const int before = fixpid_pid_step(&pid, 500, 500);
    return fixpid_pid_step(&pid, 600, 500) - before;
}

void print_bumps(void)
{
    struct loop loop;

    (void)printf("event;before;first;largest\n");
    loop_start(&loop, &trials[0], true, PID_DOUBLE_WHOLE);
    rest(&loop, 600);
    change_gains(&loop);
    change_modes(&loop);
    change_limits(&loop);
    (void)printf("lowered limit left after;;%d;\n", leaves_lowered_limit());
    (void)printf("setpoint step of 100;;%d;\n", kick(false));
    (void)printf("the same, derivative on error;;%d;\n", kick(true));
}

static void accumulate(struct fixpid_pid *pid, int16_t error)
{
    for (long i = 0; i < 1000000; i++) {
        (void)fixpid_pid_step(pid, error, 0);
    }
}

void print_drift(void)
{
    static const struct {
        uint32_t ki_q24;
        int16_t error;
    } cases[] = {{8, 1}, {8, -1}, {840, 1}, {840, -1}, {8389, 3}, {100000, -1}};

    (void)printf("ki_q24;error;after_q16;exact_q16;back_q16\n");
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const struct fixpid_pid_config config = {
            .gains = {.ki_q24 = cases[i].ki_q24},
            .output_min = -30000,
            .output_max = 30000,
            .integral_min = -32767,
            .integral_max = 32767,
            .setpoint_weight_q8 = 256,
        };
        const int64_t kept = (cases[i].ki_q24 > 32767u)
                                 ? ((cases[i].ki_q24 + 128) / 256) * 256
                                 : cases[i].ki_q24;
        // Rounded down, as the getter does it.
        const double exact =
            floor((double)(1000000 * kept * cases[i].error) / 256.0);
        struct fixpid_pid pid;

        (void)fixpid_pid_init(&pid, &config);
        accumulate(&pid, cases[i].error);
        const int32_t there = fixpid_pid_integral(&pid);
        accumulate(&pid, (int16_t)-cases[i].error);
        (void)printf("%lu;%d;%ld;%.0f;%ld\n", (unsigned long)cases[i].ki_q24,
                     cases[i].error, (long)there, exact,
                     (long)fixpid_pid_integral(&pid));
    }
}
