// SPDX-License-Identifier: MIT
#include "faults.h"

#include <math.h>
#include <stdio.h> // Deviation 21.6: a program for a PC
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "port_board.h"
#include "world.h"

#define TICK_S (1.0 / (double)PORT_TICKS_PER_SECOND)
#define STUCK_SECONDS 120u // of this machine: a copy that takes longer is lost

#define RESET_S 2e-3 // without drive, at least
#define BROWN_OUT_LEAST_S 5e-3
#define BROWN_OUT_MOST_S 150e-3
#define RESET_PLACES 200 // in one pass
#define HANGS_MOST 8u
#define LATEST_WATCHDOG 2.0 // times the typical one
#define BETWEEN_HANGS_S 20e-3

static const char *const kind_names[FAULT_KINDS] = {
    "none",       "flip",          "reset",        "brown_out",   "hang",
    "hangs",      "dead_timer",    "stuck",        "shorted",     "open",
    "noisy",      "clipped",       "input_low",    "input_high",  "input_moved",
    "ticks_lost", "ticks_doubled", "ticks_late",   "stays_stuck", "stays_level",
    "stays_off",  "stays_on",      "stays_turned", "place"};

// What a sensor reads that stays at a level: so much of its full scale from the
// set point, or an end.
static const double levels[] = {-1.0, -0.2, -0.1, -0.03, -0.01, 0.0,
                                0.01, 0.03, 0.1,  0.2,   1.0};
#define LEVELS ((long)(sizeof(levels) / sizeof(levels[0])))

static struct plan {
    const char *name;
    unsigned object_bits;
    long first;
    long count;
    int kind;
    bool cut;
} plan;

static struct fault {
    enum fault_kind kind;
    long number;
    unsigned bit;
    uint8_t channel;
    double value;
    double at_s;
    double for_s;
} fault;

// What has been seen.
static struct seen {
    bool begun;
    bool struck;
    bool mended;
    unsigned resets;
    unsigned hangs_left;
    double hung_s;      // when the loop began to hang; negative: it does not
    double off_after_s; // the longest time from there until the drive was off
    double next_hang_s;
    double ticks_ahead;
    double ticks_seen;
    int drive_low;
    int drive_high;
    int asked_low;
    int asked_high;
    double worst;
    double value;
    double least;
    double most;
    double alarm_s; // from the fault; negative where it was before it
    unsigned alarms;
    double error;
    double outside_s; // when the error was outside of the band last
    double on_s;      // when the drive was on last
    double off_s;     // from when on it was off for a tick; negative: never
} seen;

static uint32_t random_state;
static size_t value_at;
static size_t target_at;

uint32_t faults_random(void)
{
    return world_random(&random_state);
}

// From low to high.
static double drawn(double low, double high)
{
    return low + ((high - low) * ((double)faults_random() / 4294967296.0));
}

bool faults_kind(const char *name, int *kind)
{
    for (int i = 0; i < (int)FAULT_KINDS; i++) {
        if (strcmp(kind_names[i], name) == 0) {
            *kind = i;
            return true;
        }
    }
    return false;
}

static size_t column(const char *name)
{
    size_t count = 0;
    const char *const *const names = world_trace_names(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(names[i], name) == 0) {
            return i;
        }
    }
    (void)fprintf(stderr, "faults: the world has no %s\n", name);
    exit(EXIT_FAILURE);
}

void faults_plan(const char *name, unsigned object_bits, long first, long count,
                 int kind)
{
    plan = (struct plan){name, object_bits, first, count, kind, false};
    value_at = column(fault_loop.value);
    target_at =
        (fault_loop.target != NULL) ? column(fault_loop.target) : value_at;
    for (size_t i = 0; i < FAULT_SETTINGS; i++) {
        const struct fault_setting *const one = &fault_loop.settings[i];
        if ((one->name != NULL) && (world_set(one->name, one->value) != 0)) {
            (void)fprintf(stderr, "faults: cannot set %s\n", one->name);
            exit(EXIT_FAILURE);
        }
    }
}

