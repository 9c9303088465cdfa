// SPDX-License-Identifier: MIT
#include "calls.h"
#include "fixpid_slew.h"
#include "numbers.h"
#include "numbers_control.h"
#include "rows_slew.h"

#ifdef CALLS_DEFINED
#include "reference_control.h"
static struct reference_slew reference;
#define DEFINE(call) (call)
#else
#define DEFINE(call) ((void)0)
#endif

enum { NOTHING, INIT, RESET, SET_RATES, SEED };

FIXPID_DATA struct fixpid_slew slew;

static void call(uint8_t event, uint32_t rise, uint32_t fall, int16_t seed)
{
    switch (event) {
    case INIT:
        fixpid_slew_init(&slew, rise, fall);
        DEFINE(reference_slew_init(&reference, rise, fall));
        break;
    case RESET:
        fixpid_slew_reset(&slew);
        DEFINE(reference_slew_seed(&reference, 0));
        break;
    case SET_RATES:
        fixpid_slew_set_rates(&slew, rise, fall);
        DEFINE(reference.rise = rise);
        DEFINE(reference.fall = fall);
        break;
    case SEED:
        fixpid_slew_seed(&slew, seed);
        DEFINE(reference_slew_seed(&reference, seed));
        break;
    default:
        break;
    }
}

static void step(int16_t target)
{
    const uint32_t output = (uint32_t)(int32_t)fixpid_slew_step(&slew, target);
    const uint32_t value = (uint32_t)fixpid_slew_value(&slew);

    calls_answer(output,
                 DEFINED(reference_slew_step(&reference, target), output));
    calls_answer(value, DEFINED(reference.value, value));
}

void calls_rows(void)
{
    for (uint16_t row = 0; row < ROWS; row++) {
        call(rows_event[row], rows_rise_q16[row], rows_fall_q16[row],
             rows_seed[row]);
        step(rows_target[row]);
    }
}

static void random_call(uint8_t event)
{
    const uint32_t rise = numbers_slew_rate();
    const uint32_t fall = numbers_slew_rate();

    call(event, rise, fall, numbers_int16());
}

void calls_random(uint32_t count)
{
    int16_t target = 0;

    random_call(INIT);
    for (uint32_t i = 0; i < count; i++) {
        if (numbers_one_in(16)) {
            random_call((uint8_t)(1u + numbers_below(4)));
        }
        if (numbers_one_in(8)) {
            target = numbers_int16();
        }
        step(target);
    }
}
