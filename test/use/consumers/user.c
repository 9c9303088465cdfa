// SPDX-License-Identifier: MIT
// What an application expands in a file of its own, with its own warnings: each
// public macro, and what headers define, in C and in C++.
#include "fixpid_an937.h"
#include "fixpid_pid.h"
#include "fixpid_slew.h"
#include "fixpid_table.h"

extern const struct fixpid_an937_config motor;
const struct fixpid_an937_config motor = {FIXPID_AN937_GAIN(6.0),
                                          FIXPID_AN937_GAIN(5),
                                          FIXPID_AN937_GAIN(0.0), 4000u, 4u};

extern const struct fixpid_pid_gains by_period;
const struct fixpid_pid_gains by_period =
    FIXPID_PID_GAINS(2, 0.5f, 0, FIXPID_PERIOD_MS(100), 1);

extern const struct fixpid_pid_gains standard;
const struct fixpid_pid_gains standard = {FIXPID_PID_KP(1),
                                          FIXPID_PID_TI(2, 30, 10),
                                          FIXPID_PID_TD(1.5, 3, 100, 4), 4u};

extern const uint32_t rates[4];
const uint32_t rates[4] = {FIXPID_SLEW_RATE(10, 100), FIXPID_SLEW_RATE(0, 1),
                           FIXPID_SLEW_RATE(2.5, FIXPID_PERIOD_MS(20)),
                           FIXPID_SLEW_NO_LIMIT};

static const struct fixpid_table_point points[] = {{0, 0}, {2, -1}};
extern const struct fixpid_table line;
const struct fixpid_table line = FIXPID_TABLE(points);

bool user_init(FIXPID_DATA struct fixpid_pid *pid,
               FIXPID_DATA struct fixpid_slew *ramp);
int16_t user_step(FIXPID_DATA struct fixpid_pid *pid,
                  FIXPID_DATA struct fixpid_slew *ramp, int32_t setpoint,
                  int16_t measurement);

bool user_init(FIXPID_DATA struct fixpid_pid *pid,
               FIXPID_DATA struct fixpid_slew *ramp)
{
    static const struct fixpid_pid_config by_rate = {
        FIXPID_PID_GAINS(2.0, 0.5, 0.1, 100, 2u),
        0,
        255,
        0,
        0,
        0u,
        false,
        false,
        false};
    // Gains that are assigned are a constant of their own.
    static const struct fixpid_pid_gains gains =
        FIXPID_PID_GAINS(2, 0.5, 0.1, FIXPID_PERIOD_MS(100), 2);
    struct fixpid_pid_config changed = by_rate;

    changed.gains = gains;
    changed.gains.ki_q24 = FIXPID_PID_KI(0.5, 100);
    changed.gains.kd_q8 = FIXPID_PID_KD(0.1, 100, 2);
    fixpid_slew_init(ramp, FIXPID_SLEW_RATE(10, 100), FIXPID_SLEW_NO_LIMIT);
#ifdef ONCE // as the macros were once
    changed.gains.ki_q24 = (uint32_t)((10 * 65536.0 / 100) + 0.5);
    changed.gains.derivative_filter = (2u >= 0) ? 2u : 0u;
    changed.reverse = (FIXPID_REAL(2) == 0.0);
    changed.output_max = (int16_t)changed.output_max;
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
