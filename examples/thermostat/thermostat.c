// SPDX-License-Identifier: MIT
// This is a thermostat on the general-purpose controller. It heats a small oven
// from cold, and a person may switch the oven off, drive it by hand or run it
// on little power while it is hot, without a jump of the heater.
#include "fixpid_pid.h"
#include "port.h"

#include "../alarm.h"
#include "../oven_guard.h"

#define CONTROL_PERIOD_TICKS 100u
#define STEPS_PER_SECOND 10.0

// The controller is set up anew this often, 10 s: a bit that has flipped in its
// gains or limits would else last until a reset.
#define RENEWED_PERIODS 100u

#define Q8_ONE 256

// The gains are in duty counts per count of temperature, of which a degree has
// 16.
#define KP 1.3
#define KI 0.35 // per second
#define KD 0.8  // seconds
#define DERIVATIVE_FILTER 1u
#define SETPOINT_WEIGHT_Q8 154u // 0.6: softens a step of the setpoint

#define KEEP_WARM_DUTY (PORT_DRIVE_FULL / 10)
#define LOW_POWER_DUTY (PORT_DRIVE_FULL / 8)

// The selector is a rotary switch on a ladder of resistors. Each position has a
// quarter of the converter's range, and a broken wire reads as off.
#define SELECTOR_OFF 0u
#define SELECTOR_AUTOMATIC 1u
#define SELECTOR_MANUAL 2u
#define SELECTOR_LOW_POWER 3u
#define READING_TO_POSITION 8u

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_pid thermostat;

static const struct fixpid_pid_config config = {
    .gains = FIXPID_PID_GAINS(KP, KI, KD, STEPS_PER_SECOND, DERIVATIVE_FILTER),
    .output_min = 0,
    .output_max = PORT_DRIVE_FULL,
    .setpoint_weight_q8 = SETPOINT_WEIGHT_Q8,
};

static uint8_t position = SELECTOR_OFF;
static uint8_t age_periods = 0; // of the controller

// Off acknowledges an alarm. From off the controller starts anew, at full power
// if the oven is cold. From manual it takes over where the heater is. Limits
// may change at any time.
static void enter(uint8_t next)
{
    int16_t most = PORT_DRIVE_FULL;
    if (next == SELECTOR_LOW_POWER) {
        most = LOW_POWER_DUTY;
    }
    (void)fixpid_pid_set_limits(&thermostat, 0, most);
    if (next == SELECTOR_OFF) {
        fixpid_pid_set_manual(&thermostat, 0);
        fixpid_guard_acknowledge(&guard);
    } else if (next == SELECTOR_MANUAL) {
        fixpid_pid_set_manual(&thermostat, KEEP_WARM_DUTY);
    } else if (position == SELECTOR_OFF) {
        fixpid_pid_reset(&thermostat);
    } else {
        fixpid_pid_set_auto(&thermostat);
    }
    position = next;
}

// A position counts when it is read twice: between two contacts the switch may
// read anything.
static void follow_selector(void)
{
    static uint8_t last = SELECTOR_OFF;
    const uint8_t now =
        (uint8_t)(port_read(PORT_SELECTOR) >> READING_TO_POSITION);

    if ((now == last) && (now != position)) {
        enter(now);
    }
    last = now;
}

// The controller begins anew and takes over from a duty, whatever its RAM had
// become.
static void go_on_from(int16_t duty)
{
    age_periods = 0;
    (void)fixpid_pid_init(&thermostat, &config);
    fixpid_pid_seed(&thermostat, duty);
    enter(position);
}

// A heater cannot cool. The controller's limits say so, too, unless a bit of
// them has flipped; the port keeps the other end.
static int16_t heater_duty(int16_t output)
{
    if (output < 0) {
        return 0;
    }
    return output;
}

// The duty without the derivative, whose noise would else stay in the integral.
static int16_t steady_duty(int16_t duty)
{
    int32_t steady = duty - (fixpid_pid_derivative(&thermostat) / Q8_ONE);

    if (steady > PORT_DRIVE_FULL) {
        steady = PORT_DRIVE_FULL;
    }
    if (steady < 0) {
        steady = 0;
    }
    return (int16_t)steady;
}

// Without an automatic nobody controls, and only the sensor is judged.
static bool alarm(int16_t setpoint, int16_t measurement, int16_t duty)
{
    int16_t goal = setpoint;

    if ((position == SELECTOR_OFF) || (position == SELECTOR_MANUAL)) {
        goal = measurement;
    }
    return (fixpid_guard_step(&guard, goal, measurement, duty) & ALARMS) != 0u;
}

// Without a sensor the heater is off and the controller waits. After an alarm
// the heater is off until a person turns the selector to off, and on from
// there. The board has no lamp: the heater that stays off is what tells, and
// the guard's flags what it was. Now and then the controller goes on from its
// duty without the derivative.
static void control(void)
{
    static int16_t duty = 0;
    int16_t drive = 0;

    follow_selector();
    const int16_t setpoint = set_temperature();
    const int16_t measurement = temperature();
    age_periods++;
    if (age_periods >= RENEWED_PERIODS) {
        go_on_from(steady_duty(duty));
    }
    if (sensed(measurement)) {
        duty = heater_duty(fixpid_pid_step(&thermostat, setpoint, measurement));
        drive = duty;
    }
    if (alarm(setpoint, measurement, duty)) {
        fixpid_pid_set_manual(&thermostat, 0);
        duty = 0;
        drive = 0;
    }
    port_drive(drive);
}

int main(void)
{
    static const struct fixpid_guard_config guarded =
        OVEN_GUARD(GUARD_PATIENCE_MS / CONTROL_PERIOD_TICKS);

    port_init();
    (void)fixpid_pid_init(&thermostat, &config);
    (void)fixpid_guard_init(&guard, &guarded);
    fixpid_pid_set_manual(&thermostat, 0);
    while (port_running()) {
        (void)port_wait_ticks(CONTROL_PERIOD_TICKS);
        control();
    }
    return 0;
}
