// SPDX-License-Identifier: MIT
// What the oven and the motor do with an alarm.
#ifndef TURNED_DOWN_H
#define TURNED_DOWN_H
#include <stdbool.h>
#include <stdint.h>

#include "alarm.h"

// A setpoint of so few counts is turned to its lower end.
#define TURNED_DOWN 8

// Whether an alarm keeps the drive off. A person acknowledges it by turning the
// setpoint to its lower end and up again, so that the drive does not begin
// while a hand is still on its way. The boards have no lamp: the drive that
// stays off is what tells, and fixpid_guard_flags what it was.
static bool is_off(int16_t setpoint)
{
    static bool turned_down = false;

    if ((fixpid_guard_flags(&guard) & ALARMS) == 0u) {
        turned_down = false;
    } else if (setpoint <= TURNED_DOWN) {
        turned_down = true;
    } else if (turned_down) {
        fixpid_guard_acknowledge(&guard);
    } else {
        // Nobody has been there yet.
    }
    return (fixpid_guard_flags(&guard) & ALARMS) != 0u;
}

#endif
