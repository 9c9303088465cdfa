// SPDX-License-Identifier: MIT
#include "metrics.h"

#include <math.h>
#include <stdbool.h>

#include "fixpid_pid.h"
#include "params.h"
#include "tuner.h"

#define SETTLED_PART 0.02 // of the step change

static double metrics[TUNER_METRICS];

double *tuner_metrics(void)
{
    return metrics;
}

// The setpoint as the loop had it, in units.
static double setpoint(int i)
{
    return param(PARAM_SENSOR_LOW) + (tuner_counts(COUNT_SETPOINT)[i] *
                                      param(PARAM_SENSOR_RANGE) / sensor_top());
}

static double error(int i)
{
    return fabs(tuner_values(VALUE_TRUE)[i] - setpoint(i));
}

// The step of the first event behind `step`, of one kind or, by EVENT_NONE, of
// any; or n.
static int next_event(int step, int kind, int n)
{
    int next = n;

    for (int e = 0; e < TUNER_EVENTS; e++) {
        const double *const event = tuner_events() + (e * TUNER_EVENT_SIZE);
        const int what = (int)event[1];
        const double due = floor((event[0] * param(PARAM_RATE)) + 0.5);
        const bool wanted =
            (what != EVENT_NONE) && ((kind == EVENT_NONE) || (what == kind));
        if (wanted && (due > step) && (due < next)) {
            next = (int)due;
        }
    }
    return next;
}

// How the first setpoint is reached, before anything else happens.
static void step_response(int n)
{
    const double *const y = tuner_values(VALUE_TRUE);
    const double goal = setpoint(0);
    const double way = (goal < y[0]) ? -1.0 : 1.0;
    const double span = (goal < y[0] || goal > y[0]) ? fabs(goal - y[0]) : 1.0;
    const double count = unit_per_count();
    const double band =
        fmax(SETTLED_PART * span, (1.0 + param(PARAM_NOISE)) * count);
    int risen = n;
    int settled = 0;

    metrics[METRIC_OVERSHOOT] = 0.0;
    for (int i = 0; i < n; i++) {
        const double over = way * (y[i] - goal) / span;
        metrics[METRIC_OVERSHOOT] = fmax(metrics[METRIC_OVERSHOOT], over);
        if ((risen == n) && ((way * (y[i] - y[0])) >= (0.9 * span))) {
            risen = i;
        }
        settled = (fabs(y[i] - goal) > band) ? (i + 1) : settled;
    }
    metrics[METRIC_RISE] = (risen < n) ? (risen / param(PARAM_RATE)) : -1.0;
    metrics[METRIC_SETTLED] =
        (settled < n) ? (settled / param(PARAM_RATE)) : -1.0;
}

static void load_response(int n)
{
    const int from = next_event(-1, EVENT_LOAD, n);
    const int to = next_event(from, EVENT_NONE, n);

    metrics[METRIC_LOAD] = -1.0;
    for (int i = from; i < to; i++) {
        metrics[METRIC_LOAD] = fmax(metrics[METRIC_LOAD], error(i));
    }
}

static bool at_limit(int i)
{
    const int32_t output = tuner_counts(COUNT_OUTPUT)[i];

    if (param(PARAM_CONTROLLER) == TUNER_PID) {
        return (tuner_counts(COUNT_FLAGS)[i] &
                (int32_t)(FIXPID_PID_AT_MAX | FIXPID_PID_AT_MIN)) != 0;
    }
    return (output >= param(PARAM_OUTPUT_MAX)) ||
           (output <= param(PARAM_OUTPUT_MIN));
}

static void sums(int n)
{
    const int32_t *const output = tuner_counts(COUNT_OUTPUT);
    int32_t *const is_limited = tuner_counts(COUNT_LIMITED);
    double errors = 0.0;
    double moved = 0.0;
    int limited = 0;

    for (int i = 0; i < n; i++) {
        errors += error(i);
        moved += (i > 0) ? fabs((double)output[i] - output[i - 1]) : 0.0;
        is_limited[i] = at_limit(i) ? 1 : 0;
        limited += is_limited[i];
    }
    metrics[METRIC_MEAN_ERROR] = errors / n;
    metrics[METRIC_IAE] = errors / param(PARAM_RATE);
    metrics[METRIC_MOVED] = moved / n;
    metrics[METRIC_LIMITED] = (double)limited / n;
}

static void differences(int n)
{
    const double count = unit_per_count();
    double squares = 0.0;

    metrics[METRIC_TWIN_MOST] = 0.0;
    metrics[METRIC_TRAVEL] = 0.0;
    for (int i = 0; i < n; i++) {
        const double difference =
            (tuner_values(VALUE_TRUE)[i] - tuner_values(VALUE_TWIN)[i]) / count;
        metrics[METRIC_TWIN_MOST] =
            fmax(metrics[METRIC_TWIN_MOST], fabs(difference));
        metrics[METRIC_TRAVEL] =
            fmax(metrics[METRIC_TRAVEL], fabs(tuner_values(VALUE_BASE)[i]));
        squares += difference * difference;
    }
    metrics[METRIC_TWIN_RMS] = sqrt(squares / n);
}

void metrics_of_run(int n)
{
    step_response(next_event(0, EVENT_NONE, n));
    load_response(n);
    sums(n);
    differences(n);
}
