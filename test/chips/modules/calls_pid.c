// SPDX-License-Identifier: MIT
// Calls of fixpid_pid that are not steps. What they answer is tested with the
// steps, by test/chips/target; here they are metered.
#include "calls_pid.h"
#include "calls.h"
#include "numbers.h"

FIXPID_DATA struct fixpid_pid pid;

void calls_rows(void)
{
    // there are none
}

static void draw(struct fixpid_pid_gains *gains)
{
    gains->kp_q8 = (uint16_t)numbers_below(32768);
    gains->ki_q24 = numbers_next() >> (1u + numbers_below(31));
    gains->kd_q8 = (uint16_t)numbers_below(32256);
    gains->derivative_filter = (uint8_t)numbers_below(8);
}

static void answer(int16_t output)
{
    calls_answer((uint16_t)output, (uint16_t)output);
}

static void step(void)
{
    const int16_t setpoint = numbers_int16();
    const int16_t measurement = numbers_int16();

    answer(fixpid_pid_step(&pid, setpoint, measurement));
    fixpid_pid_track(&pid, numbers_int16(), (uint8_t)numbers_below(16));
}

static void change(void)
{
    struct fixpid_pid_gains gains;

    draw(&gains);
    pid_change(&pid, &gains);
    answer(fixpid_pid_output(&pid));
}

static void limit(void)
{
    const int16_t a = numbers_int16();
    const int16_t b = numbers_int16();

    (void)fixpid_pid_set_limits(&pid, -32768, 32767);
    (void)fixpid_pid_set_integral_limits(&pid, -32767, 32767);
    answer(fixpid_pid_step(&pid, a, b));
    answer(fixpid_pid_step(&pid, b, a));
    (void)fixpid_pid_set_limits(&pid, a, b);
    (void)fixpid_pid_set_limits(&pid, b, a);
    (void)fixpid_pid_set_integral_limits(&pid, a, b);
    (void)fixpid_pid_set_integral_limits(&pid, b, a);
}

void calls_random(uint32_t count)
{
    struct fixpid_pid_config config = {{256, 65536, 0, 0},
                                       -32768,
                                       32767,
                                       -32767,
                                       32767,
                                       0,
                                       false,
                                       false,
                                       false};

    (void)fixpid_pid_init(&pid, &config);
    for (uint32_t i = 0; i < count; i++) {
        step();
        limit();
        change();
    }
}
