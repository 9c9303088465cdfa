// SPDX-License-Identifier: MIT
// Spikes: now and then one reading is wild. The median of the last three
// readings is not, unless two of them are.
#include <math.h>
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 20000   // 10 a second
#define SETPOINT 3200 // tenths of a degree
#define HIGH 4730     // wild readings
#define LOW 200
#define NONE -1

// recipe
static struct fixpid_pid pid;
static int16_t last[2]; // at the start both are the first reading

// shown
static int16_t median(int16_t reading)
{
    const int16_t low = (last[0] < last[1]) ? last[0] : last[1];
    const int16_t high = (last[0] < last[1]) ? last[1] : last[0];
    const int16_t least = (reading < high) ? reading : high;

    last[1] = last[0];
    last[0] = reading;
    return (least > low) ? least : low;
}
// end of shown

static int16_t control(int16_t setpoint, int16_t reading)
{
    return fixpid_pid_step(&pid, setpoint, median(reading));
}
// end of recipe

// The tip of a soldering iron.
static const struct plant_counts tip = {.gain = 40.0,
                                        .lag_steps = 300.0,
                                        .second_lag_steps = 10.0,
                                        .delay_steps = 3,
                                        .noise_counts = 2,
                                        .sensor_max = 9999.0};

static const struct fixpid_pid_gains unfiltered =
    FIXPID_PID_GAINS(0.6, 0.12, 0.6, 10, 0);
static const struct fixpid_pid_gains filtered =
    FIXPID_PID_GAINS(0.6, 0.12, 0.6, 10, 3);

// One reading in each hundred, somewhere among them; for each run the same.
static bool is_wild(int k)
{
    const uint32_t drawn = ((uint32_t)k / 100u + 1u) * UINT32_C(1664525);

    return (drawn >> 16) % 100u == (uint32_t)k % 100u;
}

static int16_t control_without(int16_t setpoint, int16_t reading)
{
    return fixpid_pid_step(&pid, setpoint, reading);
}

static void run(int16_t (*step)(int16_t, int16_t),
                const struct fixpid_pid_gains *gains, int16_t wild,
                double *value)
{
    const struct fixpid_pid_config config = {
        .gains = *gains, .output_min = 0, .output_max = 255};
    struct motion motion;

    (void)fixpid_pid_init(&pid, &config);
    motion_start(&motion, &tip);
    last[0] = motion_read(&motion);
    last[1] = last[0];
    for (int k = 0; k < STEPS; k++) {
        const int16_t reading = motion_read(&motion);
        motion_move(
            &motion,
            step(SETPOINT, (is_wild(k) && wild != NONE) ? wild : reading));
        value[k] = motion.value / 10.0;
    }
}

int main(void)
{
    static double calm[STEPS];
    static double plain[STEPS];
    static double filter[STEPS];
    static double with[STEPS];
    static double with_filter[STEPS];
    static double with_low[STEPS];

    run(control_without, &filtered, NONE, calm);
    run(control_without, &unfiltered, HIGH, plain);
    run(control_without, &filtered, HIGH, filter);
    run(control, &unfiltered, HIGH, with);
    run(control, &filtered, HIGH, with_filter);
    run(control, &filtered, LOW, with_low);
    (void)printf("time_s,calm,plain,filter,with,with_filter,with_low\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%.1f,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n", k / 10.0, calm[k],
                     plain[k], filter[k], with[k], with_filter[k], with_low[k]);
    }
    return 0;
}
