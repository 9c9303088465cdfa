// SPDX-License-Identifier: MIT
// What the drivers for Frama-C's Eva are written with. A driver takes any
// configuration, makes an object of memory that was never written, and calls
// all functions with any arguments, in any order, for ever. Eva then names each
// place where C could leave something undefined, or none.
#ifndef EVA_H
#define EVA_H
#include <stdint.h>

#include "__fc_builtin.h"

#define ANY_INT8 Frama_C_char_interval(INT8_MIN, INT8_MAX)
#define ANY_UINT8 Frama_C_unsigned_char_interval(0, UINT8_MAX)
#define ANY_INT16 Frama_C_short_interval(INT16_MIN, INT16_MAX)
#define ANY_UINT16 Frama_C_unsigned_short_interval(0, UINT16_MAX)
#define ANY_INT32 Frama_C_long_interval(INT32_MIN, INT32_MAX)
#define ANY_UINT32 Frama_C_unsigned_long_interval(0, UINT32_MAX)
#define GOES_ON Frama_C_interval(0, 1)
#define ANY_OF(count) Frama_C_interval(1, (count))

// Initialisers of a fixpid_pid's gains, and of its configuration.
#define ANY_GAINS                                                              \
    {                                                                          \
        ANY_UINT16, ANY_UINT32, ANY_UINT16, ANY_UINT8                          \
    }
#define ANY_CONFIG                                                             \
    {                                                                          \
        .gains = ANY_GAINS, .output_min = ANY_INT16, .output_max = ANY_INT16,  \
        .integral_min = ANY_INT16, .integral_max = ANY_INT16,                  \
        .setpoint_weight_q8 = ANY_UINT16, .reverse = GOES_ON,                  \
        .derivative_on_error = GOES_ON, .proportional_on_measurement = GOES_ON \
    }

#endif
