// SPDX-License-Identifier: MIT
// What happens to a loop that is whole.
#include "guarded.h"

#include <math.h>

#define AT_ONCE 1e9 // counts in a step

static bool integrates(const struct guarded *self)
{
    return self->task.plant.integrating;
}

// The output that a setpoint needs with a load.
static double needs(const struct guarded *self, double goal, double load)
{
    if (integrates(self)) {
        return self->task.drift + load;
    }
    return (goal - self->task.zero) / self->gain + load;
}

// True if 5 to 92 % of what the supply gives is enough, with the load that is
// and with the one that comes.
static bool reachable(const struct guarded *self, double goal)
{
    const double whole = self->supply * self->span;
    const double now = needs(self, goal, self->load) / whole;
    const double then = needs(self, goal, self->load_to) / whole;

    return fmin(now, then) >= 0.05 && fmax(now, then) <= 0.92;
}

// True if a sudden change of the load leaves the reading on the scale.
static bool fits(const struct guarded *self, double load)
{
    const double swing = integrates(self)
                             ? fabs(load) * self->slope * 6.0 * self->dead
                             : 1.3 * fabs(load) * self->gain;

    return self->ramp_to + swing < 0.96 * self->top &&
           self->ramp_to - swing > 0.04 * self->top;
}

static bool is_unloaded(const struct guarded *self)
{
    return self->load == 0.0 && self->load_to == 0.0;
}

static double some_goal(struct guarded *self)
{
    if (integrates(self)) {
        return guarded_between(self, 0.2, 0.65) * self->top;
    }
    return self->task.zero +
           guarded_between(self, 0.06, 0.735) * self->gain * self->span;
}

static void move_goal(struct guarded *self, double rate)
{
    double goal = some_goal(self);

    for (int tries = 1; !reachable(self, goal) && tries < 100; tries++) {
        goal = some_goal(self);
    }
    if (reachable(self, goal)) {
        self->ramp_to = goal;
        self->ramp_rate = rate;
    }
}

static long for_scales(struct guarded *self, double least, double most)
{
    return self->now + 2 +
           (long)(guarded_between(self, least, most) * guarded_scale(self));
}

// A door that opens, or a load for long; each at once or slowly.
static void change_load(struct guarded *self)
{
    const double scale = guarded_scale(self);
    bool door;
    bool slow;

    if (!is_unloaded(self)) {
        return;
    }
    door = guarded_chance(self) < 0.5;
    slow = guarded_chance(self) < 0.3;
    self->load_to = self->span * (door ? guarded_between(self, 0.2, 0.5)
                                       : guarded_between(self, -0.3, 0.3));
    self->load_rate =
        slow ? self->span / scale / guarded_between(self, 2.0, 300.0) : AT_ONCE;
    self->load_until = for_scales(self, 0.3, door ? 6.0 : 20.0);
    if (!reachable(self, self->ramp_to) || !fits(self, self->load_to)) {
        self->load_to = 0.0;
    }
}

static void lower_supply(struct guarded *self)
{
    self->supply = 0.8;
    self->supply_until = for_scales(self, 0.5, 12.0);
    if (!reachable(self, self->ramp_to)) {
        self->supply = 1.0;
    }
}

// Off and on, or full and back, by setpoints that are out of reach.
static void switch_off(struct guarded *self)
{
    if (!is_unloaded(self) || self->supply != 1.0) {
        return;
    }
    self->goal_after_off = self->ramp_to;
    self->off_until = for_scales(self, 0.5, 12.0);
    self->ramp_to = guarded_chance(self) < 0.7 || integrates(self)
                        ? self->task.zero
                        : self->top;
    self->ramp_rate = AT_ONCE;
}

static void take_by_hand(struct guarded *self)
{
    if (integrates(self) || !is_unloaded(self)) {
        return;
    }
    self->hand_until = for_scales(self, 0.5, 8.0);
    fixpid_pid_set_manual(
        &self->pid, (int16_t)(guarded_between(self, 0.1, 0.8) * self->span));
}

static void begin(struct guarded *self)
{
    switch ((int)(guarded_chance(self) * 9.0)) {
    case 0:
    case 1:
    case 2:
        move_goal(self, AT_ONCE);
        break;
    case 3:
        move_goal(self, self->top / guarded_scale(self) /
                            guarded_between(self, 1.0, 30.0));
        break;
    case 4:
    case 5:
        change_load(self);
        break;
    case 6:
        lower_supply(self);
        break;
    case 7:
        switch_off(self);
        break;
    default:
        take_by_hand(self);
        break;
    }
}

static void end_load(struct guarded *self)
{
    const double before = self->load_to;

    if (self->now == self->load_until) {
        self->load_to = 0.0;
        if (!reachable(self, self->ramp_to)) { // the supply is low: later
            self->load_to = before;
            self->load_until = self->now + 10;
        }
    }
    self->load += fmin(fmax(self->load_to - self->load, -self->load_rate),
                       self->load_rate);
}

static void end_others(struct guarded *self)
{
    if (self->now == self->supply_until) {
        self->supply = 1.0;
    }
    if (self->now == self->off_until) {
        self->ramp_to = self->goal_after_off;
        self->ramp_rate = AT_ONCE;
        if (!reachable(self, self->ramp_to)) {
            move_goal(self, AT_ONCE);
        }
    }
    if (self->now == self->hand_until) {
        fixpid_pid_set_auto(&self->pid);
    }
}

void guarded_event(struct guarded *self)
{
    end_load(self);
    end_others(self);
    if (self->now < self->next_event) {
        return;
    }
    self->next_event =
        self->now + 30 +
        (long)(guarded_between(self, 1.0, 14.0) * guarded_scale(self));
    if (self->now >= self->off_until && self->now >= self->hand_until) {
        begin(self);
    }
}

bool guarded_is_calm(const struct guarded *self)
{
    return self->now > self->off_until && self->now > self->hand_until &&
           self->load == self->load_to;
}
