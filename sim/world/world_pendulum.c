// SPDX-License-Identifier: MIT
// The pendulum's world: released, shoved, and left on a battery that runs down
// while a hand turns the KP potentiometer up by as much.
#include <stdint.h>

#include "plant_pendulum.h"
#include "port_board.h"
#include "scene.h"

#define DEGREES_PER_RAD 57.29577951308232
#define SENSED_RANGE_DEGREES 60.0 // gain 6 on a potentiometer of 360 degrees
#define COUNTS 1024.0             // the potentiometers are set in counts
#define POTENTIOMETER_MAX 1023.0
#define NOISE_COUNTS 0.4 // standard deviation, after the filter
#define SUPPLY_FALL_START_S 10.0
#define SUPPLY_FALL_S 20.0

enum pendulum_option {
    SECONDS,
    RELEASE,
    KP,
    KI,
    KD,
    REFERENCE,
    SHOVE,
    SHOVE_AT,
    SHOVE_FOR,
    SUPPLY_FALL,
    FOLLOW_SUPPLY,
    STEP
};

struct world_option scene_options[] = {
    {"seconds", 60.0, 0.0, 3600.0, "length of the scenario, s"},
    {"release", 8.0, -90.0, 90.0, "angle of release, degrees"},
    {"kp", 0.0, 0.0, POTENTIOMETER_MAX, "KP potentiometer, counts"},
    {"ki", 0.0, 0.0, POTENTIOMETER_MAX, "KI potentiometer, counts"},
    {"kd", 0.0, 0.0, POTENTIOMETER_MAX, "KD potentiometer, counts"},
    {"reference", 0.3, -30.0, 30.0, "error of the reference, degrees"},
    {"shove", 6.0, -100.0, 100.0, "angular acceleration, rad/s2"},
    {"shove_at", 5.0, 0.0, 3600.0, "start of the shove, s"},
    {"shove_for", 0.05, 0.0, 60.0, "length of the shove, s"},
    {"supply_fall", 25.0, 0.0, 90.0, "fall of the supply from 10 to 30 s, %"},
    {"follow_supply", 1.0, 0.0, 1.0, "1: KP is turned up as the supply falls"},
    {"plant_step", 0.25e-3, 1e-6, 1e-2, "longest step of the integrator, s"},
};
const size_t scene_option_count =
    sizeof(scene_options) / sizeof(scene_options[0]);

const char *const scene_trace_names[] = {
    "angle_degrees", "base_m", "base_m_s", "supply_percent", "kp_counts",
};
const size_t scene_trace_count =
    sizeof(scene_trace_names) / sizeof(scene_trace_names[0]);

static struct pendulum pendulum_plant;

void scene_start(void)
{
    pendulum_init(&pendulum_plant,
                  scene_options[RELEASE].value / DEGREES_PER_RAD);
    pendulum_plant.longest_step_s = scene_options[STEP].value;
}

static double supply_at(double time_s)
{
    double fallen = (time_s - SUPPLY_FALL_START_S) / SUPPLY_FALL_S;
    if (fallen < 0.0) {
        fallen = 0.0;
    }
    if (fallen > 1.0) {
        fallen = 1.0;
    }
    return 1.0 - (fallen * scene_options[SUPPLY_FALL].value / 100.0);
}

void scene_update(double time_s)
{
    const double shove_s = time_s - scene_options[SHOVE_AT].value;
    // Half a millisecond, as the times are multiples of a whole one.
    const bool shoved = (shove_s > -0.5e-3) &&
                        (shove_s < (scene_options[SHOVE_FOR].value - 0.5e-3));

    pendulum_plant.supply = supply_at(time_s);
    pendulum_plant.shove_rad_s2 = shoved ? scene_options[SHOVE].value : 0.0;
}

void scene_advance(double drive, double seconds)
{
    pendulum_advance(&pendulum_plant, drive, seconds);
}

static double kp_counts(void)
{
    double counts = scene_options[KP].value;
    if (scene_options[FOLLOW_SUPPLY].value > 0.5) {
        counts /= pendulum_plant.supply;
    }
    return (counts < POTENTIOMETER_MAX) ? counts : POTENTIOMETER_MAX;
}

// Half scale is upright; trimmed well, it reads the middle of its count.
static double angle_fraction(void)
{
    const double sensed =
        pendulum_plant.state[PENDULUM_SENSED] * DEGREES_PER_RAD;
    return 0.5 + (0.5 / COUNTS) +
           ((sensed + scene_options[REFERENCE].value) / SENSED_RANGE_DEGREES);
}

// In the middle of its count, so that it reads as it was set.
static double potentiometer_fraction(double counts)
{
    return (counts + 0.5) / COUNTS;
}

double scene_voltage(uint8_t channel, double *noise)
{
    double fraction = 0.0;
    switch (channel) {
    case PORT_ANGLE:
        fraction = angle_fraction();
        *noise = NOISE_COUNTS / COUNTS;
        break;
    case PORT_KP:
        fraction = potentiometer_fraction(kp_counts());
        break;
    case PORT_KI:
        fraction = potentiometer_fraction(scene_options[KI].value);
        break;
    case PORT_KD:
        fraction = potentiometer_fraction(scene_options[KD].value);
        break;
    default:
        break;
    }
    return fraction;
}

void scene_trace(double *values)
{
    values[0] = pendulum_plant.state[PENDULUM_ANGLE] * DEGREES_PER_RAD;
    values[1] = pendulum_plant.state[PENDULUM_POSITION];
    values[2] = pendulum_plant.state[PENDULUM_SPEED];
    values[3] = pendulum_plant.supply * 100.0;
    values[4] = kp_counts();
}
