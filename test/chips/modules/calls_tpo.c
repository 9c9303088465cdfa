// SPDX-License-Identifier: MIT
#include "calls.h"
#include "fixpid_tpo.h"
#include "numbers.h"
#include "numbers_control.h"
#include "rows_tpo.h"

#ifdef CALLS_DEFINED
#include "reference_control.h"
static struct reference_tpo reference;
#define DEFINE(call) (call)
#else
#define DEFINE(call) ((void)0)
#endif

FIXPID_DATA struct fixpid_tpo tpo;

static struct fixpid_tpo_config config;

static void init(void)
{
    const uint32_t accepted = fixpid_tpo_init(&tpo, &config) ? 1u : 0u;

    calls_answer(accepted,
                 DEFINED(reference_tpo_init(&reference, &config), accepted));
}

static void reset(void)
{
    fixpid_tpo_reset(&tpo);
    DEFINE(reference_tpo_reset(&reference));
}

static void step(int16_t duty)
{
    const uint32_t on = fixpid_tpo_step(&tpo, duty) ? 1u : 0u;

    calls_answer(on, DEFINED(reference_tpo_step(&reference, duty), on));
}

void calls_rows(void)
{
    for (uint16_t row = 0; row < ROWS; row++) {
        config.full = rows_full[row];
        config.window = rows_window[row];
        config.minimum_on = rows_minimum_on[row];
        config.minimum_off = rows_minimum_off[row];
        if (rows_event[row] == 1u) {
            init();
        } else if (rows_event[row] == 2u) {
            reset();
        }
        step(rows_duty[row]);
    }
}

void calls_random(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (i == 0u || numbers_one_in(200)) {
            numbers_tpo_config(&config);
            init();
        } else if (numbers_one_in(400)) {
            reset();
        }
        step(numbers_tpo_duty(config.full));
    }
}
