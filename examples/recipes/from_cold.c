// SPDX-License-Identifier: MIT
// A boiler finds its gains when it heats up from cold, goes on with them in the
// same step, and is guarded by what the heat-up told. Cold water comes in
// later. A step is a second; counts are tenths of a degree above the room.
#include <stdio.h>

#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "fixpid_reaction.h"
#include "plant_counts.h"

#define STEPS 1000
#define WATER_AT 500
#define WATER_UNTIL 560
#define WATER (-400.0)

// recipe
#define FULL 1000
#define SETPOINT 730

static struct fixpid_reaction tuner;
static struct fixpid_pid pid;     // puts out 0 until there are gains
static struct fixpid_guard guard; // watches from then on

// From cold. After FIXPID_REACTION_LIMIT with half of the output, cold again.
static void tune(int16_t drive)
{
    const struct fixpid_reaction_config heat_up = {
        .output_rest = 0,
        .output_drive = drive,
        .measurement_stop = SETPOINT, // not to be reached while it tunes
    };

    (void)fixpid_reaction_init(&tuner, &heat_up);
}

static bool is_tuning(void)
{
    return fixpid_reaction_status(&tuner) == FIXPID_REACTION_RUNNING;
}

// Otherwise fixpid_reaction_status says why, and the heater stays off.
static void take_over(void)
{
    struct fixpid_pid_config config = {
        .gains = {0}, .output_min = 0, .output_max = FULL};
    struct fixpid_guard_config watch = {.output_min = 0,
                                        .output_max = FULL,
                                        .measurement_min = -200,
                                        .measurement_max = 1500};
    struct fixpid_reaction_process process;

    if (fixpid_reaction_result(&tuner, FIXPID_REACTION_PID,
                               FIXPID_REACTION_SAFE, &config.gains) &&
        fixpid_reaction_model(&tuner, &process)) {
        const struct fixpid_guard_model model = {.slope_q24 = process.slope_q24,
                                                 .dead_q4 = process.dead_q4,
                                                 .noise_q4 = process.noise_q4};

        config.setpoint_weight_q8 = 128; // from cold without an overshoot
        (void)fixpid_guard_from_model(&watch, &model);
        (void)fixpid_guard_init(&guard, &watch);
        (void)fixpid_pid_init(&pid, &config);
    }
}

// shown
static int16_t control(int16_t setpoint, int16_t measurement)
{
    int16_t output = 0;

    if (is_tuning()) {
        output = fixpid_reaction_step(&tuner, measurement);
        if (!is_tuning()) {
            take_over();
        }
    }
    if (!is_tuning()) { // also in the step in which it ends
        output = fixpid_pid_step(&pid, setpoint, measurement);
        (void)fixpid_guard_step(&guard, setpoint, measurement, output);
    }
    return ((fixpid_guard_flags(&guard) & FIXPID_GUARD_ALARMS) != 0u) ? 0
                                                                      : output;
}
// end of shown
// end of recipe

int main(void)
{
    static const struct plant_counts boiler = {.gain = 15.7, // for one of FULL
                                               .lag_steps = 2900.0,
                                               .second_lag_steps = 8.0,
                                               .delay_steps = 3,
                                               .noise_counts = 1,
                                               .sensor_max = 2000.0};
    struct motion motion;

    tune(FULL);
    motion_start(&motion, &boiler);
    (void)printf("time_s,setpoint,value,output,tuning,flags\n");
    for (int k = 0; k < STEPS; k++) {
        const bool water = k >= WATER_AT && k < WATER_UNTIL;
        const int16_t output = control(SETPOINT, motion_read(&motion));

        motion_move(&motion, output + (water ? WATER : 0.0));
        (void)printf("%d,%.1f,%.6g,%d,%d,%u\n", k, SETPOINT / 10.0,
                     motion.value / 10.0, (int)output, is_tuning() ? 1 : 0,
                     (unsigned)fixpid_guard_flags(&guard));
    }
    return 0;
}
