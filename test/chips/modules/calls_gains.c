// SPDX-License-Identifier: MIT
#include "calls.h"
#include "fixpid_gains.h"
#include "numbers.h"
#include "numbers_control.h"
#include "rows_gains.h"

#ifdef CALLS_DEFINED
#include "reference_control.h"
static struct fixpid_pid_gains defined_gains;
static struct fixpid_gains_milli defined_back;
#endif

static struct fixpid_pid_gains gains;
static struct fixpid_gains_milli milli;
static struct fixpid_gains_milli back;

// What was refused has left its result as it was.
static void from(uint32_t rate_milli, uint8_t filter)
{
    const uint32_t accepted =
        fixpid_gains_from_milli(&gains, &milli, rate_milli, filter) ? 1u : 0u;

    calls_answer(accepted,
                 DEFINED(reference_gains_from_milli(&defined_gains, &milli,
                                                    rate_milli, filter),
                         accepted));
    calls_answer(gains.kp_q8, DEFINED(defined_gains.kp_q8, gains.kp_q8));
    calls_answer(gains.ki_q24, DEFINED(defined_gains.ki_q24, gains.ki_q24));
    calls_answer(gains.kd_q8, DEFINED(defined_gains.kd_q8, gains.kd_q8));
    calls_answer(
        gains.derivative_filter,
        DEFINED(defined_gains.derivative_filter, gains.derivative_filter));
}

static void to(uint32_t rate_milli)
{
    const uint32_t accepted =
        fixpid_gains_to_milli(&back, &gains, rate_milli) ? 1u : 0u;

    calls_answer(accepted, DEFINED(reference_gains_to_milli(&defined_back,
                                                            &gains, rate_milli),
                                   accepted));
    calls_answer(back.kp, DEFINED(defined_back.kp, back.kp));
    calls_answer(back.ki, DEFINED(defined_back.ki, back.ki));
    calls_answer(back.kd, DEFINED(defined_back.kd, back.kd));
}

void calls_rows(void)
{
    for (uint16_t row = 0; row < ROWS; row++) {
        milli.kp = rows_kp_milli[row];
        milli.ki = rows_ki_milli[row];
        milli.kd = rows_kd_milli[row];
        from(rows_rate_milli[row], rows_filter[row]);
        to(rows_rate_milli[row]);
    }
}

void calls_random(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t rate_milli = numbers_gains_rate();

        numbers_gains_milli(&milli);
        from(rate_milli, numbers_gains_filter());
        to(numbers_one_in(2) ? rate_milli : numbers_gains_rate());
    }
}
