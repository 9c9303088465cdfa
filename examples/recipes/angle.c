// SPDX-License-Identifier: MIT
// An angle that wraps: a full turn is 65536 counts, and the shaft turns the
// short way across the end of the numbers. The same run around 4096 places of
// the circle gives the same outputs. With the angles as they are,
// fixpid_pid_step turns the wrong way round where the end lies between the two.
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 2000 // of 1 ms
#define FIRST_GOAL 400
#define SECOND_GOAL (-400)
#define ACROSS 32700 // 32768 lies between the two goals
#define PLACES 4096

// recipe
static struct fixpid_pid pid;
static uint16_t last; // the angle of the last step

static int16_t control(uint16_t setpoint, uint16_t angle)
{
    const int16_t error = (int16_t)((uint16_t)(setpoint - angle));
    const int16_t rise = (int16_t)((uint16_t)(angle - last));

    last = angle;
    return fixpid_pid_step_error(&pid, error, rise);
}
// end of recipe

static int16_t control_without(uint16_t setpoint, uint16_t angle)
{
    return fixpid_pid_step(&pid, (int16_t)setpoint, (int16_t)angle);
}

struct row {
    double value; // from the place where it starts
    int16_t output;
};

static int goal_of(int k)
{
    return (k < STEPS / 2) ? FIRST_GOAL : SECOND_GOAL;
}

static void run(int16_t (*step)(uint16_t, uint16_t), int place,
                struct row *rows)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(0.6, 0.3, 0.03, 1000, 2),
        .output_min = -1000,
        .output_max = 1000};
    static const struct plant_counts motor = {.gain = 0.08,
                                              .second_lag_steps = 40.0,
                                              .delay_steps = 1,
                                              .sensor_max = 32767.0};
    struct motion motion;

    (void)fixpid_pid_init(&pid, &config);
    motion_start(&motion, &motor);
    for (int k = 0; k < STEPS; k++) {
        const uint16_t angle = (uint16_t)(place + motion_read(&motion));
        const int16_t output = step((uint16_t)(place + goal_of(k)), angle);

        motion_move(&motion, output);
        rows[k] = (struct row){motion.value, output};
    }
}

// In how many of the places the output of each step is another one.
static void count_others(const struct row *first, int *others)
{
    static struct row rows[STEPS];

    for (int place = 0; place < PLACES; place++) {
        run(control, place * (65536 / PLACES), rows);
        for (int k = 0; k < STEPS; k++) {
            others[k] += (rows[k].output != first[k].output) ? 1 : 0;
        }
    }
}

int main(void)
{
    static struct row with[STEPS];
    static struct row without[STEPS];
    static int others[STEPS];

    run(control, ACROSS, with);
    run(control_without, ACROSS, without);
    count_others(with, others);
    (void)printf("time_s,setpoint,value,output,others,without\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%.3f,%d,%.6g,%d,%d,%.6g\n", k / 1000.0, goal_of(k),
                     with[k].value, (int)with[k].output, others[k],
                     without[k].value);
    }
    return 0;
}
