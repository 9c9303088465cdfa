// SPDX-License-Identifier: MIT
#include "families_batch.h"

#define LENGTH(array) ((int)(sizeof(array) / sizeof((array)[0])))

static const double first_lags[] = {
    0.02, 0.05, 0.1, 0.2,  0.3,  0.5,  0.7,   1.0,   1.3,   1.5,   2.0,
    4.0,  6.0,  8.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0};
static const double double_lags[] = {
    0.01, 0.02, 0.05, 0.1, 0.2,  0.3,  0.5,  0.7,   1.0,   1.3,  1.5,
    2.0,  4.0,  6.0,  8.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0};
static const double third_lags[] = {0.005, 0.01, 0.02, 0.05, 0.1,
                                    0.2,   0.5,  2.0,  5.0,  10.0};
static const double dead_times[] = {0.01, 0.02, 0.05, 0.1, 0.3,
                                    0.5,  0.7,  0.9,  1.0};
static const double slow_lags[] = {1.0, 2.0, 5.0, 10.0};

// A lag of next to nothing is left out.
static void lag(struct linear *plant, double time)
{
    if (time > 1e-6) {
        linear_lag(plant, time);
    }
}

static void one_lag(struct linear *plant, int at)
{
    plant->dead_steps = 1.0;
    lag(plant, first_lags[at]);
}

static void two_lags(struct linear *plant, int at)
{
    plant->dead_steps = 1.0;
    lag(plant, double_lags[at]);
    lag(plant, double_lags[at]);
}

static void three_lags(struct linear *plant, int at)
{
    lag(plant, 1.0);
    lag(plant, third_lags[at]);
    lag(plant, third_lags[at]);
}

static void equal_lags(struct linear *plant, int at)
{
    for (int i = 0; i < at + 3; i++) {
        lag(plant, 1.0);
    }
}

// Each is the same part of the one before.
static void falling_lags(struct linear *plant, int at)
{
    const double part = 0.1 * (at + 1);

    lag(plant, 1.0);
    lag(plant, part);
    lag(plant, part * part);
    lag(plant, part * part * part);
}

static void integrator(struct linear *plant, int at)
{
    plant->dead_steps = dead_times[at];
    linear_integrate(plant);
    lag(plant, 1.0 - dead_times[at]);
}

static void unlike_lags(struct linear *plant, int at)
{
    const double dead = dead_times[at % LENGTH(dead_times)];

    plant->dead_steps = dead;
    lag(plant, slow_lags[at / LENGTH(dead_times)]);
    lag(plant, 1.0 - dead);
}

static void inverse(struct linear *plant, int at)
{
    const double rise = -0.1 * (at + 1);

    linear_add(plant, (struct section){{1.0, rise}, {1.0, 1.0, 0.0}});
    lag(plant, 1.0);
    lag(plant, 1.0);
}

// The last one is there twice.
static void damped(struct linear *plant, int at)
{
    const double time = (at < 10) ? 0.1 * (at + 1) : 1.0;

    lag(plant, 1.0);
    linear_add(plant,
               (struct section){{1.0, 0.0}, {1.0, 1.4 * time, time * time}});
}

void draw_of_batch(struct chance *chance, struct linear *plant)
{
    static const struct {
        void (*make)(struct linear *plant, int at);
        int count;
    } kinds[] = {{one_lag, 21},     {two_lags, 21},    {three_lags, 10},
                 {equal_lags, 6},   {falling_lags, 9}, {integrator, 9},
                 {unlike_lags, 36}, {inverse, 11},     {damped, 11}};
    int at = chance_index(chance, 134);
    int kind = 0;

    while (at >= kinds[kind].count) {
        at -= kinds[kind].count;
        kind++;
    }
    kinds[kind].make(plant, at);
}
