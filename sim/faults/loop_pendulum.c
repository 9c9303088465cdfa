// SPDX-License-Identifier: MIT
// The pendulum, upright, with the gains of tools/demo tuning.
#include "faults.h"
#include "port_board.h"

const struct fault_loop fault_loop = {
    .settings = {{"seconds", 3600.0},
                 {"kp", 600.0},
                 {"ki", 96.0},
                 {"kd", 400.0},
                 {"shove_at", 3600.0},
                 {"supply_fall", 0.0}},
    .value = "angle_degrees",
    .target = 0,
    .band = 2.0,
    .fallen = 20.0, // the application's ANGLE_LIMIT_COUNTS
    .start_s = 3.0,
    .spread_s = 3.0,
    .watch_s = 4.0,
    .longest_s = 1.0,
    .watchdog_s = 17e-3,
    .sensor = PORT_ANGLE,
    .inputs = {PORT_KP, PORT_KI, PORT_KD},
    .input_count = 3,
    .low = -PORT_DRIVE_FULL,
    .high = PORT_DRIVE_FULL,
};
