// SPDX-License-Identifier: MIT
#include "machine_subject.h"

#include <math.h>

#include "answer.h"

#define HALF_TURN 3.141592653589793
#define UNKNOWN_STEPS 20.0 // a period, of a machine that has none

// As a linear plant, which has no unit of its own.
static struct linear unstable_plant(const struct machine *machine)
{
    const double lag = machine->lag_s[1] / machine->step_s;
    struct linear plant = {.dead_steps = machine->dead_s / machine->step_s,
                           .unstable = true};

    linear_add(&plant, (struct section){
                           {1.0, 0.0},
                           {-1.0, machine->lag_s[0] / machine->step_s, 0.0}});
    linear_lag(&plant, lag);
    linear_amplify(&plant, machine->gain / machine->span * machine->sensor_max /
                               machine->output_max);
    return plant;
}

// A held output is half a step late.
static double period_of(const struct machine *machine)
{
    static struct answer answer;

    if (machine->kind == MACHINE_UNSTABLE) {
        struct linear plant = unstable_plant(machine);
        plant.dead_steps += 0.5;
        return 2.0 * HALF_TURN / linear_crossing(&plant, -HALF_TURN);
    }
    answer_of(&answer, machine);
    return answer_period(&answer);
}

static bool has_its_rate(enum machine_kind kind)
{
    return kind == MACHINE_QUARTER || kind == MACHINE_OVEN ||
           kind == MACHINE_SSR || kind == MACHINE_BOILER;
}

struct subject draw_machine_subject(struct machine *machine,
                                    enum machine_kind kind, unsigned long seed,
                                    long number)
{
    struct subject self = {.family = FAMILIES,
                           .name = machine_name(kind),
                           .machine = machine,
                           .load_at = -1,
                           .cycles = 1};
    struct chance chance = {(uint64_t)kind * 77u + (uint64_t)number};

    machine_draw(machine, kind, seed, number);
    self.period_steps = period_of(machine);
    if (self.period_steps > 0.0 && self.period_steps < 14.0 &&
        !has_its_rate(kind)) {
        machine->step_s *=
            self.period_steps / chance_factor(&chance, 16.0, 60.0);
        self.period_steps = period_of(machine);
    }
    if (self.period_steps == 0.0) {
        self.period_steps = UNKNOWN_STEPS;
    }
    if (kind == MACHINE_UNSTABLE) {
        self.plant = unstable_plant(machine);
    }
    self.plant.integrating = machine->integrating;
    self.holding = machine->holding;
    self.noise = machine->noise;
    self.sensor_max = machine->sensor_max;
    self.output_min = machine->output_min;
    self.output_max = machine->output_max;
    self.reverse = machine->reverse;
    self.at_rest = chance_happens(&chance, 0.5) || kind == MACHINE_UNSTABLE;
    self.setpoint = machine->setpoint;
    self.timeout_steps =
        (int)fmin(32767.0, 12.0 * machine->slowest_s / machine->step_s +
                               60.0 * self.period_steps + 400.0);
    self.chance.state = chance_bits(&chance);
    return self;
}
