// SPDX-License-Identifier: MIT
// The lines of a recording that are kept, and what they say by themselves.
#include "parts.h"

#include <math.h>

#define LEAST 8     // lines of a recording
#define MOST 65536  // of its lines that are searched for single ones and noise
#define FEW 300     // lines that a search looks at
#define REACH 3     // neighbours on each side that a line is compared with
#define STUCK 6     // lines of the same value, at least
#define SIZE 1.4826 // standard deviation for a median of sizes

static double sorted[MOST];
static bool alone[MOST];

double squared(double x)
{
    return x * x;
}

double limited(double x, double low, double high)
{
    return fmin(fmax(x, low), high);
}

double nth(double *values, int n, int k)
{
    int low = 0;
    int high = n - 1;

    while (low < high) {
        const double pivot = values[(low + high) / 2];
        int i = low;
        int j = high;
        while (i <= j) {
            while (values[i] < pivot) {
                i++;
            }
            while (values[j] > pivot) {
                j--;
            }
            if (i <= j) {
                const double kept = values[i];
                values[i++] = values[j];
                values[j--] = kept;
            }
        }
        if (k <= j) {
            high = j;
        } else if (k >= i) {
            low = i;
        } else { // all between them equal the pivot
            return values[k];
        }
    }
    return values[k];
}

// ---- Lines that stand alone ----

// The median of y from a line to before another, of the lines that there are.
static double median_of(int n, const double *y, int from, int to)
{
    double some[(2 * REACH) + 1];
    int count = 0;

    for (int i = from; i < to; i++) {
        if ((i >= 0) && (i < n)) {
            some[count++] = y[i];
        }
    }
    return nth(some, count, count / 2);
}

static double distance(int n, const double *y, int i)
{
    return fabs(y[i] - median_of(n, y, i - REACH, i + REACH + 1));
}

// Whether the neighbours of both sides agree on another value. At an end both
// are the same.
static bool stands_alone(int n, const double *y, int i)
{
    const int left = (i > 0) ? (i - REACH) : (i + 1);
    const int right = (i < n - 1) ? (i + 1) : (i - REACH);
    const double before = median_of(n, y, left, left + REACH);
    const double after = median_of(n, y, right, right + REACH);

    return fabs(before - after) <
           (0.3 * fmin(fabs(y[i] - before), fabs(y[i] - after)));
}

// Returns how many there are. If that is more than one in twenty, they are not
// errors of single lines: none is left out.
static int mark_alone(int n, const double *y)
{
    int found = 0;

    for (int i = 0; i < n; i++) {
        sorted[i] = y[i];
    }
    const double high = nth(sorted, n, (int)(0.95 * (n - 1)));
    const double low = nth(sorted, n, (int)(0.05 * (n - 1)));
    for (int i = 0; i < n; i++) {
        sorted[i] = distance(n, y, i);
    }
    const double far =
        fmax(8.0 * SIZE * nth(sorted, n, n / 2), 0.15 * (high - low));
    for (int i = 0; i < n; i++) {
        alone[i] = (distance(n, y, i) > far) && stands_alone(n, y, i);
        found += alone[i] ? 1 : 0;
    }
    if (found <= (0.05 * n)) {
        return found;
    }
    for (int i = 0; i < n; i++) {
        alone[i] = false;
    }
    return 0;
}

// ---- What is kept ----

static double median_step(int n, const double *t)
{
    const int steps = ((n > MOST) ? MOST : n) - 1;

    for (int i = 0; i < steps; i++) {
        sorted[i] = t[i + 1] - t[i];
    }
    return nth(sorted, steps, steps / 2);
}

// Over some lines, each by the time until the next.
static double mean_drive(const struct identify_recording *from, int i, int to)
{
    double sum = 0.0;
    double time = 0.0;

    if (to == i + 1) {
        return from->u[i];
    }
    for (; (i < to) && (i < from->lines); i++) {
        const int next = (i < from->lines - 1) ? (i + 1) : i;
        const double step = from->t[next] - from->t[i] + 1e-12;
        sum += step * from->u[i];
        time += step;
    }
    return sum / time;
}

static void keep_moves(struct record *self,
                       const struct identify_recording *from)
{
    const int n = from->lines;
    double sizes = 0.0;
    int count = 1;

    for (int i = 1; i < n; i++) {
        count += (from->u[i] != from->u[i - 1]) ? 1 : 0;
    }
    const int block = 1 + ((count > MOVES) ? (n / (MOVES - 1)) : 0);
    self->moves = 1;
    self->at[0] = 0.0;
    self->to[0] = mean_drive(from, 0, block);
    self->before = from->before_known ? from->before : self->to[0];
    self->first = (self->to[0] != self->before) ? 0 : 1;
    self->gap = 0.0;
    for (int i = block; i < n; i += block) {
        const double to = mean_drive(from, i, i + block);
        const double size = fabs(to - self->to[self->moves - 1]);
        if (size > 0.0) { // at some time between two lines
            self->at[self->moves] =
                ((from->t[i - 1] + from->t[i]) / 2.0) - from->t[0];
            self->to[self->moves++] = to;
            self->gap += size * (from->t[i] - from->t[i - 1]);
            sizes += size;
        }
    }
    sizes += fabs(self->to[0] - self->before);
    self->gap = fmax((sizes > 0.0) ? (self->gap / sizes) : 0.0, self->every);
}

static void add(struct lines *self, double t, double y)
{
    self->t[self->n] = t;
    self->y[self->n] = y;
    self->use[self->n++] = 1.0;
}

