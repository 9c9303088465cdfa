// SPDX-License-Identifier: MIT
// The least application with this controller, for its size.
#include "bare.h"
#include "fixpid_an964_8bit.h"

FIXPID_DATA struct fixpid_an964_8bit an964_8bit_controller;

void main(void)
{
    static const struct fixpid_an964_8bit_gains gains = {50, 30, 20};

    (void)fixpid_an964_8bit_init(&an964_8bit_controller, &gains);
    for (;;) {
        bare_output =
            fixpid_an964_8bit_step(&an964_8bit_controller, (int8_t)bare_input);
    }
}
