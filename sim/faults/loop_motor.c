// SPDX-License-Identifier: MIT
// The motor at its speed, before and after its gains change, without a load.
#include "faults.h"
#include "port_board.h"

const struct fault_loop fault_loop = {
    .settings = {{"seconds", 3600.0}, {"load", 0.0}},
    .value = "speed_rad_s",
    .target = "setpoint_rad_s",
    .band = 18.0, // 5 % of the set speed
    .start_s = 0.25,
    .spread_s = 0.35,
    .watch_s = 1.0,
    .longest_s = 0.2,
    .watchdog_s = 32e-3,
    .sensor = PORT_TACHOMETER,
    .inputs = {PORT_SETPOINT},
    .input_count = 1,
    .low = -PORT_DRIVE_FULL,
    .high = PORT_DRIVE_FULL,
};
