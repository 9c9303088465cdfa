// SPDX-License-Identifier: MIT
// What the ports of all PICs have in common, registers and all. For port.c,
// which includes it once, after its registers.h and the two bytes of ticks.
#ifndef PORT_PIC_PORT_COMMON_H
#define PORT_PIC_PORT_COMMON_H
#include "port_ticks.h"

// Full drive off, at the end of the PWM period at the latest. The low bits go
// first: CCPR1L = 0 with low bits would be one of the pulses never made.
static void drive_off(void)
{
    CCP1CON &= (uint8_t)~CCP1CON_DC1B;
    CCPR1L = 0u;
}

static void wait_for_end_of_period(void)
{
    PIR1 &= (uint8_t)~PIR1_TMR2IF;
    while (PIR1bits.TMR2IF == 0u) {
    }
}

#endif
