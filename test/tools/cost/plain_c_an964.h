// SPDX-License-Identifier: MIT
// AN964's 10-bit form as one writes it for a 32-bit machine: signed numbers of
// 32 bits, clamps, divisions. It gives the library's answers and is what the
// library's cost is compared with where a chip has a multiplier.
#ifndef PLAIN_C_AN964_H
#define PLAIN_C_AN964_H
#include <stdint.h>

#include "fixpid_an964.h"

struct plain_c_an964 {
    struct fixpid_an964_gains gains;
    int16_t sum;
    int16_t error[3]; // the newest first
    int16_t integral;
    int16_t derivative;
    uint8_t flags;
};

int32_t plain_c_an964_step(struct plain_c_an964 *self, int32_t error);

#endif
