// SPDX-License-Identifier: MIT
// An oven at its temperature, the selector at automatic.
#include "faults.h"
#include "port_board.h"

const struct fault_loop fault_loop = {
    .settings = {{"seconds", 3600.0},
                 {"manual_at", 3600.0},
                 {"low_power_at", 3600.0},
                 {"door_at", 3600.0},
                 {"plant_step", 5e-3}},
    .value = "temperature_c",
    .target = "setpoint_c",
    .band = 2.0,
    .start_s = 30.0,
    .spread_s = 2.0,
    .watch_s = 80.0,
    .longest_s = 4.0,
    .watchdog_s = 32e-3,
    .sensor = PORT_TEMPERATURE,
#ifdef FAULTS_SELECTOR
    .inputs = {PORT_SETPOINT, PORT_SELECTOR},
    .input_count = 2,
#define PATIENCE 33 // steps of the thermostat, 100 ms
#else
    .inputs = {PORT_SETPOINT},
    .input_count = 1,
#define PATIENCE 3300 // of the oven, 1 ms
#endif
    .low = 0,
    .high = PORT_DRIVE_FULL,
    // Full power raises 400 C, so that K is 1.6 counts, of which a degree has
    // 4, for one of the drive. The slope is 0.26 in a second, L 0.35 s and the
    // second of the element, s 0.4: 4 + 8 s is 7.2, and 2 L + 20 bands / 267 is
    // 3.3 s. A broken wire reads at most 8 or at least 1015.
    .guard = {.output_max = PORT_DRIVE_FULL,
              .measurement_min = 9,
              .measurement_max = 1014,
              .reach_min = 40 * 4,
              .reach_max = 1014,
              .band = 8,
              .patience = PATIENCE},
    .guard_step_s = 3.3 / PATIENCE,
};
