// SPDX-License-Identifier: MIT
#include <math.h>
#include <string.h>

#include "machine.h"

#define TURN 6.283185307179586
#define SLOW 0.002 // a speed at which friction is that of rest

static double between(struct machine *self, double low, double high)
{
    return chance_between(&self->chance, low, high);
}

static double factor(struct machine *self, double low, double high)
{
    return chance_factor(&self->chance, low, high);
}

static bool happens(struct machine *self)
{
    return chance_happens(&self->chance, 0.5);
}

// Two lags, the dead time about as long as the second one and the first one so
// many times as long.
static void draw_lags(struct machine *self, double low, double high,
                      double most_second, double least_dead)
{
    const double dead_s = factor(self, 2.0, 20.0);

    self->states = 2;
    self->gain = 100.0;
    self->lag_s[0] = dead_s * factor(self, low, high);
    self->lag_s[1] = dead_s * between(self, 0.1, most_second);
    self->dead_s =
        (least_dead < 1.0) ? dead_s * between(self, least_dead, 1.0) : dead_s;
    self->step_s = (dead_s + self->lag_s[1]) / factor(self, 3.0, 20.0);
    self->slowest_s = 1.3 * self->lag_s[0];
    self->span = 110.0;
}

static void draw_equal(struct machine *self)
{
    self->curve = between(self, 20.0, 50.0);
    draw_lags(self, 0.7, 15.0, 0.6, 1.0);
    self->rate = 1.0 / factor(self, 0.5 * self->dead_s, 6.0 * self->dead_s);
    self->holding = between(self, 0.4, 0.9);
}

static void draw_saturates(struct machine *self)
{
    self->curve = between(self, 55.0, 95.0);
    draw_lags(self, 0.7, 15.0, 0.6, 1.0);
    self->span = 1.02 * self->curve;
    self->holding = between(self, 0.15, 0.75);
}

static void draw_stiction(struct machine *self)
{
    draw_lags(self, 0.7, 15.0, 0.6, 1.0);
    if (happens(self)) {
        self->backlash = factor(self, 0.02, 0.08);
    } else {
        self->stiction = factor(self, 0.02, 0.08);
        self->backlash = self->stiction * between(self, 0.0, 0.6);
    }
}

static void draw_ambient(struct machine *self)
{
    draw_lags(self, 2.0, 20.0, 0.6, 0.3);
    self->swing = between(self, 3.0, 12.0);
    self->swing_s = self->lag_s[0] * factor(self, 2.0, 40.0);
    self->swing_at = between(self, 0.0, TURN);
    self->door = happens(self) ? between(self, 5.0, 25.0) : 0.0;
    self->holding = between(self, 0.3, 0.7);
}

static void draw_ssr(struct machine *self)
{
    double least;

    self->states = 3;
    self->gain = 100.0;
    self->lag_s[0] = factor(self, 10.0, 120.0);
    self->lag_s[1] = factor(self, 0.5, 4.0);
    self->lag_s[2] = factor(self, 0.3, 2.0);
    self->half_cycles = (int)factor(self, 5.0, 100.0);
    self->dead_s = between(self, 0.0, 1.0);
    self->slowest_s = 1.3 * self->lag_s[0];
    self->span = 110.0;
    self->holding = between(self, 0.15, 0.8);
    least = (self->lag_s[1] + self->lag_s[2]) / 20.0 * 100.0;
    if (self->half_cycles < least) {
        self->half_cycles = (int)least + 1;
    }
    self->step_s = 0.01 * self->half_cycles;
}

static void draw_pwm(struct machine *self)
{
    draw_lags(self, 1.5, 20.0, 0.6, 0.3);
    self->levels = 10;
}

