// SPDX-License-Identifier: MIT
// AN937's controller holds the temperature of a small oven. P follows every
// millisecond, I and D follow a slower tick that the application makes by
// counting the port's.
#include "fixpid_an937.h"
#include "port.h"

#include "../oven_guard.h"
#include "../turned_down.h"

// These are the gains x 16, each 0..255.
#ifndef OVEN_KP_Q4
#define OVEN_KP_Q4 136
#endif
#ifndef OVEN_KI_Q4
#define OVEN_KI_Q4 6
#endif
#ifndef OVEN_KD_Q4
#define OVEN_KD_Q4 205
#endif
#if OVEN_KP_Q4 < 0 || OVEN_KP_Q4 > 255
#error "OVEN_KP_Q4: 0..255"
#endif
#if OVEN_KI_Q4 < 0 || OVEN_KI_Q4 > 255
#error "OVEN_KI_Q4: 0..255"
#endif
#if OVEN_KD_Q4 < 0 || OVEN_KD_Q4 > 255
#error "OVEN_KD_Q4: 0..255"
#endif

#define CONTROL_TICK_MS 400u
#define DERIVATIVE_PERIOD_TICKS 1u
#define OUTPUT_PER_DUTY 8 // so that the gains use their range

// With this limit the integral term alone can just reach full drive (or as near
// as the limit goes).
#if OVEN_KI_Q4 > 1
#define ACCUMULATED_ERROR_LIMIT                                                \
    (16L * OUTPUT_PER_DUTY * PORT_DRIVE_FULL / OVEN_KI_Q4)
#else
#define ACCUMULATED_ERROR_LIMIT 65535
#endif

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_an937 oven;

// A heater cannot cool, so its duty is 0..PORT_DRIVE_FULL.
static int16_t heater_duty(int32_t output)
{
    if (output <= 0) {
        return 0;
    }
    if (output >= (int32_t)PORT_DRIVE_FULL * OUTPUT_PER_DUTY) {
        return PORT_DRIVE_FULL;
    }
    return (int16_t)(output / OUTPUT_PER_DUTY);
}

// There is at most one control tick, as 255 ms are less than its period. What
// else only init sets is set each time, as a bit that has flipped in it would
// else last.
static void count_milliseconds(uint8_t ticks)
{
    static uint16_t waited_ms = 0;

    waited_ms = (uint16_t)(waited_ms + ticks);
    if (waited_ms >= CONTROL_TICK_MS) {
        waited_ms = (uint16_t)(waited_ms - CONTROL_TICK_MS);
        (void)fixpid_an937_set_gains(&oven, OVEN_KP_Q4, OVEN_KI_Q4, OVEN_KD_Q4);
        (void)fixpid_an937_set_accumulated_error_limit(&oven,
                                                       ACCUMULATED_ERROR_LIMIT);
        (void)fixpid_an937_set_derivative_period(&oven,
                                                 DERIVATIVE_PERIOD_TICKS);
        fixpid_an937_tick(&oven);
    }
}

// The error is four times the difference in counts of the converter, so that
// its 1023 counts are the note's 4000. Each pass is a step of the guard.
// Without a sensor the heater is off, and after an alarm the controller begins
// anew, too.
static void control(void)
{
    const int16_t setpoint = set_temperature();
    const int16_t measurement = temperature();
    const int16_t error = (int16_t)(setpoint - measurement);
    int16_t duty = 0;

    if (sensed(measurement)) {
        duty = heater_duty(fixpid_an937_step(&oven, error));
    }
    (void)fixpid_guard_step(&guard, setpoint, measurement, duty);
    if (is_off(setpoint)) {
        fixpid_an937_reset(&oven);
        duty = 0;
    }
    port_drive(duty);
}

int main(void)
{
    static const struct fixpid_an937_config config = {
        OVEN_KP_Q4, OVEN_KI_Q4, OVEN_KD_Q4, ACCUMULATED_ERROR_LIMIT,
        DERIVATIVE_PERIOD_TICKS};
    static const struct fixpid_guard_config guarded =
        OVEN_GUARD(GUARD_PATIENCE_MS);

    port_init();
    (void)fixpid_an937_init(&oven, &config);
    (void)fixpid_guard_init(&guard, &guarded);
    while (port_running()) {
        count_milliseconds(port_wait_tick());
        control();
    }
    return 0;
}
