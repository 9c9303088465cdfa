// SPDX-License-Identifier: MIT
// This oven finds its own gains: from power-on a relay experiment runs around
// the setpoint, and then a controller with what it found.
#include "fixpid_pid.h"
#include "fixpid_relay.h"
#include "port.h"

#include "../oven_sensor.h"

// The rule that makes gains of the experiment is an enum fixpid_relay_rule.
#ifndef AUTOTUNE_RULE
#define AUTOTUNE_RULE FIXPID_RELAY_TYREUS_LUYBEN_PID
#endif

#define CONTROL_PERIOD_TICKS 100u

// The heater of the experiment is off or at 30 %, which leaves the 15 % that
// the setpoint needs in the middle.
#define RELAY_HIGH ((PORT_DRIVE_FULL * 3) / 10)
#define SEED (RELAY_HIGH / 2)

// These are in counts of temperature, of which a degree has 16.
#define COLDEST 16
#define HOTTEST 4000 // 250 C; the sensor ends at 256
#define HYSTERESIS 8u
#define TIMEOUT_STEPS 600u // a minute for half a cycle
#define CYCLES 4u

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_pid oven;
// Deviation 8.4: and its one experiment.
FIXPID_DATA struct fixpid_relay tuner;

// This is what the experiment found, for a debugger to read; a product would
// keep it in its EEPROM and not tune again. It is all 0 before the experiment
// ends, and after a failure.
// Deviation 8.4: found by its name.
struct fixpid_pid_gains tuned_gains;

// The controller has no gains at first: its output is 0, and stays so if the
// experiment fails.
static void start(void)
{
    static const struct fixpid_relay_config experiment = {
        .output_low = 0,
        .output_high = RELAY_HIGH,
        .output_rest = 0,
        .measurement_min = COLDEST,
        .measurement_max = HOTTEST,
        .hysteresis = HYSTERESIS,
        .timeout_steps = TIMEOUT_STEPS,
        .cycles = CYCLES,
    };
    static const struct fixpid_pid_config controller = {
        .output_min = 0,
        .output_max = PORT_DRIVE_FULL,
    };

    (void)fixpid_relay_init(&tuner, &experiment);
    (void)fixpid_pid_init(&oven, &controller);
}

// The controller goes on from the middle of the relay. The result is computed
// with divisions: on a small chip this is the longest pass of all, and may take
// more than a tick.
static void take_result(void)
{
    if (fixpid_relay_result(&tuner, AUTOTUNE_RULE, &tuned_gains)) {
        (void)fixpid_pid_set_gains(&oven, &tuned_gains);
        fixpid_pid_seed(&oven, SEED);
    }
}

static bool experiment_is(enum fixpid_relay_status status)
{
    return fixpid_relay_status(&tuner) == (uint8_t)status;
}

static void control(void)
{
    const int16_t setpoint = set_temperature();
    const int16_t measurement = temperature();

    if (experiment_is(FIXPID_RELAY_RUNNING)) {
        port_drive(fixpid_relay_step(&tuner, setpoint, measurement));
        if (experiment_is(FIXPID_RELAY_DONE)) {
            take_result();
        }
    } else {
        port_drive(fixpid_pid_step(&oven, setpoint, measurement));
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
