// SPDX-License-Identifier: MIT
#include "families.h"

#include <math.h>
#include <stddef.h>

#include "families_batch.h"

#define HALF_TURN 3.141592653589793
#define STRETCH_MOST 3000.0

const char *family_name(enum family family)
{
    static const char *const names[FAMILIES + 1] = {"lag-dominant",
                                                    "balanced",
                                                    "dead-time",
                                                    "equal lags",
                                                    "inverse",
                                                    "oscillatory",
                                                    "integrator",
                                                    "servo",
                                                    "integrator and lag",
                                                    "unstable",
                                                    "fractional lag",
                                                    "batch",
                                                    "two lags",
                                                    "servo and lag",
                                                    "heater",
                                                    "backlash",
                                                    "drift",
                                                    "holding low",
                                                    "holding high",
                                                    "coarse",
                                                    "load",
                                                    "servo without delay",
                                                    "at once"};

    return names[family];
}

// It integrates and has next to no dead time.
static bool is_servo(enum family family)
{
    return family == FAMILY_SERVO || family == FAMILY_SERVO_LAG ||
           family == FAMILY_SERVO_NO_DELAY;
}

double subject_scale(const struct subject *self)
{
    const struct machine *const machine = self->machine;

    if (machine != NULL) {
        return (machine->slowest_s + machine->dead_s) / machine->step_s;
    }
    return linear_steps(&self->plant) * (self->plant.integrating ? 2.0 : 1.0);
}

// Of the families that are about circumstances: any of these.
static enum family any_plant(struct chance *chance, enum family family)
{
    static const enum family plain[] = {
        FAMILY_LAG_DOMINANT,   FAMILY_BALANCED, FAMILY_DEAD_TIME,
        FAMILY_EQUAL_LAGS,     FAMILY_TWO_LAGS, FAMILY_INTEGRATOR,
        FAMILY_INTEGRATOR_LAG, FAMILY_BALANCED, FAMILY_TWO_LAGS,
        FAMILY_EQUAL_LAGS};
    const enum family drawn = plain[chance_index(chance, 10)];
    const bool integrates =
        drawn == FAMILY_INTEGRATOR || drawn == FAMILY_INTEGRATOR_LAG;
    const bool at_an_end =
        family == FAMILY_HOLDING_LOW || family == FAMILY_HOLDING_HIGH;

    // An integrator holds anywhere with the same output.
    return (integrates && at_an_end) ? FAMILY_BALANCED : drawn;
}

static enum family plant_of(struct chance *chance, enum family family)
{
    if (family == FAMILY_AT_ONCE) {
        return FAMILY_FRACTIONAL;
    }
    if (family == FAMILY_HEATER) {
        return chance_happens(chance, 0.5) ? FAMILY_LAG_DOMINANT
                                           : FAMILY_BALANCED;
    }
    if (family > FAMILY_HEATER && family < FAMILY_SERVO_NO_DELAY) {
        return any_plant(chance, family);
    }
    return family;
}

static void draw_lag(struct chance *chance, struct linear *plant,
                     double least_dead, double most_dead)
{
    linear_lag(plant, 1.0);
    plant->dead_steps = chance_factor(chance, least_dead, most_dead);
}

static void draw_equal_lags(struct chance *chance, struct linear *plant)
{
    const int lags = 3 + chance_index(chance, 6);

    for (int i = 0; i < lags; i++) {
        linear_lag(plant, 1.0);
    }
}

static void draw_inverse(struct chance *chance, struct linear *plant)
{
    const int lags = 2 + chance_index(chance, 2);
    const double rise = -chance_factor(chance, 0.1, 1.1);

    linear_add(plant, (struct section){{1.0, rise}, {1.0, 1.0, 0.0}});
    for (int i = 1; i < lags; i++) {
        linear_lag(plant, 1.0);
    }
    if (!chance_happens(chance, 0.5)) {
        plant->dead_steps = chance_between(chance, 0.0, 0.5);
    }
}

static void draw_oscillatory(struct chance *chance, struct linear *plant)
{
    const double damping = chance_between(chance, 0.3, 0.9);

    linear_add(plant, (struct section){{1.0, 0.0}, {1.0, 2.0 * damping, 1.0}});
    plant->dead_steps = chance_factor(chance, 0.05, 3.0);
}

