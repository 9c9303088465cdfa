// SPDX-License-Identifier: MIT
// A pendulum as AN964 has it, before: written for this test with the note's
// names and equations, an `int` of 16 bits, and the error in a signed char.
#include "chip.h"

unsigned int angle, kp, ki, kd; // conversions of 10 bits
int pwm;                        // duty counts with the direction as their sign

static volatile unsigned char timer0_flag;
static signed char en0, en1, en2, en3;
static int sum, integral_term, derivative_term;
static int Cn, Cn_kp;

static void timer0(void) __interrupt(0)
{
    TMR0 = 11;
    INTCON &= ~0x04; // T0IF
    timer0_flag = 1;
}

void measure(void) // sets `angle`, kp, ki and kd of a converter
{
}

void drive(void) // gives pwm to a bridge
{
}

static void PID(void)
{
    en0 = angle - 512;
    sum = sum + en0;
    if (sum > 30000) {
        sum = 30000;
    }
    if (sum < -29999) {
        sum = -29999;
    }
    integral_term = sum / 256;
    integral_term = integral_term * ki;
    integral_term = integral_term / 16;

    derivative_term = en0 - en3; // Figure 6
    if (derivative_term > 120) {
        derivative_term = 120;
    }
    if (derivative_term < -120) {
        derivative_term = -120;
    }
    derivative_term = derivative_term * kd;
    derivative_term = derivative_term >> 5; // divide by 32
    if (derivative_term > 120) {
        derivative_term = 120;
    }
    if (derivative_term < -120) {
        derivative_term = -120;
    }

    Cn = en0 + integral_term + derivative_term;
    Cn_kp = ((unsigned long)(Cn < 0 ? -Cn : Cn) * kp) >> 10; // divide by 1024
    if (Cn_kp > 1000) {
        Cn_kp = 1000;
    }
    pwm = (Cn < 0) ? -Cn_kp : Cn_kp;
    en3 = en2;
    en2 = en1;
    en1 = en0;
}

void main(void)
{
    OSCCON = 0x70;     // 8 MHz
    OPTION_REG = 0x84; // Timer0 counts 32 cycles
    INTCON = 0xA0;     // GIE, T0IE
    while (1) {
        while (timer0_flag == 0) {
        }
        timer0_flag = 0;
        measure();
        PID();
        drive();
    }
}
