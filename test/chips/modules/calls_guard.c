// SPDX-License-Identifier: MIT
#include "calls.h"
#include "fixpid_guard.h"
#include "numbers.h"
#include "numbers_control.h"
#include "rows_guard.h"

#ifdef CALLS_DEFINED
#include "reference_control.h"
static struct reference_guard reference;
#define DEFINE(call) (call)
#else
#define DEFINE(call) ((void)0)
#endif

enum { NOTHING, INIT, RESET, ACKNOWLEDGE };

FIXPID_DATA struct fixpid_guard guard;

static struct fixpid_guard_config config;
static struct numbers_guard now;

static void init(void)
{
    const uint32_t accepted = fixpid_guard_init(&guard, &config) ? 1u : 0u;

    calls_answer(accepted,
                 DEFINED(reference_guard_init(&reference, &config), accepted));
}

static void call(uint8_t event)
{
    uint8_t flags;

    if (event == INIT) {
        init();
    } else if (event == RESET) {
        fixpid_guard_reset(&guard);
        DEFINE(reference_guard_reset(&reference));
    } else if (event == ACKNOWLEDGE) {
        fixpid_guard_acknowledge(&guard);
        DEFINE(reference_guard_acknowledge(&reference));
    }
    flags = fixpid_guard_flags(&guard);
    calls_answer(flags, DEFINED(reference_guard_flags(&reference), flags));
}

static void step(void)
{
    const uint32_t flags =
        fixpid_guard_step(&guard, now.setpoint, now.measurement, now.output);

    calls_answer(flags,
                 DEFINED(reference_guard_step(&reference, now.setpoint,
                                              now.measurement, now.output),
                         flags));
}

static void take_row(uint16_t row)
{
    const uint8_t which = rows_shared[row];

    config.output_min = rows_output_min[which];
    config.output_max = rows_output_max[which];
    config.measurement_min = rows_measurement_min[which];
    config.measurement_max = rows_measurement_max[which];
    config.reach_min = rows_reach_min[which];
    config.reach_max = rows_reach_max[which];
    config.band = rows_band[which];
    config.patience = rows_patience[which];
    config.reverse = (rows_options[which] & 0x80u) != 0u;
    config.noisy = (rows_options[which] & 0x40u) != 0u;
    if ((rows_options[which] & 0x3Fu) != 0u) { // stands for what is refused
        config.patience = 0;
    }
    now.setpoint = rows_setpoint[row];
    now.measurement = rows_measurement[row];
    now.output = rows_output[row];
}

void calls_rows(void)
{
    for (uint16_t row = 0; row < ROWS; row++) {
        take_row(row);
        call(rows_event[row]);
        for (uint16_t at = 0; at < rows_repeat[row]; at++) {
            step();
        }
    }
}

void calls_random(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (i == 0u || numbers_one_in(400)) {
            numbers_guard_config(&config);
            call(INIT);
        } else if (numbers_one_in(100)) {
            call(numbers_one_in(4) ? RESET : ACKNOWLEDGE);
        }
        numbers_guard_move(&now, &config);
        step();
    }
}
