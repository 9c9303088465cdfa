// SPDX-License-Identifier: MIT
// What the tuner page computes: the library's controllers and its tuners in
// closed loop with the plants of sim/plant, and beside them the same law in
// double precision. Compiled to WebAssembly for the page and natively for
// Python's package, it gives the same numbers: see libm/math.h.
//
// The caller fills tuner_params and tuner_events and calls tuner_run or
// tuner_experiment, or fills tuner_record and calls tuner_unpack; what comes of
// it is in tuner_counts, tuner_values and tuner_results.
// tools/lib/pages/tuner.rb reads the lists of names for the page.
#ifndef TUNER_H
#define TUNER_H
#include <stdint.h>

#include "fixpid_table.h"

#define TUNER_STEPS 20000 // at most
#define TUNER_EVENTS 16
#define TUNER_EVENT_SIZE 4 // seconds, enum tuner_event, and two values

// Bits of PARAM_OPTIONS and RESULT_OPTIONS.
#define TUNER_OPTION_REVERSE 0x80u
#define TUNER_OPTION_DERIVATIVE_ON_ERROR 0x40u
#define TUNER_OPTION_PROPORTIONAL_ON_MEASUREMENT 0x20u

enum tuner_controller { TUNER_PID, TUNER_AN937, TUNER_AN964 };

enum tuner_plant {
    TUNER_LAGS,       // two lags and dead time
    TUNER_OSCILLATOR, // second order with little damping
    TUNER_INTEGRATOR, // with a lag and dead time
    TUNER_OVEN,       // plant_oven.h
    TUNER_MOTOR,      // plant_motor.h
    TUNER_PENDULUM    // plant_pendulum.h
};

enum tuner_experiment_kind {
    EXPERIMENT_RELAY,  // fixpid_autotune
    EXPERIMENT_HEAT_UP // fixpid_reaction, which stops before the setpoint
};

enum tuner_param {
    PARAM_CONTROLLER,
    PARAM_PLANT,

    // The plant, in units of the measurement and seconds. Of a motor the gain
    // is the supply in V, t1 the inertia in 1e-6 kg m^2 and t2 the friction in
    // mN m; of a pendulum the gain is the base's full speed in m/s, t1 the
    // motor's time constant and t2 the rod in m.
    PARAM_GAIN,
    PARAM_T1,
    PARAM_T2,
    PARAM_DAMPING,
    PARAM_DEAD,
    PARAM_START, // the measurement at rest; of a pendulum degrees of release

    PARAM_SENSOR_BITS,
    PARAM_SENSOR_LOW, // units at count 0
    PARAM_SENSOR_RANGE,
    PARAM_NOISE, // counts, each side, evenly

    PARAM_OUTPUT_MIN,
    PARAM_OUTPUT_MAX,
    PARAM_RATE, // steps per second
    PARAM_DURATION,
    PARAM_SETPOINT,

    // Of fixpid_pid in real units; of the notes' controllers the integers.
    PARAM_KP,
    PARAM_KI,
    PARAM_KD,
    PARAM_FILTER, // AN937: ticks per derivative sample
    PARAM_WEIGHT, // 0..1
    PARAM_OPTIONS,
    PARAM_INTEGRAL_MIN,
    PARAM_INTEGRAL_MAX, // AN937: the accumulated error's limit

    // Of the experiment.
    PARAM_EXPERIMENT, // of enum tuner_experiment_kind
    PARAM_SWING,      // of a relay, as PARAM_CYCLES
    PARAM_CYCLES,
    PARAM_DRIVE, // of a heat-up: its output, in percent of the highest
    PARAM_ROBUSTNESS,

    TUNER_PARAMS
};

enum tuner_event {
    EVENT_NONE,
    EVENT_SETPOINT,
    EVENT_LOAD, // of full drive; a motor's in N m; a pendulum's shove in rad/s2
    EVENT_MANUAL, // counts
    EVENT_AUTO,
    EVENT_LIMITS,     // lowest and highest output
    EVENT_FEEDFORWARD // counts
};

// Series of whole numbers.
enum tuner_count {
    COUNT_SETPOINT,
    COUNT_MEASUREMENT,
    COUNT_OUTPUT,
    COUNT_P, // as the controller's function gives it
    COUNT_I,
    COUNT_D,
    COUNT_FLAGS,
    COUNT_PHASE, // of an experiment, as fixpid_autotune_progress has it; of a
                 // heat-up 0 listens, 1 heats, 6: it is over
    COUNT_DONE,  // cycles, or percent
    COUNT_PERIOD,
    COUNT_LIMITED, // of a run: 1 where its output was limited, or 0
    TUNER_COUNTS
};

