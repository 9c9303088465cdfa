// SPDX-License-Identifier: MIT
// AN937's controller as one writes it for a 32-bit machine: signed numbers of
// 32 bits, clamps, and `/ 16`. It gives the library's answers and is what the
// library's cost is compared with where a chip has a multiplier.
#ifndef PLAIN_C_AN937_H
#define PLAIN_C_AN937_H
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_an937.h"

struct plain_c_an937 {
    struct fixpid_an937_config config;
    int32_t accumulated_error;
    int32_t delta;
    int32_t sum; // limited, before the division: its sign is in the status
    int16_t error;
    int16_t previous_error;
    uint8_t derivative_countdown;
    bool tick_pending;
    bool tick_overrun;
    bool sum_saturated;
    bool accumulated_error_limited;
};

void plain_c_an937_init(struct plain_c_an937 *self,
                        const struct fixpid_an937_config *config);
void plain_c_an937_tick(struct plain_c_an937 *self);
int32_t plain_c_an937_step(struct plain_c_an937 *self, int16_t error);

#endif
