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
#else
    .inputs = {PORT_SETPOINT},
    .input_count = 1,
#endif
    .low = 0,
    .high = PORT_DRIVE_FULL,
};
