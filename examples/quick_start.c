// SPDX-License-Identifier: MIT
#include "fixpid_an937.h"
#include <stdio.h> // Deviation 21.6: a program for a PC

int main(void)
{
    const struct fixpid_an937_config config = {
        FIXPID_AN937_GAIN(2.0), FIXPID_AN937_GAIN(0.5), 0, // kp, ki, kd
        4000, 1}; // anti-windup limit, ticks per derivative sample
    struct fixpid_an937 tank;
    int32_t level = 0; // of a leaking tank; it settles at the valve's opening
    (void)fixpid_an937_init(&tank, &config);
    for (int second = 0; second <= 30; second++) {
        fixpid_an937_tick(&tank);
        const int32_t valve = fixpid_an937_step(&tank, (int16_t)(1000 - level));
        level += (valve - level) / 8;
        (void)printf("%2d s: level %4ld\n", second, (long)level);
    }
    return 0;
}