void faults_cut_at_alarm(void)
{
    plan.cut = true;
}

// ---- A fault from its number ----

static void draw_sensor(void)
{
    fault.channel = fault_loop.sensor;
    if (fault.kind == FAULT_NOISY) {
        fault.value = pow(10.0, drawn(-2.5, -0.5)); // of full scale
    }
    if (fault.kind == FAULT_OPEN) {
        fault.value = 1.0;
    }
    if (fault.kind == FAULT_CLIPPED) {
        fault.value = drawn(0.52, 0.8);
    }
}

static void draw_input(long turn)
{
    fault.channel = fault_loop.inputs[(size_t)turn % fault_loop.input_count];
    fault.value = (fault.kind == FAULT_INPUT_HIGH) ? 1.0 : 0.0;
    if (fault.kind == FAULT_INPUT_MOVED) {
        fault.value = pow(10.0, drawn(-1.0, 1.5)); // times a second
    }
}

// A half are flips, as there are many bits; the other kinds take turns.
static enum fault_kind kind_of(long number, long *turn)
{
    const long others = (long)FAULT_PASSING - 1;
    const long other = (number / 2) % others;
    if (plan.kind != (int)FAULT_KINDS) {
        *turn = number;
        return (enum fault_kind)plan.kind;
    }
    if ((number % 2) == 0) {
        *turn = number / 2;
        return FAULT_FLIP;
    }
    *turn = number / 2 / others;
    return (enum fault_kind)((other < (long)FAULT_FLIP) ? other : (other + 1));
}

// What lasts for a while.
static void draw_lasting(long turn)
{
    fault.for_s = fault_loop.longest_s * drawn(0.05, 1.0);
    if (fault.kind <= FAULT_CLIPPED) {
        draw_sensor();
    } else if (fault.kind <= FAULT_INPUT_MOVED) {
        draw_input(turn);
    } else {
        // the ticks
    }
}

static void draw_kind(long turn)
{
    switch (fault.kind) {
    case FAULT_NONE:
    case FAULT_DEAD_TIMER:
        break; // nothing else to choose
    case FAULT_FLIP:
        fault.bit = (unsigned)(turn % (long)plan.object_bits);
        break;
    case FAULT_FLIP_PLACE:
        fault.bit = faults_random() >> 8;
        fault.value = drawn(0.0, 1.0);
        break;
    case FAULT_RESET:
        // Each of the places once, in an order that spreads the first ones.
        fault.value = (double)((turn * 123L) % RESET_PLACES) / RESET_PLACES;
        break;
    case FAULT_BROWN_OUT:
        fault.value = drawn(BROWN_OUT_LEAST_S, BROWN_OUT_MOST_S);
        break;
    case FAULT_HANG:
        fault.value = fault_loop.watchdog_s;
        break;
    case FAULT_HANGS:
        fault.value = fault_loop.watchdog_s * drawn(1.0, LATEST_WATCHDOG);
        seen.hangs_left = 1u + (faults_random() % (HANGS_MOST - 1u));
        break;
    case FAULT_STAYS_LEVEL:
        fault.value = levels[turn % LEVELS];
        break;
    case FAULT_STAYS_STUCK:
    case FAULT_STAYS_OFF:
    case FAULT_STAYS_ON:
    case FAULT_STAYS_TURNED:
        break; // nothing else to choose
    default:
        draw_lasting(turn);
        break;
    }
}

// Each kind's turns begin at 0, with its first bit, its first channel and so
// on; so they are the same whatever else is tried.
static void draw(long number)
{
    long turn = 0;
    memset(&fault, 0, sizeof(fault));
    fault.number = number;
    fault.kind = kind_of(number, &turn);
    random_state = ((uint32_t)turn * 2654435769u) ^
                   ((uint32_t)fault.kind * 2246822519u) ^ 0x5EED5EEDu;
    random_state = (random_state != 0u) ? random_state : 1u;
    for (int i = 0; i < 8; i++) {
        (void)faults_random();
    }
    fault.at_s = fault_loop.start_s + drawn(0.0, fault_loop.spread_s);
    draw_kind(turn);
}

