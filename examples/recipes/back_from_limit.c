// SPDX-License-Identifier: MIT
// Back from a limit: while the output is limited and the error pushes it
// further, the integral drifts to the limit, where a long saturation brings the
// actuator to rest. Four rules in ten scenarios.
//
// On an ATmega328P at -O2, with no other feature than tracking, a step with the
// recipe took 358 cycles, and 528 at most where the output was limited; the
// step alone, without tracking, took 222 to 244. Flash grew by 506 bytes.
// (Measured once, in simavr by the meter of tools/cost.)
#include <math.h>
#include <stdio.h>

#include "fixpid_pid.h"
#include "plant_counts.h"

#define STEPS 3000
#define EVENT 1500 // from here on the loop is judged
#define FULL 255

// recipe
static struct fixpid_pid pid;
static uint8_t shift = 6; // 2^6 is the next above Ti, 40 steps

static int16_t saturated(int32_t value)
{
    const int32_t high = (value < INT16_MAX) ? value : INT16_MAX;

    return (int16_t)((high > INT16_MIN) ? high : INT16_MIN);
}

// shown
static int16_t control(int16_t setpoint, int16_t measurement)
{
    const int16_t output = fixpid_pid_step(&pid, setpoint, measurement);
    const uint8_t flags = fixpid_pid_flags(&pid);
    const uint32_t integral_q16 = (uint32_t)fixpid_pid_integral(&pid);
    const int32_t room = (int32_t)output - (int16_t)(integral_q16 >> 16);
    const bool up =
        (flags & FIXPID_PID_AT_MAX) != 0u && setpoint > measurement && room > 0;
    const bool down =
        (flags & FIXPID_PID_AT_MIN) != 0u && setpoint < measurement && room < 0;

    if (up || down) { // the integral moves by room / 2^shift
        fixpid_pid_track(&pid, saturated(output + room), shift);
    }
    return output;
}
// end of shown
// end of recipe

enum rule { HELD, DRIFT, SLOW, CLAMPED, RULES };

// What a loop goes through until the event, and the setpoint from then on.
struct scenario {
    const char *name;
    const struct plant_counts *plant;
    double kp;
    double ki;
    int16_t output_min;
    uint8_t shift;
    int16_t before;  // setpoint
    int from;        // step, from which there is
    int16_t limited; // this setpoint
    double load;     // and this load, in counts of the output
    int16_t after;   // setpoint
};

static const struct plant_counts lag = {
    .gain = 4.0, .lag_steps = 50.0, .delay_steps = 3, .sensor_max = 1023.0};
static const struct plant_counts integrator = {
    .gain = 0.03, .delay_steps = 4, .sensor_max = 1023.0};

#define LAG &lag, 2.0, 0.05, 0, 6
#define INTEGRATOR &integrator, 0.9, 0.006, -FULL, 8
static const struct scenario scenarios[] = {
    {"step", LAG, 0, EVENT, 0, 0.0, 700},
    {"back_300", LAG, 700, 500, 1100, 0.0, 300},
    {"back_700", LAG, 700, 500, 1100, 0.0, 700},
    {"back_900", LAG, 700, 500, 1100, 0.0, 900},
    {"back_1000", LAG, 700, 500, 1100, 0.0, 1000},
    {"short", LAG, 300, EVENT - 20, 1100, 0.0, 500},
    {"load", LAG, 700, 500, 700, -150.0, 700},
    {"integrator", INTEGRATOR, 0, EVENT, 0, 0.0, 700},
    {"at_1000", INTEGRATOR, 0, 500, 1000, 0.0, 600},
    {"at_1023", INTEGRATOR, 0, 500, 1023, 0.0, 600},
};
#define SCENARIOS (sizeof(scenarios) / sizeof(scenarios[0]))

static double limited(double value, double low)
{
    return fmin(fmax(value, low), FULL);
}

// The rule of many libraries: the integral stays within the output's range.
static int16_t control_clamped(const struct scenario *scenario,
                               double *integral, int error)
{
    *integral = limited(*integral + scenario->ki * error, scenario->output_min);
    return (int16_t)limited(floor(scenario->kp * error + *integral + 0.5),
                            scenario->output_min);
}

static void start(const struct scenario *scenario, enum rule rule)
{
    const struct fixpid_pid_config config = {
        .gains = {.kp_q8 = (uint16_t)lround(scenario->kp * 256.0),
                  .ki_q24 = (uint32_t)lround(scenario->ki * 16777216.0)},
        .output_min = scenario->output_min,
        .output_max = FULL};

    (void)fixpid_pid_init(&pid, &config);
    shift = (uint8_t)(scenario->shift + ((rule == SLOW) ? 1u : 0u));
}

static void run(const struct scenario *scenario, enum rule rule, double *value)
{
    struct motion motion;
    double integral = 0.0;

    start(scenario, rule);
    motion_start(&motion, scenario->plant);
    for (int k = 0; k < STEPS; k++) {
        const bool at_limit = k >= scenario->from && k < EVENT;
        const int16_t setpoint =
            at_limit ? scenario->limited
                     : ((k < EVENT) ? scenario->before : scenario->after);
        const int16_t measurement = motion_read(&motion);
        int16_t output;

        if (rule == CLAMPED) {
            output =
                control_clamped(scenario, &integral, setpoint - measurement);
        } else if (rule == HELD) {
            output = fixpid_pid_step(&pid, setpoint, measurement);
        } else {
            output = control(setpoint, measurement);
        }
        motion_move(&motion, output + (at_limit ? scenario->load : 0.0));
        value[k] = motion.value;
    }
}

int main(void)
{
    static const char *const names[RULES] = {"held", "drift", "slow",
                                             "clamped"};
    static double values[SCENARIOS][RULES][STEPS];

    (void)printf("time_s");
    for (size_t i = 0; i < SCENARIOS; i++) {
        for (int rule = 0; rule < RULES; rule++) {
            run(&scenarios[i], (enum rule)rule, values[i][rule]);
            (void)printf(",%s_%s", scenarios[i].name, names[rule]);
        }
    }
    for (int k = 0; k < STEPS; k++) {
        (void)printf("\n%d", k);
        for (size_t i = 0; i < SCENARIOS; i++) {
            for (int rule = 0; rule < RULES; rule++) {
                (void)printf(",%.6g", values[i][rule][k]);
            }
        }
    }
    (void)printf("\n");
    return 0;
}
