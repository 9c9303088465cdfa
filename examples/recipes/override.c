// SPDX-License-Identifier: MIT
// Override: the lower of two controllers drives one valve. One holds the flow,
// the other takes over before the pressure is too high. Both go on knowing what
// the valve does.
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 4000
#define CLOGGED_FROM 1000
#define CLOGGED_TO 2500

// recipe
#define FLOW 600
#define PRESSURE_MAX 700

static struct fixpid_pid flow_control;
static struct fixpid_pid pressure_limiter;

static int16_t control(int16_t flow, int16_t pressure)
{
    const int16_t wanted = fixpid_pid_step(&flow_control, FLOW, flow);
    const int16_t allowed =
        fixpid_pid_step(&pressure_limiter, PRESSURE_MAX, pressure);
    const int16_t valve = (wanted < allowed) ? wanted : allowed;

    fixpid_pid_track(&flow_control, valve, 5);     // Ti is 40 steps
    fixpid_pid_track(&pressure_limiter, valve, 2); // it protects: sooner
    return valve;
}
// end of recipe

static int16_t control_without(int16_t flow, int16_t pressure)
{
    const int16_t wanted = fixpid_pid_step(&flow_control, FLOW, flow);
    const int16_t allowed =
        fixpid_pid_step(&pressure_limiter, PRESSURE_MAX, pressure);

    return (wanted < allowed) ? wanted : allowed;
}

static void start(void)
{
    static const struct fixpid_pid_config flow = {
        .gains = FIXPID_PID_GAINS(0.5, 0.0125, 0, 1, 0),
        .output_min = 0,
        .output_max = 1000};
    static const struct fixpid_pid_config pressure = {
        .gains = FIXPID_PID_GAINS(1, 0.0166667, 0, 1, 0),
        .output_min = 0,
        .output_max = 1000};

    (void)fixpid_pid_init(&flow_control, &flow);
    (void)fixpid_pid_init(&pressure_limiter, &pressure);
}

struct found {
    double flow[STEPS];
    double pressure[STEPS];
};

static void run(int16_t (*step)(int16_t, int16_t), struct found *found)
{
    static const struct plant_counts pipe = {.gain = 1.0,
                                             .lag_steps = 30.0,
                                             .delay_steps = 1,
                                             .noise_counts = 3,
                                             .sensor_max = 4095.0};
    struct plant_counts filter = {.lag_steps = 50.0,
                                  .delay_steps = 1,
                                  .noise_counts = 3,
                                  .sensor_max = 4095.0};
    struct motion flow;
    struct motion pressure;

    start();
    motion_start(&flow, &pipe);
    motion_start(&pressure, &filter);
    for (int k = 0; k < STEPS; k++) {
        const int16_t valve = step(motion_read(&flow), motion_read(&pressure));
        // the pressure that a flow makes, with the filter clogged for a while
        filter.gain = (k >= CLOGGED_FROM && k < CLOGGED_TO) ? 1.6 : 0.8;
        motion_move(&flow, valve);
        motion_move(&pressure, valve);
        found->flow[k] = flow.value;
        found->pressure[k] = pressure.value;
    }
}

int main(void)
{
    static struct found with;
    static struct found without;

    run(control, &with);
    run(control_without, &without);
    (void)printf("time_s,flow,pressure,flow_without,pressure_without\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%d,%.6g,%.6g,%.6g,%.6g\n", k, with.flow[k],
                     with.pressure[k], without.flow[k], without.pressure[k]);
    }
    return 0;
}
