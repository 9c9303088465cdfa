// SPDX-License-Identifier: MIT
#include "tuner.h"

#include <math.h>
#include <stdbool.h>

#include "fit.h"
#include "fixpid_an937.h"
#include "fixpid_an964.h"
#include "fixpid_autotune.h"
#include "fixpid_guard.h"
#include "fixpid_pid.h"
#include "fixpid_reaction.h"
#include "metrics.h"
#include "params.h"
#include "plant.h"
#include "scene.h"
#include "twin.h"

#define UPRIGHT_COUNTS 512
#define ANGLE_LIMIT_COUNTS 341 // where the note's program gives up
#define DRIFT_LIMIT 55         // eighths of a count, the note's value
#define TIMEOUT_STEPS 32767
#define HEAT_UP_WEIGHT 128 // of the setpoint, as fixpid_reaction.h advises
#define LISTENS 8          // percent: below that it has not begun to heat

// As fixpid_autotune_progress has them.
#define PHASE_LISTENS 0
#define PHASE_HEATS 1
#define PHASE_OVER 6

// Where a record has these.
#define RECORD_OUTPUT_MIN 1
#define RECORD_OUTPUT_MAX 3
#define RECORD_REVERSE 16

static double events[TUNER_EVENTS * TUNER_EVENT_SIZE];
static double results[TUNER_RESULTS];
static int32_t counts[TUNER_COUNTS][TUNER_STEPS];
static double values[TUNER_VALUES][TUNER_STEPS];

static struct fixpid_pid pid;
static struct fixpid_an937 an937;
static struct fixpid_an964 an964;
static struct fixpid_autotune autotune;
static struct fixpid_autotune_record record;
static struct fixpid_reaction reaction;
static bool heat_up; // what the last experiment was
static struct fit fit;

// A loop that runs: the library's, or its twin's. Each has its own drift
// offset.
static struct scene scene;
static struct scene twin_scene;
static struct twin twin;
static int drift;
static int twin_drift;

double *tuner_events(void)
{
    return events;
}

double *tuner_results(void)
{
    return results;
}

uint8_t *tuner_record(void)
{
    return record.bytes;
}

int32_t *tuner_counts(int series)
{
    return counts[series];
}

double *tuner_values(int series)
{
    return values[series];
}

static int steps(void)
{
    const double wanted =
        floor((param(PARAM_DURATION) * param(PARAM_RATE)) + 0.5);
    return (int)fmin(fmax(wanted, 2.0), (double)TUNER_STEPS);
}

static bool within(double value, double low, double high)
{
    return (value >= low) && (value <= high);
}

static bool integer_16(int which)
{
    return within(param(which), -32768.0, 32767.0);
}

// What FIXPID_PID_GAINS takes, of gains that are scaled and not yet rounded.
static bool legal(double kp, double ki, double kd)
{
    const bool kp_legal = (kp >= 0.0) && ((kp - FIXPID_PID_KP_MAX) < 0.5) &&
                          FIXPID_PID_COUNTS(kp, kp, 0.5);
    const bool kd_legal = (kd >= 0.0) && ((kd - FIXPID_PID_KD_MAX) < 0.5) &&
                          FIXPID_PID_COUNTS(kd, kd, 0.5);
    const bool ki_legal = (ki >= 0.0) && ((ki - FIXPID_PID_KI_MAX) < 0.5) &&
                          FIXPID_PID_COUNTS(ki, ki, 8.0);
    return kp_legal && ki_legal && kd_legal;
}

