// SPDX-License-Identifier: MIT
// The promises of port.h, kept or not by a port over a fake chip. Each check is
// a process of its own, so a power-on; a port that waits for ever is stopped.
// The timer's interrupt comes by hand, or as a signal: at any moment, as on a
// chip. Prints `ok NAME` or `FAILED NAME: why` for each promise.
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fake.h"
#include "port.h"
#ifdef UART
#include "port_uart.h"
#endif

#define FULL PORT_DRIVE_FULL
#define LEAST PORT_DRIVE_LEAST
#define CPU_SECONDS 2u
#define MOVES_MOST 100000u // for two PWM periods

uint32_t chip_inputs[FAKE_INPUTS];

static const uint8_t channels[] = {
#ifdef PORT_ANGLE
    PORT_ANGLE,       PORT_KP, PORT_KI, PORT_KD,
#endif
#ifdef PORT_SETPOINT
    PORT_SETPOINT,
#endif
#ifdef PORT_TACHOMETER
    PORT_TACHOMETER,
#endif
#ifdef PORT_SELECTOR
    PORT_SELECTOR,
#endif
#ifdef PORT_TEMPERATURE
    PORT_TEMPERATURE,
#endif
};
#define CHANNELS (sizeof(channels) / sizeof(channels[0]))

static const char *running_check;

static void fail(const char *why)
{
    (void)printf("FAILED %s: %s\n", running_check, why);
    (void)fflush(stdout);
    _exit(1);
}

static void expect(bool kept, const char *why)
{
    if (!kept) {
        fail(why);
    }
}

static void expect_number(long wanted, long found, const char *what)
{
    static char why[120];

    if (wanted != found) {
        (void)snprintf(why, sizeof why, "%s is %ld, not %ld", what, found,
                       wanted);
        fail(why);
    }
}

// --- the pins, between any two uses of a register ---

static bool was_output, was_reverse;
static unsigned off_since; // the period in which the duty was 0 first

static bool off_for_a_period(void)
{
    return (chip_duty() == 0) && (chip_periods() > off_since);
}

static void watch_pins(void)
{
    const int32_t duty = chip_duty();

    if (chip_is_output() && !was_output) {
        expect(off_for_a_period(), "pins become outputs before a PWM period "
                                   "without duty has passed");
    }
    was_output = chip_is_output();
    if ((chip_reverse() != was_reverse) && was_output) {
        expect(off_for_a_period(), "the direction turns before a PWM period "
                                   "without duty has passed");
    }
    was_reverse = chip_reverse();
    if (was_output) {
        expect((duty == 0) || (duty >= LEAST),
               "a pulse is shorter than PORT_DRIVE_LEAST");
        expect(duty <= FULL, "a pulse is longer than PORT_DRIVE_FULL");
    }
    if (duty != 0) {
        off_since = chip_periods() + 1u; // not before the next
    } else if (off_since > chip_periods()) {
        off_since = chip_periods();
    } else {
        // still off
    }
}

static volatile sig_atomic_t in_interrupt;

static void move(void)
{
    if (in_interrupt == 0) {
        chip_moves();
        watch_pins();
    }
}

volatile uint8_t *fake_byte(volatile uint8_t *its)
{
    move();
    return its;
}

volatile uint16_t *fake_word(volatile uint16_t *its)
{
    move();
    return its;
}

// Two PWM periods later.
static void settle(void)
{
    const unsigned before = chip_periods();

    for (unsigned i = 0; chip_periods() < before + 2u; i++) {
        expect(i < MOVES_MOST, "the PWM does not run");
        move();
    }
}

static int32_t made(void)
{
    settle();
    expect(chip_is_output(), "the drive's pins are no outputs");
    return chip_reverse() ? -chip_duty() : chip_duty();
}

// --- the timer ---

static volatile long given; // ticks
static volatile unsigned fed_at_first_tick;

static void tick(void)
{
    in_interrupt++;
    if (given == 0) {
        fed_at_first_tick = chip_feeds();
    }
    expect(chip_tick(), "port_init does not start the timer");
    given++;
    in_interrupt--;
}

static void ticks(long n)
{
    for (long i = 0; i < n; i++) {
        tick();
    }
}

static void (*at_signal)(void) = tick;

static void on_signal(int signal)
{
    (void)signal;
    at_signal();
}

// Ticks as signals from now on; 0 us ends them. pre: below a second.
static void ticks_every(long microseconds)
{
    const struct itimerval period = {{0, microseconds}, {0, microseconds}};
    struct sigaction action = {.sa_handler = on_signal};

    (void)sigaction(SIGALRM, &action, NULL);
    (void)setitimer(ITIMER_REAL, &period, NULL);
}

