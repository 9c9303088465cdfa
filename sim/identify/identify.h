// SPDX-License-Identifier: MIT
// A plant from a recording of what drove it and what was measured. It says how
// well each number is known, and whether a loop with gains from it is safe:
// SIMC's PI has Ms of at most 2.2 with nine of ten plants that the recording
// allows. The recording may begin on the move or cold, end before the plant has
// settled, have several steps, or come from a closed loop.
//
// Doubles only. It uses no heap, and of the system sqrt, exp, log, sin, cos,
// atan2, fabs and floor. It works in memory of its own: one call at a time.
#ifndef IDENTIFY_H
#define IDENTIFY_H
#include <stdbool.h>

#define IDENTIFY_LINES 1500 // that a fit looks at; of more it takes means
#define IDENTIFY_PLANTS 32

enum identify_kind {
    IDENTIFY_FIRST,       // a lag
    IDENTIFY_SECOND,      // two lags
    IDENTIFY_INTEGRATING, // an integrator with a lag
    IDENTIFY_RINGING,     // an oscillator
    IDENTIFY_KINDS
};

enum identify_reason {
    IDENTIFY_USABLE,
    IDENTIFY_FEW_LINES,    // fewer than 8
    IDENTIFY_TIME,         // goes back, or stands still
    IDENTIFY_DRIVE_STANDS, // the drive never moves
    IDENTIFY_NO_RESPONSE,  // the measurement does not follow the drive
    IDENTIFY_NO_MODEL,     // it moves as no model does
    IDENTIFY_SLOW_LINES,   // all is over between two lines
    IDENTIFY_UNSURE_GAIN,  // not safe: mostly the gain is not known well enough
    IDENTIFY_UNSURE_LAG,
    IDENTIFY_UNSURE_DEAD,
    IDENTIFY_UNSURE_START, // it moved before the drive did: why is not known
    IDENTIFY_REASONS
};

// How the plant was before the drive first moved.
enum identify_start {
    IDENTIFY_SETTLED, // at rest, with the drive of the first line or `before`
    IDENTIFY_COLD,    // at rest without drive, which comes on at the first line
    IDENTIFY_MOVING,  // on its way from what was before
    IDENTIFY_DRIFTING // drifting evenly, and does so to the end
};

// The gain is in units of the measurement for a unit of the drive, of an
// integrator each second. All else is in seconds but the damping.
struct identify_plant {
    int kind;    // enum identify_kind
    double gain; // may be negative
    double lag;  // 0 of an integrator; of an oscillator 1 / (its radians per s)
    double lag2; // of two lags the shorter; of an integrator its only one
    double damping; // of an oscillator
    double dead;
};

struct identify_model {
    struct identify_plant plant;
    double rest;  // the measurement without drive; of an integrator, at first
    double holds; // the drive that holds an integrator where it is; else 0
    int start;    // enum identify_start
    double error; // root mean square of what the model leaves over
    double part;  // that, as a part of what the drive moved
    double noise; // of the measurement, from line to line
    double score; // the least is the best

    // Standard deviations: of ln(gain) and ln(lag), of lag2 and the dead time
    // in seconds. An integrator's sd_lag is that of its lag in seconds, and an
    // oscillator's sd_lag2 that of its damping.
    double sd_gain;
    double sd_lag;
    double sd_lag2;
    double sd_dead;
    double r2;

    // The time constant of the loop must be `calm` times that of SIMC's rule
    // to be safe: 1, 2 or 4. 0: no such loop is.
    double calm;
    double risk; // the part of the plants with Ms above 2.2 if calm is 1
    double ms;   // with `calm`, nine of ten plants have at most this Ms
    int reason;  // enum identify_reason
};

// The lines' times rise and are in seconds. No value is NaN.
struct identify_recording {
    int lines;
    const double *t;
    const double *u;   // what drives the plant from this line to the next
    const double *y;   // the measurement
    double before;     // the plant stood still with this drive until line 1
    bool before_known; // false: how it was is found out as far as lines tell
};

struct identify_result {
    // Without 8 lines in order, a move of the drive and a second value of the
    // measurement there is no model: all of them are zeros.
    int reason;   // enum identify_reason, of the chosen model
    int chosen;   // enum identify_kind
    double every; // the median of the seconds between lines
    bool assumed; // that the plant stood still at first: too few lines tell
    int outliers; // lines that stand alone, which were left out
    double stuck_from; // the sensor stood still from here to there, which was
    double stuck_to;   // left out. Seconds after the first line; both 0: never
    struct identify_model models[IDENTIFY_KINDS];

    // By the recording each of these is as likely as the next.
    struct identify_plant plants[IDENTIFY_PLANTS];
};

void identify(const struct identify_recording *recording,
              struct identify_result *result);

// SIMC's gains for a controller that steps each `step` seconds: kp, ki in units
// of kp per second, kd in seconds of kp. The loop's time constant is `calm`
// times that of the rule.
void identify_simc(const struct identify_plant *plant, double step, double calm,
                   double gains[3]);

// Ms of the loop of these gains and this plant in continuous time, with half a
// step of dead time more for the controller's hold; 1e9 where it is unstable.
// loop.h has the sampled loop of a controller with its integers.
double identify_ms(const struct identify_plant *plant, double step,
                   const double gains[3]);

// What a model of the last recording measures at the lines that were kept, and
// their seconds after the first line. Returns how many: IDENTIFY_LINES at most.
int identify_curve(const struct identify_model *model, double *t, double *y);

#endif