// The gains of fixpid_pid as FIXPID_PID_GAINS folds and refuses them.
static bool folded(struct fixpid_pid_gains *gains)
{
    const double kp = param(PARAM_KP) * 256.0;
    const double ki = FIXPID_PID_KI_Q24(param(PARAM_KI), param(PARAM_RATE));
    const unsigned filter = (unsigned)param(PARAM_FILTER);
    const double kd =
        FIXPID_PID_KD_Q8(param(PARAM_KD), param(PARAM_RATE), filter);

    results[RESULT_KP] = floor(plant_limit(kp, 0.0, 65535.0) + 0.5);
    results[RESULT_KI] = floor(plant_limit(ki, 0.0, 4294967294.0) + 0.5);
    results[RESULT_KD] = floor(plant_limit(kd, 0.0, 65535.0) + 0.5);
    results[RESULT_FILTER] = (double)filter;
    if (!legal(kp, ki, kd) || (filter > FIXPID_PID_FILTER_MAX)) {
        return false;
    }
    gains->kp_q8 = (uint16_t)FIXPID_FOLDED(kp);
    gains->ki_q24 = FIXPID_FOLDED(ki);
    gains->kd_q8 = (uint16_t)FIXPID_FOLDED(kd);
    gains->derivative_filter = (uint8_t)filter;
    return true;
}

static bool begin_pid(void)
{
    const unsigned options = (unsigned)param(PARAM_OPTIONS);
    struct fixpid_pid_config config = {
        .reverse = (options & TUNER_OPTION_REVERSE) != 0u,
        .derivative_on_error =
            (options & TUNER_OPTION_DERIVATIVE_ON_ERROR) != 0u,
        .proportional_on_measurement =
            (options & TUNER_OPTION_PROPORTIONAL_ON_MEASUREMENT) != 0u};
    const double weight = floor((param(PARAM_WEIGHT) * 256.0) + 0.5);
    const bool on_measurement = config.proportional_on_measurement;
    const bool fits =
        integer_16(PARAM_OUTPUT_MIN) && integer_16(PARAM_OUTPUT_MAX) &&
        integer_16(PARAM_INTEGRAL_MIN) && integer_16(PARAM_INTEGRAL_MAX);

    results[RESULT_OPTIONS] = param(PARAM_OPTIONS);
    // A weight of 0 is a bool, and 0 in the configuration means 256.
    results[RESULT_WEIGHT] = on_measurement ? 0.0 : weight;
    if (!folded(&config.gains) || !fits ||
        !(on_measurement || within(weight, 1.0, 256.0))) {
        return false;
    }
    config.output_min = (int16_t)param(PARAM_OUTPUT_MIN);
    config.output_max = (int16_t)param(PARAM_OUTPUT_MAX);
    config.integral_min = (int16_t)param(PARAM_INTEGRAL_MIN);
    config.integral_max = (int16_t)param(PARAM_INTEGRAL_MAX);
    config.setpoint_weight_q8 = (uint16_t)results[RESULT_WEIGHT];
    return fixpid_pid_init(&pid, &config);
}

static bool notes_gains(double most)
{
    for (int i = 0; i < 3; i++) {
        results[RESULT_KP + i] = floor(param(PARAM_KP + i) + 0.5);
        if (!within(results[RESULT_KP + i], 0.0, most)) {
            return false;
        }
    }
    return true;
}

static bool begin_an937(void)
{
    results[RESULT_FILTER] = param(PARAM_FILTER);
    if (!notes_gains(255.0) || !within(param(PARAM_FILTER), 1.0, 255.0) ||
        !within(param(PARAM_INTEGRAL_MAX), 1.0, 65535.0)) {
        return false;
    }
    const struct fixpid_an937_config config = {
        (uint8_t)results[RESULT_KP], (uint8_t)results[RESULT_KI],
        (uint8_t)results[RESULT_KD], (uint16_t)param(PARAM_INTEGRAL_MAX),
        (uint8_t)param(PARAM_FILTER)};
    return fixpid_an937_init(&an937, &config);
}

static bool begin_an964(void)
{
    if (!notes_gains(1023.0)) {
        return false;
    }
    const struct fixpid_an964_gains gains = {(uint16_t)results[RESULT_KP],
                                             (uint16_t)results[RESULT_KI],
                                             (uint16_t)results[RESULT_KD]};
    return fixpid_an964_init(&an964, &gains);
}

static bool begin(void)
{
    scene_begin(&scene);
    scene_begin(&twin_scene);
    twin_begin(&twin);
    drift = 0;
    twin_drift = 0;
    results[RESULT_DEAD_S] = scene_dead_s(&scene);
    switch ((int)param(PARAM_CONTROLLER)) {
    case TUNER_AN937:
        return begin_an937();
    case TUNER_AN964:
        return begin_an964();
    default:
        return begin_pid();
    }
}