static void draw_noise(struct machine *self)
{
    const double scale = self->sensor_max / 1023.0;

    draw_lags(self, 1.5, 20.0, 0.6, 0.3);
    self->noise = factor(self, 0.5, 4.0) * scale;
    self->burst = between(self, 3.0, 10.0);
    self->hum = between(self, 0.0, 8.0) * scale;
    self->hum_steps = factor(self, 3.0, 60.0);
    if (chance_happens(&self->chance, 0.6)) {
        self->outliers = factor(self, 0.001, 0.01);
    }
}

static void draw_delay(struct machine *self)
{
    draw_lags(self, 0.5, 8.0, 0.5, 1.0);
    self->wander = between(self, 0.2, 0.5);
    self->wander_s = (self->dead_s + self->lag_s[0]) * factor(self, 2.0, 60.0);
}

static void draw_gain(struct machine *self)
{
    self->curve = happens(self) ? 1.0 : -1.0;
    draw_lags(self, 0.7, 15.0, 0.6, 0.3);
    self->holding = between(self, 0.2, 0.8);
}

static void draw_jitter(struct machine *self)
{
    draw_lags(self, 1.5, 20.0, 0.6, 0.3);
    self->jitter = 0.2;
    self->missed = between(self, 0.01, 0.06);
}

static void draw_inverse(struct machine *self)
{
    self->states = 3;
    self->gain = 100.0;
    self->lag_s[0] = self->lag_s[2] = factor(self, 2.0, 20.0);
    self->lag_s[1] = self->lag_s[0] * factor(self, 0.5, 10.0);
    self->curve = factor(self, 0.15, 1.5);
    self->dead_s = self->lag_s[0] * between(self, 0.0, 0.4);
    self->step_s =
        self->lag_s[0] * (1.0 + self->curve) / factor(self, 4.0, 25.0);
    self->slowest_s = 1.2 * (self->lag_s[1] + 2.0 * self->lag_s[0]);
    self->span = 130.0;
    self->zero = -10.0;
}

// Behind its SSR, read ten times a second: the sum of ten readings counts from
// 22 degrees.
static void draw_boiler(struct machine *self)
{
    self->states = 2;
    self->gain = 1300.0 / 0.83;
    self->lag_s[0] = 2400.0 / 0.83;
    self->lag_s[1] = 8.0;
    self->dead_s = 3.5;
    self->step_s = 1.0;
    self->slowest_s = self->lag_s[0];
    self->half_cycles = 10;
    self->sensor_max = 10230;
    self->output_max = 1000;
    self->noise = 0.5 * sqrt(10.0);
    self->zero = -22.0;
    self->span = 150.0;
    self->holding = (95.0 - 22.0) / self->gain;
}

static double curved(const struct machine *self, double output)
{
    if (self->kind == MACHINE_EQUAL) {
        return (pow(self->curve, output) - 1.0) / (self->curve - 1.0);
    }
    if (self->kind != MACHINE_GAIN) {
        return output;
    }
    return (self->curve > 0.0) ? output / 3.0 + 2.0 * output * output / 3.0
                               : (1.0 - exp(-1.6 * output)) / (1.0 - exp(-1.6));
}

static double surroundings(const struct machine *self)
{
    const double every_s = 1.7 * self->swing_s;
    double sum;

    if (self->smooth || self->swing == 0.0) {
        return 0.0;
    }
    sum =
        self->swing * sin(TURN * self->time_s / self->swing_s + self->swing_at);
    return (fmod(self->time_s, every_s) < 0.06 * self->swing_s)
               ? sum - self->door
               : sum;
}

static void change_lags(const struct machine *self, const double *state,
                        double output, double *change)
{
    double from = self->gain * curved(self, output) + surroundings(self);

    for (int i = 0; i < self->states; i++) {
        change[i] = (from - state[i]) / self->lag_s[i];
        from = state[i];
    }
}

static double value_of_lags(const struct machine *self)
{
    const double *const state = self->state;

    switch (self->kind) {
    case MACHINE_SATURATES:
        return self->curve * tanh(state[1] / self->curve);
    case MACHINE_INVERSE:
        return state[2] + self->curve * (state[2] - state[1]);
    default:
        return state[self->states - 1];
    }
}

