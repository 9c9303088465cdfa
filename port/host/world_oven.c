// SPDX-License-Identifier: MIT
// The oven's world: cold at power-on, with a temperature to reach.
#include <stdint.h>

#include "plant_oven.h"
#include "port_board.h"
#include "scene.h"

#define SENSOR_RANGE_C 256.0 // at the converter's full scale; 0 C is 0
#define COUNTS 1024.0
#define HALF_COUNT (0.5 / COUNTS)
#define NOISE_COUNTS 0.3

enum oven_option { SECONDS, SETPOINT, AMBIENT, STEP };

struct world_option scene_options[] = {
    {"seconds", 30.0, 0.0, 3600.0, "length of the scenario, s"},
    {"setpoint", 80.0, 0.0, SENSOR_RANGE_C, "set temperature, C"},
    {"ambient", 20.0, 0.0, 100.0, "temperature of the air, C"},
    {"plant_step", 1e-3, 1e-6, 1e-1, "longest step of the integrator, s"},
};
const size_t scene_option_count =
    sizeof(scene_options) / sizeof(scene_options[0]);

const char *const scene_trace_names[] = {
    "temperature_c",
    "setpoint_c",
    "ambient_c",
};
const size_t scene_trace_count =
    sizeof(scene_trace_names) / sizeof(scene_trace_names[0]);

static struct oven oven_plant;

void scene_start(void)
{
    oven_init(&oven_plant, scene_options[AMBIENT].value);
    oven_plant.longest_step_s = scene_options[STEP].value;
}

void scene_update(double time_s)
{
    (void)time_s; // nothing happens to it
}

void scene_advance(double drive, double seconds)
{
    oven_advance(&oven_plant, drive, seconds);
}

double scene_voltage(uint8_t channel, double *noise)
{
    double fraction = 0.0;
    switch (channel) {
    case PORT_SETPOINT:
        // In the middle of its count, so that it reads as it was set.
        fraction =
            (scene_options[SETPOINT].value / SENSOR_RANGE_C) + HALF_COUNT;
        break;
    case PORT_TEMPERATURE:
        fraction = (oven_plant.state[OVEN_BODY] / SENSOR_RANGE_C) + HALF_COUNT;
        *noise = NOISE_COUNTS / COUNTS;
        break;
    default:
        break;
    }
    return fraction;
}

void scene_trace(double *values)
{
    values[0] = oven_plant.state[OVEN_BODY];
    values[1] = scene_options[SETPOINT].value;
    values[2] = scene_options[AMBIENT].value;
}
