// SPDX-License-Identifier: MIT
// The pendulum of before_an964.c with fixpid_an964.
#include "chip.h"
#include "fixpid_an964.h"

uint16_t angle, kp, ki, kd;
int16_t pwm;

FIXPID_DATA struct fixpid_an964 pendulum;

static volatile uint8_t timer0_flag;

PORT_TICK_INTERRUPT()
{
    TMR0 = 11;
    INTCON &= (uint8_t)~0x04u; // T0IF
    timer0_flag = 1;
}

void measure(void)
{
}

void drive(void)
{
}

void main(void)
{
    static const struct fixpid_an964_gains none = {0, 0, 0};

    (void)fixpid_an964_init(&pendulum, &none);
    OSCCON = 0x70;
    OPTION_REG = 0x84;
    INTCON = 0xA0;
    while (1) {
        while (timer0_flag == 0) {
        }
        timer0_flag = 0;
        measure();
        (void)fixpid_an964_set_gains(&pendulum, kp, ki, kd);
        pwm = fixpid_an964_step(&pendulum, (int16_t)(angle - 512));
        drive();
    }
}
