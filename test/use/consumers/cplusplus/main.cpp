// SPDX-License-Identifier: MIT
// A user's program in C++: constants of the language, and the linkage.
#include <cstdint>

#include "fixpid_an937.h"
#include "fixpid_pid.h"
#include "fixpid_table.h"

static constexpr std::uint8_t kp_q4 = FIXPID_AN937_GAIN(6.0);
static_assert(kp_q4 == 96, "6.0 x 16");
static_assert(FIXPID_PID_KI(0.5, 100) == 83886, "0.005 x 2^24");

static const fixpid_an937_config motor = {kp_q4, FIXPID_AN937_GAIN(5.0),
                                          FIXPID_AN937_GAIN(1.0), 4000, 4};
static const fixpid_pid_config valve = {
    FIXPID_PID_GAINS(2, 0, 0, 1, 0), 0, 255, 0, 0, 0, false, false, false};
static const fixpid_table_point points[] = {{0, 0}, {2, -1}};
static const fixpid_table line = FIXPID_TABLE(points);

int main()
{
    fixpid_an937 an937;
    fixpid_pid pid;

    if (!fixpid_an937_init(&an937, &motor) || !fixpid_pid_init(&pid, &valve)) {
        return 1;
    }
    fixpid_an937_tick(&an937);
    fixpid_pid_track(&pid, 0, 2); // before the first step: nothing
    return fixpid_an937_step(&an937, 240) == 2880 &&
                   fixpid_pid_step(&pid, 100, 50) == 100 &&
                   fixpid_pid_output(&pid) == 100 &&
                   fixpid_table_at(&line, 2) == -1
               ? 0
               : 1;
}
