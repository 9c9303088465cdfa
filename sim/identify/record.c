// SPDX-License-Identifier: MIT
// The lines of a recording that are kept, and what they say by themselves.
#include <math.h>
#include <string.h>

#include "parts.h"

#define LEAST 8     // lines of a recording
#define MOST 65536  // of them that are searched for outliers and noise
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

// The value that a part of them are below; of what is sorted already, too.
static double quantile(int n, const double *values, double part)
{
    for (int i = 0; i < n; i++) {
        sorted[i] = values[i];
    }
    return nth(sorted, n, (int)(part * (n - 1)));
}

// Without a part of them at each end.
static double range_of(int n, const double *values, double part)
{
    const double high = quantile(n, values, 1.0 - part);
    return high - quantile(n, values, part);
}

static double mean_of(const double *values, int from, int to)
{
    double sum = 0.0;
    for (int i = from; i < to; i++) {
        sum += values[i];
    }
    return sum / (to - from);
}

// ---- Outliers: lines that stand alone ----

// The median of a line and those up to before another, as far as there are any.
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

// Returns how many there are: none, where it would be one line in twenty.
static int mark_alone(int n, const double *y)
{
    const double least = 0.15 * range_of(n, y, 0.05);
    int found = 0;
    for (int i = 0; i < n; i++) {
        sorted[i] = distance(n, y, i);
    }
    const double far = fmax(least, 8.0 * SIZE * quantile(n, sorted, 0.5));
    for (int i = 0; i < n; i++) {
        alone[i] = (distance(n, y, i) > far) && stands_alone(n, y, i);
        found += alone[i] ? 1 : 0;
    }
    if (found > 0.05 * n) {
        found = 0;
        (void)memset(alone, 0, sizeof(alone));
    }
    return found;
}

// ---- What is kept ----

static int count_moves(const struct identify_recording *in)
{
    int count = 1;
    for (int i = 1; i < in->lines; i++) {
        count += (in->u[i] != in->u[i - 1]) ? 1 : 0;
    }
    return count;
}

// The drive moved between two times: in the middle. Returns its size.
static double add_move(struct record *self, double from, double until,
                       double to)
{
    const int last = self->moves - 1;
    const double size = fabs(to - ((last < 0) ? self->before : self->to[last]));
    if ((last < 0) || (size > 0.0)) {
        self->at[self->moves] = (from + until) / 2.0;
        self->to[self->moves++] = to;
        self->gap += size * (until - from);
    }
    return size;
}

static void keep_moves(struct record *self, const struct identify_recording *in)
{
    const int blocks = (count_moves(in) > MOVES) ? (MOVES - 1) : in->lines;
    const int block = 1 + ((in->lines - 1) / blocks);
    const double *const t = in->t;
    double sizes = 0.0;
    self->before = in->before_known ? in->before : mean_of(in->u, 0, block);
    self->moves = 0;
    self->gap = 0.0;
    for (int i = 0; i < in->lines; i += block) {
        const int end = (i + block < in->lines) ? (i + block) : in->lines;
        const double from = (i == 0) ? 0.0 : (t[i - 1] - t[0]);
        sizes += add_move(self, from, t[i] - t[0], mean_of(in->u, i, end));
    }
    self->first = (self->to[0] != self->before) ? 0 : 1;
    self->gap = fmax((sizes > 0.0) ? (self->gap / sizes) : 0.0, self->every);
}

static void add(struct lines *self, double t, double y)
{
    self->t[self->n] = t;
    self->y[self->n] = y;
    self->use[self->n++] = 1.0;
}

// The mean of some lines but of those that stand alone.
static void add_mean(struct record *self, const struct identify_recording *in,
                     int from, int to)
{
    double t = 0.0;
    double y = 0.0;
    int n = 0;
    for (int i = from; i < to; i++) {
        if ((i >= MOST) || !alone[i]) {
            t += in->t[i] - in->t[0];
            y += in->y[i];
            n++;
        }
    }
    if (n > 0) {
        add(&self->all, t / n, y / n);
    }
}

