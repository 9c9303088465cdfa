// SPDX-License-Identifier: MIT
// An alarm is latched: the heater is off until a person has looked. First the
// sensor slips off the boiler and reads far too little, then, long after it was
// put back, the solid-state relay fails shut: there the supply is cut.
#include <stdio.h>

#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 20000 // of 0.1 s
#define SLIPPED_AT 4000
#define REPAIRED_AT 7000
#define SHORTED_AT 12000
#define FULL 255
#define SETPOINT 600 // tenths of a degree
#define ROOM 200

static bool supplied; // the second contactor

static void cut_supply(void)
{
    supplied = false;
}

static void close_supply(void)
{
    supplied = true;
}

// recipe
static struct fixpid_pid pid;
static struct fixpid_guard guard;

// shown
static int16_t control(int16_t setpoint, int16_t measurement)
{
    int16_t output = fixpid_pid_step(&pid, setpoint, measurement);
    const uint8_t flags =
        fixpid_guard_step(&guard, setpoint, measurement, output);

    if ((flags & FIXPID_GUARD_ALARMS) != 0u) {
        fixpid_pid_set_manual(&pid, 0); // an alarm stays until acknowledged
        output = 0;
    }
    if ((flags & FIXPID_GUARD_NOT_FALLING) != 0u) {
        cut_supply(); // the output is off, and it gets warmer
    }
    return output;
}
// end of shown

// When a person has looked and pressed the button, and by nothing else.
static void acknowledge(void)
{
    fixpid_guard_acknowledge(&guard);
    close_supply();
    fixpid_pid_set_auto(&pid);
}
// end of recipe

static int16_t control_without(int16_t setpoint, int16_t measurement)
{
    return fixpid_pid_step(&pid, setpoint, measurement);
}

static void start(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(2, 0.02, 0, 10, 0),
        .output_min = 0,
        .output_max = FULL};
    static const struct fixpid_guard_config watch = {
        .output_min = 0,
        .output_max = FULL,
        .measurement_min = 10,
        .measurement_max = 1500,
        .reach_min = 300, // in the warmest room
        .reach_max = 900, // at the lowest supply
        .band = 11,       // by the rule of fixpid_guard.h
        .patience = 359};

    (void)fixpid_pid_init(&pid, &config);
    (void)fixpid_guard_init(&guard, &watch);
    close_supply();
}

struct row {
    double value;
    int16_t reading;
    int16_t output;
    bool supplied;
};

static void run(int16_t (*step)(int16_t, int16_t), struct row *rows)
{
    static const struct plant_counts boiler = {.gain = 1.0,
                                               .lag_steps = 1200.0,
                                               .delay_steps = 50,
                                               .noise_counts = 1,
                                               .sensor_max = 4095.0};
    struct motion motion;

    start();
    motion_start(&motion, &boiler);
    motion.value = ROOM;
    for (int k = 0; k < boiler.delay_steps; k++) {
        motion.line[k] = ROOM;
    }
    for (int k = 0; k < STEPS; k++) {
        const bool slipped = k >= SLIPPED_AT && k < REPAIRED_AT;
        int16_t reading = motion_read(&motion);
        int16_t output;

        if (k == REPAIRED_AT) {
            acknowledge();
        }
        if (slipped) { // it feels the air, which the boiler warms little
            reading = (int16_t)(ROOM + (reading - ROOM) / 40);
        }
        output = step(SETPOINT, reading);
        rows[k] = (struct row){motion.value, reading, output, supplied};
        if (k >= SHORTED_AT) {
            output = FULL;
        }
        motion_move(&motion, ROOM + 4.0 * (supplied ? output : 0));
    }
}

int main(void)
{
    static struct row with[STEPS];
    static struct row without[STEPS];

    run(control, with);
    run(control_without, without);
    (void)printf("time_s,setpoint,value,reading,output,supply,without\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%.1f,%.1f,%.6g,%.1f,%d,%d,%.6g\n", k / 10.0,
                     SETPOINT / 10.0, with[k].value / 10.0,
                     with[k].reading / 10.0, (int)with[k].output,
                     with[k].supplied ? 1 : 0, without[k].value / 10.0);
    }
    return 0;
}
