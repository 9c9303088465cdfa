// SPDX-License-Identifier: MIT
// What one missing feature does: the same scene three times, with fixpid_pid,
// with the whole law, and with the law without the feature.
#include <stdio.h>
#include <string.h>

#include "loops.h"

struct event {
    int step;
    enum { SETPOINT, LIMIT, MANUAL, AUTO } what;
    double value;
};

#define EVENTS_MAX 4

struct scene {
    const char *name;
    enum pid_double_without without;
    int trial;
    struct pid_double_gains gains; // all 0: the trial's own
    double setpoint_weight;        // with those gains
    int steps;
    struct event events[EVENTS_MAX]; // the first is the setpoint at step 0
    int event_count;
};

static const struct scene scenes[] = {
    {.name = "windup",
     .without = PID_DOUBLE_NO_ANTI_WINDUP,
     .trial = 0,
     .steps = 400,
     .events = {{0, SETPOINT, 700.0}},
     .event_count = 1},
    {.name = "sign_blind",
     .without = PID_DOUBLE_SIGN_BLIND,
     .trial = 0,
     .gains = {0.5, 0.02, 0.0, 0},
     .setpoint_weight = 0.7,
     .steps = 900,
     .events = {{0, SETPOINT, 700.0},
                {300, LIMIT, 100.0},
                {600, SETPOINT, 330.0}},
     .event_count = 3},
    {.name = "clamped",
     .without = PID_DOUBLE_INTEGRAL_CLAMPED,
     .trial = 4,
     .steps = 9000,
     .events = {{0, SETPOINT, 600.0}},
     .event_count = 1},
    {.name = "kick",
     .without = PID_DOUBLE_DERIVATIVE_ON_ERROR,
     .trial = 1,
     .steps = 500,
     .events = {{0, SETPOINT, 400.0}, {300, SETPOINT, 440.0}},
     .event_count = 2},
    {.name = "eight_bits",
     .without = PID_DOUBLE_EIGHT_FRACTIONAL_BITS,
     .trial = 4,
     .gains = {2.0, 0.0015, 0.0, 0},
     .setpoint_weight = 1.0,
     .steps = 9000,
     .events = {{0, SETPOINT, 600.0}},
     .event_count = 1},
    {.name = "no_seed",
     .without = PID_DOUBLE_NO_SEED,
     .trial = 0,
     .steps = 800,
     .events = {{0, SETPOINT, 700.0}, {300, MANUAL, 120.0}, {450, AUTO, 0.0}},
     .event_count = 3},
};

static void happen(struct loop *loop, const struct event *event,
                   double *setpoint)
{
    switch (event->what) {
    case SETPOINT:
        *setpoint = event->value;
        break;
    case LIMIT:
        loop_set_limits(loop, 0.0, event->value);
        break;
    case MANUAL:
        loop_set_manual(loop, event->value);
        break;
    default:
        loop_set_auto(loop);
        break;
    }
}

static void print_steps(const struct scene *scene, const struct trial *trial)
{
    struct loop loops[3];
    double setpoint = 0.0;

    loop_start(&loops[0], trial, true, PID_DOUBLE_WHOLE);
    loop_start(&loops[1], trial, false, PID_DOUBLE_WHOLE);
    loop_start(&loops[2], trial, false, scene->without);
    (void)printf("step,setpoint,fixpid,fixpid_output,double,double_output,"
                 "without,without_output\n");
    for (int step = 0; step < scene->steps; step++) {
        (void)printf("%d", step);
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < scene->event_count; j++) {
                if (scene->events[j].step == step) {
                    happen(&loops[i], &scene->events[j], &setpoint);
                }
            }
            if (i == 0) {
                (void)printf(",%g", setpoint);
            }
            loop_step(&loops[i], setpoint);
            (void)printf(",%.9g,%g", loops[i].motion.value, loops[i].output);
        }
        (void)printf("\n");
    }
}

bool print_scene(const char *name)
{
    for (size_t i = 0; i < sizeof(scenes) / sizeof(scenes[0]); i++) {
        if (strcmp(scenes[i].name, name) == 0) {
            struct trial trial = trials[scenes[i].trial];
            if (scenes[i].gains.kp > 0.0) {
                trial.gains = scenes[i].gains;
                trial.setpoint_weight = scenes[i].setpoint_weight;
            }
            print_steps(&scenes[i], &trial);
            return true;
        }
    }
    return false;
}