// ---- Rows ----

void faults_heading(void)
{
    (void)printf(
        "loop,kind,number,bit,channel,value,at_s,for_s,resets,"
        "drive_low,drive_high,asked_low,asked_high,worst,error,back_s,"
        "off_s,off_first_s,off_after_s,least,most,alarm_s,alarms,end\n");
    (void)fflush(stdout);
}

// In control, off, fallen and off, or none of these.
static const char *end(void)
{
    const double now_s = world_time_s();
    const bool off = (now_s - seen.on_s) > (fault_loop.watch_s / 4.0);
    const bool back = (now_s - seen.outside_s) > (fault_loop.watch_s / 2.0);
    const char *how = "out";
    if (back) {
        how = "back";
    } else if (off) {
        how = ((fault_loop.fallen > 0.0) &&
               (fabs(seen.error) > fault_loop.fallen))
                  ? "fallen"
                  : "off";
    } else {
        // none of these
    }
    return how;
}

static void report(const char *how)
{
    const double until_s = fault.at_s + fault.for_s;
    (void)printf(
        "%s,%s,%ld,%u,%u,%.6g,%.6f,%.6f,%u,%d,%d,%d,%d,%.5g,%.5g,"
        "%.6f,%.6f,%.6f,%.6f,%.5g,%.5g,%.6f,%u,%s\n",
        plan.name, kind_names[fault.kind], fault.number, fault.bit,
        (unsigned)fault.channel, fault.value, fault.at_s, fault.for_s,
        seen.resets, seen.drive_low, seen.drive_high, seen.asked_low,
        seen.asked_high, seen.worst, seen.error,
        fmax(seen.outside_s - until_s, 0.0), fmax(seen.on_s - fault.at_s, 0.0),
        (seen.off_s < 0.0) ? -1.0 : (seen.off_s - fault.at_s), seen.off_after_s,
        seen.least, seen.most, seen.alarm_s, seen.alarms, how);
    (void)fflush(stdout);
}

// ---- Breaking and mending ----

static bool stays(void)
{
    return (fault.kind >= FAULT_PASSING) && (fault.kind != FAULT_FLIP_PLACE);
}

static struct fault_order hang(void)
{
    seen.hung_s = world_time_s();
    return (struct fault_order){.deed = FAULT_HANG_LOOP,
                                .seconds = fault.value};
}

static void break_input(void)
{
    static const enum world_break how[FAULT_KINDS] = {
        [FAULT_STUCK] = WORLD_STUCK,      [FAULT_SHORTED] = WORLD_READS,
        [FAULT_OPEN] = WORLD_READS,       [FAULT_NOISY] = WORLD_NOISY,
        [FAULT_CLIPPED] = WORLD_CLIPPED,  [FAULT_INPUT_LOW] = WORLD_READS,
        [FAULT_INPUT_HIGH] = WORLD_READS, [FAULT_INPUT_MOVED] = WORLD_MOVED};
    if (how[fault.kind] != WORLD_WHOLE) {
        world_break_input(fault.channel, how[fault.kind], fault.value);
    }
}

// What stays broken: nothing mends it.
static void break_for_good(void)
{
    const double set = world_last_voltage(fault_loop.inputs[0]);
    switch (fault.kind) {
    case FAULT_STAYS_STUCK:
        world_break_input(fault_loop.sensor, WORLD_STUCK, 0.0);
        break;
    case FAULT_STAYS_LEVEL:
        world_break_input(fault_loop.sensor, WORLD_READS, set + fault.value);
        break;
    case FAULT_STAYS_OFF:
        world_break_drive(WORLD_HELD, 0.0);
        break;
    case FAULT_STAYS_ON:
        world_break_drive(WORLD_HELD, 1.0);
        break;
    case FAULT_STAYS_TURNED:
        world_break_drive(WORLD_MIRRORED, (fault_loop.low + fault_loop.high) /
                                              (double)PORT_DRIVE_FULL);
        break;
    default:
        break;
    }
}