static int16_t limited(int32_t output)
{
    return (int16_t)fmin(fmax(output, param(PARAM_OUTPUT_MIN)),
                         param(PARAM_OUTPUT_MAX));
}

// The note's drift offset, which brings a base that runs away back.
static int followed(int offset, double output)
{
    if (output < 0.0) {
        return (offset > -DRIFT_LIMIT) ? (offset - 1) : offset;
    }
    if (output > 0.0) {
        return (offset < DRIFT_LIMIT) ? (offset + 1) : offset;
    }
    return offset;
}

static bool fallen(int16_t measurement)
{
    return !within(measurement, UPRIGHT_COUNTS - ANGLE_LIMIT_COUNTS,
                   UPRIGHT_COUNTS + ANGLE_LIMIT_COUNTS);
}

static bool is_plant(int kind)
{
    return (int)param(PARAM_PLANT) == kind;
}

static bool is_reverse(void)
{
    return ((unsigned)param(PARAM_OPTIONS) & TUNER_OPTION_REVERSE) != 0u;
}

// What the firmware of a note's controller would pass to it.
static int16_t error_of(int16_t setpoint, int16_t measurement)
{
    const int32_t error = is_reverse() ? ((int32_t)measurement - setpoint)
                                       : ((int32_t)setpoint - measurement);

    return (int16_t)plant_limit(error * scene_error_per_count(), -32768.0,
                                32767.0);
}

static int16_t step_pendulum(int16_t measurement)
{
    if (fallen(measurement)) {
        fixpid_an964_reset(&an964);
        drift = 0;
        return 0;
    }
    const int16_t output = fixpid_an964_step(
        &an964, (int16_t)(measurement + (drift / 8) - UPRIGHT_COUNTS));
    drift = followed(drift, output);
    return output;
}

static void keep(int i, int32_t p, int32_t integral, int32_t d, int32_t flags)
{
    counts[COUNT_P][i] = p;
    counts[COUNT_I][i] = integral;
    counts[COUNT_D][i] = d;
    counts[COUNT_FLAGS][i] = flags;
}

static void keep_stage(int i, const struct fixpid_autotune_stage *stage)
{
    counts[COUNT_PHASE][i] = stage->phase;
    counts[COUNT_DONE][i] = stage->done;
    counts[COUNT_PERIOD][i] = stage->period;
}

static int16_t step(int i, int16_t setpoint, int16_t measurement)
{
    int16_t output;

    switch ((int)param(PARAM_CONTROLLER)) {
    case TUNER_AN937:
        fixpid_an937_tick(&an937);
        output =
            limited(fixpid_an937_step(&an937, error_of(setpoint, measurement)));
        keep(i, fixpid_an937_proportional(&an937),
             fixpid_an937_integral(&an937), fixpid_an937_derivative(&an937),
             fixpid_an937_flags(&an937));
        break;
    case TUNER_AN964:
        output = is_plant(TUNER_PENDULUM)
                     ? step_pendulum(measurement)
                     : limited(fixpid_an964_step(
                           &an964, error_of(setpoint, measurement)));
        keep(i, fixpid_an964_proportional(&an964),
             fixpid_an964_integral(&an964), fixpid_an964_derivative(&an964),
             fixpid_an964_flags(&an964));
        break;
    default:
        output = fixpid_pid_step(&pid, setpoint, measurement);
        keep(i, fixpid_pid_proportional(&pid), fixpid_pid_integral(&pid),
             fixpid_pid_derivative(&pid), fixpid_pid_flags(&pid));
        break;
    }
    return output;
}

static double step_twin(int16_t setpoint, int16_t measurement)
{
    const bool notes_pendulum =
        (param(PARAM_CONTROLLER) == TUNER_AN964) && is_plant(TUNER_PENDULUM);
    double error = error_of(setpoint, measurement);

    if (notes_pendulum && fallen(measurement)) {
        twin_begin(&twin);
        twin_drift = 0;
        return 0.0;
    }
    if (notes_pendulum) {
        error = measurement + (twin_drift / 8.0) - UPRIGHT_COUNTS;
    }
    const double output = twin_step(&twin, setpoint, measurement, error);
    twin_drift = followed(twin_drift, output);
    return output;
}

