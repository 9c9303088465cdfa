// SPDX-License-Identifier: MIT
// The motor of before_an937.asm with fixpid_an937, for SDCC and XC8. Another
// PIC than the PIC18F4520 has other registers: start from a copy of
// port/template, with `tools/firmware --chip CHIP --port COPY`. To build this
// by hand with SDCC and look at it in gpsim, type in the folder of the sources:
//
//     here=test/use/notes
//     paths="-Iinclude -Iport/pic/pic18f4520 -I$here"
//     flags="$paths -DFIXPID_AN937_OBJECT=motor"
//     sources="$here/after_an937.c src/an937/*.c"
//     tools/lib/build/build_pic pic18f4520 build/motor $flags $sources
//     gpsim -i -s build/motor.cod
//     BreakOnInvalidRegisterWrite=false
//     break c 2000000
//     run
//     dump r
//     quit
//
// The last five lines are for gpsim. The first of them allows that SDCC's
// start-up clears more RAM than this chip has. After 2000000 cycles, 0.2 s, the
// dump has the output at the address of `_pid_out` in build/motor.map, lowest
// byte first. Nothing is measured, so the error is 2000 and the accumulated
// error at its limit: output is (96 * 2000 + 80 * 4000) / 16 = 32000.
#include "chip.h"
#include "fixpid_an937.h"

#define SETPOINT 2000
#define TIMER1 (0x10000 - 10000) // timer1_hi:timer1_lo

static const struct fixpid_an937_config config = {
    .kp_q4 = 96, // kp, ki and kd are the same numbers
    .ki_q4 = 80,
    .kd_q4 = 16,
    .accumulated_error_limit = 4000, // a_err_1_lim:a_err_2_lim
    .derivative_period_ticks = 4};   // the derivative counter

FIXPID_DATA struct fixpid_an937 motor;
int32_t pid_out;   // pid_out0:pid_out2 and pid_sign
uint8_t pid_stat1; // if the program looks at it
int16_t measured;

static volatile uint8_t ticks; // the interrupt counts, and only it writes here

PORT_TICK_INTERRUPT()
{
    TMR1H = TIMER1 >> 8;
    TMR1L = TIMER1 & 0xFF;
    PIR1 &= (uint8_t)~0x01u; // TMR1IF
    ticks++;
}

void measure(void) // sets `measured` of a converter
{
}

void drive(void) // gives pid_out to a bridge
{
}

void main(void)
{
    uint8_t seen = 0;

    if (!fixpid_an937_init(&motor, &config)) {
        return; // a limit or a period of 0
    }
    TMR1H = TIMER1 >> 8;
    TMR1L = TIMER1 & 0xFF;
    PIE1 = 0x01; // TMR1IE
    T1CON = 0x01;
    INTCON = 0xC0; // GIE, PEIE
    while (1) {
        if (seen != ticks) {
            seen++;
            fixpid_an937_tick(&motor);
        }
        measure();
        pid_out = fixpid_an937_step(&motor, SETPOINT - measured);
        pid_stat1 = fixpid_an937_stat1(&motor);
        drive();
    }
}
