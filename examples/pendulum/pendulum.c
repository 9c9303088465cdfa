// SPDX-License-Identifier: MIT
// AN964's demonstration: an inverted pendulum kept upright by moving its base,
// with the gains on three potentiometers.
#include "fixpid_an964.h"
#include "port.h"

// How far the drift offset may go, in eighths of a count: 0..127, 0 switches it
// off. The note's value is 55.
#ifndef PENDULUM_DRIFT_LIMIT
#define PENDULUM_DRIFT_LIMIT 55
#endif
#if PENDULUM_DRIFT_LIMIT < 0 || PENDULUM_DRIFT_LIMIT > 127
#error "PENDULUM_DRIFT_LIMIT: 0..127"
#endif

#define UPRIGHT_COUNTS 512
#define ANGLE_LIMIT_COUNTS 341 // 20 degrees

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_an964 pendulum;

static int8_t drift_offset;

// The offset / 8 toward zero; by magnitude, as a PIC16 has no division.
static int16_t drift_counts(void)
{
    if (drift_offset < 0) {
        const uint8_t magnitude = (uint8_t)-drift_offset;
        return (int16_t) - (int16_t)(magnitude >> 3);
    }
    return (int16_t)((uint8_t)drift_offset >> 3);
}

// A drive that keeps its sign drives the base away: shift the upright angle
// until it comes back.
static void follow_drift(int16_t output)
{
    if ((output > 0) && (drift_offset < PENDULUM_DRIFT_LIMIT)) {
        drift_offset++;
    }
    if ((output < 0) && (drift_offset > -PENDULUM_DRIFT_LIMIT)) {
        drift_offset--;
    }
}

static void stop(void)
{
    port_drive(0);
    fixpid_an964_reset(&pendulum);
    drift_offset = 0;
}

static void balance(int16_t angle)
{
    const int16_t error = (int16_t)(angle + drift_counts());
    const int16_t output = fixpid_an964_step(&pendulum, error);
    port_drive(output);
    follow_drift(output);
}

static void read_gains(void)
{
    const uint16_t kp = port_read(PORT_KP);
    const uint16_t ki = port_read(PORT_KI);
    const uint16_t kd = port_read(PORT_KD);
    (void)fixpid_an964_set_gains(&pendulum, kp, ki, kd);
}

int main(void)
{
    static const struct fixpid_an964_gains from_rest = {0, 0, 0};

    port_init();
    (void)fixpid_an964_init(&pendulum, &from_rest);
    while (port_running()) {
        (void)port_wait_tick();
        read_gains();
        const int16_t angle =
            (int16_t)((int16_t)port_read(PORT_ANGLE) - UPRIGHT_COUNTS);
        if ((angle > ANGLE_LIMIT_COUNTS) || (angle < -ANGLE_LIMIT_COUNTS)) {
            stop();
        } else {
            balance(angle);
        }
    }
    return 0;
}
