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

// 1..32767, small ones as often as large ones.
static uint16_t some_steps(void)
{
    const uint16_t steps = (uint16_t)(numbers_any_size() & 0x7FFFu);

    return steps == 0u ? 1u : steps;
}

// Windows are short, so that many of them are seen.
void numbers_tpo_config(struct fixpid_tpo_config *config)
{
    config->full = (int16_t)some_steps();
    config->window =
        (uint16_t)(numbers_one_in(20) ? some_steps() : 1u + numbers_below(24));
    config->minimum_on = (uint16_t)numbers_below(config->window + 1u);
    config->minimum_off =
        (uint16_t)numbers_below(config->window - config->minimum_on + 1u);
    if (numbers_one_in(40)) {
        config->minimum_off++; // sometimes one too many
    }
    if (numbers_one_in(40)) {
        config->window = (uint16_t)numbers_next();
    }
    if (numbers_one_in(40)) {
        config->full = numbers_int16();
    }
}

int16_t numbers_tpo_duty(int16_t full)
{
    switch (numbers_below(4)) {
    case 0:
        return numbers_int16();
    case 1:
        return numbers_one_in(2) ? full : 0;
    default:
        return (int16_t)numbers_below((uint32_t)(full < 1 ? 1 : full));
    }
}

// low..high, both any int16_t; low if they are the wrong way round
static int16_t between(int16_t low, int16_t high)
{
    const uint16_t span = (uint16_t)((uint16_t)high - (uint16_t)low);

    if (high < low) {
        return low;
    }
    return (int16_t)(low + (int32_t)numbers_below(span + UINT32_C(1)));
}

static void some_range(int16_t *low, int16_t *high)
{
    switch (numbers_below(4)) {
    case 0:
        *low = 0;
        *high = 0;
        break;
    case 1:
        *low = numbers_int16();
        *high = numbers_int16();
        break;
    default:
        *low = (int16_t)(-(int16_t)numbers_below(100));
        *high = (int16_t)(50u + numbers_below(400));
        break;
    }
}

void numbers_guard_config(struct fixpid_guard_config *config)
{
    some_range(&config->measurement_min, &config->measurement_max);
    config->reach_min = 0;
    config->reach_max = 0;
    if (!numbers_one_in(3)) {
        config->reach_min = between(config->measurement_min, 30);
        config->reach_max = between(config->reach_min, config->measurement_max);
    }
    config->output_min = (int16_t)(-(int16_t)numbers_below(20));
    config->output_max = (int16_t)(1u + numbers_below(300));
    config->band = (uint16_t)(1u + numbers_below(numbers_one_in(8) ? 100 : 6));
    config->patience = (uint16_t)(2u + numbers_below(6));
    config->reverse = numbers_one_in(4);
    config->noisy = numbers_one_in(4);
    if (numbers_one_in(40)) {
        config->band = (uint16_t)numbers_next();
    }
    if (numbers_one_in(40)) {
        config->patience = (uint16_t)numbers_next();
    }
    if (numbers_one_in(20)) {
        config->output_min = numbers_int16();
        config->output_max = numbers_int16();
    }
}

static int16_t close_to(int16_t value, uint16_t most)
{
    const uint16_t up = (uint16_t)numbers_below(most + UINT32_C(1));
    const uint16_t close =
        (uint16_t)((uint16_t)value +
                   (numbers_one_in(2) ? up : (uint16_t)(0u - up)));

    return (int16_t)close;
}

static int16_t some_output(const struct fixpid_guard_config *config)
{
    switch (numbers_below(8)) {
    case 0:
        return numbers_int16();
    case 1:
        return between(config->output_min, config->output_max);
    case 2:
    case 3:
    case 4:
        return config->output_max;
    default:
        return config->output_min;
    }
}

void numbers_guard_move(struct numbers_guard *now,
                        const struct fixpid_guard_config *config)
{
    const uint16_t band = (uint16_t)(config->band & 0x7FFFu);

    if (numbers_one_in(60)) {
        now->setpoint = numbers_one_in(3)
                            ? numbers_int16()
                            : between(config->reach_min, config->reach_max);
    } else if (numbers_one_in(30)) {
        now->setpoint = close_to(now->setpoint, band);
    }
    if (numbers_one_in(3)) {
        now->measurement = close_to(now->setpoint, (uint16_t)(2u * band));
    } else if (numbers_one_in(3)) {
        now->measurement = close_to(now->measurement, band);
    } else if (numbers_one_in(40)) {
        now->measurement = numbers_int16();
    }
    if (numbers_one_in(5)) {
        now->output = some_output(config);
    }
}

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
    return close_to(points[numbers_below(count)].x, 100);
}