// --- the promises ---

static void init_leaves_the_drive_off(void)
{
    expect_number(0, made(), "the drive");
    expect_number(0, made(), "the drive");
}

// watch_pins looks what is on them then.
static void init_makes_the_pins_outputs_last(void)
{
    expect(chip_is_output(), "the drive's pins are no outputs");
    settle();
}

static void running_is_true(void)
{
    expect(port_running(), "port_running is false");
}

static void ticks_are_told_once(void)
{
    static const long numbers[] = {1, 0, 2, 100, 0, 254, 1};

    for (unsigned i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        ticks(numbers[i]);
        expect_number(numbers[i], port_ticks(), "what port_ticks tells");
        expect_number(0, port_ticks(), "what port_ticks tells next");
    }
}

static void ticks_saturate_at_255(void)
{
    static const long numbers[] = {255, 256, 257, 300, 511, 512, 1000};

    for (unsigned i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        ticks(numbers[i]);
        expect_number(255, port_ticks(), "what port_ticks tells");
        ticks(3);
        expect_number(3, port_ticks(), "what port_ticks tells next");
    }
}

static void ticks_are_not_lost_whenever_they_come(void)
{
    long told = 0;

    ticks_every(30);
    while (given < 3000) {
        told += port_ticks();
    }
    ticks_every(0);
    told += port_ticks();
    expect_number(given, told, "the sum of what port_ticks tells");
}

static void wait_tick_waits_for_one(void)
{
    ticks_every(2000);
    for (long i = 1; i <= 20; i++) {
        const long told = port_wait_tick();
        expect(told > 0, "port_wait_tick tells 0");
        expect(given >= i, "port_wait_tick does not wait");
    }
}

static void wait_tick_tells_those_that_came_before(void)
{
    ticks(3);
    expect_number(3, port_wait_tick(), "what port_wait_tick tells");
    ticks(300);
    expect_number(255, port_wait_tick(), "what port_wait_tick tells");
    expect_number(0, port_ticks(), "what port_ticks tells next");
}

static void wait_ticks_waits_for_n(void)
{
    long told = 0;

    ticks_every(300);
    told += port_wait_ticks(20);
    expect((told >= 20) && (given >= 20), "port_wait_ticks(20) waits for less");
    told += port_wait_ticks(0);
    expect(told >= 21, "port_wait_ticks(0) waits for none");
    ticks_every(0);
    told += port_ticks();
    expect_number(given, told, "the sum of what was told");
    ticks(300);
    expect_number(255, port_wait_ticks(3), "what port_wait_ticks tells");
}

static unsigned feeds(void)
{
    move(); // what was written last
    return chip_feeds();
}

static void watchdog_is_fed_when_there_was_a_tick(void)
{
    for (int i = 0; i < 10; i++) {
        const unsigned before = feeds();
        tick();
        expect_number(1, (i % 2 != 0) ? port_wait_tick() : port_ticks(),
                      "what is told");
        expect(feeds() > before, "a tick does not feed the watchdog");
    }
}

static void watchdog_is_fed_as_ticks_come(void)
{
    const unsigned before = feeds();

    ticks_every(300);
    (void)port_wait_ticks(40);
    expect(feeds() > before + 20u, "port_wait_ticks feeds too seldom");
}

static void watchdog_is_not_fed_without_a_tick(void)
{
    const unsigned before = feeds();

    for (int i = 0; i < 1000; i++) {
        (void)port_ticks();
    }
    expect_number(before, feeds(), "the watchdog's count after port_ticks");
    ticks_every(5000);
    (void)port_wait_tick();
    ticks_every(0);
    expect_number(before, fed_at_first_tick,
                  "the watchdog's count in port_wait_tick, before the tick");
}

static void watchdog_is_not_fed_by_the_rest(void)
{
    const unsigned before = feeds();

    for (unsigned i = 0; i < CHANNELS; i++) {
        (void)port_read(channels[i]);
        port_drive((i % 2u != 0u) ? FULL : -FULL);
    }
    expect_number(before, feeds(), "the watchdog's count after reads, drives");
}

static void read_gives_0_to_1023(void)
{
    expect(CHANNELS > 0u, "port_board.h has no channel of the examples");
    for (uint32_t code = 0; code <= chip_code_most; code++) {
        const unsigned before = chip_conversions();
        chip_inputs[chip_input_of(channels[0])] = code;
        expect_number((long)(1024u * code / (chip_code_most + 1u)),
                      port_read(channels[0]), "what port_read gives");
        expect_number(before + 1u, chip_conversions(),
                      "the number of conversions");
    }
}

