// SPDX-License-Identifier: MIT
#include "numbers_control.h"

#include "numbers.h"

// Near or far above x, and no more than 32767.
static int16_t some_x_above(int16_t x)
{
    const uint32_t room = (uint32_t)(INT16_MAX - (int32_t)x);
    const uint32_t most = numbers_one_in(3) ? 4u : numbers_any_size() >> 18;
    const uint32_t way = 1u + numbers_below(most + 1u);

    return (int16_t)((int32_t)x + (int32_t)(way < room ? way : room));
}

uint8_t numbers_table_points(struct fixpid_table_point points[], uint8_t most)
{
    uint8_t count = (uint8_t)numbers_below((uint32_t)most + 1u);
    int16_t x = numbers_one_in(4) ? INT16_MIN : numbers_int16();

    if (numbers_one_in(3) && count > 2u) {
        count = 2;
    }
    for (uint8_t i = 0; i < count; i++) {
        points[i].x = x;
        points[i].y = numbers_int16();
        if (x == INT16_MAX && !numbers_one_in(20)) {
            return (uint8_t)(i + 1u);
        }
        x = numbers_one_in(100) ? numbers_int16() : some_x_above(x);
    }
    if (count == 2u && numbers_one_in(2)) {
        points[0].x = INT16_MIN;
        points[1].x = INT16_MAX;
    }
    return count;
}

int16_t numbers_table_x(const struct fixpid_table_point points[], uint8_t count)
{
    if (count == 0u || numbers_one_in(3)) {
        return numbers_int16();
    }
    return numbers_close_to(points[numbers_below(count)].x, 100);
}
