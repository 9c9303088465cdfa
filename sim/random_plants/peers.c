// SPDX-License-Identifier: MIT
#include "peers.h"

#include <math.h>
#include <string.h>

#define HALF_TURN 3.141592653589793

// It gives up after so many times dead time and lags.
static long most_steps(const struct subject *subject)
{
    return (long)((60.0 * linear_steps(&subject->plant)) + 3000.0);
}

static double holding(const struct subject *subject)
{
    return floor(subject->holding * subject->output_max);
}

// A fifth of the range, or what is left of it on the shorter side.
static double relay_step(const struct subject *subject)
{
    const double room = fmin(subject->holding, 1.0 - subject->holding);

    return fmax(2.0, floor(subject->output_max * fmin(0.2, room * 0.95)));
}

static double in_range(const struct subject *subject, double output)
{
    return fmin(fmax(output, 0.0), subject->output_max);
}

// From the ultimate gain and period.
static struct design by_ultimate(double gain, double period,
                                 const double rule[3])
{
    return (struct design){true, rule[0] * gain, rule[1] * gain / period,
                           rule[2] * gain * period, 0};
}

// Arduino PID AutoTune Library, v0: a relay around the measurement of the
// start; a peak is above, or below, all of the last `look_back` samples. Its Ku
// is 4 times the output step over pi times the swing peak to peak, half of what
// the describing function says.
#define LOOK_BACK_MOST 100
#define PEAKS 10

struct classic {
    double last[LOOK_BACK_MOST];
    int look_back;
    double start;
    double band;
    double highest;
    double lowest;
    double peaks[PEAKS + 2];
    int count;
    int kind; // 1: the last one was a maximum, -1: a minimum
    bool changed;
    long peak;
    long peak_before;
};

static void classic_look(const struct classic *self, double value, bool *above,
                         bool *below)
{
    *above = true;
    *below = true;
    for (int i = 0; i < self->look_back; i++) {
        *above = *above && value > self->last[i];
        *below = *below && value < self->last[i];
    }
}

static void classic_maximum(struct classic *self, double value, long now)
{
    if (self->kind == -1) {
        self->changed = true;
        self->peak_before = self->peak;
    }
    self->kind = 1;
    self->peak = now;
    self->peaks[self->count] = value;
}

static void classic_minimum(struct classic *self, double value)
{
    if (self->kind == 1) {
        self->changed = true;
        self->count++;
    }
    self->kind = -1;
    self->peaks[self->count] = value;
}

static bool classic_alike(const struct classic *self)
{
    const double *const peaks = &self->peaks[self->count];
    const double apart =
        (fabs(peaks[-1] - peaks[-2]) + fabs(peaks[-2] - peaks[-3])) / 2.0;

    return apart < 0.05 * (self->highest - self->lowest);
}

// True when it is done.
static bool classic_step(struct classic *self, double value, long now)
{
    bool above;
    bool below;

    self->highest = fmax(self->highest, value);
    self->lowest = fmin(self->lowest, value);
    classic_look(self, value, &above, &below);
    for (int i = self->look_back - 1; i > 0; i--) {
        self->last[i] = self->last[i - 1];
    }
    self->last[0] = value;
    self->changed = false;
    if (above) {
        classic_maximum(self, value, now);
    } else if (below) {
        classic_minimum(self, value);
    }
    if (self->changed && self->count > 2 && classic_alike(self)) {
        return true;
    }
    return self->count >= PEAKS;
}

// The output's offset from what holds.
static double classic_relay(const struct classic *self, double value,
                            double offset, double step)
{
    if (value > self->start + self->band) {
        return -step;
    }
    return (value < self->start - self->band) ? step : offset;
}

static void classic_begin(struct classic *self, double value)
{
    self->start = value;
    self->highest = value;
    self->lowest = value;
}

static long run_classic(const struct subject *subject, struct design *designs)
{
    static const double pi[] = {0.4, 0.48, 0.0};
    static const double pid[] = {0.6, 1.2, 0.075};
    const double step = relay_step(subject);
    const long most = most_steps(subject);
    struct classic self = {.band = fmax(0.5, 3.0 * subject->noise)};
    struct bench bench;
    double offset = step;
    bool done = false;
    long now = 0;
    double swing;

    self.look_back =
        (int)fmin(LOOK_BACK_MOST, fmax(9.0, subject->period_steps / 4.0));
    bench_start(&bench, subject);
    for (; !done && now < most; now++) {
        const double value = bench_read(&bench);
        if (now == 0) {
            classic_begin(&self, value);
        }
        offset = classic_relay(&self, value, offset, step);
        done = classic_step(&self, value, now);
        bench_drive(&bench, in_range(subject, holding(subject) + offset));
    }
    swing = self.highest - self.lowest;
    if (done && self.peak > self.peak_before && swing > 0.0) {
        const double gain = 4.0 * step / (swing * HALF_TURN);
        const double period = (double)(self.peak - self.peak_before);
        designs[0] = by_ultimate(gain, period, pi);
        designs[1] = by_ultimate(gain, period, pid);
    }
    return now;
}

