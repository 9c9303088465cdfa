// SPDX-License-Identifier: MIT
// The template filled in for an imaginary chip with the usual parts: a timer
// that reloads itself, a PWM, a converter of 12 bits and a watchdog.
// `test/use/port_check/run test/use/port_check/filled` runs it on a PC, over
// fake/.
#include "port.h"

#include <chip.h>

#define TICK_TOP 15999u // 16 MHz over 1000 Hz, less 1
#define PIN_REVERSE 0x01u
#define PINS_OF_BRIDGE 0x03u
#define ADC_ON 0x01u
#define ADC_BUSY 0x02u
#define RESTART 0x5Au

static volatile uint8_t ticks_counted; // by the interrupt only
static uint8_t ticks_taken;            // by the loop only

// The timer reloads itself, so no latency enters the period.
void timer_vector(void)
{
    TIMER_FLAG = 0;
    if ((uint8_t)(ticks_counted + 1u) != ticks_taken) {
        ticks_counted++;
    }
}

static void feed_watchdog(void)
{
    WATCHDOG = RESTART;
}

// The duty is taken at the end of a period: after one flag the period without
// duty begins, and after two it is over.
static void wait_for_end_of_period(void)
{
    PWM_FLAG = 0;
    while (PWM_FLAG == 0u) {
    }
}

void port_init(void)
{
    PWM_TOP = PORT_DRIVE_FULL - 1;
    PWM_DUTY = 0;
    PWM_CONTROL = 1;
    ADC_CONTROL = ADC_ON;
    TIMER_TOP = TICK_TOP;
    TIMER_CONTROL = 1;
    INTERRUPTS = 1;
    wait_for_end_of_period();
    wait_for_end_of_period();
    OUTPUTS = PINS_OF_BRIDGE;
}

uint8_t port_ticks(void)
{
    const uint8_t ticks = (uint8_t)(ticks_counted - ticks_taken);

    ticks_taken = (uint8_t)(ticks_taken + ticks);
    if (ticks != 0u) {
        feed_watchdog();
    }
    return ticks;
}

uint8_t port_wait_tick(void)
{
    while (ticks_counted == ticks_taken) {
    }
    return port_ticks();
}

uint16_t port_read(uint8_t channel)
{
    ADC_CHANNEL = channel;
    ADC_CONTROL = ADC_ON | ADC_BUSY;
    while ((ADC_CONTROL & ADC_BUSY) != 0u) {
    }
    return (uint16_t)(ADC_RESULT >> 2);
}

static void turn_around(uint8_t direction)
{
    PWM_DUTY = 0;
    wait_for_end_of_period();
    wait_for_end_of_period();
    LEVELS = direction;
}

void port_drive(int16_t duty)
{
    uint16_t magnitude = (uint16_t)duty;
    uint8_t direction = 0;

    if (duty < 0) {
        magnitude = (uint16_t)(0u - magnitude);
        direction = PIN_REVERSE;
    }
    if (magnitude > (uint16_t)PORT_DRIVE_FULL) {
        magnitude = (uint16_t)PORT_DRIVE_FULL;
    }
    if (magnitude < (uint16_t)PORT_DRIVE_LEAST) {
        PWM_DUTY = 0;
        return;
    }
    if ((LEVELS & PIN_REVERSE) != direction) {
        turn_around(direction);
    }
    PWM_DUTY = magnitude;
}
