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
#define NO_DRIFT 16

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_an964 pendulum;

static int8_t drift_offset;

// The offset / 8 toward zero, and NO_DRIFT: without a sign it is divided by a
// shift, as a PIC16 has no division.
static uint8_t drift_counts(void)
{
    uint8_t eighths = (uint8_t)((uint8_t)drift_offset + 128u);

    if ((eighths & 128u) == 0u) {
        eighths += 7u; // at most 127 + 7
    }
    return (uint8_t)(eighths >> 3);
}

// A drive that keeps its sign drives the base away: shift the upright angle
// until it comes back.
static void follow_drift(int16_t output)
{
    if (output < 0) {
        if (drift_offset != -PENDULUM_DRIFT_LIMIT) {
            drift_offset--;
        }
    } else if ((output != 0) && (drift_offset != PENDULUM_DRIFT_LIMIT)) {
        drift_offset++;
    } else {
        // neither rises nor falls
    }
}

static void stop(void)
{
    port_drive(0);
    fixpid_an964_reset(&pendulum);
    drift_offset = 0;
}

static void balance(int16_t conversion)
{
    const uint8_t drift = drift_counts();
    const int16_t error =
        (int16_t)(conversion + (int16_t)drift - (UPRIGHT_COUNTS + NO_DRIFT));
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
        const int16_t conversion = (int16_t)port_read(PORT_ANGLE);
        if ((conversion < (UPRIGHT_COUNTS - ANGLE_LIMIT_COUNTS)) ||
            (conversion > (UPRIGHT_COUNTS + ANGLE_LIMIT_COUNTS))) {
            stop();
        } else {
            balance(conversion);
        }
    }
    return 0;
}
