// SPDX-License-Identifier: MIT
#include "numbers_control.h"

#include "numbers.h"

uint32_t numbers_slew_rate(void)
{
    switch (numbers_below(8)) {
    case 0:
        return 0;
    case 1:
        return UINT32_MAX - numbers_below(2);
    case 2: // 65535 counts, which are no limit
        return UINT32_C(0xFFFEFFFF) + numbers_below(3);
    case 3: // whole counts and halves
        return numbers_any_size() & UINT32_C(0xFFFF8000);
    default:
        return numbers_any_size();
    }
}
