// SPDX-License-Identifier: MIT
// Gains from a menu, in thousandths, kept in an EEPROM. What was stored is
// checked when the controller starts; without it, it starts with what is safe.
#include <stdio.h>

#include "fixpid_gains.h"
#include "fixpid_pid.h"
#include "fixpid_record.h"
#include "plant_counts.h"

#define STEPS 2000

// recipe
#define RATE_MILLI 10000u // 10 steps a second

static struct fixpid_pid pid;
static struct fixpid_record eeprom; // all 0: never written

static struct fixpid_pid_config safe = {
    .gains = FIXPID_PID_GAINS(0.5, 0.05, 0, 10, 0),
    .output_min = 0,
    .output_max = 255};

// At power-on. False: nothing good was stored.
static bool start(void)
{
    struct fixpid_pid_config stored;

    if (fixpid_record_unpack(&eeprom, &stored)) {
        if (fixpid_pid_init(&pid, &stored)) {
            return true;
        }
    }
    (void)fixpid_pid_init(&pid, &safe);
    return false;
}

// shown
// When somebody has typed new gains. False: they do not fit, nothing changed.
static bool take(uint32_t kp_milli, uint32_t ki_milli, uint32_t kd_milli)
{
    const struct fixpid_gains_milli typed = {kp_milli, ki_milli, kd_milli};
    struct fixpid_pid_config config = safe;

    if (!fixpid_gains_from_milli(&config.gains, &typed, RATE_MILLI, 2)) {
        return false;
    }
    (void)fixpid_pid_set_gains(&pid, &config.gains);
    fixpid_pid_seed(&pid, fixpid_pid_output(&pid));
    fixpid_record_pack(&eeprom, &config);
    return true;
}
// end of shown
// end of recipe

static void settle(struct motion *motion, const char *what, bool good)
{
    int settled = 0;

    motion_start(motion, motion->plant);
    for (int k = 0; k < STEPS; k++) {
        motion_move(motion, fixpid_pid_step(&pid, 600, motion_read(motion)));
        if (motion->value < 588.0 || motion->value > 612.0) {
            settled = k + 1;
        }
    }
    (void)printf("%s;%d;%d\n", what, good ? 1 : 0, settled);
}

int main(void)
{
    static const struct plant_counts process = {
        .gain = 4.0, .lag_steps = 50.0, .delay_steps = 3, .sensor_max = 1023.0};
    struct motion motion = {.plant = &process};
    bool good = start();

    (void)printf("what;good;settled\n");
    settle(&motion, "an empty EEPROM", good);
    good = take(200000, 0, 0);
    settle(&motion, "kp of 200 typed", good);
    good = take(1800, 600, 0);
    settle(&motion, "kp of 1.8 and ki of 0.6 typed", good);
    good = start();
    settle(&motion, "after a reset", good);
    eeprom.bytes[3] ^= 0x10u;
    good = start();
    settle(&motion, "after a reset with a bit of the EEPROM lost", good);
    return 0;
}
