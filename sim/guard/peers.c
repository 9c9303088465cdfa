// SPDX-License-Identifier: MIT
#include "peers.h"

#define WATCHED 5.0 // Marlin watches a way of more degrees
#define RISE 2.0    // degrees in a period
#define NEAR 5.0    // degrees, Klipper's hysteresis
#define MOST 120.0  // degree seconds

void peers_start(struct peers *self, bool hot_end, double step_s)
{
    *self = (struct peers){
        .step_s = step_s,
        .period_s = hot_end ? 40.0 : 20.0,
        .hysteresis = hot_end ? 4.0 : 2.0,
        .watch_s = hot_end ? 40.0 : 60.0,
        .gain_s = hot_end ? 20.0 : 60.0,
    };
}

static void watch_from(struct peers *self, double temperature)
{
    self->watches = temperature < self->target - WATCHED;
    self->goal = temperature + RISE;
    self->left_s = self->watch_s;
}

static bool watch(struct peers *self, double temperature)
{
    if (!self->watches) {
        return false;
    }
    self->left_s -= self->step_s;
    if (temperature >= self->goal) {
        watch_from(self, temperature);
        return false;
    }
    return self->left_s <= 0.0;
}

static bool marlin(struct peers *self, double temperature)
{
    if (!self->reached) {
        self->reached = temperature >= self->target;
        return watch(self, temperature);
    }
    self->below_s += self->step_s;
    if (temperature >= self->target - self->hysteresis) {
        self->below_s = 0.0;
    }
    return self->below_s >= self->period_s || watch(self, temperature);
}

static void approach(struct peers *self, double temperature)
{
    self->rise_goal = temperature + RISE;
    self->rise_left_s = self->gain_s;
}

static bool klipper(struct peers *self, double temperature)
{
    if (temperature >= self->target - NEAR) {
        self->approaches = false;
        self->error = 0.0;
        return false;
    }
    self->error += self->target - NEAR - temperature;
    if (!self->approaches) {
        return self->error >= MOST;
    }
    self->rise_left_s -= 1.0;
    if (temperature >= self->rise_goal) {
        self->error = 0.0;
        approach(self, temperature);
    } else if (self->rise_left_s <= 0.0) {
        self->approaches = false;
    }
    return false;
}

static void take_target(struct peers *self, double target, double temperature)
{
    self->target = target;
    self->reached = false;
    self->below_s = 0.0;
    watch_from(self, temperature);
    self->approaches = true;
    approach(self, temperature);
}

static unsigned look(struct peers *self, double temperature)
{
    unsigned off = marlin(self, temperature) ? PEER_MARLIN : 0u;

    self->since_s += self->step_s;
    if (self->since_s >= 1.0) {
        self->since_s = 0.0;
        off |= klipper(self, temperature) ? PEER_KLIPPER : 0u;
    }
    return off;
}

unsigned peers_step(struct peers *self, double target, double temperature)
{
    unsigned off;

    if (target != self->target) {
        take_target(self, target, temperature);
    }
    off = (target > 0.0) ? look(self, temperature) : 0u;
    if ((off & PEER_MARLIN) != 0u) {
        self->reached = self->watches = false;
        self->below_s = 0.0;
    }
    if ((off & PEER_KLIPPER) != 0u) {
        self->error = 0.0;
    }
    return off;
}
