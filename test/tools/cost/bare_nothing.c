// SPDX-License-Identifier: MIT
// The application without a controller.
#include "bare.h"

void main(void)
{
    for (;;) {
        bare_output = bare_input;
    }
}
