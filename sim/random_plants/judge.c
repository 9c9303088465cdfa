// SPDX-License-Identifier: MIT
#include "judge.h"

#include <math.h>
#include <stdlib.h>

#include "answer.h"

#define HALF_TURN 3.141592653589793

// One that is unstable has a linear plant, too, as no answer of it comes to an
// end.
static bool is_measured(const struct subject *subject)
{
    return subject->machine != NULL && !subject->plant.unstable;
}

// Below it nothing happens.
static double least_radians(const struct subject *subject)
{
    return fmin(2.0 * HALF_TURN / subject->period_steps / 60.0,
                0.02 / linear_steps(&subject->plant));
}

void judge_start(struct judge *self, const struct subject *subject, int points)
{
    const bool measured = is_measured(subject);
    static struct answer answer;
    struct sampled sampled;
    double least;

    self->points = points;
    self->integrating = subject->plant.integrating;
    self->unstable = subject->plant.unstable;
    if (measured) {
        answer_of(&answer, subject->machine);
        least = answer.least;
    } else {
        sampled_start(&sampled, &subject->plant);
        least = least_radians(subject);
    }
    for (int i = 0; i < self->points; i++) {
        const double share = (double)i / (points - 1);
        const double radians = least * pow(HALF_TURN / least, share);
        self->before[i] = cexp(-I * radians);
        self->sum[i] = 1.0 / (1.0 - self->before[i]);
        self->response[i] = measured ? answer_response(&answer, radians)
                                     : sampled_response(&sampled, radians);
    }
}

// The controller's response at one of the frequencies: see fixpid_pid_step.
static double complex controller(const struct judge *self,
                                 const struct design *design, int at)
{
    const double complex before = self->before[at];
    const double kept = 1.0 - ldexp(1.0, -design->filter);
    const double complex answer = design->kp + (design->ki * self->sum[at]);

    if (design->kd == 0.0) {
        return answer;
    }
    return answer + (design->kd * (1.0 - before) / (1.0 - (kept * before)));
}

// From pi radians down to the lowest frequency, the curve of 1 + loop turns by
// a quarter turn around 0 for the controller's integrator, one more for the
// plant's, and half a turn for an unstable pole.
static bool is_stable(const struct judge *self, double turned)
{
    const double wanted =
        -HALF_TURN * (((self->integrating ? 2.0 : 1.0) / 2.0) +
                      (self->unstable ? 1.0 : 0.0));

    return fabs(turned - wanted) < 2.6;
}

// 1 if the angle grows beyond half a turn from one point to the next, -1 if it
// falls below minus half a turn: if they are on both sides of the negative
// axis.
static int passes(double complex from, double complex to)
{
    const double area = (creal(from) * cimag(to)) - (creal(to) * cimag(from));
    const bool was_above = cimag(from) >= 0.0;
    const bool is_above = cimag(to) >= 0.0;

    if (was_above == is_above) {
        return 0;
    }
    return was_above ? (area > 0.0) : -(area < 0.0);
}

static double square(double complex value)
{
    return (creal(value) * creal(value)) + (cimag(value) * cimag(value));
}

double judge_sensitivity(const struct judge *self, const struct design *design)
{
    double complex last = 1.0;
    double first_angle = 0.0;
    double least = HUGE_VAL;
    int turns = 0;

    for (int i = self->points - 1; i >= 0; i--) {
        const double complex curve =
            1.0 + (controller(self, design, i) * self->response[i]);
        if (i == self->points - 1) {
            first_angle = carg(curve);
        } else {
            turns += passes(last, curve);
        }
        least = fmin(least, square(curve));
        last = curve;
    }
    // Or its sign changes with every step.
    if (fabs(first_angle) < 1.0 &&
        is_stable(self, carg(last) + (2.0 * HALF_TURN * turns))) {
        return 1.0 / sqrt(least);
    }
    return HUGE_VAL;
}

double judge_told(const struct judge *self, const struct design *design)
{
    const double found = design->found ? judge_sensitivity(self, design) : 0.0;

    return (found < HUGE_VAL) ? found : -1.0;
}

// Gains with which the loop is nearer to -1 than it may be.
struct gap {
    double from;
    double to;
};

static int by_start(const void *one, const void *other)
{
    const double a = ((const struct gap *)one)->from;
    const double b = ((const struct gap *)other)->from;

    return (a > b) - (a < b);
}

// |1 + gain shape| < 1 / most between the two roots of a quadratic equation.
static int forbidden(const struct judge *self, const double complex *shape,
                     double most, struct gap *gaps)
{
    int count = 0;

    for (int i = 0; i < self->points; i++) {
        const double real = creal(shape[i]);
        const double norm = square(shape[i]);
        const double inside =
            (real * real) - ((1.0 - (1.0 / (most * most))) * norm);
        if (real < 0.0 && inside > 0.0) {
            gaps[count].from = (-real - sqrt(inside)) / norm;
            gaps[count].to = (-real + sqrt(inside)) / norm;
            count++;
        }
    }
    qsort(gaps, (size_t)count, sizeof gaps[0], by_start);
    return count;
}

// The largest gain of a stable loop that is at the beginning of a gap.
static double largest_gain(const struct judge *self,
                           const double complex *shape, double reset,
                           double most)
{
    struct gap gaps[JUDGE_FINE];
    const int count = forbidden(self, shape, most, gaps);
    double reached = 0.0;
    double largest = 0.0;

    for (int i = 0; i < count; i++) {
        if (gaps[i].from > reached * 1.0001) {
            const double kp = gaps[i].from * 0.9999;
            const struct design design = {true, kp, kp / reset, 0.0, 0};
            if (judge_sensitivity(self, &design) < HUGE_VAL) {
                largest = kp;
            }
        }
        reached = fmax(reached, gaps[i].to);
    }
    return largest;
}

struct design judge_best(const struct judge *self, double period_steps,
                         double most)
{
    double complex shape[JUDGE_FINE];
    struct design best = {false, 0.0, 0.0, 0.0, 0};

    for (int i = 0; i < 44; i++) {
        const double reset = period_steps * 0.05 * pow(1.16, i);
        const struct design unit = {true, 1.0, 1.0 / reset, 0.0, 0};
        double kp;
        for (int j = 0; j < self->points; j++) {
            shape[j] = controller(self, &unit, j) * self->response[j];
        }
        kp = largest_gain(self, shape, reset, most);
        if (kp / reset > best.ki) {
            best = (struct design){true, kp, kp / reset, 0.0, 0};
        }
    }
    return best;
}
