// SPDX-License-Identifier: MIT
// This is AN964's demonstration in the form of the note's assembly program: the
// pendulum and the potentiometers are the same, and the products are of 8 x 8
// bits.
#include "fixpid_an964_8bit.h"
#include "port.h"

#include "../pendulum/drift.h"

#define CONVERSION_MAX 1023
#define UPRIGHT_BYTE 128

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_an964_8bit pendulum;

static void stop(void)
{
    port_drive(0);
    fixpid_an964_8bit_reset(&pendulum);
    drift_offset = 0;
}

// The offset is added in 10-bit counts, before the two low bits are dropped.
// Subtracting 128 is the note's "add 128 and ignore the carry".
static int8_t error_byte(int16_t conversion)
{
    int16_t counts = (int16_t)(conversion + (int16_t)drift_counts() - NO_DRIFT);
    if (counts < 0) {
        counts = 0;
    }
    if (counts > CONVERSION_MAX) {
        counts = CONVERSION_MAX;
    }
    return (int8_t)((int16_t)((uint16_t)counts >> 2) - UPRIGHT_BYTE);
}

static void balance(int16_t conversion)
{
    const int8_t error = error_byte(conversion);
    const int16_t output = fixpid_an964_8bit_step(&pendulum, error);
    port_drive(output);
    follow_drift(output);
}

static void read_gains(void)
{
    const uint8_t kp = (uint8_t)(port_read(PORT_KP) >> 3);
    const uint8_t ki = (uint8_t)(port_read(PORT_KI) >> 3);
    const uint8_t kd = (uint8_t)(port_read(PORT_KD) >> 3);
    (void)fixpid_an964_8bit_set_gains(&pendulum, kp, ki, kd);
}

int main(void)
{
    static const struct fixpid_an964_8bit_gains from_rest = {0, 0, 0};

    port_init();
    (void)fixpid_an964_8bit_init(&pendulum, &from_rest);
    while (port_running()) {
        (void)port_wait_tick();
        read_gains();
        const int16_t conversion = (int16_t)port_read(PORT_ANGLE);
        if ((conversion > (UPRIGHT_COUNTS + ANGLE_LIMIT_COUNTS)) ||
            (conversion < (UPRIGHT_COUNTS - ANGLE_LIMIT_COUNTS))) {
            stop();
        } else {
            balance(conversion);
        }
    }
    return 0;
}