static void manual_or_limits(int what, double a, double b)
{
    const int16_t first = (int16_t)plant_limit(a, -32768.0, 32767.0);
    const int16_t second = (int16_t)plant_limit(b, -32768.0, 32767.0);

    switch (what) {
    case EVENT_MANUAL:
        fixpid_pid_set_manual(&pid, first);
        break;
    case EVENT_AUTO:
        fixpid_pid_set_auto(&pid);
        break;
    case EVENT_LIMITS:
        if (!fixpid_pid_set_limits(&pid, first, second)) {
            return; // the twin keeps its own, too
        }
        break;
    case EVENT_FEEDFORWARD:
        fixpid_pid_set_feedforward(&pid, first);
        break;
    default:
        break;
    }
    twin_event(&twin, what, first, second);
}

// Those that are due at step i, in their order.
static void happen(int i, double *setpoint)
{
    for (int e = 0; e < TUNER_EVENTS; e++) {
        const double *const event = &events[e * TUNER_EVENT_SIZE];
        const int what = (int)event[1];
        const double due = floor((event[0] * param(PARAM_RATE)) + 0.5);
        if ((what == EVENT_NONE) || ((int)due != i)) {
            continue;
        }
        if (what == EVENT_SETPOINT) {
            *setpoint = event[2];
        } else if (what == EVENT_LOAD) {
            scene_load(&scene, event[2]);
            scene_load(&twin_scene, event[2]);
        } else if (param(PARAM_CONTROLLER) == TUNER_PID) {
            manual_or_limits(what, event[2], event[3]);
        } else {
            // the notes' controllers have none of these
        }
    }
}

static void forget_results(void)
{
    for (int i = 0; i < TUNER_RESULTS; i++) {
        results[i] = 0.0;
    }
}

static void see(int i)
{
    values[VALUE_TRUE][i] = scene_value(&scene);
    values[VALUE_TWIN][i] = scene_value(&twin_scene);
    values[VALUE_BASE][i] = 0.0;
    if (scene.kind == TUNER_PENDULUM) {
        values[VALUE_BASE][i] = scene.pendulum.state[PENDULUM_POSITION];
    }
}

int tuner_run(void)
{
    static const struct fixpid_autotune_stage none = {0, 0, 0, 0};
    const int n = steps();
    double setpoint = param(PARAM_SETPOINT);

    forget_results();
    if (!begin()) {
        return -1;
    }
    for (int i = 0; i < n; i++) {
        happen(i, &setpoint);
        const int16_t r = scene_counts(setpoint);
        const int16_t y = scene_read(&scene);
        const int16_t u = step(i, r, y);
        const double twin_u = step_twin(r, scene_read(&twin_scene));
        counts[COUNT_SETPOINT][i] = r;
        counts[COUNT_MEASUREMENT][i] = y;
        counts[COUNT_OUTPUT][i] = u;
        values[VALUE_TWIN_OUTPUT][i] = twin_u;
        keep_stage(i, &none);
        see(i);
        scene_move(&scene, u);
        scene_move(&twin_scene, twin_u);
    }
    metrics_of_run(n);
    return n;
}

static bool begin_heat_up(void)
{
    const double drive = param(PARAM_OUTPUT_MAX) * param(PARAM_DRIVE) / 100.0;
    const struct fixpid_reaction_config config = {
        .output_rest = limited(0),
        .output_drive = limited((int32_t)floor(drive + 0.5)),
        .measurement_stop = scene_counts(param(PARAM_SETPOINT)),
        .timeout_steps = TIMEOUT_STEPS,
        .reverse = is_reverse(),
    };
    return fixpid_reaction_init(&reaction, &config);
}

