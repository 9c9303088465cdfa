// SPDX-License-Identifier: MIT
#include "numbers_control.h"

#include "numbers.h"

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
        now->setpoint = numbers_close_to(now->setpoint, band);
    }
    if (numbers_one_in(3)) {
        now->measurement =
            numbers_close_to(now->setpoint, (uint16_t)(2u * band));
    } else if (numbers_one_in(3)) {
        now->measurement = numbers_close_to(now->measurement, band);
    } else if (numbers_one_in(40)) {
        now->measurement = numbers_int16();
    }
    if (numbers_one_in(5)) {
        now->output = some_output(config);
    }
}