static void read_converts_its_channel(void)
{
    for (uint32_t i = 0; i < FAKE_INPUTS; i++) {
        chip_inputs[i] = i * (chip_code_most / FAKE_INPUTS);
    }
    for (unsigned i = 0; i < 2u * CHANNELS; i++) {
        const uint8_t channel = channels[i % CHANNELS];
        const uint32_t code = chip_inputs[chip_input_of(channel)];
        expect_number((long)(1024u * code / (chip_code_most + 1u)),
                      port_read(channel), "what port_read gives");
    }
}

static void drive_makes_each_duty(void)
{
    for (int32_t duty = -FULL; duty <= FULL; duty++) {
        port_drive((int16_t)duty);
        if (labs(duty) >= LEAST) {
            expect_number(duty, made(), "the drive");
        }
    }
}

static void drive_below_the_least_is_off(void)
{
    static const int16_t before[] = {FULL, -FULL, LEAST, -LEAST};

    for (int32_t duty = -LEAST + 1; duty < LEAST; duty++) {
        for (int i = 0; i < 4; i++) {
            port_drive(before[i]);
            expect_number(before[i], made(), "the drive");
            port_drive((int16_t)duty);
            expect_number(0, made(), "the drive");
        }
    }
}

static void drive_is_limited_to_full(void)
{
    static const int16_t beyond[] = {INT16_MIN, INT16_MAX, INT16_MIN + 1, 0};

    for (int i = 0; i < 4; i++) {
        port_drive(beyond[i]);
        expect_number((beyond[i] > 0) ? FULL : ((beyond[i] < 0) ? -FULL : 0),
                      made(), "the drive");
    }
#if PORT_DRIVE_FULL < 32767
    port_drive(FULL + 1);
    expect_number(FULL, made(), "the drive");
    port_drive(-FULL - 1);
    expect_number(-FULL, made(), "the drive");
#endif
}

// watch_pins looks; from each to each.
static void drive_is_off_before_it_turns(void)
{
    static const int16_t duties[] = {FULL, -FULL, LEAST, -LEAST, 0, -FULL / 2};

    for (int i = 0; i < 36; i++) {
        port_drive(duties[i / 6]);
        expect_number(duties[i / 6], made(), "the drive");
        port_drive(duties[i % 6]);
        expect_number(duties[i % 6], made(), "the drive");
    }
}

// --- those of port_uart.h ---

#ifdef UART
static int sends(bool late)
{
    int byte = 0;

    in_interrupt++;
    byte = chip_uart_sends(late);
    in_interrupt--;
    return byte;
}

static void receives(uint8_t byte)
{
    in_interrupt++;
    chip_uart_receives(byte);
    in_interrupt--;
}

static void nothing_is_sent(void)
{
    expect_number(-1, sends(false), "what is sent after the last byte");
    expect_number(-1, sends(true), "what is sent when none is to be");
    expect_number(PORT_UART_OUT, port_uart_room(), "the room");
}

static void uart_has_its_rate(void)
{
    const long off = (long)chip_uart_baud() - (long)PORT_UART_BAUD;

    expect(labs(off) * 50 <= (long)PORT_UART_BAUD, "the rate is 2 % off");
}

static void uart_begins_empty(void)
{
    nothing_is_sent();
    expect_number(0, port_uart_waiting(), "what waits");
    receives(1);
    port_uart_put(1);
    port_uart_init();
    nothing_is_sent();
    expect_number(0, port_uart_waiting(), "what waits after another init");
}

// Fills the ring from each place of it.
static void uart_sends_what_it_has_room_for(void)
{
    for (unsigned from = 0; from <= PORT_UART_OUT; from++) {
        unsigned byte = from;

        for (; port_uart_room() != 0u; byte++) {
            expect_number((long)(PORT_UART_OUT - (byte - from)),
                          port_uart_room(), "the room");
            port_uart_put((uint8_t)byte);
        }
        expect_number((long)(from + PORT_UART_OUT), byte, "the last byte");
        port_uart_put(0xEE); // is lost
        for (unsigned next = from; next != byte; next++) {
            expect_number((uint8_t)next, sends(false), "what is sent");
        }
        nothing_is_sent();
        port_uart_put(0xAA); // the next place
        expect_number(0xAA, sends(false), "what is sent");
    }
}

