// SPDX-License-Identifier: MIT
// fixpid_an937_tick from an interrupt that comes before every instruction of
// each function of its controller, on the machine that this program is compiled
// for. What is left of the object, and what the function returned, must be as
// if the tick had come just before the call or just after it. It prints
//
//   step interrupts 1234 before 700 after 534 neither 0
//   at 02f8 02fa 02fc
//
// for each function, and in the end all addresses that were interrupted, so
// that test/chips/target/interrupted.rb sees that none was left out.
#include "interrupted.h"

#include <stdio.h>
#include <string.h>

#include "fixpid_an937.h"
#include "numbers.h"
#include "put.h"

#ifndef STATES
#define STATES 24u // in which each function is called
#endif
#define DELAYS_MOST 4000u // far more than any call takes
#define CODE_MOST 16384u  // bytes that are watched
#define OF_A_LINE 16u     // addresses

// Of object mode, too.
struct fixpid_an937 an937_controller;

// What a call is asked.
static struct fixpid_an937_config config;
static int16_t error;
static uint16_t argument;
static int32_t result;

static volatile uint8_t came;
static uint8_t interrupted[CODE_MOST / 16u]; // a bit for two bytes of code

void interrupt_came(uintptr_t before)
{
    interrupt_never();
    fixpid_an937_tick(&an937_controller);
    came++;
    if (before < CODE_MOST) {
        interrupted[before / 16u] |= (uint8_t)(1u << (before / 2u % 8u));
    }
}

static void call_init(void)
{
    result = fixpid_an937_init(&an937_controller, &config);
}

static void call_reset(void)
{
    fixpid_an937_reset(&an937_controller);
}

static void call_set_gains(void)
{
    result =
        fixpid_an937_set_gains(&an937_controller, (uint8_t)argument, 80, 16);
}

static void call_set_limit(void)
{
    result =
        fixpid_an937_set_accumulated_error_limit(&an937_controller, argument);
}

static void call_set_period(void)
{
    result = fixpid_an937_set_derivative_period(&an937_controller,
                                                (uint8_t)argument);
}

static void call_step(void)
{
    result = fixpid_an937_step(&an937_controller, error);
}

static void call_step_percent(void)
{
    result = fixpid_an937_step_percent(&an937_controller, (int8_t)(error >> 8));
}

static void call_proportional(void)
{
    result = fixpid_an937_proportional(&an937_controller);
}

static void call_integral(void)
{
    result = fixpid_an937_integral(&an937_controller);
}

static void call_derivative(void)
{
    result = fixpid_an937_derivative(&an937_controller);
}

static void call_accumulated_error(void)
{
    result = fixpid_an937_accumulated_error(&an937_controller);
}

static void call_stat1(void)
{
    result = fixpid_an937_stat1(&an937_controller);
}

static void call_stat2(void)
{
    result = fixpid_an937_stat2(&an937_controller);
}

static void call_flags(void)
{
    result = fixpid_an937_flags(&an937_controller);
}

static void call_clear_flags(void)
{
    fixpid_an937_clear_flags(&an937_controller);
}

static const struct call {
    const char *name;
    void (*make)(void);
} calls[] = {{"init", call_init},
             {"reset", call_reset},
             {"set_gains", call_set_gains},
             {"set_limit", call_set_limit},
             {"set_period", call_set_period},
             {"step", call_step},
             {"step_percent", call_step_percent},
             {"proportional", call_proportional},
             {"integral", call_integral},
             {"derivative", call_derivative},
             {"accumulated_error", call_accumulated_error},
             {"stat1", call_stat1},
             {"stat2", call_stat2},
             {"flags", call_flags},
             {"clear_flags", call_clear_flags}};
#define CALLS (sizeof calls / sizeof calls[0])

// What a call leaves.
struct left {
    struct fixpid_an937 object;
    int32_t result;
};
static struct left start, before, after, now;

static void leave(struct left *to)
{
    memset(to, 0, sizeof *to);
    to->object = an937_controller;
    to->result = result;
}

static void begin(void)
{
    an937_controller = start.object;
    result = 0;
}

