// SPDX-License-Identifier: MIT
// Gains that change with the level of a tank, which is a cone: what flows in
// raises it the less the fuller it is. Both gains are curves between points.
#include <math.h>
#include <stdio.h>

#include "fixpid_pid.h"
#include "fixpid_table.h"

#define GOALS 5
#define GOAL_STEPS 4000 // of 1 s
#define STEPS (GOALS * GOAL_STEPS)

// recipe
static const struct fixpid_table_point kp_points[] = {
    {0, 341}, {250, 1408}, {500, 4608}, {750, 9941}, {1000, 17408}}; // 1/2^8
static const struct fixpid_table_point ki_points[] = {
    {0, 182}, {250, 751}, {500, 2457}, {750, 5300}, {1000, 9284}}; // 1/2^14
static const struct fixpid_table kp_of = FIXPID_TABLE(kp_points);
static const struct fixpid_table ki_of = FIXPID_TABLE(ki_points);
static struct fixpid_pid pid;

// shown
static int16_t control(int16_t setpoint, int16_t level)
{
    struct fixpid_pid_gains gains = {0, 0, 0, 0};

    gains.kp_q8 = (uint16_t)fixpid_table_at(&kp_of, level);
    gains.ki_q24 = (uint32_t)fixpid_table_at(&ki_of, level) << 10;
    (void)fixpid_pid_set_gains(&pid, &gains); // the integral stays
    return fixpid_pid_step(&pid, setpoint, level);
}
// end of shown
// end of recipe

// With gains that stay.
static int16_t control_fixed(int16_t setpoint, int16_t level)
{
    return fixpid_pid_step(&pid, setpoint, level);
}

static int16_t goal_of(int k)
{
    static const int16_t goals[GOALS] = {100, 800, 200, 950, 150};

    return goals[k / GOAL_STEPS];
}

struct row {
    double level;
    int16_t valve;
};

static void run(int16_t (*step)(int16_t, int16_t), uint16_t level,
                struct row *rows)
{
    struct fixpid_pid_config config = {.output_min = 0, .output_max = 1000};
    double height = 100.0;

    config.gains.kp_q8 = (uint16_t)fixpid_table_at(&kp_of, (int16_t)level);
    config.gains.ki_q24 = (uint32_t)fixpid_table_at(&ki_of, (int16_t)level)
                          << 10;
    (void)fixpid_pid_init(&pid, &config);
    for (int k = 0; k < STEPS; k++) {
        const int16_t valve = step(goal_of(k), (int16_t)floor(height + 0.5));
        const double area = 0.4 + height * height / 50000.0;

        height += (valve / 100.0 - 0.25 * sqrt(height)) / area;
        height = fmax(height, 0.0);
        rows[k] = (struct row){height, valve};
    }
}

int main(void)
{
    static struct row with[STEPS];
    static struct row low[STEPS];
    static struct row high[STEPS];

    run(control, 100, with);
    run(control_fixed, 100, low);
    run(control_fixed, 1000, high);
    (void)printf("time_s,setpoint,value,output,low,output_low,high,"
                 "output_high\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%d,%d,%.6g,%d,%.6g,%d,%.6g,%d\n", k, (int)goal_of(k),
                     with[k].level, (int)with[k].valve, low[k].level,
                     (int)low[k].valve, high[k].level, (int)high[k].valve);
    }
    return 0;
}
