// SPDX-License-Identifier: MIT
// Breaks an application's loop on the host. The application is loaded, and
// loaded anew at each reset, so that it begins with its own data.
#include <dlfcn.h>
#include <math.h>
#include <setjmp.h>
#include <stdio.h> // Deviation 21.6: a program for a PC
#include <stdlib.h>
#include <string.h>

#include "faults.h"
#include "fixpid_guard.h"
#include "host.h"
#include "port_board.h"
#include "world.h"

#include PROBE_HEADER

#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)
#define TICK_S (1.0 / (double)PORT_TICKS_PER_SECOND)
#define START_UP_S 2e-3

// A sensor that is noisy for a while looks like a loop that swings.
#define ALARMS                                                                 \
    (FIXPID_GUARD_ALARMS & (unsigned)~(unsigned)FIXPID_GUARD_OSCILLATING)
#define EXIT_WRONG_USE 2

static void *application;
static unsigned char *object;
static const size_t object_size = sizeof(struct PROBE_TYPE);
static jmp_buf power_on; // Deviation 21.4: a reset leaves the application
static bool timer_dead;
static double dead_since_s;
static struct fixpid_guard none; // of an application without one: refused
static struct fixpid_guard *guard;

void host_probe(struct host_terms *terms)
{
    (void)terms; // there is no trace
}

void host_report(void)
{
    // a row is printed for each fault
}

static void *found(const char *name)
{
    void *const place = dlsym(application, name);
    if (place == NULL) {
        (void)fprintf(stderr, "faults: %s\n", dlerror());
        exit(EXIT_FAILURE);
    }
    return place;
}

static void load(const char *path)
{
    application = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (application == NULL) {
        (void)fprintf(stderr, "faults: %s\n", dlerror());
        exit(EXIT_FAILURE);
    }
    object = found(TEXT(HOST_PROBE_OBJECT));
    guard = dlsym(application, "guard");
    guard = (guard != NULL) ? guard : &none;
}

static void flip(unsigned bit)
{
    object[bit / 8u] ^= (unsigned char)(1u << (bit % 8u));
}

static void obey(const struct fault_order *order);

static void look(void)
{
    const struct fault_order order =
        faults_watch(host_drive_counts(), host_drive_asked(),
                     fixpid_guard_flags(guard) & ALARMS);
    obey(&order);
}

// Lets time pass in which no instruction is executed.
static void stand_still(double seconds)
{
    const double end_s = world_time_s() + seconds;
    while (world_time_s() < end_s) {
        world_advance(fmin(end_s - world_time_s(), TICK_S / 4.0));
        look();
    }
}

static bool random_ram;
static double dark_s;

static void reset(double seconds, bool random)
{
    host_reset();
    timer_dead = false;
    random_ram = random;
    dark_s = seconds;
    longjmp(power_on, 1); // Deviation 21.4: see above
}

static void hang(double watchdog_s)
{
    stand_still(fmax(host_fed_s() + watchdog_s - world_time_s(), 0.0));
    host_reset();
    look(); // the drive is off
    faults_was_reset();
    reset(START_UP_S, false);
}

static void stop_timer(void)
{
    timer_dead = true;
    dead_since_s = world_time_s();
}

// The host's application takes no time between two calls of the port, so that a
// share of its pass means nothing. A reset and a hang do not return.
static void obey(const struct fault_order *order)
{
    switch (order->deed) {
    case FAULT_FLIP_BIT:
        flip(order->bit);
        break;
    case FAULT_RESET_CHIP:
        reset(order->seconds, order->random_ram);
        break;
    case FAULT_HANG_LOOP:
        hang(order->seconds);
        break;
    case FAULT_STOP_TIMER:
        stop_timer();
        break;
    case FAULT_BLIND_GUARD:
        memset(guard, 0, sizeof(*guard)); // it is refused
        break;
    case FAULT_SHIFT_TICKS:
        host_shift_ticks(order->ticks);
        break;
    default:
        break;
    }
}

static void watch(void)
{
    if (timer_dead) {
        host_shift_ticks((dead_since_s - world_time_s()) / TICK_S);
    }
    look();
    if ((world_time_s() - host_fed_s()) > fault_loop.watchdog_s) {
        host_reset();
        look();
        faults_was_reset();
        reset(START_UP_S, false);
    }
}

static void randomize(void)
{
    for (size_t i = 0; i < object_size; i++) {
        object[i] = (unsigned char)(faults_random() & 0xFFu);
    }
}

// Each reset comes back here.
static void run(const char *path)
{
    int (*volatile begin)(void);
    host_watch = watch;
    if (setjmp(power_on) != 0) { // Deviation 21.4: see above
        host_watch = NULL;
        stand_still(dark_s);
        (void)dlclose(application);
        host_watch = watch;
    }
    load(path);
    if (random_ram) {
        randomize();
    }
    // Deviation 11.1: POSIX has functions as dlsym's data.
    *(void **)(&begin) = found("application_main");
    (void)begin();
}

// PROGRAM APPLICATION.so FIRST COUNT [KIND [cut]]
int main(int count, char **arguments)
{
    int kind = (int)FAULT_KINDS;

    const bool cut = (count == 6) && (strcmp(arguments[5], "cut") == 0);
    if ((count < 4) || ((count > 4) && !faults_kind(arguments[4], &kind)) ||
        (kind == (int)FAULT_FLIP_PLACE) || // only a chip has places
        ((count > 5) && !cut)) {
        (void)fprintf(stderr,
                      "usage: %s APPLICATION.so FIRST COUNT [KIND [cut]]\n"
                      "Breaks the application's loop by the faults FIRST and "
                      "the next ones: rows of CSV. With cut, an alarm of the "
                      "guard cuts the drive.\n",
                      arguments[0]);
        return EXIT_WRONG_USE;
    }
    faults_plan(TEXT(FAULTS_NAME), (unsigned)(object_size * 8u),
                strtol(arguments[2], NULL, 10), strtol(arguments[3], NULL, 10),
                kind);
    if (cut) {
        faults_cut_at_alarm();
    }
    faults_heading();
    run(arguments[1]);
    return EXIT_FAILURE; // the copies end by themselves
}
