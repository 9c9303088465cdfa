// SPDX-License-Identifier: MIT
#include "draw.h"

#include <math.h>

// Marsaglia's xorshift of 64 bits: 0..1.
static double number(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static double between(struct draw *self, double low, double high)
{
    return low + ((high - low) * number(&self->state));
}

static bool happens(struct draw *self, double share)
{
    return number(&self->state) < share;
}

// Each factor is as likely as the others.
static double any_of(struct draw *self, double low, double high)
{
    return low * exp(log(high / low) * number(&self->state));
}

double draw_noise(uint64_t *state)
{
    double sum = 0.0;

    for (int i = 0; i < 12; i++) {
        sum += number(state);
    }
    return sum - 6.0;
}

void draw_start(struct draw *self, unsigned long seed)
{
    self->state = ((uint64_t)seed * UINT64_C(2654435761)) + 12345u;
    for (int i = 0; i < 20; i++) {
        (void)number(&self->state);
    }
}

static void draw_lag(struct draw *self, struct plant_lags *plant,
                     double least_dead)
{
    plant->dead_steps = any_of(self, 3.0, 60.0);
    plant->lags = 1;
    plant->lag_steps[0] = plant->dead_steps / any_of(self, least_dead, 10.0);
    plant->lag_steps[0] = fmin(fmax(plant->lag_steps[0], 1.0), 1200.0);
}

static void draw_lags(struct draw *self, struct plant_lags *plant)
{
    plant->lags = 4 + (int)(number(&self->state) * 3.0);
    plant->lag_steps[0] = any_of(self, 4.0, 60.0);
    for (int i = 1; i < plant->lags; i++) {
        plant->lag_steps[i] = plant->lag_steps[0];
    }
}

static void draw_two_lags(struct draw *self, struct plant_lags *plant)
{
    plant->dead_steps = any_of(self, 2.0, 40.0);
    plant->lags = 2;
    plant->lag_steps[0] =
        fmin(plant->dead_steps / any_of(self, 0.05, 3.0), 800.0);
    plant->lag_steps[1] = plant->lag_steps[0] * between(self, 0.1, 1.0);
}

static void draw_integrator(struct draw *self, struct task *task)
{
    struct plant_lags *const plant = &task->plant;
    // Full output moves it by so much of the sensor's range in the time of its
    // dead time and lag.
    const double least = 0.04;
    double most = 0.4;

    plant->integrating = true;
    if (task->kind == KIND_INTEGRATOR) {
        plant->dead_steps = any_of(self, 3.0, 60.0);
    } else if (task->kind == KIND_POSITION) {
        plant->lags = 1;
        plant->lag_steps[0] = any_of(self, 5.0, 80.0);
        plant->dead_steps = any_of(self, 1.0, 20.0);
    } else {
        plant->lags = 1;
        plant->lag_steps[0] = any_of(self, 5.0, 600.0);
        plant->dead_steps = between(self, 0.0, 3.0);
        most = 8.0;
    }
    plant->gain =
        task->sensor_max * any_of(self, least, most) /
        (task->output_max * (plant->dead_steps + lags_sum_steps(plant)));
}

static void draw_plant(struct draw *self, struct task *task)
{
    switch (task->kind) {
    case KIND_LAG:
        draw_lag(self, &task->plant, 0.05);
        break;
    case KIND_DEAD:
        draw_lag(self, &task->plant, 1.0);
        break;
    case KIND_TWO_LAGS:
        draw_two_lags(self, &task->plant);
        break;
    case KIND_LAGS:
        draw_lags(self, &task->plant);
        break;
    default:
        draw_integrator(self, task);
        break;
    }
}

// Where an integrator is does not matter to it; the others must be held.
static void place_setpoint(struct task *task)
{
    if (task->plant.integrating) {
        task->setpoint = (int)(task->sensor_max / 2.0);
        task->zero = task->power_on ? task->sensor_max * 0.2 : task->setpoint;
        task->drift = task->holding;
    } else {
        task->zero = task->sensor_max * 0.02;
        task->setpoint = (int)((task->plant.gain * task->holding) + task->zero);
    }
}

struct task draw_task(struct draw *self, int number_of_task)
{
    static const double noises[] = {0.0, 0.3, 1.0, 2.0, 3.0};
    struct task task = {.kind = self->kind, .load_at = -1};
    double scale;

    if (self->kind == KIND_MIXED) {
        task.kind = (enum kind)(number_of_task % KIND_MIXED);
    }
    task.sensor_max = happens(self, 0.5) ? 1023.0 : 4095.0;
    task.output_max = happens(self, 0.5) ? 255.0 : 1000.0;
    task.holding =
        (self->holding < 0.0) ? between(self, 0.1, 0.9) : self->holding;
    task.holding *= task.output_max;
    task.noise = noises[(int)(number(&self->state) * 5.0)];
    task.plant.gain =
        task.sensor_max * between(self, 0.5, 0.95) / task.output_max;
    draw_plant(self, &task);
    scale = lags_scale_steps(&task.plant);
    task.power_on = happens(self, 0.5);
    task.reverse = happens(self, 0.3);
    if (happens(self, self->load_share)) {
        task.load = between(self, -0.1, 0.1) * task.output_max;
        task.load_at = (long)between(self, 40.0, 40.0 + (25.0 * scale));
    }
    place_setpoint(&task);
    task.timeout_steps = (int)fmin(32767.0, (48.0 * scale) + 400.0);
    task.noise_state = self->state ^ UINT64_C(0x9E3779B97F4A7C15);
    return task;
}
