// SPDX-License-Identifier: MIT
// The experiment alone, on a chip that is too small for what makes gains of it.
// The chip keeps a record, of which a PC computes the gains; docs/choosing.md
// says for which chips that is the way.
#include "fixpid_autotune.h"
#include "port.h"

#include "../oven_temperature.h"

#define CONTROL_PERIOD_TICKS 100u

// These are in counts of temperature, of which a degree has 16.
#define COLDEST 16
#define HOTTEST 4000       // 250 C; the sensor ends at 256
#define SWING 160u         // 10 C are enough, from top to bottom
#define TIMEOUT_STEPS 600u // a minute for half a cycle

// Deviation 8.4: the application's one experiment, found by its name.
FIXPID_DATA struct fixpid_autotune tuner;

// The experiment when it is over, for a debugger to read; a product would send
// it, or keep it in its EEPROM. All bytes are 0 before.
// Deviation 8.4: found by its name.
struct fixpid_autotune_record measured;

// The heater is off when the experiment is over.
static void control(void)
{
    const int16_t setpoint = set_temperature();

    port_drive(fixpid_autotune_step(&tuner, setpoint, temperature()));
    if (measured.bytes[0] == 0u) {
        (void)fixpid_autotune_pack(&tuner, &measured); // false while it runs
    }
}

int main(void)
{
    static const struct fixpid_autotune_config experiment = {
        .output_min = 0,
        .output_max = PORT_DRIVE_FULL,
        .output_rest = 0,
        .measurement_min = COLDEST,
        .measurement_max = HOTTEST,
        .swing = SWING,
        .timeout_steps = TIMEOUT_STEPS,
        .cycles = 1,
    };

    port_init();
    (void)fixpid_autotune_init(&tuner, &experiment);
    while (port_running()) {
        (void)port_wait_ticks(CONTROL_PERIOD_TICKS);
        control();
    }
    return 0;
}
