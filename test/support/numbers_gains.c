// SPDX-License-Identifier: MIT
#include "numbers_control.h"

#include "numbers.h"

void numbers_gains_milli(struct fixpid_gains_milli *milli)
{
    milli->kp = numbers_any_size() >> (numbers_one_in(8) ? 0 : 15);
    milli->ki = numbers_any_size() >> (numbers_one_in(2) ? 0 : 12);
    milli->kd = numbers_any_size() >> (numbers_one_in(2) ? 0 : 12);
    if (numbers_one_in(16)) {
        milli->kp = UINT32_C(127997) + numbers_below(3);
    }
}

uint32_t numbers_gains_rate(void)
{
    switch (numbers_below(8)) {
    case 0:
        return FIXPID_GAINS_RATE_MAX - 1u + numbers_below(4);
    case 1:
        return numbers_below(3);
    default:
        return numbers_any_size() >> 3;
    }
}

uint8_t numbers_gains_filter(void)
{
    return (uint8_t)(numbers_one_in(50) ? 8u : numbers_below(8));
}
