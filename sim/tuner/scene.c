// SPDX-License-Identifier: MIT
#include "scene.h"

#include <math.h>

#include "params.h"
#include "plant.h"

#define SHOVE_S 0.05

static double step_s(void)
{
    return 1.0 / param(PARAM_RATE);
}

static double smaller(double a, double b)
{
    return ((b > 0.0) && (b < a)) ? b : a;
}

static void begin_process(struct process *self, int kind)
{
    const double t1 = param(PARAM_T1);
    const double t2 = param(PARAM_T2);

    self->gain = param(PARAM_GAIN);
    self->dead_time_s = param(PARAM_DEAD);
    self->a2 = t1 * t2;
    self->a1 = t1 + t2;
    self->a0 = 1.0;
    if (kind == TUNER_OSCILLATOR) {
        self->a2 = t1 * t1;
        self->a1 = 2.0 * param(PARAM_DAMPING) * t1;
        process_start(self, step_s(), t1);
    } else if (kind == TUNER_INTEGRATOR) {
        self->a2 = t2;
        self->a1 = 1.0;
        self->a0 = 0.0;
        process_start(self, step_s(), (t2 > 0.0) ? t2 : 1e9);
    } else {
        process_start(self, step_s(), smaller(t1, t2));
    }
}

// The time constant t1 and the warmth at full drive are as in plant_oven.h,
// with a resistance of 1.
static void begin_oven(struct oven *self)
{
    oven_init(self, param(PARAM_START));
    self->full_power_w = param(PARAM_GAIN);
    self->thermal_resistance_k_w = 1.0;
    self->heat_capacity_j_k = param(PARAM_T1);
    self->element_time_constant_s = param(PARAM_T2);
    self->dead_time_s =
        fmin(param(PARAM_DEAD), step_s() * (OVEN_DELAY_LINE - 2u));
    self->longest_step_s = smaller(param(PARAM_T1), param(PARAM_T2)) / 20.0;
}

static void begin_motor(struct motor *self)
{
    motor_init(self);
    self->supply_v = param(PARAM_GAIN);
    self->inertia_kg_m2 = param(PARAM_T1) * 1e-6;
    self->friction_n_m = param(PARAM_T2) * 1e-3;
    self->longest_step_s = 50e-6;
}

static void begin_pendulum(struct pendulum *self)
{
    pendulum_init(self, param(PARAM_START) / DEGREES_PER_RAD);
    self->full_speed_m_s = param(PARAM_GAIN);
    self->motor_time_constant_s = param(PARAM_T1);
    self->rod_m = param(PARAM_T2);
    self->longest_step_s = 0.5e-3;
}

void scene_begin(struct scene *self)
{
    self->kind = (int)param(PARAM_PLANT);
    self->load = 0.0;
    self->shove_left_s = 0.0;
    self->noise = 1u;
    switch (self->kind) {
    case TUNER_OVEN:
        begin_oven(&self->oven);
        break;
    case TUNER_MOTOR:
        begin_motor(&self->motor);
        break;
    case TUNER_PENDULUM:
        begin_pendulum(&self->pendulum);
        break;
    default:
        begin_process(&self->process, self->kind);
        break;
    }
}

double scene_value(const struct scene *self)
{
    switch (self->kind) {
    case TUNER_OVEN:
        return self->oven.state[OVEN_BODY];
    case TUNER_MOTOR:
        return self->motor.state[MOTOR_SPEED];
    case TUNER_PENDULUM:
        return self->pendulum.state[PENDULUM_SENSED] * DEGREES_PER_RAD;
    default:
        return self->process.state[PROCESS_VALUE] + param(PARAM_START);
    }
}

static int16_t converted(double units, double noise)
{
    const double top = sensor_top();
    const double span = param(PARAM_SENSOR_RANGE);
    const double counts =
        ((units - param(PARAM_SENSOR_LOW)) / span * top) + noise;
    return (int16_t)floor(plant_limit(counts, 0.0, top) + 0.5);
}

int16_t scene_counts(double units)
{
    return converted(units, 0.0);
}

int scene_error_per_count(void)
{
    const int notes = (int)param(PARAM_CONTROLLER) == TUNER_AN937;
    return (notes && ((int)param(PARAM_PLANT) == TUNER_MOTOR)) ? 4 : 1;
}

// Even in -1..1, by the generator of plant_counts.c.
static double drawn(struct scene *self)
{
    self->noise = self->noise * UINT32_C(1664525) + UINT32_C(1013904223);
    return ((double)(self->noise >> 16) / 32767.5) - 1.0;
}

int16_t scene_read(struct scene *self)
{
    return converted(scene_value(self), param(PARAM_NOISE) * drawn(self));
}

double scene_dead_s(const struct scene *self)
{
    switch (self->kind) {
    case TUNER_OVEN:
        return self->oven.dead_time_s;
    case TUNER_MOTOR:
    case TUNER_PENDULUM:
        return 0.0;
    default:
        return process_dead_s(&self->process);
    }
}

void scene_load(struct scene *self, double load)
{
    self->load = load;
    self->shove_left_s = SHOVE_S;
}

static void move_pendulum(struct scene *self, double drive)
{
    const int shoved = self->shove_left_s > 0.0;

    self->pendulum.shove_rad_s2 = shoved ? self->load : 0.0;
    pendulum_advance(&self->pendulum, drive, step_s());
    self->shove_left_s -= step_s();
}

void scene_move(struct scene *self, double output)
{
    const double most = highest_output();
    const double drive = output / most;

    switch (self->kind) {
    case TUNER_OVEN:
        oven_advance(&self->oven, drive + self->load, step_s());
        break;
    case TUNER_MOTOR:
        self->motor.load_n_m = self->load;
        motor_advance(&self->motor, drive, step_s());
        break;
    case TUNER_PENDULUM:
        move_pendulum(self, drive);
        break;
    default:
        process_move(&self->process, drive + self->load);
        break;
    }
}
