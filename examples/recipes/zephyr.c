// SPDX-License-Identifier: MIT
// A thread of Zephyr owns the loop, and others give it orders. Of Zephyr there
// is here what the recipe calls, with one thread and a queue of one message: a
// wait for the timer moves the process by a step.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 1000

struct k_timer {
    unsigned expired;
};
struct k_msgq {
    unsigned char item[64];
    size_t size;
    bool full;
};

#define K_MSEC(ms) (ms)
#define K_NO_WAIT 0
#define K_TIMER_DEFINE(name, expiry, stop) static struct k_timer name
#define K_MSGQ_DEFINE(name, bytes, messages, align)                            \
    static struct k_msgq name = {.size = (bytes)}

static void k_timer_start(struct k_timer *timer, int duration, int period)
{
    (void)duration;
    (void)period;
    timer->expired = 0;
}

static uint32_t k_timer_status_sync(struct k_timer *timer);
static int16_t measure(void);
static void drive(int16_t output);

static int k_msgq_put(struct k_msgq *queue, const void *item, int wait)
{
    (void)wait;
    if (queue->full) {
        return -1;
    }
    (void)memcpy(queue->item, item, queue->size);
    queue->full = true;
    return 0;
}

static int k_msgq_get(struct k_msgq *queue, void *item, int wait)
{
    (void)wait;
    if (!queue->full) {
        return -1;
    }
    (void)memcpy(item, queue->item, queue->size);
    queue->full = false;
    return 0;
}

// recipe
struct order {
    int16_t setpoint;
    struct fixpid_pid_gains gains;
    uint8_t edition; // of the gains: whoever changes them adds 1
};

K_MSGQ_DEFINE(orders, sizeof(struct order), 1, 4);
K_TIMER_DEFINE(period, NULL, NULL);
static struct fixpid_pid pid;

// shown
// Nobody else calls a function of this controller.
static void control_thread(void *a, void *b, void *c)
{
    struct order order = {0, {0, 0, 0, 0}, 0};
    uint8_t edition = 0; // which the controller has

    (void)a;
    (void)b;
    (void)c;
    k_timer_start(&period, K_MSEC(100), K_MSEC(100));
    for (;;) {
        (void)k_msgq_get(&orders, &order, K_NO_WAIT);
        if (order.edition != edition) {
            edition = order.edition;
            (void)fixpid_pid_set_gains(&pid, &order.gains);
            fixpid_pid_seed(&pid, fixpid_pid_output(&pid));
        }
        drive(fixpid_pid_step(&pid, order.setpoint, measure()));
        (void)k_timer_status_sync(&period); // above 1: steps were missed
    }
}
// end of shown

// From another thread or an interrupt. False: the last order still waits.
static bool change(const struct order *order)
{
    return k_msgq_put(&orders, order, K_NO_WAIT) == 0;
}
// end of recipe

static struct motion motion;

static int16_t measure(void)
{
    return motion_read(&motion);
}

static void drive(int16_t output)
{
    motion_move(&motion, output);
}

// Another thread runs now, which repeats its order each time; after the last
// step all end.
static uint32_t k_timer_status_sync(struct k_timer *timer)
{
    static const struct order faster = {.setpoint = 700,
                                        .gains =
                                            FIXPID_PID_GAINS(2, 0.05, 0, 1, 0),
                                        .edition = 2};
    const unsigned k = timer->expired;

    (void)printf("%u,%d,%.6g,%d\n", k, (k < STEPS / 2) ? 600 : 700,
                 motion.value, fixpid_pid_output(&pid));
    timer->expired++;
    if (k + 1u >= STEPS / 2 && !change(&faster)) {
        exit(EXIT_FAILURE);
    }
    if (k + 1u == STEPS) {
        exit(EXIT_SUCCESS);
    }
    return 1;
}

int main(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(1, 0.02, 0, 1, 0),
        .output_min = 0,
        .output_max = 255};
    static const struct plant_counts process = {
        .gain = 4.0, .lag_steps = 50.0, .delay_steps = 3, .sensor_max = 1023.0};
    const struct order first = {600, config.gains, 1};

    (void)fixpid_pid_init(&pid, &config);
    motion_start(&motion, &process);
    (void)printf("time_s,setpoint,value,output\n");
    if (change(&first)) {
        control_thread(NULL, NULL, NULL);
    }
    return EXIT_FAILURE;
}
