// SPDX-License-Identifier: MIT
// Cascade: a slow process behind a fast one. The outer controller's output is
// the inner one's setpoint. While the supply is weak the inner loop cannot
// follow, and the outer one must know.
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 6000
#define WEAK_FROM 2000
#define WEAK_TO 3500

// recipe
static struct fixpid_pid outer;
static struct fixpid_pid inner;

static int16_t control(int16_t setpoint, int16_t slow, int16_t fast)
{
    const int16_t wanted = fixpid_pid_step(&outer, setpoint, slow);
    const int16_t output = fixpid_pid_step(&inner, wanted, fast);
    const uint8_t limited = FIXPID_PID_AT_MAX | FIXPID_PID_AT_MIN;

    if ((fixpid_pid_flags(&inner) & limited) != 0u) {
        fixpid_pid_track(&outer, fast, 6); // Ti is 100 steps, and 2^6 below it
    }
    return output;
}
// end of recipe

static int16_t control_without(int16_t setpoint, int16_t slow, int16_t fast)
{
    const int16_t wanted = fixpid_pid_step(&outer, setpoint, slow);

    return fixpid_pid_step(&inner, wanted, fast);
}

static void start(void)
{
    static const struct fixpid_pid_config slow = {
        .gains = FIXPID_PID_GAINS(2, 0.02, 0, 1, 0),
        .output_min = 0,
        .output_max = 1000};
    static const struct fixpid_pid_config fast = {
        .gains = FIXPID_PID_GAINS(2, 0.1, 0, 1, 0),
        .output_min = 0,
        .output_max = 255};

    (void)fixpid_pid_init(&outer, &slow);
    (void)fixpid_pid_init(&inner, &fast);
}

static void run(int16_t (*step)(int16_t, int16_t, int16_t), double *slow_found)
{
    struct plant_counts supply = {.lag_steps = 20.0,
                                  .delay_steps = 1,
                                  .noise_counts = 2,
                                  .sensor_max = 4095.0};
    static const struct plant_counts process = {.gain = 1.0,
                                                .lag_steps = 200.0,
                                                .delay_steps = 1,
                                                .noise_counts = 2,
                                                .sensor_max = 4095.0};
    struct motion fast;
    struct motion slow;

    start();
    motion_start(&fast, &supply);
    motion_start(&slow, &process);
    for (int k = 0; k < STEPS; k++) {
        supply.gain = (k >= WEAK_FROM && k < WEAK_TO) ? 1.0 : 2.5;
        motion_move(&fast, step(500, motion_read(&slow), motion_read(&fast)));
        motion_move(&slow, fast.value);
        slow_found[k] = slow.value;
    }
}

int main(void)
{
    static double with[STEPS];
    static double without[STEPS];

    run(control, with);
    run(control_without, without);
    (void)printf("time_s,setpoint,with,without\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%d,500,%.6g,%.6g\n", k, with[k], without[k]);
    }
    return 0;
}
