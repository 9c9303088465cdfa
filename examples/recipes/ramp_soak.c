// SPDX-License-Identifier: MIT
// Ramp and soak with hold-back: the setpoint waits while the process is too far
// from it, and only time within counts as a soak. The oven cannot rise as fast
// as the second ramp wants it to.
#include <stdio.h>

#include "fixpid_pid.h"
#include "fixpid_slew.h"
#include "plant_counts.h"

#define STEPS 1200 // of 1 s
#define ROOM 200   // tenths of a degree

// recipe
#define HOLD_BACK 80 // tenths of a degree

struct segment {
    int16_t target;
    uint32_t rate_q16; // counts a step
    uint16_t soak;     // steps at the target
};

static const struct segment profile[] = {
    {1500, FIXPID_SLEW_RATE(20, 1), 90}, // tenths a second, seconds
    {2200, FIXPID_SLEW_RATE(30, 1), 40},
    {600, FIXPID_SLEW_RATE(20, 1), 1}};
#define SEGMENTS ((uint8_t)(sizeof(profile) / sizeof(profile[0])))

static struct fixpid_pid pid;
static struct fixpid_slew ramp; // seeded with the measurement at the start
static int16_t setpoint;        // likewise
static uint8_t segment;
static uint16_t soaked;
static int32_t hold_back = HOLD_BACK;

// shown
static int16_t ramp_and_soak(int16_t measurement)
{
    const struct segment *const now = &profile[segment];
    const int32_t error = (int32_t)setpoint - measurement;
    const bool near = error <= hold_back && error >= -hold_back;

    if (!near) {
        return setpoint; // it waits
    }
    if (setpoint == now->target) {
        soaked++;
        if (soaked >= now->soak && segment + 1 < SEGMENTS) {
            segment++;
            soaked = 0;
        }
    }
    fixpid_slew_set_rates(&ramp, now->rate_q16, now->rate_q16);
    return fixpid_slew_step(&ramp, now->target);
}
// end of shown

static int16_t control(int16_t measurement)
{
    setpoint = ramp_and_soak(measurement);
    return fixpid_pid_step(&pid, setpoint, measurement);
}
// end of recipe

static void start(int32_t wanted_hold_back)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(8, 0.03, 60, 1, 2),
        .output_min = 0,
        .output_max = 1000};

    (void)fixpid_pid_init(&pid, &config);
    fixpid_slew_seed(&ramp, ROOM);
    setpoint = ROOM;
    segment = 0;
    soaked = 0;
    hold_back = wanted_hold_back;
}

struct row {
    double value;
    int16_t setpoint;
    int16_t output;
};

static void run(int32_t wanted_hold_back, struct row *rows)
{
    static const struct plant_counts oven = {.gain = 1.0,
                                             .lag_steps = 20.0,
                                             .second_lag_steps = 200.0,
                                             .delay_steps = 1,
                                             .sensor_max = 4095.0};
    struct motion motion;

    start(wanted_hold_back);
    motion_start(&motion, &oven);
    motion.value = ROOM;
    motion.inner = ROOM;
    motion.line[0] = ROOM;
    for (int k = 0; k < STEPS; k++) {
        const int16_t output = control(motion_read(&motion));

        motion_move(&motion, ROOM + 3.0 * output); // full power: 300 degrees
        rows[k] = (struct row){motion.value, setpoint, output};
    }
}

int main(void)
{
    static struct row with[STEPS];
    static struct row without[STEPS];

    run(HOLD_BACK, with);
    run(INT16_MAX, without);
    (void)printf("time_s,setpoint,value,output,setpoint_without,"
                 "value_without\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%d,%.1f,%.6g,%d,%.1f,%.6g\n", k, with[k].setpoint / 10.0,
                     with[k].value / 10.0, (int)with[k].output,
                     without[k].setpoint / 10.0, without[k].value / 10.0);
    }
    return 0;
}
