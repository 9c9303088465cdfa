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
