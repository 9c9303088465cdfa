// SPDX-License-Identifier: MIT
// The motor's world: a set speed at power-on, later a load on the shaft, later
// off again.
#include <stdint.h>

#include "plant_motor.h"
#include "port_board.h"
#include "scene.h"

#define TACHOMETER_RANGE_RAD_S 480.0 // at the converter's full scale
#define COUNTS 1024.0
#define HALF_COUNT (0.5 / COUNTS)
#define NOISE_COUNTS 0.3

enum motor_option { SECONDS, SETPOINT, LOAD, LOAD_AT, LOAD_FOR, STEP };

struct world_option scene_options[] = {
    {"seconds", 1.2, 0.0, 3600.0, "length of the scenario, s"},
    {"setpoint", 360.0, 0.0, TACHOMETER_RANGE_RAD_S, "set speed, rad/s"},
    {"load", 0.08, -1.0, 1.0, "load torque, N m"},
    {"load_at", 0.7, 0.0, 3600.0, "start of the load, s"},
    {"load_for", 0.25, 0.0, 3600.0, "length of the load, s"},
    {"plant_step", 20e-6, 1e-6, 1e-3, "longest step of the integrator, s"},
};
const size_t scene_option_count =
    sizeof(scene_options) / sizeof(scene_options[0]);

const char *const scene_trace_names[] = {
    "speed_rad_s",
    "setpoint_rad_s",
    "current_a",
    "load_n_m",
};
const size_t scene_trace_count =
    sizeof(scene_trace_names) / sizeof(scene_trace_names[0]);

static struct motor motor_plant;

void scene_start(void)
{
    motor_init(&motor_plant);
    motor_plant.longest_step_s = scene_options[STEP].value;
}

void scene_update(double time_s)
{
    const double loaded_s = time_s - scene_options[LOAD_AT].value;
    // Half a millisecond, as the times are multiples of a whole one.
    const bool loaded = (loaded_s > -0.5e-3) &&
                        (loaded_s < (scene_options[LOAD_FOR].value - 0.5e-3));
    motor_plant.load_n_m = loaded ? scene_options[LOAD].value : 0.0;
}

void scene_advance(double drive, double seconds)
{
    motor_advance(&motor_plant, drive, seconds);
}

double scene_voltage(uint8_t channel, double *noise)
{
    double fraction = 0.0;
    switch (channel) {
    case PORT_SETPOINT:
        // In the middle of its count, so that it reads as it was set.
        fraction = (scene_options[SETPOINT].value / TACHOMETER_RANGE_RAD_S) +
                   HALF_COUNT;
        break;
    case PORT_TACHOMETER:
        fraction = (motor_plant.state[MOTOR_SPEED] / TACHOMETER_RANGE_RAD_S) +
                   HALF_COUNT;
        *noise = NOISE_COUNTS / COUNTS;
        break;
    default:
        break;
    }
    return fraction;
}

void scene_trace(double *values)
{
    values[0] = motor_plant.state[MOTOR_SPEED];
    values[1] = scene_options[SETPOINT].value;
    values[2] = motor_plant.state[MOTOR_CURRENT];
    values[3] = motor_plant.load_n_m;
}
