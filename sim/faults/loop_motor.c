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
    // K is 1 count of speed for one of the drive, the slope 0.04 with a lag of
    // 25 ms, L a tick and s 0.4: 4 + 8 s is 7.2, and 2 L + 20 bands / 82 is 4.
    .guard = {.output_min = -PORT_DRIVE_FULL,
              .output_max = PORT_DRIVE_FULL,
              .reach_max = 900, // on the largest load
              .band = 8,
              .patience = 4},
    .guard_step_s = 1e-3,
};