static bool begin_relay(void)
{
    struct fixpid_autotune_config config = {
        .output_min = (int16_t)param(PARAM_OUTPUT_MIN),
        .output_max = (int16_t)param(PARAM_OUTPUT_MAX),
        .measurement_min = -1, // the plant may rest at the converter's end
        .measurement_max = (int16_t)sensor_top(),
        .swing = (uint16_t)param(PARAM_SWING),
        .timeout_steps = TIMEOUT_STEPS,
        .cycles = (uint8_t)param(PARAM_CYCLES),
        .reverse = is_reverse(),
    };
    config.output_rest = limited(0);
    return fixpid_autotune_init(&autotune, &config);
}

static bool experiment_runs(void)
{
    return heat_up
               ? (fixpid_reaction_status(&reaction) == FIXPID_REACTION_RUNNING)
               : (fixpid_autotune_status(&autotune) == FIXPID_AUTOTUNE_RUNNING);
}

static void heat_up_progress(struct fixpid_autotune_stage *stage)
{
    stage->done = fixpid_reaction_progress(&reaction);
    stage->expected = 100;
    stage->period = 0;
    if (!experiment_runs()) {
        stage->phase = PHASE_OVER;
    } else {
        stage->phase = (stage->done < LISTENS) ? PHASE_LISTENS : PHASE_HEATS;
    }
}

static void tell_heat_up(void)
{
    struct fixpid_reaction_process process;
    struct fixpid_autotune_stage stage;

    heat_up_progress(&stage);
    results[RESULT_STATUS] = fixpid_reaction_status(&reaction);
    results[RESULT_DONE] = stage.done;
    results[RESULT_EXPECTED] = stage.expected;
    if (fixpid_reaction_model(&reaction, &process)) {
        results[RESULT_HAS_MODEL] = 1.0;
        results[RESULT_GAIN] = FIXPID_AUTOTUNE_INTEGRATING;
        results[RESULT_DEAD] = process.dead_q4;
        results[RESULT_SLOPE] = process.slope_q24;
        results[RESULT_NOISE] = process.noise_q4;
    }
}

static void tell_relay(void)
{
    struct fixpid_autotune_process process;
    struct fixpid_autotune_stage stage;

    results[RESULT_STATUS] = fixpid_autotune_status(&autotune);
    fixpid_autotune_progress(&autotune, &stage);
    results[RESULT_DONE] = stage.done;
    results[RESULT_EXPECTED] = stage.expected;
    results[RESULT_PERIOD] = stage.period;
    if (fixpid_autotune_model(&autotune, &process)) {
        results[RESULT_HAS_MODEL] = 1.0;
        results[RESULT_GAIN] = process.gain_q8;
        results[RESULT_LAG] = process.lag_q4;
        results[RESULT_DEAD] = process.dead_q4;
        results[RESULT_SLOPE] = process.slope_q24;
        results[RESULT_HOLDING] = process.holding;
        results[RESULT_NOISE] = process.noise_q4;
        results[RESULT_HYSTERESIS] = process.hysteresis;
    }
}

// Of the model that was told, if there is one.
static void tell_guard(int16_t output_min, int16_t output_max)
{
    const struct fixpid_guard_model model = {
        .slope_q24 = (uint32_t)results[RESULT_SLOPE],
        .dead_q4 = (uint32_t)results[RESULT_DEAD],
        .noise_q4 = (uint16_t)results[RESULT_NOISE],
        .gain_q8 = (uint32_t)results[RESULT_GAIN],
    };
    struct fixpid_guard_config config = {.output_min = output_min,
                                         .output_max = output_max};

    if (fixpid_guard_from_model(&config, &model)) {
        results[RESULT_BAND] = config.band;
        results[RESULT_PATIENCE] = config.patience;
        results[RESULT_NOISY] = config.noisy ? 1.0 : 0.0;
    }
}

static int16_t step_experiment(int i, int16_t setpoint, int16_t measurement)
{
    struct fixpid_autotune_stage stage;
    int16_t output;

    if (heat_up) {
        output = fixpid_reaction_step(&reaction, measurement);
        heat_up_progress(&stage);
    } else {
        output = fixpid_autotune_step(&autotune, setpoint, measurement);
        fixpid_autotune_progress(&autotune, &stage);
    }
    keep_stage(i, &stage);
    return output;
}

