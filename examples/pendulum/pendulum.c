// SPDX-License-Identifier: MIT
// This is AN964's demonstration: it keeps an inverted pendulum upright by
// moving the pendulum's base, and reads the gains from three potentiometers.
#include "fixpid_an964.h"
#include "port.h"

#include "drift.h"

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_an964 pendulum;

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
