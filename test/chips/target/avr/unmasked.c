// SPDX-License-Identifier: MIT
// The highest output of a step in an interrupt that comes before each cycle of
// set_limits, from 255 to 256, and of init, from 255 to 1000: masked around the
// call, as the contract has it, and not masked. It prints
//
//   set_limits masked 256 unmasked 511
#include <avr/interrupt.h>
#include <stdbool.h>

#include "../interrupted.h"
#include "fixpid_pid.h"
#include "put.h"

#define DELAYS_MOST 4000u // far more than any call takes

static const struct fixpid_pid_config before = {
    .gains = FIXPID_PID_GAINS(100, 0, 0, 1, 0),
    .output_min = 0,
    .output_max = 255};

static struct fixpid_pid pid;
static int16_t highest;

void interrupt_came(uintptr_t at)
{
    (void)at;
    interrupt_never();
    const int16_t output = fixpid_pid_step(&pid, INT16_MAX, 0);
    if (output > highest) {
        highest = output;
    }
}

static void set_limits(void)
{
    (void)fixpid_pid_set_limits(&pid, 0, 256);
}

static void init(void)
{
    struct fixpid_pid_config config = before;

    config.output_max = 1000;
    (void)fixpid_pid_init(&pid, &config);
}

static int16_t highest_of(void (*call)(void), bool masked)
{
    highest = 0;
    for (uint16_t delay = 1; delay < DELAYS_MOST; delay++) {
        (void)fixpid_pid_init(&pid, &before);
        interrupt_after(delay);
        if (masked) {
            cli();
        }
        call();
        sei();
        interrupt_never();
    }
    return highest;
}

static void show(const char *name, void (*call)(void))
{
    put_text(name);
    put_number(" masked ", (uint32_t)highest_of(call, true));
    put_number(" unmasked ", (uint32_t)highest_of(call, false));
    put_text("\n");
}

int main(void)
{
    show("set_limits", set_limits);
    show("init", init);
    return 0;
}
