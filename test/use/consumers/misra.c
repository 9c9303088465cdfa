// SPDX-License-Identifier: MIT
// What an application expands in its own file, which cppcheck's addon for MISRA
// looks at.
#include "fixpid_an937.h"
#include "fixpid_pid.h"
#include "fixpid_slew.h"

bool user_init(FIXPID_DATA struct fixpid_pid *pid,
               FIXPID_DATA struct fixpid_slew *ramp);
int16_t user_step(FIXPID_DATA struct fixpid_pid *pid,
                  FIXPID_DATA struct fixpid_slew *ramp, int32_t setpoint,
                  int16_t measurement);

bool user_init(FIXPID_DATA struct fixpid_pid *pid,
               FIXPID_DATA struct fixpid_slew *ramp)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(2.0, 0.5, 0.1, 100, 2u),
        .output_max = 255,
    };
    static const struct fixpid_pid_gains other =
        FIXPID_PID_GAINS(2, 0.5, 0.1, FIXPID_PERIOD_MS(100), 2);
    struct fixpid_pid_config changed = config;

    // In C and in C++: gains that are assigned are a constant of their own.
    changed.gains = other;
    changed.gains.ki_q24 = FIXPID_PID_TI(2, 30, 10);
    changed.gains.kd_q8 = FIXPID_PID_TD(1, 3, 10, 2);
    fixpid_slew_init(ramp, FIXPID_SLEW_RATE(10, 100), FIXPID_SLEW_NO_LIMIT);
#ifdef COMPOSITE // as the macros were once
    changed.gains.ki_q24 = (uint32_t)((10 * 65536.0 / 100) + 0.5);
    changed.gains.derivative_filter = (2u >= 0) ? 2u : 0u;
#endif
    return fixpid_pid_init(pid, &changed);
}

int16_t user_step(FIXPID_DATA struct fixpid_pid *pid,
                  FIXPID_DATA struct fixpid_slew *ramp, int32_t setpoint,
                  int16_t measurement)
{
    const int16_t target = fixpid_slew_step(ramp, fixpid_sat16(setpoint));

    return fixpid_pid_step(pid, target, measurement);
}
