// SPDX-License-Identifier: MIT
#include "margins.h"

#include <math.h>

#include "params.h"
#include "scene.h"

static const struct scene *at_rest(void)
{
    static struct scene scene;
    scene_begin(&scene);
    return &scene;
}

// --- The plant, of full drive and units --------------------------------------

static void of_process(struct loop_plant *to, const struct process *process)
{
    const double a[3] = {process->a0, process->a1, process->a2};
    loop_plant_second_order(to, a, process->gain);
}

static void of_oven(struct loop_plant *to, const struct oven *oven)
{
    const double capacity = oven->heat_capacity_j_k;
    to->states = OVEN_STATES;
    to->a[OVEN_HEAT][OVEN_HEAT] = -1.0 / oven->element_time_constant_s;
    to->b[OVEN_HEAT] = 1.0 / oven->element_time_constant_s;
    to->a[OVEN_BODY][OVEN_HEAT] = oven->full_power_w / capacity;
    to->a[OVEN_BODY][OVEN_BODY] =
        -1.0 / (oven->thermal_resistance_k_w * capacity);
    to->c[OVEN_BODY] = 1.0;
}

// Without friction.
static void of_motor(struct loop_plant *to, const struct motor *motor)
{
    const double inductance = motor->inductance_h;
    const double inertia = motor->inertia_kg_m2;
    to->states = MOTOR_STATES;
    to->a[MOTOR_CURRENT][MOTOR_CURRENT] = -motor->resistance_ohm / inductance;
    to->a[MOTOR_CURRENT][MOTOR_SPEED] = -motor->constant_v_s / inductance;
    to->b[MOTOR_CURRENT] = motor->supply_v / inductance;
    to->a[MOTOR_SPEED][MOTOR_CURRENT] = motor->constant_v_s / inertia;
    to->a[MOTOR_SPEED][MOTOR_SPEED] = -motor->viscous_n_m_s / inertia;
    to->c[MOTOR_SPEED] = 1.0;
}

// Upright, where a sine is its angle. Where the base is does not matter: its
// state is the rate of what is sensed instead.
static void of_pendulum(struct loop_plant *to, const struct pendulum *pendulum)
{
    enum { SENSED_RATE = PENDULUM_POSITION };
    const double rod = pendulum->rod_m;
    const double lag = pendulum->motor_time_constant_s;
    const double filter = pendulum_filter_rad_s(pendulum);
    to->states = LOOP_STATES;
    to->a[PENDULUM_ANGLE][PENDULUM_RATE] = 1.0;
    to->a[PENDULUM_RATE][PENDULUM_ANGLE] = PENDULUM_GRAVITY_M_S2 / rod;
    to->a[PENDULUM_RATE][PENDULUM_SPEED] = 1.0 / (lag * rod);
    to->b[PENDULUM_RATE] = -pendulum->full_speed_m_s / (lag * rod);
    to->a[PENDULUM_SPEED][PENDULUM_SPEED] = -1.0 / lag;
    to->b[PENDULUM_SPEED] = pendulum->full_speed_m_s / lag;
    to->a[PENDULUM_SENSED][SENSED_RATE] = 1.0;
    to->a[SENSED_RATE][PENDULUM_ANGLE] = filter * filter;
    to->a[SENSED_RATE][PENDULUM_SENSED] = -filter * filter;
    to->a[SENSED_RATE][SENSED_RATE] = -filter / PENDULUM_FILTER_QUALITY;
    to->c[PENDULUM_SENSED] = DEGREES_PER_RAD;
}

static void plant_of(struct loop_plant *to, const struct scene *scene)
{
    *to = (struct loop_plant){.dead = scene_dead_s(scene),
                              .scale = tuner_scale_s()};
    switch (scene->kind) {
    case TUNER_OVEN:
        of_oven(to, &scene->oven);
        break;
    case TUNER_MOTOR:
        of_motor(to, &scene->motor);
        break;
    case TUNER_PENDULUM:
        of_pendulum(to, &scene->pendulum);
        break;
    default:
        of_process(to, &scene->process);
        break;
    }
    for (int i = 0; i < to->states; i++) {
        to->b[i] /= highest_output();
        to->c[i] /= unit_per_count();
    }
}

double tuner_scale_s(void)
{
    const double dead = param(PARAM_DEAD);
    struct motor motor;

    switch ((int)param(PARAM_PLANT)) {
    case TUNER_MOTOR:
        motor_init(&motor);
        return motor.resistance_ohm * param(PARAM_T1) * 1e-6 /
               (motor.constant_v_s * motor.constant_v_s);
    case TUNER_PENDULUM:
        return sqrt(param(PARAM_T2) / PENDULUM_GRAVITY_M_S2);
    case TUNER_INTEGRATOR:
        return (2.0 * (dead + param(PARAM_T2))) + (4.0 / param(PARAM_RATE));
    case TUNER_OSCILLATOR:
        return (param(PARAM_T1) / fmax(param(PARAM_DAMPING), 0.05)) + dead;
    default:
        return param(PARAM_T1) + param(PARAM_T2) + dead;
    }
}

// --- The controller ----------------------------------------------------------

static double sign(void)
{
    const unsigned options = (unsigned)param(PARAM_OPTIONS);
    const bool falls =
        ((int)param(PARAM_CONTROLLER) == TUNER_AN964) &&
        ((int)param(PARAM_PLANT) == TUNER_PENDULUM); // which its drive meets

    return (falls || ((options & TUNER_OPTION_REVERSE) != 0u)) ? -1.0 : 1.0;
}

// Of the integers, each with its scale.
static struct loop_controller scaled(double kp, double ki, double kd)
{
    const double *const integers = tuner_results();
    return (struct loop_controller){
        .kp = sign() * integers[RESULT_KP] * kp,
        .ki = sign() * integers[RESULT_KI] * ki,
        .kd = sign() * integers[RESULT_KD] * kd,
    };
}

static struct loop_controller controller(void)
{
    const double filter = tuner_results()[RESULT_FILTER];
    struct loop_controller found;

    if ((int)param(PARAM_CONTROLLER) == TUNER_AN937) {
        const double q4 = scene_error_per_count() / 16.0;
        found = scaled(q4, q4, q4);
        found.derivative = LOOP_PERIODIC;
        found.period = (int)filter;
    } else if ((int)param(PARAM_CONTROLLER) == TUNER_AN964) {
        const double kp = tuner_results()[RESULT_KP] / 1024.0; // of all terms
        found = scaled(1.0 / 1024.0, kp / 4096.0, kp / 32.0);
        found.derivative = LOOP_THREE;
    } else {
        found = scaled(1.0 / 256.0, 1.0 / 16777216.0, 1.0 / 256.0);
        found.derivative = LOOP_FILTERED;
        found.keep = 1.0 - (1.0 / (double)(1 << (int)filter));
    }
    return found;
}

// --- The loop ----------------------------------------------------------------

void tuner_margins(struct loop_margins *to)
{
    const struct loop_controller by = controller();
    struct loop_plant plant;

    plant_of(&plant, at_rest());
    loop_margins(&plant, &by, 1.0 / param(PARAM_RATE), to);
}

double tuner_ms(const struct identify_plant *identified, double full)
{
    static struct loop_margins margins;
    const struct loop_controller by = controller();
    struct loop_plant plant;

    loop_plant_of(&plant, identified, unit_per_count(),
                  full / highest_output());
    loop_margins(&plant, &by, 1.0 / param(PARAM_RATE), &margins);
    return margins.stable ? margins.ms : -1.0;
}
