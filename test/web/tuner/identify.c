// SPDX-License-Identifier: MIT
// sim/identify/identify.h on recordings of plants that are known. Each line of
// expected.csv names a recording, the drive before it if that is known, and a
// verdict: usable, refused, a reason, or safe, which may be either. What is
// usable must have numbers within the ranges: the gain; the slope, which is the
// gain by lag + lag2 / 2 and an integrator's gain; the delay, dead time + lag2
// /
// 2. And Ms of SIMC's PI with the plant that made the recording is below 2.3.
//
//   identify FOLDER      prints `ok FILE` or `FAILED FILE` with what was found,
//                        in so many digits that no other number has them
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "identify.h"
#include "loop.h"

#define LINES 20000
#define MOST_MS 2.3
#define FIELDS 15

enum field { FILE_NAME, BEFORE, VERDICT, GAIN, SLOPE = 5, DELAY = 7 };
enum truth { INTEGRATES = 9, TRUE_GAIN, TRUE_DEAD, TRUE_LAGS };

static const char *const REASONS[IDENTIFY_REASONS] = {
    "usable",      "few_lines",   "time",        "drive_stands",
    "no_response", "no_model",    "slow_lines",  "unsure_gain",
    "unsure_lag",  "unsure_dead", "unsure_start"};

static double t[LINES];
static double u[LINES];
static double y[LINES];
static struct identify_result found;

static FILE *opened(const char *folder, const char *name)
{
    char path[500];
    (void)snprintf(path, sizeof(path), "%s/%s", folder, name);
    FILE *const file = fopen(path, "r");
    if (file == NULL) {
        perror(path);
        exit(2);
    }
    return file;
}

static int recorded(const char *folder, const char *name)
{
    char line[200];
    int n = 0;
    FILE *const file = opened(folder, name);
    while ((n < LINES) && (fgets(line, sizeof(line), file) != NULL)) {
        n += (sscanf(line, "%lf,%lf,%lf", &t[n], &u[n], &y[n]) == 3) ? 1 : 0;
    }
    (void)fclose(file);
    return n;
}

// Lags in a chain, and behind them an integral.
static struct loop_plant true_plant(char *const *row)
{
    struct loop_plant p = {0};
    const double gain = atof(row[TRUE_GAIN]);
    p.dead = atof(row[TRUE_DEAD]);
    p.scale = p.dead;
    for (int i = 0; (i < 3) && (atof(row[TRUE_LAGS + i]) > 0.0); i++) {
        const double lag = atof(row[TRUE_LAGS + i]);
        p.a[i][i] = -1.0 / lag;
        *((i == 0) ? &p.b[0] : &p.a[i][i - 1]) = 1.0 / lag;
        p.scale += lag;
        p.states = i + 1;
    }
    if (atoi(row[INTEGRATES]) != 0) {
        p.a[p.states][p.states - 1] = gain;
        p.states++;
    }
    p.c[p.states - 1] = (atoi(row[INTEGRATES]) != 0) ? 1.0 : gain;
    return p;
}

static double true_ms(char *const *row, const struct identify_model *m)
{
    static struct loop_margins margins;
    const struct loop_plant plant = true_plant(row);
    const double step = plant.scale / 40.0;
    double gains[3];
    identify_simc(&m->plant, step, m->calm, gains);
    const struct loop_controller pi = {.kp = gains[0],
                                       .ki = gains[1] * step,
                                       .kd = gains[2] / step,
                                       .derivative = LOOP_FILTERED,
                                       .period = 1};
    loop_margins(&plant, &pi, step, &margins);
    return margins.stable ? margins.ms : 1e9;
}

// Of a range whose ends are the field and the next; empty: any.
static int within(char *const *row, int field, double value)
{
    return (row[field][0] == '\0') ||
           ((value >= atof(row[field])) && (value <= atof(row[field + 1])));
}

static const char *wrong(char *const *row)
{
    const struct identify_model *const m = &found.models[found.chosen];
    const struct identify_plant *const p = &m->plant;
    const char *const verdict = row[VERDICT];
    const int usable = found.reason == IDENTIFY_USABLE;
    const double lags = p->lag + (p->lag2 / 2.0);
    const int integrates = p->kind == IDENTIFY_INTEGRATING;
    const int expected =
        (strcmp(verdict, "safe") == 0) ||
        (strcmp(verdict, usable ? "usable" : "refused") == 0) ||
        (strcmp(verdict, REASONS[found.reason]) == 0);
    if (!expected || !usable) {
        return expected ? NULL : "the verdict";
    }
    return !within(row, GAIN, p->gain) ? "the gain"
           : !within(row, SLOPE, p->gain / (integrates ? 1.0 : lags))
               ? "the slope"
           : !within(row, DELAY, p->dead + (p->lag2 / 2.0)) ? "the delay"
           : (true_ms(row, m) < MOST_MS)                    ? NULL
                                                            : "Ms";
}

static int checked(const char *folder, char *const *row)
{
    const int n = recorded(folder, row[FILE_NAME]);
    const struct identify_recording in = {
        n, t, u, y, atof(row[BEFORE]), row[BEFORE][0] != '\0'};
    identify(&in, &found);
    const struct identify_model *const m = &found.models[found.chosen];
    const struct identify_plant *const p = &m->plant;
    const char *const fault = wrong(row);
    (void)printf("%s identify %s: %s %d %.17g %.17g %.17g %.17g %.17g %g%s%s\n",
                 (fault == NULL) ? "ok" : "FAILED", row[FILE_NAME],
                 REASONS[found.reason], p->kind, p->gain, p->lag, p->lag2,
                 p->damping, p->dead, m->calm,
                 (fault == NULL) ? "" : ", which is wrong: ",
                 (fault == NULL) ? "" : fault);
    return fault == NULL;
}

int main(int count, char **arguments)
{
    char line[500];
    int good = 1;
    if (count != 2) {
        return 2;
    }
    FILE *const list = opened(arguments[1], "expected.csv");
    (void)fgets(line, sizeof(line), list); // the names
    while (fgets(line, sizeof(line), list) != NULL) {
        char *row[FIELDS];
        char *next = line;
        for (int i = 0; i < FIELDS; i++) {
            row[i] = next;
            next += strcspn(next, ",\n");
            *next++ = '\0';
        }
        good &= checked(arguments[1], row);
    }
    (void)fclose(list);
    return good ? 0 : 1;
}
