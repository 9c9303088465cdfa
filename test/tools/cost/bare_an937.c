// SPDX-License-Identifier: MIT
// The least application with this controller, for its size.
#include "bare.h"
#include "fixpid_an937.h"

FIXPID_DATA struct fixpid_an937 FIXPID_AN937_PLACE an937_controller;

void main(void)
{
    static const struct fixpid_an937_config config = {96, 80, 16, 4000, 4};

    (void)fixpid_an937_init(&an937_controller, &config);
    for (;;) {
        fixpid_an937_tick(&an937_controller);
        bare_output = (int16_t)fixpid_an937_step(&an937_controller, bare_input);
    }
}