static void uart_keeps_what_it_has_room_for(void)
{
    for (unsigned from = 0; from <= PORT_UART_IN; from++) {
        for (unsigned byte = 0; byte < PORT_UART_IN + 5u; byte++) {
            receives((uint8_t)(from + byte));
        }
        for (unsigned byte = 0; byte < PORT_UART_IN; byte++) {
            expect_number((long)(PORT_UART_IN - byte), port_uart_waiting(),
                          "what waits");
            expect_number((uint8_t)(from + byte), port_uart_get(),
                          "what has come");
        }
        expect_number(0, port_uart_waiting(), "what waits");
        (void)port_uart_get(); // of an empty ring, and it stays so
        expect_number(0, port_uart_waiting(), "what waits");
        receives(0xAA); // the next place
        expect_number(0xAA, port_uart_get(), "what has come");
    }
}

static volatile uint8_t next_sent;
static volatile uint8_t next_received;
static volatile long moved;
static volatile bool wrong;

static void one_each_way(void)
{
    const int byte = sends(false);

    if (byte >= 0) {
        wrong = wrong || (byte != next_sent);
        next_sent++;
    }
    if (port_uart_waiting() < PORT_UART_IN) {
        receives(next_received);
        next_received++;
    }
    moved++;
}

static void uart_bytes_are_not_lost_whenever_they_come(void)
{
    uint8_t put = 0;
    uint8_t got = 0;

    at_signal = one_each_way;
    ticks_every(30);
    while (moved < 3000) {
        if (port_uart_room() != 0u) {
            port_uart_put(put);
            put++;
        }
        if (port_uart_waiting() != 0u) {
            expect_number(got, port_uart_get(), "what has come");
            got++;
        }
        expect(!wrong, "another byte is sent than was to be");
    }
    ticks_every(0);
    while (sends(false) >= 0) {
        next_sent++;
    }
    expect_number(put, next_sent, "the number of bytes that were sent");
    got = (uint8_t)(got + port_uart_waiting());
    expect_number(next_received, got, "the number of bytes that came");
}
#endif

struct promise {
    const char *name;
    void (*check)(void);
};

#define PROMISE(name)                                                          \
    {                                                                          \
#name, name                                                            \
    }

static const struct promise promises[] = {
    PROMISE(init_leaves_the_drive_off),
    PROMISE(init_makes_the_pins_outputs_last),
    PROMISE(running_is_true),
    PROMISE(ticks_are_told_once),
    PROMISE(ticks_saturate_at_255),
    PROMISE(ticks_are_not_lost_whenever_they_come),
    PROMISE(wait_tick_waits_for_one),
    PROMISE(wait_tick_tells_those_that_came_before),
    PROMISE(wait_ticks_waits_for_n),
    PROMISE(watchdog_is_fed_when_there_was_a_tick),
    PROMISE(watchdog_is_fed_as_ticks_come),
    PROMISE(watchdog_is_not_fed_without_a_tick),
    PROMISE(watchdog_is_not_fed_by_the_rest),
    PROMISE(read_gives_0_to_1023),
    PROMISE(read_converts_its_channel),
    PROMISE(drive_makes_each_duty),
    PROMISE(drive_below_the_least_is_off),
    PROMISE(drive_is_limited_to_full),
    PROMISE(drive_is_off_before_it_turns),
#ifdef UART
    PROMISE(uart_has_its_rate),
    PROMISE(uart_begins_empty),
    PROMISE(uart_sends_what_it_has_room_for),
    PROMISE(uart_keeps_what_it_has_room_for),
    PROMISE(uart_bytes_are_not_lost_whenever_they_come),
#endif
};

static void power_on(const struct promise *promise)
{
    const struct rlimit most = {CPU_SECONDS, CPU_SECONDS};

    (void)setrlimit(RLIMIT_CPU, &most);
    running_check = promise->name;
    chip_reset();
    port_init();
#ifdef UART
    port_uart_init();
#endif
    promise->check();
    (void)printf("ok %s\n", promise->name);
    (void)fflush(stdout);
    _exit(0);
}

static bool keeps(const struct promise *promise)
{
    int status = 0;
    const pid_t child = fork();

    if (child == 0) {
        power_on(promise);
    }
    (void)waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) {
        (void)printf("FAILED %s: the port waits for ever\n", promise->name);
        (void)fflush(stdout);
    }
    return status == 0;
}

// All, or the one that is named.
int main(int count, char **arguments)
{
    bool good = true;

    for (unsigned i = 0; i < sizeof promises / sizeof promises[0]; i++) {
        if ((count < 2) || (strcmp(arguments[1], promises[i].name) == 0)) {
            good = keeps(&promises[i]) && good;
        }
    }
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