static uint8_t is(const struct left *expected)
{
    return memcmp(&now, expected, sizeof now) == 0 ? 1u : 0u;
}

// A controller somewhere on its way; every fourth one is refused, some
// have a tick waiting or have lost one, and the sum of the first two is
// saturated.
static void draw(uint8_t state)
{
    static const int16_t ends[] = {INT16_MAX, INT16_MIN};

    config.kp_q4 = (uint8_t)(state < 2u ? 255u : numbers_next());
    config.ki_q4 = (uint8_t)(state < 2u ? 255u : numbers_next());
    config.kd_q4 = (uint8_t)numbers_next();
    config.accumulated_error_limit =
        (uint16_t)(state < 2u ? 0xFFFFu : 1u + numbers_below(0xFFFFu));
    config.derivative_period_ticks = (uint8_t)(1u + numbers_below(3));
    if (state % 4u == 3u) {
        config.accumulated_error_limit = 0;
    }
    memset(&an937_controller, 0, sizeof an937_controller);
    (void)fixpid_an937_init(&an937_controller, &config);
    for (uint8_t step = 0; step < 3u; step++) {
        fixpid_an937_tick(&an937_controller);
        error = state < 2u ? ends[state] : numbers_int16();
        (void)fixpid_an937_step(&an937_controller, error);
    }
    for (uint8_t tick = 0; tick < state % 3u; tick++) {
        fixpid_an937_tick(&an937_controller);
    }
    // What init is asked for is another thing than what the object has.
    config.derivative_period_ticks = (uint8_t)(state % 8u);
    config.accumulated_error_limit = (uint16_t)(state % 3u);
    error = state < 2u ? ends[state] : numbers_int16();
    argument = (uint16_t)(state % 6u == 0u ? 0u : numbers_next());
    leave(&start);
}

static void define(const struct call *call)
{
    begin();
    fixpid_an937_tick(&an937_controller);
    call->make();
    leave(&before);
    begin();
    call->make();
    fixpid_an937_tick(&an937_controller);
    leave(&after);
}

// An interrupt after each delay: from the first with which it comes to the
// last. Returns how many left what they must not.
static uint32_t interrupt_each(const struct call *call)
{
    uint32_t interrupts = 0, as_before = 0, as_after = 0, neither = 0;

    for (uint8_t state = 0; state < STATES; state++) {
        uint8_t begun = 0, late = 0;

        draw(state);
        define(call);
        for (uint16_t delay = 1; delay < DELAYS_MOST; delay++) {
            begin();
            came = 0;
            interrupt_after(delay);
            call->make();
            interrupt_never();
            if (came == 0u && begun == 0u) {
                continue;
            }
            if (came == 0u) {
                break;
            }
            begun = 1;
            leave(&now);
            interrupts++;
            if (is(&before) && late == 0u) {
                as_before++;
            } else if (is(&after)) {
                late |= is(&before) ^ 1u;
                as_after++;
            } else {
                neither++;
            }
        }
    }
    put_text(call->name);
    put_number(" interrupts ", interrupts);
    put_number(" before ", as_before);
    put_number(" after ", as_after);
    put_number(" neither ", neither);
    put_text("\n");
    return neither;
}

static void put_address(uint16_t address)
{
    putchar(' ');
    for (uint8_t digit = 0; digit < 4u; digit++) {
        putchar("0123456789abcdef"[(address >> (12u - 4u * digit)) & 15u]);
    }
}

static void put_addresses(void)
{
    uint8_t column = 0;

    for (uint16_t address = 0; address < CODE_MOST; address += 2u) {
        if ((interrupted[address / 16u] >> (address / 2u % 8u) & 1u) != 0u) {
            put_text(column == 0u ? "\nat" : "");
            put_address(address);
            column = (uint8_t)((column + 1u) % OF_A_LINE);
        }
    }
    put_text("\n");
}

int main(void)
{
    uint32_t neither = 0;

    numbers_seed(1);
    for (uint8_t at = 0; at < CALLS; at++) {
        neither += interrupt_each(&calls[at]);
    }
    put_addresses();
    return neither == 0u ? 0 : 1;
}