// What is heated: watts, watts per degree, and so many degrees at full power.
static void draw_heater(struct machine *self, double top, double lag_s,
                        const double drops[2], const double lags_s[4])
{
    self->states = 3;
    self->loss = self->power / top;
    self->body = self->loss * lag_s;
    self->coupling = self->power / between(self, drops[0], drops[1]);
    self->element = self->coupling * factor(self, lags_s[0], lags_s[1]);
    self->sensor_s = factor(self, lags_s[2], lags_s[3]);
    self->slowest_s = 1.3 * lag_s;
}

static void draw_furnace(struct machine *self)
{
    const double top = between(self, 700.0, 1250.0);
    double share;
    double lag_s;

    self->room = 20.0;
    self->power = factor(self, 800.0, 4000.0);
    share = between(self, 0.4, 0.9); // of the loss
    lag_s = factor(self, 300.0, 3000.0);
    draw_heater(self, top, lag_s, (const double[]){60.0, 250.0},
                (const double[]){5.0, 40.0, 4.0, 30.0});
    self->radiation = self->power * share / pow(top + 273.15, 4.0);
    self->loss = self->power * (1.0 - share) / (top - self->room);
    self->slowest_s = 1.5 * lag_s;
    self->dead_s = between(self, 0.0, 5.0);
    self->step_s = factor(self, 0.5, 3.0);
    self->span = 1300.0;
    self->holding = between(self, 0.25, 0.8);
    self->parts = 4;
}

static void draw_quarter(struct machine *self)
{
    double top;

    self->room = 20.0;
    self->power = factor(self, 50.0, 500.0);
    top = between(self, 120.0, 400.0);
    draw_heater(self, top, factor(self, 60.0, 600.0),
                (const double[]){30.0, 120.0},
                (const double[]){3.0, 20.0, 2.0, 15.0});
    self->sensor_max = 1023;
    self->output_max = 255;
    self->span = 255.75;
    self->noise = happens(self) ? 0.0 : between(self, 0.1, 0.6);
    self->step_s = 1.0;
    self->parts = 10;
    self->holding = between(self, 0.15, 0.7);
    while (self->holding * top + self->room > 225.0) {
        self->holding *= 0.8;
    }
    self->dead_s = between(self, 0.0, 4.0);
}

static void draw_thermistor(struct machine *self)
{
    double top;

    self->room = 25.0;
    self->power = 40.0;
    top = between(self, 280.0, 420.0);
    draw_heater(self, top, factor(self, 60.0, 250.0),
                (const double[]){20.0, 80.0},
                (const double[]){2.0, 8.0, 1.0, 6.0});
    self->step_s = factor(self, 0.15, 1.0);
    self->parts = 6;
    self->holding = between(self, 0.15, 0.6);
    self->reverse = true;
    self->output_max = 255;
    self->dead_s = between(self, 0.0, 2.0);
    self->noise = between(self, 0.0, 1.5);
}

static void draw_oven(struct machine *self)
{
    double top;

    self->room = 20.0;
    self->power = factor(self, 500.0, 3000.0);
    top = between(self, 250.0, 500.0);
    draw_heater(self, top, factor(self, 400.0, 900.0),
                (const double[]){20.0, 150.0},
                (const double[]){1.0, 4.0, 0.5, 3.0});
    self->span = top + 40.0;
    self->step_s = happens(self) ? 1.0 : 0.25;
    self->parts = (self->step_s > 0.5) ? 10 : 4;
    self->holding = between(self, 0.12, 0.7);
}

