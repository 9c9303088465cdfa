// SPDX-License-Identifier: MIT
// What identify.c is made of.
#ifndef IDENTIFY_PARTS_H
#define IDENTIFY_PARTS_H
#include "identify.h"

#define MOVES 1500 // of the drive; where there are more, it is averaged
#define NUMBERS 3  // of a model, at most, that a search moves
#define REST 6     // lines tell surely that the plant is at rest
#define COLUMNS 4  // of a model's linear part, at most

struct lines {
    int n;
    double t[IDENTIFY_LINES]; // seconds after the recording's first line
    double y[IDENTIFY_LINES];
    double use[IDENTIFY_LINES];    // 1, or 0: the sensor stood still
    double weight[IDENTIFY_LINES]; // less than `use` of what is far away
    double heavy[IDENTIFY_LINES];  // the weight that the last projection used
    double left[IDENTIFY_LINES];   // what the last projection left over
};

struct record {
    struct lines all;
    struct lines few; // of all, for a search

    // The drive from a time on. The first is at 0; it is a move only if the
    // drive is known to have been another one before.
    int moves;
    double at[MOVES];
    double to[MOVES];
    double before;
    int first; // index of the first that is a move

    int rest_lines; // before that move
    int rest;       // 1 if they stand still, 0 if they do not, -1: none tells

    double span;    // seconds from the first line to the last
    double every;   // the median of the seconds between lines
    double gap;     // the mean of that about a move, by the move's size
    double swing;   // of the measurement, without the outermost lines
    double noise;   // of the measurement, from line to line
    double quantum; // the least step that the measurement makes
};

// What a search moves, any real numbers: ln(lag), dead time and a third one.
struct numbers {
    double x[NUMBERS];
};

// A kind of model with a start, and the lines that it is fitted to.
struct task {
    const struct record *record;
    struct lines *lines;
    int kind;  // enum identify_kind
    int start; // enum identify_start
};

// A model's linear part: the measurement is the sum of its columns, each times
// its factor. The first column is 1, the last the answer to the drive, whose
// factor is the gain. Between them is what remains of the start.
struct projection {
    int columns;
    double factor[COLUMNS];
    double fresh;   // weighted square of what only the answer can explain
    double square;  // weighted square of what is left over
    double weights; // their sum
};

double squared(double x);
double limited(double x, double low, double high);

// The value that k of n are below. It changes their order.
double nth(double *values, int n, int k);

// ---- record.c ----

// Keeps a recording. Returns why it cannot be identified, or IDENTIFY_USABLE;
// fills what the result says of the lines.
int record_keep(struct record *self, const struct identify_recording *from,
                struct identify_result *result);

// The square of an error that is as good as none.
double record_exact(const struct record *self);

// Leaves out the lines where the sensor stood still although the model of the
// last projection over all lines moved, if there are such, and says where.
bool record_leave_stuck(struct record *self, struct identify_result *result);

// ---- model.c ----

int model_numbers(int kind);                                    // 2 or 3
struct identify_plant model_plant(int kind, struct numbers at); // of gain 1
double model_before(const struct task *task); // the drive that it started from

// A dead time must be less than this.
double model_latest(const struct record *record, int start);

struct projection model_project(const struct task *task,
                                const struct identify_plant *plant);
double model_error(const struct task *task, struct numbers at);

// The sum of products of two columns by the weights of the last projection.
double model_product(const struct lines *lines, const double *a,
                     const double *b);

// ---- search.c ----

// The numbers with the least error over the task's lines, from anywhere.
struct numbers search_all(const struct task *task);

// The same from a place near it, with weights for lines that are far away. Its
// first steps are `part` of the lag.
struct numbers search_near(const struct task *task, struct numbers from,
                           double part);

void search_unweigh(struct lines *lines);
void search_weigh(const struct task *task, const struct identify_plant *plant);

// ---- gains.c ----

// The plant is its gain over a[0] + a[1] s + a[2] s^2, and its dead time.
void identify_denominator(const struct identify_plant *plant, double a[3]);

// ---- doubt.c ----

// Prepares a kind's share of the plants that the recording allows, and fills
// the model's standard deviations.
void doubt_about(const struct task *task, struct numbers best,
                 struct identify_model *model);

// Equally likely plants of all kinds, each kind by its weight.
void doubt_draw(const double weight[IDENTIFY_KINDS],
                struct identify_plant plants[IDENTIFY_PLANTS]);

#endif
