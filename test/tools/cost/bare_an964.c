// SPDX-License-Identifier: MIT
// The least application with this controller, for its size.
#include "bare.h"
#include "fixpid_an964.h"

FIXPID_DATA struct fixpid_an964 an964_controller;

void main(void)
{
    static const struct fixpid_an964_gains gains = {500, 300, 200};

    (void)fixpid_an964_init(&an964_controller, &gains);
    for (;;) {
        bare_output = fixpid_an964_step(&an964_controller, bare_input);
    }
}
