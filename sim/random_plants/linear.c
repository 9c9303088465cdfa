// SPDX-License-Identifier: MIT
#include "linear.h"

#include <assert.h>
#include <math.h>
#include <string.h>

void linear_add(struct linear *self, struct section section)
{
    assert(self->count < LINEAR_SECTIONS);
    self->sections[self->count] = section;
    self->count++;
}

void linear_lag(struct linear *self, double lag)
{
    linear_add(self, (struct section){{1.0, 0.0}, {1.0, lag, 0.0}});
}

void linear_integrate(struct linear *self)
{
    linear_add(self, (struct section){{1.0, 0.0}, {0.0, 1.0, 0.0}});
    self->integrating = true;
}

// An integrator has no time of its own: linear_amplify says how fast it is.
void linear_stretch(struct linear *self, double factor)
{
    self->dead_steps *= factor;
    for (int i = 0; i < self->count; i++) {
        struct section *const section = &self->sections[i];
        section->numerator[1] *= factor;
        if (section->denominator[0] != 0.0) {
            section->denominator[1] *= factor;
        }
        section->denominator[2] *= factor * factor;
    }
}

void linear_amplify(struct linear *self, double gain)
{
    self->sections[0].numerator[0] *= gain;
    self->sections[0].numerator[1] *= gain;
}

double linear_phase(const struct linear *self, double radians)
{
    double phase = -radians * self->dead_steps;

    for (int i = 0; i < self->count; i++) {
        const double *const top = self->sections[i].numerator;
        const double *const bottom = self->sections[i].denominator;
        const double real = bottom[0] - (bottom[2] * radians * radians);
        phase += atan2(top[1] * radians, top[0]);
        phase -= atan2(bottom[1] * radians, real);
    }
    return phase;
}

