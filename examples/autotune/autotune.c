// SPDX-License-Identifier: MIT
// This oven finds its own gains: from power-on an experiment runs around the
// setpoint, and then a controller with what it found.
#include "fixpid_autotune.h"
#include "fixpid_pid.h"
#include "port.h"

#include "../oven_experiment.h"
#include "../oven_sensor.h"

// The rule that makes gains of the experiment is an enum fixpid_autotune_rule.
#ifndef AUTOTUNE_RULE
#define AUTOTUNE_RULE FIXPID_AUTOTUNE_PI
#endif
#define ROBUSTNESS_Q4 FIXPID_AUTOTUNE_SAFE

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_pid oven;
// Deviation 8.4: and its one experiment.
FIXPID_DATA struct fixpid_autotune tuner;

// This is what the experiment found, for a debugger to read; a product would
// keep it in its EEPROM and not tune again. The gains are all 0 before the
// experiment ends, and after a failure.
// Deviation 8.4: found by its name.
struct fixpid_pid_config tuned;
// Deviation 8.4: found by its name. Why there are none.
uint8_t no_gains = FIXPID_AUTOTUNE_NOT_DONE;

// The controller has no gains at first: its output is 0, and stays so if the
// experiment fails.
static void start(void)
{
    tuned.output_min = 0;
    tuned.output_max = PORT_DRIVE_FULL;
    start_experiment(&tuner);
    (void)fixpid_pid_init(&oven, &tuned);
}

// The controller goes on from the output that holds the temperature. Model and
// gains are computed with divisions: on a small chip this is the longest pass
// of all, and takes many ticks.
static void take_result(void)
{
    struct fixpid_autotune_process process;

    if (fixpid_autotune_result(&tuner, AUTOTUNE_RULE, ROBUSTNESS_Q4, &tuned) &&
        fixpid_autotune_model(&tuner, &process)) {
        no_gains = (uint8_t)FIXPID_AUTOTUNE_NO_REASON;
        (void)fixpid_pid_init(&oven, &tuned);
        fixpid_pid_seed(&oven, process.holding);
    } else {
        no_gains = fixpid_autotune_reason(&tuner, AUTOTUNE_RULE, ROBUSTNESS_Q4);
    }
}

static bool experiment_is(enum fixpid_autotune_state status)
{
    return fixpid_autotune_status(&tuner) == (uint8_t)status;
}

static void control(void)
{
    const int16_t setpoint = set_temperature();
    const int16_t measurement = temperature();

    if (experiment_is(FIXPID_AUTOTUNE_RUNNING)) {
        port_drive(fixpid_autotune_step(&tuner, setpoint, measurement));
        if (!experiment_is(FIXPID_AUTOTUNE_RUNNING)) {
            take_result();
        }
    } else if (sensed(measurement)) {
        port_drive(fixpid_pid_step(&oven, setpoint, measurement));
    } else {
        port_drive(0); // the controller rests until the sensor is there again
    }
}

int main(void)
{
    port_init();
    start();
    while (port_running()) {
        (void)port_wait_ticks(CONTROL_PERIOD_TICKS);
        control();
    }
    return 0;
}