static void keep_lines(struct record *self, const struct identify_recording *in)
{
    const int block = 1 + ((in->lines - 1) / IDENTIFY_LINES);
    self->all.n = 0;
    for (int i = 0; i < in->lines; i += block) {
        const int end = (i + block < in->lines) ? (i + block) : in->lines;
        add_mean(self, in, i, end);
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
    for (int i = 2; i < n; i++) {
        sorted[i - 2] = fabs(y[i] - (2.0 * y[i - 1]) + y[i - 2]);
    }
    self->noise = SIZE * quantile(n - 2, sorted, 0.5) / sqrt(6.0);
    self->quantum = 1e300;
    for (int i = 1; i < n; i++) {
        const double step = fabs(y[i] - y[i - 1]);
        self->quantum = fmin(self->quantum, (step > 1e-12) ? step : 1e300);
    }
    self->quantum = (self->quantum < 1e300) ? self->quantum : 0.0;
    self->noise = fmax(self->noise, self->quantum / sqrt(12.0));
}

// Whether the lines before the first move of the drive stand still: their slope
// is no more than their noise could make. 1, 0, or -1 where none tells.
static int rest_of(const struct record *self, int *lines)
{
    const struct lines *const in = &self->all;
    double tt = 0.0;
    double ty = 0.0;
    double yy = 0.0;
    int n = 0;
    while ((n < in->n) && (in->t[n] <= self->at[self->first])) {
        n++;
    }
    const double middle = mean_of(in->t, 0, n);
    const double mean = mean_of(in->y, 0, n);
    for (int i = 0; i < n; i++) {
        const double t = in->t[i] - middle;
        const double y = in->y[i] - mean;
        tt += t * t;
        ty += t * y;
        yy += y * y;
    }
    *lines = n;
    if (!(tt > 0.0)) {
        return -1;
    }
    const double left = fmax(yy - (ty * ty / tt), 0.0);
    const double sd = (n >= REST) ? sqrt(left / (n - 2)) : 0.0;
    return (fabs(ty) < 4.0 * fmax(sd, self->noise) * sqrt(tt)) ? 1 : 0;
}

// Why it cannot be identified, by the lines alone.
static int reason_of(const struct record *self,
                     const struct identify_recording *in)
{
    bool moves = false;
    bool back = !(self->span > 0.0);
    for (int i = 1; i < in->lines; i++) {
        back = back || (in->t[i] < in->t[i - 1]);
        moves = moves || (in->y[i] != in->y[0]);
    }
    return back                         ? IDENTIFY_TIME
           : self->first == self->moves ? IDENTIFY_DRIVE_STANDS
           : moves                      ? IDENTIFY_USABLE
                                        : IDENTIFY_NO_RESPONSE;
}

int record_keep(struct record *self, const struct identify_recording *in,
                struct identify_result *result)
{
    if (in->lines < LEAST) {
        return IDENTIFY_FEW_LINES;
    }
    const int n = (in->lines < MOST) ? in->lines : MOST;
    for (int i = 1; i < n; i++) {
        sorted[i - 1] = in->t[i] - in->t[i - 1];
    }
    self->span = in->t[in->lines - 1] - in->t[0];
    self->every = quantile(n - 1, sorted, 0.5);
    self->every = (self->every > 0.0) ? self->every : (self->span / n);
    keep_moves(self, in);
    const int reason = reason_of(self, in);
    if (reason == IDENTIFY_USABLE) {
        result->outliers = mark_alone(n, in->y);
        measure_noise(self, n, in->y);
        keep_lines(self, in);
        self->rest = rest_of(self, &self->rest_lines);
        self->swing = range_of(self->all.n, self->all.y, 0.02);
        if (!(self->swing > 0.0)) {
            self->swing = range_of(self->all.n, self->all.y, 0.0);
        }
    }
    result->every = (reason == IDENTIFY_TIME) ? 0.0 : self->every;
    return reason;
}

double record_exact(const struct record *self)
{
    return squared(0.3 * self->noise) + squared(1e-4 * self->swing);
}

// ---- A sensor that stood still ----

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
    const double least = fmax(6.0 * self->noise, 3.0 * self->quantum);
    double most = fmax(least, 0.05 * self->swing);
    double low = 0.0;
    double high = 0.0;
    int start = 0;
    bool found = false;
    for (int i = 0; i < all->n; i++) {
        const double model = all->y[i] - all->left[i];
        if ((i == 0) || (all->y[i] != all->y[i - 1])) {
            start = i;
            low = model;
            high = model;
        }
        low = fmin(low, model);
        high = fmax(high, model);
        if ((i - start >= STUCK - 1) && (high - low > most)) {
            found = true;
            most = high - low;
            result->stuck_from = all->t[start];
            result->stuck_to = all->t[i];
        }
    }
    if (found) {
        leave_out(&self->few, result->stuck_from, result->stuck_to);
        leave_out(&self->all, result->stuck_from, result->stuck_to);
    }
    return found;
}
