// SPDX-License-Identifier: MIT
// Instructions of a routine on a core in QEMU. The core's counter.h has the
// counter, and METERED(name, routine): `name` calls `routine` and leaves in
// metered_ticks what the counter counted.
#ifndef METERED_H
#define METERED_H
#include <stdint.h>

#include "counter.h"

#define RESOLUTION 64u // instructions between the two calibrating routines

volatile uint32_t metered_ticks;
extern uint32_t metered_sixty_four(void), metered_nothing(void);

METERED("metered_nothing", "nothing");
METERED("metered_sixty_four", "sixty_four");
__asm__(".text\n" ROUTINE("nothing", ""));
__asm__(".text\n" ROUTINE("sixty_four", ".rept 64\n    nop\n.endr\n"));

static uint32_t ticks_of_nothing, ticks_of_sixty_four;

static uint32_t ticks(void)
{
    return metered_ticks & TICKS_MASK;
}

static void calibrate(void)
{
    counter_begin();
    (void)metered_nothing();
    ticks_of_nothing = ticks();
    (void)metered_sixty_four();
    ticks_of_sixty_four = ticks() - ticks_of_nothing;
}

// Instructions of the step, its return included.
static uint32_t instructions(void)
{
    const int32_t beyond = (int32_t)(ticks() - ticks_of_nothing);
    const int32_t half = (int32_t)ticks_of_sixty_four / 2;

    return (uint32_t)((beyond * (int32_t)RESOLUTION + half) /
                      (int32_t)ticks_of_sixty_four) +
           1u;
}

#endif
