// SPDX-License-Identifier: MIT
#include "wave_features.h"

#include <math.h>

#define LAG_NONE 1e9 // of what integrates

// What the sums of one relay say.
struct relay {
    double drive;  // high less low output
    double length; // of a cycle, steps
    double middle; // M
    double slope;
    double turn;        // X
    double output;      // mean
    double measurement; // mean
};

// Both relays, together.
struct wave {
    struct relay relays[2];
    double slope;
    double middle;
    double swing;
    double net; // swing without noise
};

static double output_at(const struct fixpid_autotune *tuner, double halves)
{
    const double output = tuner->centre + (halves * tuner->half);

    return fmin(fmax(output, tuner->config.output_min),
                tuner->config.output_max);
}

static struct relay relay_of(const struct fixpid_autotune *tuner, int number)
{
    const struct fixpid_autotune_sums *const sums = &tuner->sums[number];
    const double low = output_at(tuner, (number == 0) ? -1.0 : -2.0);
    const double high = output_at(tuner, (number == 0) ? 2.0 : 1.0);
    const double cycles = tuner->config.cycles * ((number == 0) ? 2.0 : 1.0);
    const double steps = sums->steps;
    const double on = sums->on_steps;
    const double area =
        (sums->all * on / steps) - sums->on - (sums->rise / 2.0);
    struct relay relay;
    double slope;
    double square;

    relay.drive = high - low;
    relay.length = steps / cycles;
    relay.middle = on * (steps - on) / steps / cycles;
    relay.turn = fmax(sums->rise, 0.0) / (cycles * relay.drive);
    relay.output = low + (relay.drive * on / steps);
    relay.measurement = sums->all / steps;
    slope = 2.0 * area / cycles / (relay.drive * relay.middle * relay.middle);
    square = relay.turn * relay.turn / (relay.middle * relay.middle);
    relay.slope = slope + (square / (slope + (square / slope)));
    return relay;
}

static struct wave wave_of(const struct fixpid_autotune *tuner)
{
    struct wave wave;

    wave.relays[0] = relay_of(tuner, 0);
    wave.relays[1] = relay_of(tuner, 1);
    wave.slope = (wave.relays[0].slope + wave.relays[1].slope) / 2.0;
    wave.middle = (wave.relays[0].middle + wave.relays[1].middle) / 2.0;
    wave.swing = tuner->highest - tuner->lowest;
    wave.net = 1.0 + fmax(wave.swing - (tuner->noise * 0.75 / 16.0), 0.0);
    return wave;
}

static double roundness_of_lag(double ratio)
{
    return 0.5 + (ratio * ratio * (0.3 + (0.2 * ratio)));
}

// What the two means say of the static gain: 0 for an integrator. `away` is how
// far an unstable process is beyond one.
static double ratio_of(const struct wave *wave, const struct features *found,
                       double *away)
{
    const struct relay *const relays = wave->relays;
    const double outputs = relays[0].output - relays[1].output;
    const double change = relays[0].measurement - relays[1].measurement;
    const double limit =
        (1.1 * found->roundness) + (1.0 / wave->middle) + (0.3 * found->skew);
    double ratio;

    *away = 0.0;
    if (change <= wave->swing / 16.0) {
        return 0.0;
    }
    ratio = wave->slope * wave->middle * outputs / change / 2.0;
    if (outputs <= 0.0) {
        *away = -ratio;
        return 0.0;
    }
    ratio = fmin(ratio, 63.0 / 64.0);
    while (roundness_of_lag(ratio) > limit && ratio > 1.0 / 256.0) {
        ratio *= 15.0 / 16.0;
    }
    return ratio;
}

// The ratio less what the means leave open.
static double sure_ratio(const struct wave *wave, double ratio)
{
    const struct relay *const relays = wave->relays;
    const double outputs = relays[0].output - relays[1].output;
    const double open = fmax(relays[0].drive, relays[1].drive) / 4.0 *
                        ((1.0 / 32.0) + (1.0 / relays[1].length));

    return (ratio > 0.0) ? ratio * fmax(0.0, 1.0 - (open / outputs)) : 0.0;
}

// The delay with which PI has this Ms, between a twentieth of M and a hundred.
static double wanted_delay(const struct judge *judge, double slope,
                           double middle, double lag, double wanted_ms)
{
    double low = middle * 0.05;
    double high = middle * 100.0;

    for (int i = 0; i < 15; i++) {
        const double delay = sqrt(low * high);
        const double kp = 1.0 / (slope * delay);
        const double reset = fmin(lag, 4.0 * delay);
        const struct design design = {true, kp, kp / reset, 0.0, 0};
        if (judge_sensitivity(judge, &design) > wanted_ms) {
            low = delay;
        } else {
            high = delay;
        }
    }
    return high;
}

struct features features_of(const struct experiment *experiment,
                            const struct judge *judge, double wanted_ms)
{
    const struct fixpid_autotune *const tuner = &experiment->autotune;
    const struct wave wave = wave_of(tuner);
    const struct relay *const relays = wave.relays;
    const double asked = 1 + ((tuner->noise + (tuner->noise >> 1) + 16) >> 5);
    struct features found = {.middle = wave.middle};
    double away;
    double sure;
    double bent; // the slope, with the lag's bend taken out
    double lag = LAG_NONE;

    found.roundness =
        relays[0].slope * relays[0].middle * relays[0].drive / 2.0 / wave.net;
    found.skew =
        (relays[0].turn + relays[1].turn) / 2.0 / (wave.slope * wave.middle);
    found.quarrel = fabs(relays[0].slope - relays[1].slope) / wave.slope;
    found.noise = fmin(asked / wave.net, 0.25);
    found.ratio = ratio_of(&wave, &found, &away);
    sure = sure_ratio(&wave, found.ratio);
    found.lag = sure >= 0.03;
    if (!found.lag) {
        found.ratio = 0.0;
    }
    bent = 1.0 - (found.ratio *
                  ((found.ratio *
                    ((found.ratio * found.ratio * found.ratio * 0.31) + 0.64)) +
                   0.05));
    if (found.lag) {
        lag = wave.middle / (2.0 * sure) * bent;
    }
    found.refused = found.quarrel > 0.5 || found.skew > 1.0 ||
                    found.roundness < 0.3 || away > 0.06;
    found.wanted =
        wanted_delay(judge, wave.slope / bent, wave.middle, lag, wanted_ms) /
        wave.middle;
    return found;
}
