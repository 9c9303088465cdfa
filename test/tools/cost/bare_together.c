// SPDX-License-Identifier: MIT
// A firmware with controller, guard and one table, for its size.
#include <stdbool.h>
#include <stdint.h>

#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "fixpid_table.h"

#define FULL 1023
#define SETPOINT 600 // 60.0 C

volatile uint16_t together_reading;
volatile int16_t together_duty;

static const struct fixpid_table_point points[] = {
    {60, 1200}, {120, 950}, {220, 740}, {360, 570},
    {520, 420}, {690, 270}, {850, 100}, {960, -100},
};

int main(void)
{
    static const struct fixpid_table curve = FIXPID_TABLE(points);
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(2, 0.5, 2, 10, 0), .output_max = FULL};
    static const struct fixpid_guard_config guarded = {.output_max = FULL,
                                                       .measurement_min = -90,
                                                       .measurement_max = 1190,
                                                       .band = 10,
                                                       .patience = 60};
    static struct fixpid_pid pid;
    static struct fixpid_guard guard;
    bool off = !fixpid_pid_init(&pid, &config);

    off = !fixpid_guard_init(&guard, &guarded) || off;
    for (;;) {
        const int16_t y = fixpid_table_at(&curve, (int16_t)together_reading);
        const int16_t duty = fixpid_pid_step(&pid, SETPOINT, y);
        const uint8_t flags = fixpid_guard_step(&guard, SETPOINT, y, duty);

        off = ((flags & FIXPID_GUARD_ALARMS) != 0u) || off;
        together_duty = off ? 0 : duty;
    }
}
