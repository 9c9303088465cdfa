// SPDX-License-Identifier: MIT
#include "fixpid_pid.h"
#include "port.h"

FIXPID_DATA struct fixpid_pid oven;

static const struct fixpid_pid_config config = {
    .gains = FIXPID_PID_GAINS(2, 0.1, 0, 10, 0), // ten steps a second
    .output_min = 0,
    .output_max = PORT_DRIVE_FULL};

int main(void)
{
    port_init();
    if (fixpid_pid_init(&oven, &config)) {
        while (port_running()) {
            const int16_t setpoint = (int16_t)port_read(PORT_SETPOINT);
            const int16_t measured = (int16_t)port_read(PORT_TEMPERATURE);

            port_drive(fixpid_pid_step(&oven, setpoint, measured));
            port_wait_ticks(PORT_TICKS_PER_SECOND / 10u);
        }
    }
    return 0;
}