int tuner_experiment(void)
{
    int n = 0;

    forget_results();
    heat_up = param(PARAM_EXPERIMENT) == EXPERIMENT_HEAT_UP;
    results[RESULT_EXPERIMENT] =
        heat_up ? EXPERIMENT_HEAT_UP : EXPERIMENT_RELAY;
    if (!(heat_up ? begin_heat_up() : begin_relay())) {
        return -1;
    }
    scene_begin(&scene);
    const int16_t r = scene_counts(param(PARAM_SETPOINT));
    while ((n < TUNER_STEPS) && experiment_runs()) {
        const int16_t y = scene_read(&scene);
        const int16_t u = step_experiment(n, r, y);
        counts[COUNT_SETPOINT][n] = r;
        counts[COUNT_MEASUREMENT][n] = y;
        counts[COUNT_OUTPUT][n] = u;
        keep(n, 0, 0, 0, 0);
        values[VALUE_TRUE][n] = scene_value(&scene);
        values[VALUE_TWIN][n] = 0.0;
        values[VALUE_TWIN_OUTPUT][n] = 0.0;
        values[VALUE_BASE][n] = 0.0;
        scene_move(&scene, u);
        n++;
    }
    if (heat_up) {
        tell_heat_up();
    } else {
        tell_relay();
    }
    tell_guard((int16_t)param(PARAM_OUTPUT_MIN),
               (int16_t)param(PARAM_OUTPUT_MAX));
    return n;
}

int tuner_pack(void)
{
    return (!heat_up && fixpid_autotune_pack(&autotune, &record)) ? 1 : 0;
}

// A number of the record, whose layout is in fixpid_autotune.h.
static int16_t recorded(int at)
{
    return (int16_t)(record.bytes[at] | (record.bytes[at + 1] << 8));
}

int tuner_unpack(void)
{
    forget_results();
    if (!fixpid_autotune_unpack(&autotune, &record)) {
        return 0;
    }
    heat_up = false;
    tell_relay();
    results[RESULT_OUTPUT_MIN] = recorded(RECORD_OUTPUT_MIN);
    results[RESULT_OUTPUT_MAX] = recorded(RECORD_OUTPUT_MAX);
    tell_guard(recorded(RECORD_OUTPUT_MIN), recorded(RECORD_OUTPUT_MAX));
    results[RESULT_OPTIONS] =
        (record.bytes[RECORD_REVERSE] != 0u) ? TUNER_OPTION_REVERSE : 0u;
    return 1;
}

static bool result_of(uint8_t rule, struct fixpid_pid_config *config)
{
    const uint8_t robustness = (uint8_t)param(PARAM_ROBUSTNESS);

    if (heat_up) {
        config->setpoint_weight_q8 = HEAT_UP_WEIGHT;
        return fixpid_reaction_result(&reaction, rule, robustness,
                                      &config->gains);
    }
    results[RESULT_REASON] =
        fixpid_autotune_reason(&autotune, rule, robustness);
    return fixpid_autotune_result(&autotune, rule, robustness, config);
}

int tuner_rule(int rule)
{
    struct fixpid_pid_config config = {.output_min = 0};
    const bool has = result_of((uint8_t)rule, &config);

    // A rule without gains leaves zeros.
    results[RESULT_KP] = config.gains.kp_q8;
    results[RESULT_KI] = config.gains.ki_q24;
    results[RESULT_KD] = config.gains.kd_q8;
    results[RESULT_FILTER] = config.gains.derivative_filter;
    results[RESULT_WEIGHT] = config.setpoint_weight_q8;
    return has ? 1 : 0;
}

double *tuner_fit_values(void)
{
    return fit.f;
}

int tuner_fit(int first, int last, int most)
{
    fit.first = first;
    fit.last = last;
    return fit_least(&fit, most) ? fit.count : 0;
}

struct fixpid_table_point *tuner_fit_points(void)
{
    return fit.points;
}

double tuner_fit_error(void)
{
    return fit.error;
}
