// SPDX-License-Identifier: MIT
// A world whose plant diverges: its angle is not a number after 0.1 s.
#include <math.h>

#include "scene.h"

struct world_option scene_options[] = {
    {"seconds", 1.0, 0.0, 3600.0, "length of the scenario, s"},
};
const size_t scene_option_count =
    sizeof(scene_options) / sizeof(scene_options[0]);

const char *const scene_trace_names[] = {"angle_degrees"};
const size_t scene_trace_count =
    sizeof(scene_trace_names) / sizeof(scene_trace_names[0]);

static double angle;

void scene_start(void)
{
    angle = 0.0;
}

void scene_update(double time_s)
{
    angle = (time_s > 0.1) ? (double)NAN : 0.0;
}

void scene_advance(double drive, double seconds)
{
    (void)drive;
    (void)seconds;
}

double scene_voltage(uint8_t channel, double *noise)
{
    (void)channel;
    *noise = 0.0;
    return 0.5;
}

void scene_trace(double *values)
{
    values[0] = angle;
}
