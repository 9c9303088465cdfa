// SPDX-License-Identifier: MIT
// Whether fixpid_guard sees what burns things:
//
//   guarded SEED PLANTS
//
// A row for each plant, of semicolon-separated values: for each fault, the
// steps until the alarm, or -1, and how far the plant got beyond its setpoint,
// in percent of the sensor's range, if nobody acts and if the alarm cuts the
// supply.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "guarded.h"

#define HORIZON_MOST 60000L

static const char *const kinds[] = {"lag", "two lags", "lags", "integrator",
                                    "position"};
static const char *const faults[FAULTS] = {
    [FAULT_NONE] = "none",           [FAULT_OPEN] = "open",
    [FAULT_SHORT] = "short",         [FAULT_FALLEN] = "fallen",
    [FAULT_STUCK_LOW] = "stuck_low", [FAULT_STUCK_HIGH] = "stuck_high",
    [FAULT_DRIVE_ON] = "drive_on",   [FAULT_DRIVE_OFF] = "drive_off",
    [FAULT_SIGN] = "sign",           [FAULT_STUCK_2] = "stuck_2",
    [FAULT_STUCK_AT] = "stuck_at",   [FAULT_STUCK_NOISY] = "stuck_noisy",
    [FAULT_DRIFT] = "drift",         [FAULT_HALF] = "half",
};

struct outcome {
    long alarm; // steps; -1: none
    double without, with;
};

// A step; the most that it was beyond its setpoint, `over` until now.
static double further(struct guarded *loop, double over, uint8_t *flags)
{
    *flags = guarded_step(loop);
    return fmax(over, 100.0 * (loop->value - loop->limit) / loop->top);
}

// As far as it comes when it is cut off now.
static double coasts(const struct guarded *loop, double over)
{
    static struct guarded cut;
    const long steps = 200 + 3 * (long)guarded_scale(loop);
    uint8_t flags = 0;

    cut = *loop;
    cut.motion.plant = &cut.task.plant;
    cut.cut = true;
    for (long n = 0; n < steps; n++) {
        over = further(&cut, over, &flags);
    }
    return over;
}

static struct outcome goes_on(struct guarded *loop, enum fault fault)
{
    const double most =
        400.0 + 60.0 * guarded_scale(loop) + 10.0 * loop->config.patience;
    const long horizon = most > HORIZON_MOST ? HORIZON_MOST : (long)most;
    struct outcome found = {.alarm = -1};
    uint8_t flags = 0;

    loop->motion.plant = &loop->task.plant;
    fixpid_guard_acknowledge(&loop->guard);
    guarded_break(loop, fault);
    for (long n = 0; n < horizon; n++) {
        found.without = further(loop, found.without, &flags);
        if (found.alarm < 0 && (flags & FIXPID_GUARD_ALARMS) != 0u) {
            found.alarm = n;
            found.with = coasts(loop, found.without);
        }
    }
    if (found.alarm < 0) {
        found.with = found.without;
    }
    return found;
}

static void broken(struct guarded *loop)
{
    static struct guarded copy;
    const long at = 300 + (long)((14.0 + 20.0 * guarded_chance(loop)) *
                                 guarded_scale(loop));

    while (loop->now < at) {
        (void)guarded_step(loop);
    }
    for (int fault = FAULT_OPEN; fault < FAULTS; fault++) {
        struct outcome found;

        copy = *loop;
        found = goes_on(&copy, (enum fault)fault);
        printf(";%ld;%.1f;%.1f", found.alarm, found.without, found.with);
    }
    printf(";%.1f;%.3f\n", guarded_scale(loop), loop->dead / loop->lag);
}

int main(int argc, char *argv[])
{
    static struct guarded loop;
    struct draw draw = {.kind = KIND_MIXED, .holding = -1.0};

    if (argc != 3) {
        fprintf(stderr, "usage: guarded SEED PLANTS\n");
        return 2;
    }
    draw_start(&draw, strtoul(argv[1], NULL, 10));
    printf("plant;kind");
    for (int fault = FAULT_OPEN; fault < FAULTS; fault++) {
        printf(";%s;%s_without;%s_with", faults[fault], faults[fault],
               faults[fault]);
    }
    printf(";scale;dead\n");
    for (int i = 0; i < atoi(argv[2]); i++) {
        const struct task task = draw_task(&draw, i);

        guarded_start(&loop, &task, (unsigned)i);
        printf("%d;%s", i, kinds[task.kind]);
        broken(&loop);
    }
    return 0;
}
