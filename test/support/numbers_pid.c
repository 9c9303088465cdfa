// SPDX-License-Identifier: MIT
#include "numbers_pid.h"

#include <stdbool.h>

#include "numbers.h"

static bool one_in(uint32_t count)
{
    return numbers_below(count) == 0u;
}

// 0..most, but one in 256 is any 16 bits.
static uint16_t gain(uint16_t most)
{
    switch (numbers_below(6)) {
    case 0:
        return 0;
    case 1:
        return (uint16_t)(most - numbers_below(2));
    case 2:
        return (uint16_t)numbers_below(most + 1u);
    case 3:
        return (uint16_t)numbers_below(256);
    case 4:
        return one_in(40) ? (uint16_t)numbers_next() : 256;
    default:
        return (uint16_t)numbers_below(4096);
    }
}

// Of every exponent and around the two borders between them.
static uint32_t integral_gain(void)
{
    const uint32_t any = (numbers_next() << 16) ^ numbers_next();

    switch (numbers_below(8)) {
    case 0:
        return 0;
    case 1:
        return FIXPID_PID_KI_MAX - numbers_below(2);
    case 2:
        return UINT32_C(32766) + numbers_below(4);
    case 3:
        return UINT32_C(8388478) + numbers_below(4);
    case 4:
        return any >> 17;
    case 5:
        return any >> 10;
    case 6:
        return one_in(40) ? any : any >> 20;
    default:
        return any >> 1;
    }
}

void numbers_pid_gains(struct fixpid_pid_gains *gains)
{
    gains->ki_q24 = integral_gain();
    gains->kp_q8 = gain(FIXPID_PID_KP_MAX);
    gains->kd_q8 = gain(FIXPID_PID_KD_MAX);
    gains->derivative_filter =
        (uint8_t)(one_in(100) ? 8u : numbers_below(one_in(2) ? 8 : 2));
}

void numbers_pid_range(int16_t *low, int16_t *high)
{
    int16_t swapped;

    *low = numbers_int16();
    *high = numbers_int16();
    if (*low > *high && !one_in(10)) {
        swapped = *low;
        *low = *high;
        *high = swapped;
    }
    if (one_in(8)) {
        *low = 0;
        *high = 0;
    } else if (one_in(4)) {
        *low = one_in(8) ? INT16_MIN : -INT16_MAX;
        *high = INT16_MAX;
    }
}

void numbers_pid_config(struct fixpid_pid_config *config)
{
    uint32_t options;

    numbers_pid_gains(&config->gains);
    numbers_pid_range(&config->output_min, &config->output_max);
    numbers_pid_range(&config->integral_min, &config->integral_max);
    options = numbers_next();
    config->reverse = (options & 0x80u) != 0u;
    config->derivative_on_error = (options & 0x40u) != 0u;
    config->proportional_on_measurement = (options & 0x20u) != 0u;
    config->setpoint_weight_q8 = 0;
    if (!config->proportional_on_measurement || one_in(40)) {
        config->setpoint_weight_q8 =
            (uint16_t)(one_in(60)  ? 257u
                       : one_in(2) ? 256u
                                   : numbers_below(256));
    }
    if (one_in(100)) {
        config->setpoint_weight_q8 = (uint16_t)(257u << numbers_below(5));
    }
}

void numbers_pid_inputs(int16_t *setpoint, int16_t *measurement)
{
    int32_t near;

    if (one_in(20)) {
        *setpoint = numbers_int16();
    }
    *measurement = numbers_int16();
    near = *setpoint + (int32_t)numbers_below(64) - 32;
    if (near == (int16_t)near && !one_in(4)) {
        *measurement = (int16_t)near;
    }
}