static struct fault_order strike(void)
{
    struct fault_order order = {.deed = FAULT_GO_ON};

    seen.struck = true;
    seen.least = seen.value;
    seen.most = seen.value;
    seen.ticks_seen = floor(world_time_s() / TICK_S);
    break_input();
    break_for_good();
    switch (fault.kind) {
    case FAULT_FLIP:
        order.deed = FAULT_FLIP_BIT;
        order.bit = fault.bit;
        break;
    case FAULT_FLIP_PLACE:
        order.deed = FAULT_FLIP_BIT_OF_PLACE;
        order.bit = fault.bit;
        order.share = fault.value;
        break;
    case FAULT_RESET:
        seen.resets++;
        order.deed = FAULT_RESET_CHIP;
        order.seconds = RESET_S;
        order.share = fault.value;
        break;
    case FAULT_BROWN_OUT:
        seen.resets++;
        order.deed = FAULT_RESET_CHIP;
        order.seconds = fault.value;
        order.random_ram = true;
        break;
    case FAULT_HANG:
    case FAULT_HANGS:
        order = hang();
        break;
    case FAULT_DEAD_TIMER:
        seen.hung_s = world_time_s();
        order.deed = FAULT_STOP_TIMER;
        break;
    default:
        break;
    }
    if (stays() && !plan.cut) {
        order.deed = FAULT_BLIND_GUARD;
    }
    return order;
}

static struct fault_order shift_ticks(double ticks)
{
    return (struct fault_order){.deed = FAULT_SHIFT_TICKS, .ticks = ticks};
}

// Once in each tick, as long as the fault lasts.
static struct fault_order shake_ticks(struct fault_order order)
{
    const double ticks = floor(world_time_s() / TICK_S);
    if ((fault.kind < FAULT_TICKS_LOST) || (fault.kind > FAULT_TICKS_LATE) ||
        (ticks <= seen.ticks_seen)) {
        return order;
    }
    seen.ticks_seen = ticks;
    if (fault.kind == FAULT_TICKS_LATE) {
        seen.ticks_ahead = -drawn(0.0, 0.9);
    } else if ((faults_random() & 1u) != 0u) {
        seen.ticks_ahead += (fault.kind == FAULT_TICKS_LOST) ? -1.0 : 1.0;
    } else {
        // this tick is as it should be
    }
    return shift_ticks(seen.ticks_ahead);
}

static struct fault_order mend(struct fault_order order)
{
    seen.mended = true;
    world_break_input(fault.channel, WORLD_WHOLE, 0.0);
    return (fault.kind == FAULT_TICKS_LATE) ? shift_ticks(0.0) : order;
}

void faults_was_reset(void)
{
    seen.resets++;
    seen.ticks_ahead = 0.0;
    if (fault.kind == FAULT_HANGS) {
        fault.for_s = world_time_s() - fault.at_s;
    }
    if (seen.hangs_left > 0u) {
        seen.next_hang_s = world_time_s() + drawn(0.0, BETWEEN_HANGS_S);
    }
}

// ---- Watching ----

static int lower(int one, int other)
{
    return (one < other) ? one : other;
}

static int higher(int one, int other)
{
    return (one > other) ? one : other;
}

static void judge_error(double now_s)
{
    double values[WORLD_TRACE_MAX];
    world_trace(values);
    seen.value = values[value_at];
    seen.error = seen.value;
    if (target_at != value_at) {
        seen.error -= values[target_at];
    }
    if (!(fabs(seen.error) <= fault_loop.band)) { // nor if it is not a number
        seen.outside_s = now_s;
    }
    if (seen.struck) {
        seen.worst = fmax(seen.worst, fabs(seen.error));
        seen.least = fmin(seen.least, seen.value);
        seen.most = fmax(seen.most, seen.value);
    }
}