static void draw_kettle(struct machine *self)
{
    double loss;

    self->room = 20.0;
    self->power = factor(self, 300.0, 3000.0);
    loss = self->power * between(self, 0.02, 0.12) / 45.0;
    draw_heater(
        self, self->power / loss, self->power / loss / factor(self, 0.01, 0.06),
        (const double[]){5.0, 40.0}, (const double[]){8.0, 40.0, 3.0, 20.0});
    self->slowest_s = self->body / self->loss;
    self->dead_s = between(self, 0.0, 15.0);
    self->step_s = factor(self, 1.0, 5.0);
    self->parts = 3;
    self->span = 120.0;
    self->sensor_max = 4095;
    self->noise = between(self, 0.0, 1.5);
    self->holding =
        (between(self, 45.0, 75.0) - self->room) * self->loss / self->power;
}

static void draw_hot_end(struct machine *self)
{
    double top;

    self->room = 25.0;
    self->power = factor(self, 30.0, 60.0);
    top = between(self, 320.0, 500.0);
    draw_heater(self, top, factor(self, 80.0, 220.0),
                (const double[]){15.0, 60.0},
                (const double[]){2.0, 7.0, 1.0, 5.0});
    self->step_s = factor(self, 0.16, 0.5);
    self->parts = 4;
    self->holding = (between(self, 180.0, 260.0) - self->room) / top;
    self->sensor_max = 4095;
    self->output_max = 255;
    self->span = 350.0;
    self->noise = between(self, 0.5, 4.0);
    self->dead_s = between(self, 0.0, 1.5);
}

static void change_heater(const struct machine *self, const double *state,
                          double output, double *change)
{
    const double flow = self->coupling * (state[0] - state[1]);
    const double lost = self->loss * (state[1] - self->room) +
                        self->radiation * (pow(state[1] + 273.15, 4.0) -
                                           pow(self->room + 273.15, 4.0));

    change[0] = (self->power * output - flow) / self->element;
    change[1] = (flow - lost) / self->body;
    change[2] = (state[1] - state[2]) / self->sensor_s;
}

// Of a thermistor of 100 kilohms in a divider with 4.7.
static double value_of_heater(const struct machine *self)
{
    const double degrees = self->state[2];
    const double ohms =
        1e5 * exp(3950.0 * (1.0 / (degrees + 273.15) - 1.0 / 298.15));

    return self->reverse ? ohms / (ohms + 4700.0) : degrees;
}

// Full output reaches 1 / 1.05 to 1 / 1.6 of the scale.
static void draw_rod(struct machine *self)
{
    const double time_s = factor(self, 20.0, 500.0);
    double seen_s;

    self->states = MACHINE_STATES;
    self->coupling = self->states * self->states / time_s;
    self->sensed = (int)between(self, 1.0, 19.0);
    self->loss = factor(self, 0.2, 3.0) / time_s;
    seen_s = time_s * pow((self->sensed + 1.0) / self->states, 2.0);
    self->step_s = fmax(seen_s / factor(self, 2.0, 12.0), time_s / 800.0);
    self->parts = (int)fmax(self->step_s * self->coupling * 2.86 + 1.0, 2.0);
    self->slowest_s = 3.0 * time_s + 1.0 / self->loss;
    machine_settle(self, self->output_max);
    self->span = machine_kind_value(self) * between(self, 1.05, 1.6);
}

static void change_rod(const struct machine *self, const double *state,
                       double output, double *change)
{
    const int last = self->states - 1;

    for (int i = 0; i <= last; i++) {
        const double left = state[(i > 0) ? i - 1 : 0];
        const double right = state[(i < last) ? i + 1 : last];
        change[i] = self->coupling * (left - 2.0 * state[i] + right) -
                    self->loss * state[i];
    }
    change[0] += output;
}

static double value_of_rod(const struct machine *self)
{
    return self->state[self->sensed];
}

