// SPDX-License-Identifier: MIT
// Two rates in a cascade: the current of a motor 10 000 times a second, its
// speed 1000 times. While the supply is weak the inner loop comes to its limit
// in some of the ten steps and not in others. Their flags are collected.
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 60000 // of 0.1 ms
#define WEAK_FROM 20000
#define WEAK_TO 35000
#define SPEED 500

// recipe
#define INNER_STEPS 10 // of each step of the outer one

static struct fixpid_pid outer; // speed: its output is a current
static struct fixpid_pid inner; // current: its output is a voltage
static uint8_t collected;       // what the inner one was limited by

// shown
static int16_t control_speed(int16_t setpoint, int16_t speed, int16_t current)
{
    const uint8_t limited = FIXPID_PID_AT_MAX | FIXPID_PID_AT_MIN;

    if ((collected & limited) != 0u) {
        fixpid_pid_track(&outer, current, 6); // Ti is 100 steps
    }
    collected = 0;
    return fixpid_pid_step(&outer, setpoint, speed);
}
// end of shown

// 10 000 times a second.
static int16_t control(int16_t setpoint, int16_t speed, int16_t current)
{
    static uint8_t step = 0;
    static int16_t wanted = 0;
    int16_t output;

    if (step == 0u) {
        wanted = control_speed(setpoint, speed, current);
    }
    step = (uint8_t)((step + 1u) % INNER_STEPS);
    output = fixpid_pid_step(&inner, wanted, current);
    collected |= fixpid_pid_flags(&inner);
    return output;
}
// end of recipe

// No flags count.
static int16_t control_without(int16_t setpoint, int16_t speed, int16_t current)
{
    collected = 0;
    return control(setpoint, speed, current);
}

static void start(void)
{
    static const struct fixpid_pid_config of_speed = {
        .gains = FIXPID_PID_GAINS(4, 40, 0, 1000, 0),
        .output_min = -1000,
        .output_max = 1000};
    static const struct fixpid_pid_config of_current = {
        .gains = FIXPID_PID_GAINS(1, 1000, 0, 10000, 0),
        .output_min = -1000,
        .output_max = 1000};

    (void)fixpid_pid_init(&outer, &of_speed);
    (void)fixpid_pid_init(&inner, &of_current);
    collected = 0;
}

// Of one step of the outer controller.
struct row {
    double speed;
    int limited; // the inner one was at its limit in so many of the ten steps
    bool last;   // in the last one, too
};

// The speed's electromotive force is taken from the voltage, and the load from
// the current.
static void run(int16_t (*step)(int16_t, int16_t, int16_t), struct row *rows)
{
    static const struct plant_counts winding = {.gain = 1.0,
                                                .lag_steps = 10.0,
                                                .delay_steps = 1,
                                                .noise_counts = 8,
                                                .sensor_max = 4095.0};
    static const struct plant_counts rotor = {.gain = 1.0,
                                              .lag_steps = 2000.0,
                                              .delay_steps = 1,
                                              .noise_counts = 1,
                                              .sensor_max = 4095.0};
    struct motion current;
    struct motion speed;

    start();
    motion_start(&current, &winding);
    motion_start(&speed, &rotor);
    for (int k = 0; k < STEPS; k++) {
        const bool weak = k >= WEAK_FROM && k < WEAK_TO;
        const int16_t voltage =
            step(SPEED, motion_read(&speed), motion_read(&current));
        const double most = weak ? 0.45 : 1.0;

        motion_move(&current, most * voltage - 0.5 * speed.value);
        motion_move(&speed, 2.0 * current.value);
        struct row *const row = &rows[k / INNER_STEPS];

        row->speed = speed.value;
        row->last = (fixpid_pid_flags(&inner) &
                     (FIXPID_PID_AT_MAX | FIXPID_PID_AT_MIN)) != 0u;
        row->limited += row->last ? 1 : 0;
    }
}

int main(void)
{
    static struct row with[STEPS / INNER_STEPS];
    static struct row without[STEPS / INNER_STEPS];

    run(control, with);
    run(control_without, without);
    (void)printf("time_s,setpoint,with,without,limited,last\n");
    for (int k = 0; k < STEPS / INNER_STEPS; k++) {
        (void)printf("%.3f,%d,%.6g,%.6g,%d,%d\n", k / 1000.0, SPEED,
                     with[k].speed, without[k].speed, with[k].limited,
                     with[k].last ? 1 : 0);
    }
    return 0;
}