static void judge_drive(double now_s, int drive, int asked)
{
    if (drive != 0) {
        seen.on_s = now_s;
    } else if (seen.hung_s >= 0.0) {
        seen.off_after_s = fmax(seen.off_after_s, now_s - seen.hung_s);
        seen.hung_s = -1.0;
    } else {
        // it may be off
    }
    if (seen.struck) {
        seen.drive_low = lower(seen.drive_low, drive);
        seen.drive_high = higher(seen.drive_high, drive);
        seen.asked_low = lower(seen.asked_low, asked);
        seen.asked_high = higher(seen.asked_high, asked);
        const double since_s = fmax(seen.on_s, fault.at_s);
        if ((seen.off_s < 0.0) && ((now_s - since_s) > TICK_S)) {
            seen.off_s = since_s;
        }
    }
}

static void judge_alarms(double now_s, unsigned alarms)
{
    if ((alarms != 0u) && (seen.alarms == 0u)) {
        seen.alarms = alarms;
        seen.alarm_s = now_s - fault.at_s;
        if (plan.cut) {
            world_break_drive(WORLD_HELD, 0.0);
        }
    }
}

// Returns in each copy, with its fault drawn, and never in the original.
static void copy_for_each(void)
{
    for (long i = plan.first; i < (plan.first + plan.count); i++) {
        (void)fflush(stdout);
        const pid_t copy = fork();
        if (copy == 0) {
            (void)alarm(STUCK_SECONDS);
            memset(&seen, 0, sizeof(seen));
            draw(i);
            seen.begun = true;
            seen.hung_s = -1.0;
            seen.off_s = -1.0;
            return;
        }
        int status = 0;
        if ((copy < 0) || (waitpid(copy, &status, 0) < 0)) {
            perror("faults");
            exit(EXIT_FAILURE);
        }
        if (status != 0) {
            draw(i);
            report("crashed");
        }
    }
    _exit(EXIT_SUCCESS); // each row has been written
}

// What has been quiet for half of the time that it is watched is over, unless
// it stays broken.
static bool over(double now_s)
{
    const double until_s = fault.at_s + fault.for_s;
    const double half_s = fault_loop.watch_s / 2.0;
    const bool quiet = seen.struck && !stays() && (seen.hangs_left == 0u) &&
                       ((now_s - fmax(seen.outside_s, until_s)) > half_s);
    return quiet || (now_s > (until_s + fault_loop.watch_s));
}

// What the fault does at this moment: one thing at most, by its kind.
static struct fault_order act(double now_s)
{
    const bool rests =
        seen.struck ? (seen.mended || stays()) : (now_s < fault.at_s);
    const bool hangs = (seen.next_hang_s > 0.0) && (now_s >= seen.next_hang_s);
    if (rests && !hangs) { // nearly always, so it is told first
        return (struct fault_order){.deed = FAULT_GO_ON};
    }

    struct fault_order order = {.deed = FAULT_GO_ON};
    if (!seen.struck && (now_s >= fault.at_s)) {
        order = strike();
    }
    if (seen.struck && !seen.mended && !stays()) {
        if (now_s < (fault.at_s + fault.for_s)) {
            order = shake_ticks(order);
        } else {
            order = mend(order);
        }
    }
    if (hangs) {
        seen.hangs_left--;
        seen.next_hang_s = 0.0;
        order = hang();
    }
    return order;
}

struct fault_order faults_watch(int drive, int asked, unsigned alarms)
{
    const double now_s = world_time_s();
    if (!seen.begun) {
        if (now_s < fault_loop.start_s) {
            return (struct fault_order){.deed = FAULT_GO_ON};
        }
        copy_for_each();
    }
    judge_error(now_s);
    judge_drive(now_s, drive, asked);
    judge_alarms(now_s, alarms);
    if (over(now_s)) {
        report(end());
        _exit(EXIT_SUCCESS);
    }
    return act(now_s);
}
