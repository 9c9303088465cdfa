// SPDX-License-Identifier: MIT
#include "numbers_control.h"

#include "numbers.h"

bool numbers_one_in(uint32_t count)
{
    return numbers_below(count) == 0u;
}

uint32_t numbers_any_size(void)
{
    const uint32_t high = numbers_next() << 16;
    const uint32_t any = high ^ numbers_next();
    const uint8_t bits = (uint8_t)numbers_below(32);

    return any >> bits;
}

int16_t numbers_close_to(int16_t value, uint16_t most)
{
    const uint16_t up = (uint16_t)numbers_below(most + UINT32_C(1));
    const uint16_t close =
        (uint16_t)((uint16_t)value +
                   (numbers_one_in(2) ? up : (uint16_t)(0u - up)));

    return (int16_t)close;
}