double linear_crossing(const struct linear *self, double phase)
{
    double low = 1e-4;
    double high;

    while (self->unstable && linear_phase(self, low) <= phase && low < 1e3) {
        low *= 1.02;
    }
    high = low;
    while (linear_phase(self, high) > phase && high < 1e6) {
        low = high;
        high *= 1.05;
    }
    for (int i = 0; i < 50; i++) {
        const double middle = sqrt(low * high);
        if (linear_phase(self, middle) > phase) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

double linear_steps(const struct linear *self)
{
    double steps = self->dead_steps;

    for (int i = 0; i < self->count; i++) {
        const double *const bottom = self->sections[i].denominator;
        if (bottom[0] != 0.0) {
            steps += fabs(bottom[1] / bottom[0]) + sqrt(bottom[2]);
        }
    }
    return steps;
}

// The plant without its dead time: x' = a x + b u, y = c x.
struct continuous {
    int states;
    double a[LINEAR_STATES][LINEAR_STATES];
    double b[LINEAR_STATES];
    double c[LINEAR_STATES];
    double direct; // and that times u
};

// A state more, whose change is what comes in over `divisor`.
static int add_state(struct continuous *self, double divisor)
{
    const int state = self->states;

    assert(state < LINEAR_STATES);
    for (int i = 0; i < state; i++) {
        self->a[state][i] = self->c[i] / divisor;
    }
    self->b[state] = self->direct / divisor;
    self->states++;
    return state;
}

// x' = (v - bottom0 x) / bottom1, y = top0 x + top1 x'
static void chain_first(struct continuous *self, const struct section *section)
{
    const double *const top = section->numerator;
    const double *const bottom = section->denominator;
    const int state = add_state(self, bottom[1]);

    self->a[state][state] = -bottom[0] / bottom[1];
    for (int i = 0; i < state; i++) {
        self->c[i] *= top[1] / bottom[1];
    }
    self->c[state] = top[0] - (top[1] * bottom[0] / bottom[1]);
    self->direct *= top[1] / bottom[1];
}

// x1' = x2, x2' = (v - bottom0 x1 - bottom1 x2) / bottom2,
// y = top0 x1 + top1 x2
static void chain_second(struct continuous *self, const struct section *section)
{
    const double *const bottom = section->denominator;
    const int speed = add_state(self, bottom[2]);
    const int place = self->states;

    assert(place < LINEAR_STATES);
    self->states++;
    self->a[place][speed] = 1.0;
    self->a[speed][place] = -bottom[0] / bottom[2];
    self->a[speed][speed] = -bottom[1] / bottom[2];
    memset(self->c, 0, sizeof self->c);
    self->c[place] = section->numerator[0];
    self->c[speed] = section->numerator[1];
    self->direct = 0.0;
}

static struct continuous chain(const struct linear *plant)
{
    struct continuous chained = {.direct = 1.0};

    for (int i = 0; i < plant->count; i++) {
        if (plant->sections[i].denominator[2] > 0.0) {
            chain_second(&chained, &plant->sections[i]);
        } else {
            chain_first(&chained, &plant->sections[i]);
        }
    }
    return chained;
}

// The input is a state that does not change, the last one of these.
#define HELD (LINEAR_STATES + 1)

static void multiply(double self[HELD][HELD], double other[HELD][HELD],
                     int size)
{
    double product[HELD][HELD];

    for (int i = 0; i < size; i++) {
        for (int j = 0; j < size; j++) {
            double sum = 0.0;
            for (int k = 0; k < size; k++) {
                sum += self[i][k] * other[k][j];
            }
            product[i][j] = sum;
        }
    }
    for (int i = 0; i < size; i++) {
        memcpy(self[i], product[i], (size_t)size * sizeof self[i][0]);
    }
}

// How often it must be halved for the largest sum of a row to be small.
static int halvings(double self[HELD][HELD], int size)
{
    double largest = 0.0;
    int count = 0;

    for (int i = 0; i < size; i++) {
        double sum = 0.0;
        for (int j = 0; j < size; j++) {
            sum += fabs(self[i][j]);
        }
        largest = fmax(largest, sum);
    }
    for (; largest > 0.25; largest /= 2.0) {
        count++;
    }
    return count;
}

// e to the power of this, by ten terms of the series and squaring.
static void exponential(double self[HELD][HELD], int size)
{
    const int count = halvings(self, size);
    double power[HELD][HELD] = {{0.0}};
    double sum[HELD][HELD] = {{0.0}};

    for (int i = 0; i < size; i++) {
        power[i][i] = 1.0;
        sum[i][i] = 1.0;
    }
    for (int term = 1; term <= 10; term++) {
        multiply(power, self, size);
        for (int i = 0; i < size; i++) {
            for (int j = 0; j < size; j++) {
                power[i][j] *= ldexp(1.0, -count) / term;
                sum[i][j] += power[i][j];
            }
        }
    }
    for (int i = 0; i < count; i++) {
        multiply(sum, sum, size);
    }
    memcpy(self, sum, sizeof sum);
}

// What a held input does in so many steps.
static void held_for(double self[HELD][HELD], const struct continuous *chained,
                     double steps)
{
    const int states = chained->states;

    memset(self, 0, HELD * sizeof self[0]);
    for (int i = 0; i < states; i++) {
        for (int j = 0; j < states; j++) {
            self[i][j] = chained->a[i][j] * steps;
        }
        self[i][states] = chained->b[i] * steps;
    }
    exponential(self, states + 1);
}

// A dead time of 2.3 steps: for 0.3 steps the input of 3 steps ago counts, then
// for 0.7 steps that of 2 steps ago.
void sampled_start(struct sampled *self, const struct linear *plant)
{
    const struct continuous chained = chain(plant);
    const int states = chained.states;
    double whole[HELD][HELD];
    double rest[HELD][HELD];
    double part[HELD][HELD];
    double share;

    memset(self, 0, sizeof *self);
    self->states = states;
    self->direct = plant->at_once ? chained.direct : 0.0;
    self->dead = (int)floor(plant->dead_steps + 1e-9);
    assert(self->dead < LINEAR_DEAD);
    share = fmax(0.0, plant->dead_steps - self->dead);
    held_for(whole, &chained, 1.0);
    held_for(rest, &chained, 1.0 - share);
    held_for(part, &chained, share);
    for (int i = 0; i < states; i++) {
        memcpy(self->transition[i], whole[i], sizeof self->transition[i]);
        self->now[i] = rest[i][states];
        for (int j = 0; j < states; j++) {
            self->before[i] += rest[i][j] * part[j][states];
        }
        self->output[i] = chained.c[i];
    }
}

// A row for each state, with the right side as its last column. The largest
// pivot of a column is taken.
struct equations {
    int size;
    double complex rows[LINEAR_STATES][LINEAR_STATES + 1];
};

static void swap_rows(struct equations *self, int one, int other)
{
    for (int j = 0; j <= self->size; j++) {
        const double complex kept = self->rows[one][j];
        self->rows[one][j] = self->rows[other][j];
        self->rows[other][j] = kept;
    }
}

static void pivot(struct equations *self, int column)
{
    int best = column;

    for (int i = column + 1; i < self->size; i++) {
        if (cabs(self->rows[i][column]) > cabs(self->rows[best][column])) {
            best = i;
        }
    }
    if (best != column) {
        swap_rows(self, best, column);
    }
}

static void eliminate(struct equations *self, int column)
{
    for (int i = column + 1; i < self->size; i++) {
        if (self->rows[i][column] != 0.0) {
            const double complex factor =
                self->rows[i][column] / self->rows[column][column];
            for (int j = column + 1; j <= self->size; j++) {
                self->rows[i][j] -= factor * self->rows[column][j];
            }
        }
    }
}

static void solve(struct equations *self, double complex *solution)
{
    for (int column = 0; column < self->size; column++) {
        pivot(self, column);
        eliminate(self, column);
    }
    for (int i = self->size - 1; i >= 0; i--) {
        solution[i] = self->rows[i][self->size];
        for (int j = i + 1; j < self->size; j++) {
            solution[i] -= self->rows[i][j] * solution[j];
        }
        solution[i] /= self->rows[i][i];
    }
}

// (shift - transition) state = input
static void answer(const struct sampled *self, double complex shift,
                   double complex *state)
{
    struct equations equations;

    equations.size = self->states;
    for (int i = 0; i < self->states; i++) {
        for (int j = 0; j < self->states; j++) {
            equations.rows[i][j] = -self->transition[i][j];
        }
        equations.rows[i][i] += shift;
        equations.rows[i][self->states] =
            self->now[i] + (self->before[i] / shift);
    }
    solve(&equations, state);
}

double complex sampled_response(const struct sampled *self, double radians)
{
    double complex state[LINEAR_STATES];
    double complex response = self->direct * cexp(-I * radians);

    answer(self, cexp(I * radians), state);
    for (int i = 0; i < self->states; i++) {
        response += self->output[i] * state[i];
    }
    return response * cexp(-I * radians * self->dead);
}

void motion_start(struct motion *self, const struct sampled *plant)
{
    memset(self, 0, sizeof *self);
    self->plant = plant;
    self->falling = plant;
}

void motion_rest(struct motion *self, double input)
{
    double complex state[LINEAR_STATES];

    answer(self->plant, 1.0, state);
    for (int i = 0; i < self->plant->states; i++) {
        self->state[i] = input * creal(state[i]);
    }
    for (int i = 0; i < self->plant->dead; i++) {
        self->line[i] = input;
    }
    self->last = input;
}

double motion_value(const struct motion *self)
{
    double value = self->plant->direct * self->last;

    for (int i = 0; i < self->plant->states; i++) {
        value += self->plant->output[i] * self->state[i];
    }
    return value;
}

// What arrives now was put in so many steps ago.
static double arriving(struct motion *self, double input)
{
    const double arrives = self->line[self->at];

    if (self->plant->dead == 0) {
        return input;
    }
    self->line[self->at] = input;
    self->at++;
    if (self->at == self->plant->dead) {
        self->at = 0;
    }
    return arrives;
}

// The state after one step.
static void follow(const struct motion *self, const struct sampled *plant,
                   double now, double *next)
{
    for (int i = 0; i < plant->states; i++) {
        next[i] = (plant->now[i] * now) + (plant->before[i] * self->last);
        for (int j = 0; j < plant->states; j++) {
            next[i] += plant->transition[i][j] * self->state[j];
        }
    }
}

void motion_move(struct motion *self, double input)
{
    const double now = arriving(self, input);
    double next[LINEAR_STATES];

    follow(self, self->plant, now, next);
    if (self->falling != self->plant && next[0] < self->state[0]) {
        follow(self, self->falling, now, next);
    }
    memcpy(self->state, next, (size_t)self->plant->states * sizeof next[0]);
    self->last = now;
}
