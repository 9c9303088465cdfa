// SPDX-License-Identifier: MIT
// port.h over a simulated world.
//
// The host's own speed costs no simulated time; each call costs about what it
// does on the chips. A conversion takes 20 us and asking for a tick 5 us. The
// arithmetic between a reading and its drive is charged to port_drive: an
// eighth of a tick, which is 0.5 ms on the PIC16F684 and 0.1 ms on the PIC18.
#include "port.h"

#include <math.h>
#include <stdio.h> // Deviation 21.6: a program for a PC
#include <stdlib.h>

#include "host.h"
#include "world.h"

#define CONVERSION_S 20e-6
#define ASKING_S 5e-6
#define TICK_S (1.0 / (double)PORT_TICKS_PER_SECOND)
#define ARITHMETIC_S (TICK_S / 8.0)

#define COUNTS 1024.0
#define COUNTS_MAX 1023.0
#define TICKS_MAX 255.0

static uint32_t world_seed = 1;
static double ticks_seen;
static double ticks_ahead;
static double fed_s;
static int16_t drive_counts;
static int16_t drive_asked;
static bool world_goes_on;

void (*host_watch)(void);

static FILE *trace;
static double trace_period_s;
static double trace_rows;

void host_seed(uint32_t seed)
{
    world_seed = seed;
}

static void trace_row(void)
{
    static double values[WORLD_TRACE_MAX];
    size_t count = 0;
    struct host_terms terms = {0.0, 0.0, 0.0, 0.0};

    (void)world_trace_names(&count);
    world_trace(values);
    host_probe(&terms);
    (void)fprintf(trace, "%.6f", world_time_s());
    for (size_t i = 0; i < count; i++) {
        (void)fprintf(trace, ",%.9g", values[i]);
    }
    (void)fprintf(trace, ",%d,%.6g,%.6g,%.6g,%.6g\n", (int)drive_counts,
                  terms.proportional, terms.integral, terms.derivative,
                  terms.accumulated_error);
}

bool host_trace_open(const char *path, double period_s)
{
    size_t count = 0;
    const char *const *const names = world_trace_names(&count);

    trace = fopen(path, "w");
    if (trace == NULL) {
        return false;
    }
    trace_period_s = period_s;
    trace_rows = 0.0;
    (void)fprintf(trace, "time_s");
    for (size_t i = 0; i < count; i++) {
        (void)fprintf(trace, ",%s", names[i]);
    }
    (void)fprintf(trace, ",drive_counts,proportional,integral,derivative,"
                         "accumulated_error\n");
    return true;
}

bool host_trace_close(void)
{
    bool complete = true;
    if (trace != NULL) {
        const bool failed = (ferror(trace) != 0);
        complete = (fclose(trace) == 0) && !failed;
        trace = NULL;
    }
    return complete;
}

void host_shift_ticks(double ticks)
{
    ticks_ahead = ticks;
}

double host_fed_s(void)
{
    return fed_s;
}

int16_t host_drive_counts(void)
{
    return drive_counts;
}

int16_t host_drive_asked(void)
{
    return drive_asked;
}

// Who watches is called a few times on the way.
static void pass_watched(double end_s)
{
    host_watch();
    // Deviation 14.1: simulated time decides, and it is not an integer.
    while (world_time_s() < end_s) {
        world_advance(fmin(end_s - world_time_s(), TICK_S / 4.0));
        host_watch();
    }
}

// Time passes up to each row of the trace, so that its rows are equally spaced.
static void pass(double seconds)
{
    const double end_s = world_time_s() + seconds;
    if (host_watch != NULL) {
        pass_watched(end_s);
    }
    // Deviation 14.1: simulated time decides, and it is not an integer.
    while ((trace != NULL) && ((trace_rows * trace_period_s) <= end_s)) {
        const double wait_s = (trace_rows * trace_period_s) - world_time_s();
        world_advance(fmax(wait_s, 0.0));
        trace_row();
        trace_rows += 1.0;
    }
    world_advance(fmax(end_s - world_time_s(), 0.0));
}

static double ticks_now(void)
{
    // The allowance keeps a rounding error from hiding a tick that was met.
    return floor((world_time_s() / TICK_S) + ticks_ahead + 1e-6);
}

void host_reset(void)
{
    drive_counts = 0;
    drive_asked = 0;
    world_drive(0.0);
    world_goes_on = true;
}

void port_init(void)
{
    drive_counts = 0;
    if (!world_goes_on) {
        world_start(world_seed);
    }
    world_goes_on = false;
    ticks_ahead = 0.0;
    ticks_seen = ticks_now();
    fed_s = world_time_s();
}

bool port_running(void) // Deviation 5.5: a constant on a PIC16
{
    return world_running();
}

static uint8_t take_ticks(void)
{
    const double ticks = ticks_now();
    const double counted = fmin(fmax(ticks - ticks_seen, 0.0), TICKS_MAX);
    ticks_seen = ticks_seen + fmax(ticks - ticks_seen, 0.0);
    if (counted > 0.0) {
        fed_s = world_time_s();
    }
    return (uint8_t)counted;
}

uint8_t port_ticks(void)
{
    pass(ASKING_S);
    return take_ticks();
}

uint8_t port_wait_tick(void)
{
    uint8_t ticks = 0;
    pass(ASKING_S);
    while (ticks == 0u) {
        const double next_s = (ticks_seen + 1.0 - ticks_ahead) * TICK_S;
        pass(fmax(next_s - world_time_s(), 0.0));
        ticks = take_ticks();
    }
    return ticks;
}

uint16_t port_read(uint8_t channel)
{
    pass(CONVERSION_S);
    const double counts = floor(COUNTS * world_voltage(channel));
    return (uint16_t)fmin(counts, COUNTS_MAX);
}

static int16_t made_of(int16_t duty)
{
    int16_t made = duty;
    if (made > PORT_DRIVE_FULL) {
        made = PORT_DRIVE_FULL;
    }
    if (made < -PORT_DRIVE_FULL) {
        made = -PORT_DRIVE_FULL;
    }
    if (abs(made) < PORT_DRIVE_LEAST) {
        made = 0;
    }
    return made;
}

void port_drive(int16_t duty)
{
    pass(ARITHMETIC_S);
    drive_asked = duty;
    drive_counts = made_of(duty);
    world_drive((double)drive_counts / (double)PORT_DRIVE_FULL);
}
