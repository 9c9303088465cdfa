// SPDX-License-Identifier: MIT
// What an application expands in its own file, for a compiler that warns of old
// and of useless casts.
#include "fixpid_an937.h"
#include "fixpid_pid.h"
#include "fixpid_slew.h"

extern const uint8_t gain;
const uint8_t gain = FIXPID_AN937_GAIN(6.0);

extern const fixpid_pid_config by_rate;
const fixpid_pid_config by_rate = {FIXPID_PID_GAINS(2.0, 0.5, 0.1, 100, 2u),
                                   0,
                                   255,
                                   0,
                                   0,
                                   0,
                                   false,
                                   false,
                                   false};

extern const fixpid_pid_gains by_period;
const fixpid_pid_gains by_period =
    FIXPID_PID_GAINS(2, 0.5f, 0.1, FIXPID_PERIOD_MS(100), 1);

extern const fixpid_pid_gains standard;
const fixpid_pid_gains standard = {FIXPID_PID_KP(1), FIXPID_PID_TI(2, 30, 10),
                                   FIXPID_PID_TD(1.5, 3, 100, 4), 4};

extern const uint32_t rates[3];
const uint32_t rates[3] = {FIXPID_SLEW_RATE(10, 100),
                           FIXPID_SLEW_RATE(2.5, FIXPID_PERIOD_MS(20)),
                           FIXPID_SLEW_NO_LIMIT};

int16_t stepped(fixpid_pid *pid, int32_t setpoint, int measured);

int16_t stepped(fixpid_pid *pid, int32_t setpoint, int measured)
{
    // In C++ and in C: gains that are assigned are a constant of their own.
    static const fixpid_pid_gains gains = FIXPID_PID_GAINS(2, 0, 0, 10, 0);
    fixpid_pid_config config = by_rate;

    config.gains = gains;
    if (!fixpid_pid_init(pid, &config) || !fixpid_pid_set_gains(pid, &gains)) {
        return 0;
    }
#ifdef OLD_CAST
    measured = (int)measured;
#endif
    return fixpid_pid_step(pid, fixpid_sat16(setpoint), fixpid_sat16(measured));
}
