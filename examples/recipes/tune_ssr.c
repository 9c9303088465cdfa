// SPDX-License-Identifier: MIT
// A heater behind a solid-state relay finds its gains through that relay, and
// is then controlled through it: a step each second, and ten steps of the
// relay.
#include <stdio.h>

#include "fixpid_autotune.h"
#include "fixpid_pid.h"
#include "fixpid_tpo.h"
#include "plant_counts.h"

#define TICKS 15000 // 25 minutes, 10 a second
#define WARMER_AT 10000

// recipe
#define FULL 1000
#define RELAY_STEPS 10 // of each step of the tuner and of the controller

static struct fixpid_autotune tuner;
static struct fixpid_pid pid; // refused at first: it puts out 0
static struct fixpid_tpo relay;

static void start(void)
{
    static const struct fixpid_autotune_config experiment = {
        .output_min = 0,
        .output_max = FULL,
        .output_rest = 0,
        .measurement_min = -10, // counts of a converter that has 4096
        .measurement_max = 4085,
        .swing = 0, // the tuner chooses
        .timeout_steps = 3600,
        .cycles = 1,
    };
    // The window is one step of the tuner and of the controller.
    static const struct fixpid_tpo_config windows = {.full = FULL,
                                                     .window = RELAY_STEPS};

    (void)fixpid_autotune_init(&tuner, &experiment);
    (void)fixpid_tpo_init(&relay, &windows);
}

static void take_over(void)
{
    struct fixpid_pid_config config = {
        .gains = {0}, .output_min = 0, .output_max = FULL};
    struct fixpid_autotune_process process;

    if (fixpid_autotune_result(&tuner, FIXPID_AUTOTUNE_PI, FIXPID_AUTOTUNE_SAFE,
                               &config) &&
        fixpid_autotune_model(&tuner, &process)) {
        (void)fixpid_pid_init(&pid, &config);
        fixpid_pid_seed(&pid, process.holding);
    } // else fixpid_autotune_reason says why, and the heater stays off
}

// shown
// The duty of the next window, once a second.
static int16_t duty_of_window(int16_t setpoint, int16_t measurement)
{
    int16_t duty;

    if (fixpid_autotune_status(&tuner) != FIXPID_AUTOTUNE_RUNNING) {
        return fixpid_pid_step(&pid, setpoint, measurement);
    }
    duty = fixpid_autotune_step(&tuner, setpoint, measurement);
    if (fixpid_autotune_status(&tuner) != FIXPID_AUTOTUNE_RUNNING) {
        take_over();
    }
    return duty;
}

// Ten times a second.
static bool control(int16_t setpoint, int16_t measurement)
{
    static uint8_t step = 0;
    static int16_t duty = 0;

    if (step == 0u) {
        duty = duty_of_window(setpoint, measurement);
    }
    step = (uint8_t)((step + 1u) % RELAY_STEPS);
    return fixpid_tpo_step(&relay, duty);
}
// end of shown
// end of recipe

static int percent(void)
{
    struct fixpid_autotune_stage stage;

    fixpid_autotune_progress(&tuner, &stage);
    return 100 * stage.done / stage.expected;
}

int main(void)
{
    static const struct plant_counts heater = {.gain = 3200.0,
                                               .lag_steps = 600.0,
                                               .second_lag_steps = 100.0,
                                               .delay_steps = 1,
                                               .noise_counts = 2,
                                               .sensor_max = 4095.0};
    struct motion motion;
    int on_steps = 0;

    start();
    motion_start(&motion, &heater);
    (void)printf("time_s,setpoint,value,on,percent\n");
    for (int k = 0; k < TICKS; k++) {
        const int16_t setpoint = (k < WARMER_AT) ? 960 : 1200;
        const bool on = control(setpoint, motion_read(&motion));

        motion_move(&motion, on ? 1.0 : 0.0);
        on_steps += on ? 1 : 0;
        if (k % RELAY_STEPS == RELAY_STEPS - 1) {
            (void)printf("%d,%d,%.6g,%d,%d\n", k / RELAY_STEPS, (int)setpoint,
                         motion.value, on_steps, percent());
            on_steps = 0;
        }
    }
    return 0;
}
