// SPDX-License-Identifier: MIT
// A task of FreeRTOS owns the loop, and others give it orders. Of FreeRTOS
// there is here what the recipe calls, with one task and a mailbox: a wait
// moves the process by a step.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 1000

typedef uint32_t TickType_t;
typedef long BaseType_t;
typedef unsigned long UBaseType_t;
typedef struct mailbox *QueueHandle_t;

#define pdTRUE 1
#define pdMS_TO_TICKS(ms) (ms)

struct mailbox {
    unsigned char item[64];
    UBaseType_t size;
    bool full;
};

static QueueHandle_t xQueueCreate(UBaseType_t length, UBaseType_t size)
{
    static struct mailbox only;

    only.size = size;
    return (length == 1u && size <= sizeof only.item) ? &only : NULL;
}

static BaseType_t xQueueOverwrite(QueueHandle_t queue, const void *item)
{
    (void)memcpy(queue->item, item, queue->size);
    queue->full = true;
    return pdTRUE;
}

static BaseType_t xQueueReceive(QueueHandle_t queue, void *item,
                                TickType_t wait)
{
    const BaseType_t full = queue->full ? pdTRUE : !pdTRUE;

    (void)wait;
    if (queue->full) {
        (void)memcpy(item, queue->item, queue->size);
        queue->full = false;
    }
    return full;
}

static TickType_t xTaskGetTickCount(void)
{
    return 0;
}

static void vTaskDelayUntil(TickType_t *woken, TickType_t ticks);
static int16_t measure(void);
static void drive(int16_t output);

// recipe
struct order {
    int16_t setpoint;
    struct fixpid_pid_gains gains;
    uint8_t edition; // of the gains: whoever changes them adds 1
};

static QueueHandle_t orders; // xQueueCreate(1, sizeof(struct order))
static struct fixpid_pid pid;

// shown
// Nobody else calls a function of this controller.
static void control_task(void *unused)
{
    struct order order = {0, {0, 0, 0, 0}, 0};
    uint8_t edition = 0; // which the controller has
    TickType_t woken = xTaskGetTickCount();

    (void)unused;
    for (;;) {
        (void)xQueueReceive(orders, &order, 0);
        if (order.edition != edition) {
            edition = order.edition;
            (void)fixpid_pid_set_gains(&pid, &order.gains);
            fixpid_pid_seed(&pid, fixpid_pid_output(&pid));
        }
        drive(fixpid_pid_step(&pid, order.setpoint, measure()));
        vTaskDelayUntil(&woken, pdMS_TO_TICKS(100));
    }
}
// end of shown

// From any other task; in an interrupt it is xQueueOverwriteFromISR.
static void change(const struct order *order)
{
    (void)xQueueOverwrite(orders, order);
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

// Another task runs now, which repeats its order each time; after the last step
// all end.
static void vTaskDelayUntil(TickType_t *woken, TickType_t ticks)
{
    static const struct order faster = {.setpoint = 700,
                                        .gains =
                                            FIXPID_PID_GAINS(2, 0.05, 0, 1, 0),
                                        .edition = 2};
    const TickType_t k = *woken / ticks;

    (void)printf("%u,%d,%.6g,%d\n", (unsigned)k, (k < STEPS / 2) ? 600 : 700,
                 motion.value, fixpid_pid_output(&pid));
    *woken += ticks;
    if (k + 1u >= STEPS / 2) {
        change(&faster);
    }
    if (k + 1u == STEPS) {
        exit(EXIT_SUCCESS);
    }
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
    orders = xQueueCreate(1, sizeof(struct order));
    (void)printf("time_s,setpoint,value,output\n");
    change(&first);
    control_task(NULL);
    return EXIT_FAILURE;
}
