// SPDX-License-Identifier: MIT
#include "fixpid_an964.h"
#include "port.h"

FIXPID_DATA struct fixpid_an964 axis;

static const struct fixpid_an964_gains gains = {
    .kp = 600, .ki = 100, .kd = 300};

int main(void)
{
    port_init();
    if (fixpid_an964_init(&axis, &gains)) {
        while (port_running()) {
            (void)port_wait_tick(); // 256 times a second
            const int16_t angle = (int16_t)port_read(PORT_ANGLE);

            port_drive(fixpid_an964_step(&axis, (int16_t)(512 - angle)));
        }
    }
    return 0;
}
