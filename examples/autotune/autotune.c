// SPDX-License-Identifier: MIT
// This oven finds its own gains: after power-on it heats up and watches how the
// temperature begins to rise, and then a controller goes on with what that
// tells.
#include "fixpid_pid.h"
#include "fixpid_reaction.h"
#include "port.h"

#include "../oven_sensor.h"

#define CONTROL_PERIOD_TICKS 100u

// At full power this oven gets 67 K warmer in a second, and a second is what it
// takes to notice: 80 C would be passed. At a quarter, 17 K coast on.
#define HEAT_UP (PORT_DRIVE_FULL / 4)

// The rule that makes gains of the heat-up is an enum fixpid_reaction_rule.
#ifndef AUTOTUNE_RULE
#define AUTOTUNE_RULE FIXPID_REACTION_PID
#endif
#define HALF_Q8 128 // of the setpoint's step goes to P: no overshoot

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_pid oven;
// Deviation 8.4: and its one tuner.
FIXPID_DATA struct fixpid_reaction tuner;

// This is what was found, for a debugger to read; a product would keep it in
// its EEPROM and not tune again. The gains are all 0 before, and stay so where
// none were found: fixpid_reaction_status says why.
// Deviation 8.4: found by its name.
struct fixpid_pid_config tuned;

// The controller has no gains at first: its output is 0, and stays so if there
// are none. What was set at power-on must not be passed.
static void start(void)
{
    struct fixpid_reaction_config heat_up = {.output_rest = 0,
                                             .output_drive = HEAT_UP};

    heat_up.measurement_stop = set_temperature();
    (void)fixpid_reaction_init(&tuner, &heat_up);
    tuned.output_min = 0;
    tuned.output_max = PORT_DRIVE_FULL;
    tuned.setpoint_weight_q8 = HALF_Q8;
    (void)fixpid_pid_init(&oven, &tuned);
}

static bool is_tuning(void)
{
    return fixpid_reaction_status(&tuner) == (uint8_t)FIXPID_REACTION_RUNNING;
}

// The gains are computed with divisions: on a small chip this is the longest
// pass of all.
static int16_t tune(int16_t measurement)
{
    const int16_t duty = fixpid_reaction_step(&tuner, measurement);

    if (fixpid_reaction_result(&tuner, AUTOTUNE_RULE, FIXPID_REACTION_SAFE,
                               &tuned.gains)) {
        (void)fixpid_pid_init(&oven, &tuned);
    }
    return duty;
}

// Without a sensor the heater is off. A heat-up begins anew then, and a
// controller rests until the sensor is there again. The controller goes on in
// the period in which the heat-up ends.
static int16_t heater_duty(int16_t setpoint, int16_t measurement)
{
    int16_t duty = 0;

    if (!sensed(measurement)) {
        if (is_tuning()) {
            fixpid_reaction_reset(&tuner);
        }
        return 0;
    }
    if (is_tuning()) {
        duty = tune(measurement);
    }
    if (!is_tuning()) {
        duty = fixpid_pid_step(&oven, setpoint, measurement);
    }
    return duty;
}

static void control(void)
{
    const int16_t setpoint = set_temperature();

    port_drive(heater_duty(setpoint, temperature()));
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
