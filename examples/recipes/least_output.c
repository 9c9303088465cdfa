// SPDX-License-Identifier: MIT
// The least output that still turns the fan: below a fifth of full speed it
// stands. A heat sink is held at 50 degrees, first with a heat for which the
// slowest fan is too much, then with one for which it runs fast. Told by track
// that it got nothing, the controller never starts the fan.
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 20000 // of 1 s
#define LOADED_AT 10000
#define SETPOINT 500

// recipe
#define LEAST 200 // of 1000: below it the fan stands
#define START 140
#define STOP 60

static struct fixpid_pid pid; // reverse: more fan, less heat
static bool runs;

// shown
static int16_t fan(int16_t setpoint, int16_t measurement)
{
    const int16_t wanted = fixpid_pid_step(&pid, setpoint, measurement);

    // The two borders are so far apart that noise does not start it.
    runs = wanted >= (runs ? STOP : START);
    if (!runs) {
        return 0; // and the controller is not told
    }
    return (wanted < LEAST) ? LEAST : wanted;
}
// end of shown
// end of recipe

static int16_t fan_tracked(int16_t setpoint, int16_t measurement)
{
    const int16_t got = fan(setpoint, measurement);

    fixpid_pid_track(&pid, got, 0);
    return got;
}

struct row {
    double value;
    int16_t output;
};

static void run(int16_t (*step)(int16_t, int16_t), struct row *rows)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(5, 0.1, 0, 1, 0),
        .output_min = 0,
        .output_max = 1000,
        .reverse = true};
    struct plant_counts sink = {.gain = 1.0,
                                .lag_steps = 120.0,
                                .delay_steps = 1,
                                .noise_counts = 1,
                                .sensor_max = 4095.0};
    struct motion motion;

    (void)fixpid_pid_init(&pid, &config);
    runs = false;
    motion_start(&motion, &sink);
    motion.value = 400.0;
    for (int k = 0; k < STEPS; k++) {
        const double watts = (k < LOADED_AT) ? 25.0 : 80.0;
        const int16_t output = step(SETPOINT, motion_read(&motion));
        const double speed = (output < LEAST) ? 0.0 : output / 1000.0;

        // the more air, the less it warms and the sooner
        sink.lag_steps = 120.0 / (1.0 + 3.0 * speed);
        motion_move(&motion, 250.0 + 10.0 * watts / (0.5 + 4.5 * speed));
        rows[k] = (struct row){motion.value, output};
    }
}

int main(void)
{
    static struct row with[STEPS];
    static struct row tracked[STEPS];

    run(fan, with);
    run(fan_tracked, tracked);
    (void)printf("time_s,setpoint,value,output,tracked,output_tracked\n");
    for (int k = 0; k < STEPS; k++) {
        (void)printf("%d,%.1f,%.6g,%d,%.6g,%d\n", k, SETPOINT / 10.0,
                     with[k].value / 10.0, (int)with[k].output,
                     tracked[k].value / 10.0, (int)tracked[k].output);
    }
    return 0;
}
