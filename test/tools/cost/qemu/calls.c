// SPDX-License-Identifier: MIT
// What the calls of a program of test/chips/modules cost on a core in QEMU.
// Build with -DCALLS_METERED and
//
//   -DFIRST="fixpid_x_step" -Wl,--wrap=fixpid_x_step
//
// and SECOND if there is another function, so that their calls come here. Each
// takes up to four arguments in registers. Prints a line for each:
//
//   fixpid_x_step calls 3000 least 26 most 31 total 87000
#include "calls.h"
#include "metered.h"
#include "put.h"

struct figures {
    uint32_t calls;
    uint32_t least;
    uint32_t most;
    uint32_t total;
};

static struct figures figures[2];

typedef uint32_t (*function)(uint32_t, uint32_t, uint32_t, uint32_t);

static uint32_t account(struct figures *of, function metered, uint32_t a,
                        uint32_t b, uint32_t c, uint32_t d)
{
    const uint32_t result = metered(a, b, c, d);
    const uint32_t cost = instructions();

    if (of->calls == 0u || cost < of->least) {
        of->least = cost;
    }
    if (cost > of->most) {
        of->most = cost;
    }
    of->calls++;
    of->total += cost;
    return result;
}

uint32_t metered_first(uint32_t a, uint32_t b, uint32_t c, uint32_t d);
uint32_t first(uint32_t a, uint32_t b, uint32_t c,
               uint32_t d) __asm__("__wrap_" FIRST);

METERED("metered_first", "__real_" FIRST);

uint32_t first(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    return account(&figures[0], metered_first, a, b, c, d);
}

#ifdef SECOND
uint32_t metered_second(uint32_t a, uint32_t b, uint32_t c, uint32_t d);
uint32_t second(uint32_t a, uint32_t b, uint32_t c,
                uint32_t d) __asm__("__wrap_" SECOND);

METERED("metered_second", "__real_" SECOND);

uint32_t second(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    return account(&figures[1], metered_second, a, b, c, d);
}
#endif

static void report(const char *name, const struct figures *of)
{
    put_text(name);
    put_number(" calls ", of->calls);
    put_number(" least ", of->least);
    put_number(" most ", of->most);
    put_number(" total ", of->total);
    put_text("\n");
}

void calls_begin(void)
{
    calibrate();
}

void calls_end(void)
{
    report(FIRST, &figures[0]);
#ifdef SECOND
    report(SECOND, &figures[1]);
#endif
}