// QuickPID's relay, version 2: one cycle with hysteresis, after it has come to
// the setpoint from below. Times t0 to t3 are those of its documentation. It
// reads the mean of 16 conversions.
struct quick {
    struct bench bench;
    long now;
    long most;
    double highest;
    double lowest;
    double hysteresis;
};

#define QUICK_FINE 4.0 // parts of a count, of a mean of 16

static double quick_read(struct quick *self, double output)
{
    const struct subject *const subject = self->bench.subject;
    double value;

    bench_drive(&self->bench, in_range(subject, output));
    self->now++;
    value = bench_value(&self->bench) +
            bench_noise(&self->bench, subject->noise / QUICK_FINE);
    value = floor((value * QUICK_FINE) + 0.5) / QUICK_FINE;
    return fmin(fmax(value, 0.0), subject->sensor_max);
}

// Until it is above the level, or below it; the time then.
static long quick_until(struct quick *self, double output, double level,
                        bool above)
{
    while (self->now < self->most) {
        const double value = quick_read(self, output);
        if (above ? (value > level) : (value < level)) {
            break;
        }
    }
    return self->now;
}

// The same while it notes the peaks.
static long quick_cycle(struct quick *self, double output, double level,
                        bool above)
{
    const double setpoint = self->bench.subject->setpoint;

    while (self->now < self->most) {
        const double value = quick_read(self, output);
        self->highest = fmax(self->highest, value);
        if (self->highest >= setpoint + self->hysteresis) {
            self->lowest = fmin(self->lowest, value);
        }
        if (above ? (value > level) : (value < level)) {
            break;
        }
    }
    return self->now;
}

// With the period for the lag and the gain of the oscillation for that of the
// process, as it is published.
static struct design quick_amigo(double gain, double period, double delay)
{
    const double kp = (0.2 + (0.45 * period / delay)) / gain;
    const double reset =
        ((0.4 * delay) + (0.8 * period)) / (delay + (0.1 * period)) * delay;
    const double rate = 0.5 * delay * period / ((0.3 * delay) + period);

    return (struct design){true, kp, kp / reset, kp * rate, 0};
}

static long run_quick(const struct subject *subject, struct design *designs)
{
    static const double tyreus_luyben[] = {0.313, 0.142, 0.0};
    static const double ziegler_nichols[] = {0.6, 1.176, 0.075};
    const double setpoint = subject->setpoint;
    const double step = relay_step(subject);
    const double low = holding(subject) - step;
    const double high = holding(subject) + step;
    const double more = subject->output_max * (5.0 / 255.0);
    struct quick self = {.most = most_steps(subject),
                         .highest = setpoint,
                         .lowest = setpoint,
                         .hysteresis = fmax(1.0, 3.0 * subject->noise)};
    double times[4];
    double swing;

    bench_start(&self.bench, subject);
    (void)quick_until(&self, 0.0, setpoint - self.hysteresis, false);
    (void)quick_until(&self, high + more, setpoint, true);
    (void)quick_until(&self, low, setpoint, false);
    times[0] = (double)quick_until(&self, high, setpoint, true);
    times[1] = (double)quick_until(&self, high, setpoint + 0.2, true);
    times[2] =
        (double)quick_cycle(&self, high, setpoint + self.hysteresis, true);
    (void)quick_cycle(&self, low, setpoint - self.hysteresis, false);
    times[3] =
        (double)quick_cycle(&self, high, setpoint + self.hysteresis, true);
    swing = pow(self.highest - self.lowest, 2.0) - pow(self.hysteresis, 2.0);
    if (self.now < self.most && swing > 0.0) {
        const double gain = 8.0 * step / (HALF_TURN * sqrt(swing));
        const double period = times[3] - times[2];
        designs[0] = by_ultimate(gain, period, tyreus_luyben);
        designs[1] = by_ultimate(gain, period, ziegler_nichols);
        designs[2] = quick_amigo(gain, period, fmax(1.0, times[1] - times[0]));
    }
    return self.now;
}