// `coupling` is its outlet's and `power` the inlet's flow.
static void draw_tank(struct machine *self)
{
    self->states = 2;
    self->body = factor(self, 20.0, 400.0);
    self->power = 10.0;
    self->coupling = 10.0 / sqrt(100.0 * between(self, 0.8, 1.3));
    self->lag_s[0] = factor(self, 0.5, 20.0);
    self->dead_s = between(self, 0.0, 6.0);
    self->step_s = (self->lag_s[0] + self->dead_s) / factor(self, 3.0, 12.0);
    self->span = 140.0;
    self->slowest_s = 20.0 * self->body;
    self->holding = between(self, 0.3, 0.85);
    while (12.0 * self->slowest_s / self->step_s > 60000.0) {
        self->step_s *= 1.3;
    }
}

static void change_tank(const struct machine *self, const double *state,
                        double output, double *change)
{
    const double out = self->coupling * sqrt(fmax(state[1], 0.0));

    change[0] = (output - state[0]) / self->lag_s[0];
    change[1] = (self->power * state[0] - out) / self->body;
}

static double value_of_tank(const struct machine *self)
{
    return self->state[1];
}

// State 1 is the speed, 2 the position.
static void draw_motor(struct machine *self, double least, double most)
{
    self->states = 3;
    self->damping = between(self, 0.7, 1.0);
    self->inertia = factor(self, 0.03, 0.5) * self->damping;
    self->friction = factor(self, least, most);
    self->breakaway = between(self, 1.0, 1.5);
}

static void draw_position(struct machine *self)
{
    self->output_min = -self->output_max;
    draw_motor(self, 0.01, 0.12);
    self->step_s = self->inertia / self->damping / factor(self, 5.0, 25.0);
    self->span = 2.0 * factor(self, 3.0, 30.0) * self->inertia;
    self->zero = -self->span / 2.0;
    self->slowest_s = 4.0 * self->inertia;
    self->holding = 0.0;
    self->integrating = true;
    self->noise = happens(self) ? 0.0 : between(self, 0.0, 1.0);
    self->dead_s = self->step_s * between(self, 0.0, 1.5);
}

static void draw_speed(struct machine *self)
{
    draw_motor(self, 0.02, 0.2);
    self->step_s = self->inertia / self->damping / factor(self, 4.0, 15.0);
    self->span = 1.5;
    self->slowest_s = 2.0 * self->inertia;
    self->holding = between(self, 0.35, 0.8);
    self->dead_s = self->step_s * between(self, 0.5, 3.0);
    self->noise = between(self, 0.5, 4.0) * self->sensor_max / 1023.0;
}

static void change_motor(const struct machine *self, const double *state,
                         double output, double *change)
{
    const double torque = output - self->damping * state[1];
    const double level = self->smooth ? 0.0 : self->friction;
    const bool slow = fabs(state[1]) < SLOW;
    const double rest = level * self->breakaway;

    change[0] = 0.0;
    change[2] = state[1];
    if (!slow) {
        change[1] = (torque - copysign(level, state[1])) / self->inertia;
    } else if (fabs(torque) > rest) {
        change[1] = (torque - copysign(rest, torque)) / self->inertia;
    } else {
        change[1] = -20.0 * self->damping * state[1] / self->inertia;
    }
}

static double value_of_motor(const struct machine *self)
{
    return self->state[self->integrating ? 2 : 1];
}

static void draw_unstable(struct machine *self)
{
    self->states = 2;
    self->lag_s[0] = 1.0;
    self->lag_s[1] = factor(self, 0.03, 0.15);
    self->dead_s = factor(self, 0.02, 0.15);
    self->step_s = (self->lag_s[1] + self->dead_s) / factor(self, 4.0, 10.0);
    self->gain = between(self, 0.4, 1.2);
    self->span = 2.0;
    self->zero = -1.0;
    self->holding = between(self, 0.4, 0.6);
    self->slowest_s = 1.0;
}

static void change_unstable(const struct machine *self, const double *state,
                            double output, double *change)
{
    change[0] = (self->gain * state[1] + state[0]) / self->lag_s[0];
    change[1] = (output - self->holding - state[1]) / self->lag_s[1];
}

static double value_of_unstable(const struct machine *self)
{
    return self->state[0];
}

