// SPDX-License-Identifier: MIT
// The step in a timer interrupt, everything else in the main loop. Functions of
// one controller must not interrupt each other, so the main loop masks the
// interrupt around its calls. Here the mask is a counter, and the `interrupt`
// that finds it set fails.
#include <stdio.h>
#include <stdlib.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 1000

static struct motion motion;
static int masked;

static void disable_interrupts(void)
{
    masked++;
}

static void enable_interrupts(void)
{
    masked--;
}

static int16_t measure(void)
{
    return motion_read(&motion);
}

static void drive(int16_t output)
{
    motion_move(&motion, output);
}

// recipe
static struct fixpid_pid pid;
static volatile int16_t setpoint;

// The timer's interrupt, at the controller's rate.
static void on_timer(void)
{
    drive(fixpid_pid_step(&pid, setpoint, measure()));
}

// In the main loop. A setpoint has two bytes, which an 8-bit chip writes one
// after the other: that is masked, too.
static void change_setpoint(int16_t new_setpoint)
{
    disable_interrupts();
    setpoint = new_setpoint;
    enable_interrupts();
}

// A seed keeps the output where it is: only new gains want that.
static void change_gains(const struct fixpid_pid_gains *gains)
{
    disable_interrupts();
    (void)fixpid_pid_set_gains(&pid, gains);
    fixpid_pid_seed(&pid, fixpid_pid_output(&pid));
    enable_interrupts();
}
// end of recipe

int main(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(1, 0.02, 0, 1, 0),
        .output_min = 0,
        .output_max = 255};
    static const struct fixpid_pid_gains faster =
        FIXPID_PID_GAINS(2, 0.05, 0, 1, 0);
    static const struct plant_counts process = {
        .gain = 4.0, .lag_steps = 50.0, .delay_steps = 3, .sensor_max = 1023.0};

    (void)fixpid_pid_init(&pid, &config);
    motion_start(&motion, &process);
    (void)printf("time_s,setpoint,value,output\n");
    for (int k = 0; k < STEPS; k++) {
        if (k == STEPS / 2) {
            change_gains(&faster);
        }
        change_setpoint((k < STEPS / 2) ? 600 : 700);
        if (masked != 0) {
            return EXIT_FAILURE;
        }
        on_timer();
        (void)printf("%d,%d,%.6g,%d\n", k, setpoint, motion.value,
                     fixpid_pid_output(&pid));
    }
    return 0;
}