static void draw_unstable(struct chance *chance, struct linear *plant)
{
    linear_add(plant, (struct section){{1.0, 0.0}, {-1.0, 1.0, 0.0}});
    plant->unstable = true;
    plant->dead_steps = chance_factor(chance, 0.05, 0.4);
}

// Poles and zeros by turns over three decades, then a small delay. The product
// of these sections would let 2 % of the input pass at once, which a process of
// this kind, such as heat that is conducted, does not: that part is left out.
static void draw_fractional(struct chance *chance, struct linear *plant)
{
    double pole = 1.0;

    for (int i = 0; i < 4; i++) {
        const double zero = pole * ((0.32 * 0.55) + 0.2);
        linear_add(plant, (struct section){{1.0, zero}, {1.0, pole, 0.0}});
        pole *= 0.12;
    }
    if (chance_happens(chance, 0.5)) {
        plant->dead_steps = chance_factor(chance, 0.01, 0.3);
    } else {
        const double lag = chance_factor(chance, 0.01, 0.2);
        linear_lag(plant, lag);
        linear_lag(plant, lag);
    }
}

static void draw_two_lags(struct chance *chance, struct linear *plant)
{
    linear_lag(plant, 1.0);
    linear_lag(plant, chance_between(chance, 0.1, 1.0));
    plant->dead_steps = chance_factor(chance, 0.03, 3.0);
}

static void draw_integrator(struct chance *chance, struct linear *plant,
                            enum family family)
{
    linear_integrate(plant);
    if (family == FAMILY_INTEGRATOR) {
        plant->dead_steps = 1.0;
        return;
    }
    linear_lag(plant, 1.0);
    if (family == FAMILY_SERVO_LAG) {
        linear_lag(plant, chance_between(chance, 0.05, 0.5));
    } else if (family == FAMILY_INTEGRATOR_LAG) {
        plant->dead_steps = chance_factor(chance, 0.02, 2.0);
    }
}

// With times in units of one of them: in steps only when they are stretched.
static void draw_plant(struct chance *chance, struct linear *plant,
                       enum family family)
{
    switch (family) {
    case FAMILY_LAG_DOMINANT:
        draw_lag(chance, plant, 0.02, 0.2);
        break;
    case FAMILY_BALANCED:
        draw_lag(chance, plant, 0.2, 1.0);
        break;
    case FAMILY_DEAD_TIME:
        draw_lag(chance, plant, 1.0, 10.0);
        break;
    case FAMILY_EQUAL_LAGS:
        draw_equal_lags(chance, plant);
        break;
    case FAMILY_INVERSE:
        draw_inverse(chance, plant);
        break;
    case FAMILY_OSCILLATORY:
        draw_oscillatory(chance, plant);
        break;
    case FAMILY_UNSTABLE:
        draw_unstable(chance, plant);
        break;
    case FAMILY_FRACTIONAL:
        draw_fractional(chance, plant);
        break;
    case FAMILY_BATCH:
        draw_of_batch(chance, plant);
        break;
    case FAMILY_TWO_LAGS:
        draw_two_lags(chance, plant);
        break;
    default:
        draw_integrator(chance, plant, family);
        break;
    }
}

// Steps of dead time of a servo, which do not grow with its lag.
static double draw_delay(struct chance *chance, enum family family)
{
    if (family == FAMILY_SERVO) {
        return chance_between(chance, 0.0, 3.0);
    }
    return (family == FAMILY_SERVO_LAG) ? chance_between(chance, 0.0, 2.0)
                                        : 0.0;
}

// Stretches the plant until it oscillates at -180 degrees with the drawn
// period. A held output is half a step late, and a servo's delay comes on top.
static void stretch(struct subject *self, double delay)
{
    const double step = 2.0 * HALF_TURN / self->period_steps; // radians
    const double phase = -HALF_TURN + (step * (delay + 0.5));
    const double factor = linear_crossing(&self->plant, phase) / step;

    linear_stretch(&self->plant, fmin(factor, STRETCH_MOST));
    self->plant.dead_steps += delay;
}

// A servo swings more quickly.
static void draw_period(struct chance *chance, struct subject *self, bool servo)
{
    self->period_steps = chance_factor(chance, 14.0, 220.0);
    if (servo) {
        self->period_steps = chance_factor(chance, 14.0, 120.0);
    }
}