// Series in double precision.
enum tuner_value {
    VALUE_TRUE,        // units, before the sensor
    VALUE_TWIN,        // the same beside the law in double precision
    VALUE_TWIN_OUTPUT, // counts
    VALUE_BASE,        // of a pendulum, m
    TUNER_VALUES
};

enum tuner_result {
    RESULT_KP, // the integers that the controller has
    RESULT_KI,
    RESULT_KD,
    RESULT_FILTER,
    RESULT_WEIGHT, // x 256, as in the configuration
    RESULT_OPTIONS,
    RESULT_DEAD_S,     // the dead time as it is simulated
    RESULT_OUTPUT_MIN, // of a record that was unpacked
    RESULT_OUTPUT_MAX,
    RESULT_EXPERIMENT, // of enum tuner_experiment_kind
    RESULT_STATUS,     // of the experiment, as all below
    RESULT_DONE,
    RESULT_EXPECTED,
    RESULT_PERIOD,
    RESULT_HAS_MODEL, // 1, or 0: then the model is zeros
    RESULT_GAIN, // of a heat-up as of what integrates; it has no lag, holding
                 // output and hysteresis
    RESULT_LAG,
    RESULT_DEAD,
    RESULT_SLOPE,
    RESULT_HOLDING,
    RESULT_NOISE,
    RESULT_HYSTERESIS,
    RESULT_BAND, // of the plant's guard; 0: it has none
    RESULT_PATIENCE,
    RESULT_NOISY,
    RESULT_REASON, // why the rule of a relay has no gains
    TUNER_RESULTS
};

// What a run is worth; -1 is none.
enum tuner_metric {
    METRIC_OVERSHOOT,  // as a part of the first step change
    METRIC_RISE,       // seconds to 90 % of it
    METRIC_SETTLED,    // seconds from which on it stays within 2 % of it
    METRIC_LOAD,       // units: the largest error after the first load
    METRIC_MEAN_ERROR, // units, of its size
    METRIC_IAE,        // its integral, units times seconds
    METRIC_MOVED,      // counts of the output from step to step, on average
    METRIC_LIMITED,    // the part of the steps whose output was limited
    METRIC_TWIN_MOST,  // counts of the sensor from the law in double precision
    METRIC_TWIN_RMS,
    METRIC_TRAVEL, // of a pendulum's base, m
    TUNER_METRICS
};

double *tuner_params(void);
double *tuner_events(void);
double *tuner_results(void);
double *tuner_metrics(void);
uint8_t *tuner_record(void); // FIXPID_AUTOTUNE_RECORD_SIZE bytes
int32_t *tuner_counts(int series);
double *tuner_values(int series);

// The scene from its start. Returns its steps, or -1 where the controller
// refuses a value; the integers are in tuner_results, and what the run is worth
// in tuner_metrics.
int tuner_run(void);

// A tuner in the controller's place, without events: fixpid_autotune at the
// setpoint, or fixpid_reaction on the way to it. Returns its steps, or -1 where
// it is refused; its status, its model and the guard that
// fixpid_guard_from_model makes of it are in tuner_results.
int tuner_experiment(void);

// The record of the relay's experiment, into tuner_record. Returns 1, or 0
// where there is none: it has not ended within TUNER_STEPS, or it was refused.
int tuner_pack(void);

// The experiment that tuner_record has, maybe a chip's: its status, its model,
// its guard and its range of outputs are in tuner_results, and in
// RESULT_OPTIONS whether it is reverse acting. Returns 1, or 0 where the record
// is refused.
int tuner_unpack(void);

// The gains of one rule after one of these, by the robustness of the
// parameters, in tuner_results. Returns 1, or 0 where the rule has none, which
// are zeros then; RESULT_REASON says why.
int tuner_rule(int rule);

// The points of a table, as fit.h finds them: the caller fills tuner_fit_values
// with the function at first, first + 1, .. last. Returns the points that are
// used, `most` at most, or 0 where that is refused; their x and y follow each
// other in tuner_fit_points.
double *tuner_fit_values(void);
int tuner_fit(int first, int last, int most);
struct fixpid_table_point *tuner_fit_points(void);
double tuner_fit_error(void);

#endif