// A jacket that a controller of its own heats, what is in it, and the sensor.
static void draw_cascade(struct machine *self)
{
    self->states = 3;
    self->gain = 150.0;
    self->lag_s[0] = factor(self, 5.0, 40.0);
    self->lag_s[1] = self->lag_s[0] * factor(self, 3.0, 15.0);
    self->lag_s[2] = self->lag_s[0] * between(self, 0.05, 0.5);
    self->inner_gain = between(self, 0.1, 1.0);
    self->inner_power = factor(self, 80.0, 300.0);
    self->inner_min = happens(self) ? 0.0 : -1.0;
    self->loss = between(self, 0.05, 0.4);
    self->dead_s = between(self, 0.0, 3.0);
    self->step_s = (0.3 * self->lag_s[0] + self->lag_s[2] + self->dead_s) /
                   factor(self, 3.0, 12.0);
    self->span = 160.0;
    self->slowest_s = 1.2 * self->lag_s[1];
    self->holding = between(self, 0.2, 0.8);
}

static void change_cascade(const struct machine *self, const double *state,
                           double output, double *change)
{
    const double wanted = self->inner_gain * (self->gain * output - state[0]);
    const double inner = fmin(fmax(wanted, self->inner_min), 1.0);
    const double flow = state[0] - state[1];

    change[0] = (self->inner_power * inner - 0.3 * flow) / self->lag_s[0];
    change[1] = (flow - self->loss * state[1]) / self->lag_s[1];
    change[2] = (state[1] - state[2]) / self->lag_s[2];
}

static double value_of_cascade(const struct machine *self)
{
    return self->state[2];
}

#define LAGS change_lags, value_of_lags
#define HEATER change_heater, value_of_heater
#define MOTOR change_motor, value_of_motor

static const struct {
    const char *name;
    void (*draw)(struct machine *self);
    void (*change)(const struct machine *self, const double *state,
                   double output, double *change);
    double (*value)(const struct machine *self);
} kinds[MACHINES + 1] = {
    {"furnace", draw_furnace, HEATER},
    {"equal-percentage valve", draw_equal, LAGS},
    {"sensor saturates", draw_saturates, LAGS},
    {"stiction", draw_stiction, LAGS},
    {"0.25 C", draw_quarter, HEATER},
    {"thermistor", draw_thermistor, HEATER},
    {"ambient", draw_ambient, LAGS},
    {"SSR", draw_ssr, LAGS},
    {"PWM of ten levels", draw_pwm, LAGS},
    {"noise", draw_noise, LAGS},
    {"dead time varies", draw_delay, LAGS},
    {"gain 3:1", draw_gain, LAGS},
    {"oven", draw_oven, HEATER},
    {"rod", draw_rod, change_rod, value_of_rod},
    {"inverse response", draw_inverse, LAGS},
    {"tank", draw_tank, change_tank, value_of_tank},
    {"motor position", draw_position, MOTOR},
    {"motor speed", draw_speed, MOTOR},
    {"unstable machine", draw_unstable, change_unstable, value_of_unstable},
    {"cascade", draw_cascade, change_cascade, value_of_cascade},
    {"jitter", draw_jitter, LAGS},
    {"kettle", draw_kettle, HEATER},
    {"hot end", draw_hot_end, HEATER},
    {"boiler", draw_boiler, LAGS},
};

const char *machine_name(enum machine_kind kind)
{
    return kinds[kind].name;
}

void machine_kind_draw(struct machine *self)
{
    kinds[self->kind].draw(self);
}

void machine_kind_change(const struct machine *self, const double *state,
                         double output, double *change)
{
    kinds[self->kind].change(self, state, output, change);
}

double machine_kind_value(const struct machine *self)
{
    return kinds[self->kind].value(self);
}

void machine_kind_cold(struct machine *self)
{
    memset(self->state, 0, sizeof self->state);
    for (int i = 0; i < self->states && self->power > 0.0; i++) {
        self->state[i] = self->room;
    }
}
