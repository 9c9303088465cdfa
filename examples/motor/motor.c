// SPDX-License-Identifier: MIT
// This is AN937's motor. The controller holds its speed, which a tachometer
// measures, with the note's gains and the note's change of the integral gain
// once the motor runs.
#include "fixpid_an937.h"
#include "port.h"

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

// A tachometer that reads an end for so long, while so much drive pushes it
// away from there, is broken. The motor leaves an end within 2 ms.
#define LOW_END 8 // of 1023 counts
#define HIGH_END 1015
#define PUSH (PORT_DRIVE_FULL / 2)
#define DEAF_TICKS 20u

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_an937 motor;

// Deviation 8.9: its test begins each time with 0.
static uint16_t deaf_ticks = 0; // of a tachometer that does not answer

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

// For good, until the next reset: a motor that stands still reads as one whose
// tachometer is broken.
static bool is_deaf(uint8_t ticks, int16_t duty, int16_t speed)
{
    if (deaf_ticks >= DEAF_TICKS) {
        return true;
    }
    if (((duty >= PUSH) && (speed <= LOW_END)) ||
        ((duty <= -PUSH) && (speed >= HIGH_END))) {
        deaf_ticks = (uint16_t)(deaf_ticks + ticks);
    } else {
        deaf_ticks = 0;
    }
    return deaf_ticks >= DEAF_TICKS;
}

// P acts on every pass, I and D on the passes after a tick. The drive is off
// without a tachometer.
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
    if (is_deaf(ticks, duty, speed)) {
        duty = 0;
    }
    port_drive(duty);
}

int main(void)
{
    static const struct fixpid_an937_config config = {
        KP_Q4, KI_START_Q4, KD_Q4, MOTOR_ACCUMULATED_ERROR_LIMIT,
        DERIVATIVE_PERIOD_TICKS};

    port_init();
    (void)fixpid_an937_init(&motor, &config);
    while (port_running()) {
        control(port_ticks());
    }
    return 0;
}
