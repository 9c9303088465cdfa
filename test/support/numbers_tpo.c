// SPDX-License-Identifier: MIT
#include "numbers_control.h"

#include "numbers.h"

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
