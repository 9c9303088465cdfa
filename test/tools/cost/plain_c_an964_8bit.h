// SPDX-License-Identifier: MIT
// AN964's 8-bit form as one writes it for a 32-bit machine: signed numbers of
// 32 bits, clamps, divisions. It gives the library's answers and is what the
// library's cost is compared with where a chip has a multiplier.
#ifndef PLAIN_C_AN964_8BIT_H
#define PLAIN_C_AN964_8BIT_H
#include <stdint.h>

#include "fixpid_an964_8bit.h"

struct plain_c_an964_8bit {
    struct fixpid_an964_8bit_gains gains;
    int8_t error[3]; // the newest first
    int16_t sum;
    int8_t integral;
    int8_t derivative;
    uint8_t flags;
};

int32_t plain_c_an964_8bit_step(struct plain_c_an964_8bit *self, int32_t error);

#endif
