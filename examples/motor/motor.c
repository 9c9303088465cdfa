// SPDX-License-Identifier: MIT
// This is AN937's motor. The controller holds its speed, which a tachometer
// measures, with the note's gains and the note's change of the integral gain
// once the motor runs.
#include "fixpid_an937.h"
#include "port.h"

#include "../turned_down.h"

// The anti-windup limit of the accumulated error is 1..65535. The note's value
// is 4000; 65535 is as good as none.
#ifndef MOTOR_ACCUMULATED_ERROR_LIMIT
#define MOTOR_ACCUMULATED_ERROR_LIMIT 4000
#endif
#if MOTOR_ACCUMULATED_ERROR_LIMIT < 1 || MOTOR_ACCUMULATED_ERROR_LIMIT > 65535
#error "MOTOR_ACCUMULATED_ERROR_LIMIT: 1..65535"
#endif

#define KP_Q4 96u
#define KI_START_Q4 80u
#define KI_RUNNING_Q4 144u
#define KD_Q4 16u
#define DERIVATIVE_PERIOD_TICKS 4u

#define ERROR_PER_COUNT 4  // 1023 counts are the note's 4000
#define CLOSE_ERROR 80     // 2 % of the note's range
#define RUNNING_TICKS 250u // this long close to the set speed

// Of the guard, whose step is a tick of 1 ms. The plant that it guards,
// sim/plant/plant_motor.h, has a gain of 1 count of speed for one of duty, a
// time constant of 25 ms, that is a slope of 0.04, a dead time of a tick and
// 0.4 counts of noise. The rule of fixpid_guard.h makes of that a band of 8
// counts and a patience of 4. It is 20, as the noise of a bad tachometer is
// more than 0.4: in 4 steps of it there may be no progress.
#define GUARD_BAND 8u
#define GUARD_PATIENCE 20u
// Full drive surely brings 360 rad/s, with 22 V of 24 and the largest load.
#define GUARD_REACH_MAX 768

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_an937 motor;

static int16_t limited_to_full_drive(int32_t output)
{
    if (output > PORT_DRIVE_FULL) {
        return PORT_DRIVE_FULL;
    }
    if (output < -PORT_DRIVE_FULL) {
        return -PORT_DRIVE_FULL;
    }
    return (int16_t)output;
}

// Once the motor first runs close to its set speed, it gets the higher integral
// gain, for good. A motor that is to stand still does not count as running.
static void follow_schedule(int16_t setpoint, int16_t error)
{
    static uint8_t close_ticks = 0;

    if (close_ticks == RUNNING_TICKS) {
        return;
    }
    if (((setpoint * ERROR_PER_COUNT) <= CLOSE_ERROR) ||
        (error > CLOSE_ERROR) || (error < -CLOSE_ERROR)) {
        close_ticks = 0;
        return;
    }
    close_ticks++;
    if (close_ticks == RUNNING_TICKS) {
        (void)fixpid_an937_set_gains(&motor, KP_Q4, KI_RUNNING_Q4, KD_Q4);
    }
}

// P acts on every pass, I and D on the passes after a tick. The guard sees what
// the controller asks for in those. After an alarm the drive is off and the
// controller begins anew.
static void control(uint8_t ticks)
{
    const int16_t setpoint = (int16_t)port_read(PORT_SETPOINT);
    const int16_t speed = (int16_t)port_read(PORT_TACHOMETER);
    const int16_t error = (int16_t)((setpoint - speed) * ERROR_PER_COUNT);
    int16_t duty;

    for (uint8_t i = 0; i < ticks; i++) {
        fixpid_an937_tick(&motor);
        follow_schedule(setpoint, error);
    }
    duty = limited_to_full_drive(fixpid_an937_step(&motor, error));
    if (ticks > 0u) {
        (void)fixpid_guard_step(&guard, setpoint, speed, duty);
    }
    if (is_off(setpoint)) {
        fixpid_an937_reset(&motor);
        duty = 0;
    }
    port_drive(duty);
}

int main(void)
{
    static const struct fixpid_an937_config config = {
        KP_Q4, KI_START_Q4, KD_Q4, MOTOR_ACCUMULATED_ERROR_LIMIT,
        DERIVATIVE_PERIOD_TICKS};
    // A tachometer may read anything: one at an end is seen as one that does
    // not follow the drive.
    static const struct fixpid_guard_config guarded = {
        .output_min = -PORT_DRIVE_FULL,
        .output_max = PORT_DRIVE_FULL,
        .reach_max = GUARD_REACH_MAX,
        .band = GUARD_BAND,
        .patience = GUARD_PATIENCE,
    };

    port_init();
    (void)fixpid_an937_init(&motor, &config);
    (void)fixpid_guard_init(&guard, &guarded);
    while (port_running()) {
        control(port_ticks());
    }
    return 0;
}
