// SPDX-License-Identifier: MIT
// The oven's world: cold at power-on, with a temperature to reach, and a person
// who turns the selector, opens the door and may choose another temperature,
// break the sensor's wire or switch off.
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "plant_oven.h"
#include "port_board.h"
#include "scene.h"

#define SENSOR_RANGE_C 256.0 // at the converter's full scale; 0 C is 0
#define COUNTS 1024.0
#define HALF_COUNT (0.5 / COUNTS)
#define NOISE_COUNTS 0.3
#define POSITIONS 4.0 // of the selector
#define HOUR_S 3600.0

enum selector { OFF, AUTOMATIC, MANUAL, LOW_POWER };

enum oven_option {
    SECONDS,
    SETPOINT,
    SETPOINT_AT,
    SETPOINT_THEN,
    AMBIENT,
    MANUAL_AT,
    MANUAL_FOR,
    LOW_POWER_AT,
    LOW_POWER_FOR,
    DOOR_AT,
    DOOR_FOR,
    DOOR_LOSS,
    WIRE_AT,
    WIRE_FOR,
    WIRE_READS,
    OFF_AT,
    OFF_FOR,
    DOWN_AT,
    DOWN_FOR,
    STEP
};

struct world_option scene_options[] = {
    {"seconds", 110.0, 0.0, HOUR_S, "length of the scenario, s"},
    {"setpoint", 80.0, 0.0, SENSOR_RANGE_C, "set temperature, C"},
    {"setpoint_at", HOUR_S, 0.0, HOUR_S, "another one is set, s"},
    {"setpoint_then", 80.0, 0.0, SENSOR_RANGE_C, "which is, C"},
    {"ambient", 20.0, 0.0, 100.0, "temperature of the air, C"},
    {"manual_at", 20.0, 0.0, HOUR_S, "selector to manual, s"},
    {"manual_for", 15.0, 0.0, HOUR_S, "until it is back, s"},
    {"low_power_at", 55.0, 0.0, HOUR_S, "selector to low power, s"},
    {"low_power_for", 15.0, 0.0, HOUR_S, "until it is back, s"},
    {"door_at", 90.0, 0.0, HOUR_S, "the door opens, s"},
    {"door_for", 5.0, 0.0, HOUR_S, "until it is shut, s"},
    {"door_loss", 2.0, 1.0, 100.0, "loss with an open door, times"},
    {"wire_at", HOUR_S, 0.0, HOUR_S, "the sensor's wire breaks, s"},
    {"wire_for", 5.0, 0.0, HOUR_S, "until it is whole, s"},
    {"wire_reads", 1.0, 0.0, 1.0, "which then reads, of full scale"},
    {"off_at", HOUR_S, 0.0, HOUR_S, "selector to off, s"},
    {"off_for", 1.0, 0.0, HOUR_S, "until it is back, s"},
    {"down_at", HOUR_S, 0.0, HOUR_S, "set temperature to 0 C, s"},
    {"down_for", 1.0, 0.0, HOUR_S, "until it is back, s"},
    {"plant_step", 1e-3, 1e-6, 1e-1, "longest step of the integrator, s"},
};
const size_t scene_option_count =
    sizeof(scene_options) / sizeof(scene_options[0]);

const char *const scene_trace_names[] = {
    "temperature_c", "setpoint_c", "ambient_c", "selector", "door_open",
};
const size_t scene_trace_count =
    sizeof(scene_trace_names) / sizeof(scene_trace_names[0]);

static struct oven oven_plant;
static double closed_k_w; // thermal resistance with the door shut
static double setpoint_c;
static enum selector selector;
static bool door_open;
static bool wire_broken;

// Half a millisecond, as the times are multiples of a whole one.
static bool within(double time_s, double start_s, double length_s)
{
    const double since_s = (time_s - start_s) + 0.5e-3;
    return (since_s > 0.0) && (since_s < length_s);
}

void scene_update(double time_s)
{
    const bool changed =
        within(time_s, scene_options[SETPOINT_AT].value, HOUR_S);
    setpoint_c = scene_options[changed ? SETPOINT_THEN : SETPOINT].value;

    selector = AUTOMATIC;
    if (within(time_s, scene_options[MANUAL_AT].value,
               scene_options[MANUAL_FOR].value)) {
        selector = MANUAL;
    }
    if (within(time_s, scene_options[LOW_POWER_AT].value,
               scene_options[LOW_POWER_FOR].value)) {
        selector = LOW_POWER;
    }
    if (within(time_s, scene_options[OFF_AT].value,
               scene_options[OFF_FOR].value)) {
        selector = OFF;
    }
    if (within(time_s, scene_options[DOWN_AT].value,
               scene_options[DOWN_FOR].value)) {
        setpoint_c = 0.0;
    }

    door_open = within(time_s, scene_options[DOOR_AT].value,
                       scene_options[DOOR_FOR].value);
    wire_broken = within(time_s, scene_options[WIRE_AT].value,
                         scene_options[WIRE_FOR].value);
    oven_plant.thermal_resistance_k_w =
        closed_k_w / (door_open ? scene_options[DOOR_LOSS].value : 1.0);
}

void scene_start(void)
{
    oven_init(&oven_plant, scene_options[AMBIENT].value);
    oven_plant.longest_step_s = scene_options[STEP].value;
    closed_k_w = oven_plant.thermal_resistance_k_w;
    scene_update(0.0);
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
        fraction = (setpoint_c / SENSOR_RANGE_C) + HALF_COUNT;
        break;
    case PORT_SELECTOR:
        fraction = ((double)selector + 0.5) / POSITIONS;
        break;
    case PORT_TEMPERATURE:
        fraction = (oven_plant.state[OVEN_BODY] / SENSOR_RANGE_C) + HALF_COUNT;
        *noise = NOISE_COUNTS / COUNTS;
        if (wire_broken) {
            fraction = fmin(scene_options[WIRE_READS].value, 1.0 - HALF_COUNT);
            *noise = 0.0;
        }
        break;
    default:
        break;
    }
    return fraction;
}

void scene_trace(double *values)
{
    values[0] = oven_plant.state[OVEN_BODY];
    values[1] = setpoint_c;
    values[2] = scene_options[AMBIENT].value;
    values[3] = (double)selector;
    values[4] = door_open ? 1.0 : 0.0;
}