static void draw_circumstances(struct chance *chance, struct subject *self)
{
    static const double noises[] = {0.0, 0.3, 0.5, 1.0, 2.0, 3.0};

    self->sensor_max = chance_happens(chance, 0.5) ? 1023 : 4095;
    self->output_max = chance_happens(chance, 0.5) ? 255 : 1000;
    self->noise = noises[chance_index(chance, 6)];
    self->holding = chance_between(chance, 0.1, 0.9);
    if (self->family == FAMILY_HEATER) {
        self->holding = chance_between(chance, 0.08, 0.4);
    } else if (self->family == FAMILY_HOLDING_LOW) {
        self->holding = chance_between(chance, 0.03, 0.05);
    } else if (self->family == FAMILY_HOLDING_HIGH) {
        self->holding = chance_between(chance, 0.93, 0.97);
    } else if (self->family == FAMILY_COARSE) {
        self->sensor_max = 1023;
        self->output_max = 255;
        self->noise = chance_between(chance, 0.5, 3.0);
    }
}

// Full output moves an integrator by so much of the scale in its own time. A
// servo's swing at full output must stay on the scale, or nothing can be done.
static double draw_speed(struct chance *chance, const struct subject *self,
                         bool servo)
{
    const double scale = (double)self->sensor_max / self->output_max;
    const double time = linear_steps(&self->plant);
    const double most = 0.25 * scale / (self->period_steps / 2.0);
    const double speed =
        scale * chance_factor(chance, 0.04, servo ? 8.0 : 0.4) / time;

    if (servo && speed > most) {
        return most * chance_factor(chance, 0.2, 1.0);
    }
    return speed;
}

// Full output reaches `reach` of the scale.
static void draw_gain(struct chance *chance, struct subject *self, bool servo)
{
    const double scale = (double)self->sensor_max / self->output_max;
    const double reach = chance_between(chance, 0.5, 0.95);
    double gain = reach * scale;

    self->setpoint = self->sensor_max / 2;
    if (self->plant.integrating) {
        gain = draw_speed(chance, self, servo);
    } else if (self->plant.unstable) {
        gain = 0.2 * scale;
        self->holding = chance_between(chance, 0.35, 0.65);
    } else {
        self->setpoint = (int)((gain * self->holding * self->output_max) +
                               (0.03 * self->sensor_max));
    }
    linear_amplify(&self->plant, gain);
}

static void draw_trouble(struct chance *chance, struct subject *self)
{
    self->at_rest = chance_happens(chance, 0.5) || self->plant.unstable;
    if (self->family == FAMILY_HEATER) {
        self->cooling = chance_between(chance, 2.0, 5.0);
    } else if (self->family == FAMILY_BACKLASH) {
        self->backlash = chance_factor(chance, 0.003, 0.03) * self->output_max;
    } else if (self->family == FAMILY_DRIFT) {
        self->drift = chance_between(chance, -0.1, 0.1) * self->output_max;
    }
    if (chance_happens(chance, 0.25) || self->family == FAMILY_LOAD) {
        const double scale = subject_scale(self);
        self->load = chance_between(chance, -0.1, 0.1) * self->output_max;
        self->load_at = (long)(40.0 + (chance_share(chance) * 25.0 * scale));
    }
}

struct subject draw_subject(unsigned long seed, long number, enum family family)
{
    struct chance chance = {((uint64_t)seed * 1000003u) +
                            ((uint64_t)number * 7919u)};
    struct subject self = {.family = family,
                           .name = family_name(family),
                           .cooling = 1.0,
                           .load_at = -1,
                           .cycles = 1};
    enum family plant;
    bool servo;
    double delay;

    (void)chance_bits(&chance);
    plant = plant_of(&chance, self.family);
    servo = is_servo(plant);
    draw_plant(&chance, &self.plant, plant);
    self.plant.at_once = family == FAMILY_AT_ONCE;
    delay = draw_delay(&chance, plant);
    draw_period(&chance, &self, servo);
    stretch(&self, delay);
    draw_circumstances(&chance, &self);
    draw_gain(&chance, &self, servo);
    draw_trouble(&chance, &self);
    self.timeout_steps =
        (int)fmin(32767.0, (48.0 * subject_scale(&self)) + 400.0);
    self.chance.state = chance_bits(&chance);
    return self;
}