// Means of blocks, where there are more lines than IDENTIFY_LINES.
static void keep_lines(struct record *self,
                       const struct identify_recording *from)
{
    const int block = 1 + ((from->lines - 1) / IDENTIFY_LINES);

    self->all.n = 0;
    for (int i = 0; i < from->lines; i += block) {
        double t = 0.0;
        double y = 0.0;
        int n = 0;
        for (int k = i; (k < i + block) && (k < from->lines); k++) {
            if ((k >= MOST) || !alone[k]) {
                t += from->t[k] - from->t[0];
                y += from->y[k];
                n++;
            }
        }
        if (n > 0) {
            add(&self->all, t / n, y / n);
        }
    }
    self->few.n = 0;
    for (int i = 0; i < self->all.n; i += 1 + ((self->all.n - 1) / FEW)) {
        add(&self->few, self->all.t[i], self->all.y[i]);
    }
}

// What neighbours differ by; or if that is more, what rounding to the steps of
// a converter does.
static void measure_noise(struct record *self, int n, const double *y)
{
    int count = 0;
    double least = 1e300;

    for (int i = 2; i < n; i++) {
        sorted[i - 2] = fabs(y[i] - (2.0 * y[i - 1]) + y[i - 2]);
    }
    self->noise = SIZE * nth(sorted, n - 2, (n - 2) / 2) / sqrt(6.0);
    for (int i = 1; i < n; i++) {
        const double step = fabs(y[i] - y[i - 1]);
        if (step > 1e-12) {
            sorted[count++] = step;
            least = fmin(least, step);
        }
    }
    self->quantum = (count > 0) ? least : 0.0;
    self->noise = fmax(self->noise, self->quantum / sqrt(12.0));
}

static void measure_swing(struct record *self)
{
    const struct lines *all = &self->all;

    for (int i = 0; i < all->n; i++) {
        sorted[i] = all->y[i];
    }
    const double high = nth(sorted, all->n, (int)(0.98 * (all->n - 1)));
    const double low = nth(sorted, all->n, (int)(0.02 * (all->n - 1)));
    const double most = nth(sorted, all->n, all->n - 1);
    self->swing = (high > low) ? (high - low) : (most - nth(sorted, all->n, 0));
}

// What the times, the drive and the measurement say without a model.
static int reason_of(const struct record *self,
                     const struct identify_recording *from)
{
    bool moves = false;

    for (int i = 1; i < from->lines; i++) {
        if (from->t[i] < from->t[i - 1]) {
            return IDENTIFY_TIME;
        }
        moves = moves || (from->y[i] != from->y[0]);
    }
    if (!(self->span > 0.0)) {
        return IDENTIFY_TIME;
    }
    if (self->first == self->moves) {
        return IDENTIFY_DRIVE_STANDS;
    }
    return moves ? IDENTIFY_USABLE : IDENTIFY_NO_RESPONSE;
}

int record_keep(struct record *self, const struct identify_recording *from,
                struct identify_result *result)
{
    const int n = from->lines;

    if (n < LEAST) {
        return IDENTIFY_FEW_LINES;
    }
    self->span = from->t[n - 1] - from->t[0];
    self->every = median_step(n, from->t);
    self->every = (self->every > 0.0) ? self->every : (self->span / n);
    keep_moves(self, from);
    const int reason = reason_of(self, from);
    if (reason == IDENTIFY_TIME) {
        return reason;
    }
    result->every = self->every;
    if (reason == IDENTIFY_USABLE) {
        const int looked_at = (n > MOST) ? MOST : n;
        result->outliers = mark_alone(looked_at, from->y);
        measure_noise(self, looked_at, from->y);
        keep_lines(self, from);
        measure_swing(self);
    }
    return reason;
}

double record_exact(const struct record *self)
{
    return squared(0.3 * self->noise) + squared(1e-4 * self->swing);
}

// ---- A sensor that stood still ----

// Of the lines from one with the same value: the first that is not, and how far
// the model moves.
static int run_of(const struct lines *in, int from, double *moved)
{
    double low = 1e300;
    double high = -1e300;
    int i = from;

    for (; (i < in->n) && (in->y[i] == in->y[from]); i++) {
        low = fmin(low, in->y[i] - in->left[i]);
        high = fmax(high, in->y[i] - in->left[i]);
    }
    *moved = high - low;
    return i;
}

static void leave_out(struct lines *self, double from, double to)
{
    for (int i = 0; i < self->n; i++) {
        if ((self->t[i] >= from) && (self->t[i] <= to)) {
            self->use[i] = 0.0;
        }
    }
}

bool record_leave_stuck(struct record *self, struct identify_result *result)
{
    const struct lines *const all = &self->all;
    double most =
        fmax(fmax(6.0 * self->noise, 3.0 * self->quantum), 0.05 * self->swing);
    int from = 0;
    int to = 0;
    int next = 0;

    for (int i = 0; i < all->n; i = next) {
        double moved;
        next = run_of(all, i, &moved);
        if ((next - i >= STUCK) && (moved > most)) {
            most = moved;
            from = i;
            to = next;
        }
    }
    if (to == 0) {
        return false;
    }
    result->stuck_from = all->t[from];
    result->stuck_to = all->t[to - 1];
    leave_out(&self->few, result->stuck_from, result->stuck_to);
    leave_out(&self->all, result->stuck_from, result->stuck_to);
    return true;
}