// sTune: a step of the output from rest, and the steepest tangent of the
// answer. A window of 6 % of the samples slides along; where it has not become
// steeper for a 16th of them, its tangent says the gain and the lag. Read
// kindly: the published code writes ki as 1 / (0.33 dead time), without kp;
// here the integral time is Ziegler and Nichols's, as its documentation says.
#define SAMPLES_MOST 4000
#define TANGENT_GAIN 4.3004 // as published
#define EPSILON 0.0001

struct stune {
    double window[SAMPLES_MOST];
    int size;
    int at;
    double sum;
    double start;
    double resolution;
    double slope;
    double bend; // the mean where it was steepest
    long dead;
    int flat; // samples since
};

static void stune_start(struct stune *self, double value, int samples)
{
    memset(self, 0, sizeof *self);
    self->size = (int)fmax(3.0, samples * 0.06);
    for (int i = 0; i < self->size; i++) {
        self->window[i] = value;
    }
    self->sum = value * self->size;
    self->start = value;
    self->resolution = value;
}

// The oldest one of the window makes place.
static double stune_mean(struct stune *self, double value)
{
    self->at = (self->at + 1) % self->size;
    self->sum += value - self->window[self->at];
    self->window[self->at] = value;
    return self->sum / self->size;
}

static void stune_step(struct stune *self, double value, double before,
                       long now)
{
    const double mean = stune_mean(self, value);
    const double tangent = mean - self->window[(self->at + 1) % self->size];
    const double moved = fabs(value - before);

    if (moved > EPSILON && moved < self->resolution) {
        self->resolution = moved;
    }
    if (self->dead == 0 && mean > self->start + self->resolution + EPSILON) {
        self->dead = now;
    }
    if (tangent < EPSILON) {
        self->flat = 0;
    }
    if (tangent > self->slope + EPSILON) {
        self->flat = 0;
        self->slope = tangent;
        self->bend = mean;
    }
    self->flat++;
}

// The step is a tenth of the range to each side of what holds, at most. What
// cannot rest elsewhere starts at the setpoint.
static double stune_rest(struct bench *bench, double *from)
{
    const struct subject *const subject = bench->subject;
    const double before = fmax(0.0, subject->holding - 0.1);
    const double after = fmin(1.0, subject->holding + 0.1);

    *from = subject->holding * subject->output_max;
    if (!subject->plant.integrating && !subject->plant.unstable) {
        *from = before * subject->output_max;
        bench_hold(bench, *from);
    }
    return after * subject->output_max;
}

static void stune_designs(const struct stune *self, double moved,
                          struct design *designs)
{
    const double dead = fmax(1.0, (double)self->dead);
    const double end = self->bend + (self->slope * TANGENT_GAIN);
    const double lag =
        ((end - self->start) / self->slope * (self->size - 1)) - dead;
    const double gain = (end - self->start) / moved;
    const double kp = lag / (gain * dead);

    if (gain > 0.0 && lag > 0.0) {
        designs[0] = (struct design){true, 0.45 * kp,
                                     0.45 * kp / (3.3333 * dead), 0.0, 0};
        designs[1] = (struct design){true, 0.6 * kp, 0.6 * kp / (2.0 * dead),
                                     0.6 * kp * 0.5 * dead, 0};
    }
}

static long run_stune(const struct subject *subject, struct design *designs)
{
    const int samples = (int)fmin(
        SAMPLES_MOST, fmax(100.0, 3.0 * linear_steps(&subject->plant)));
    struct stune self;
    struct bench bench;
    double from;
    double to;
    double before;
    long now = 0;

    bench_start(&bench, subject);
    to = stune_rest(&bench, &from);
    before = bench_read(&bench);
    stune_start(&self, before, samples);
    for (; now < samples; now++) {
        const double value = bench_read(&bench);
        stune_step(&self, value, before, now);
        if (self.flat >= samples / 16 && self.slope > 0.0) {
            stune_designs(&self, to - from, designs);
            break;
        }
        before = value;
        bench_drive(&bench, to);
    }
    return now;
}

const struct peer peers[PEERS] = {
    {"Arduino PID AutoTune", 2, {"PI", "PID"}, run_classic},
    {"QuickPID",
     3,
     {"Tyreus-Luyben PI", "Ziegler-Nichols PID", "AMIGO PID"},
     run_quick},
    {"sTune", 2, {"Ziegler-Nichols PI", "Ziegler-Nichols PID"}, run_stune},
};
