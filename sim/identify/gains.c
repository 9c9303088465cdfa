// SPDX-License-Identifier: MIT
// SIMC's gains for a plant, and Ms of the loop that they make.
#include <math.h>

#include "parts.h"

#define POINTS 220 // frequencies
#define UNSTABLE 1e9
#define QUARTER 1.5707963267948966

struct number {
    double re;
    double im;
};

void identify_simc(const struct identify_plant *plant, double step, double calm,
                   double gains[3])
{
    const bool ringing = plant->kind == IDENTIFY_RINGING;
    const bool integrating = plant->kind == IDENTIFY_INTEGRATING;
    // The rule takes half of the second lag for dead time, half for lag.
    const double half = ringing ? 0.0 : (plant->lag2 / 2.0);
    const double dead = plant->dead + (step / 2.0) + half;
    double lag = plant->lag + half;
    double own = fmax(dead, lag / 10.0);
    if (ringing) {
        lag = 2.0 * plant->damping * plant->lag;
        own = plant->lag;
    } else if (integrating) {
        lag = 1.0;
        own = dead;
    }
    const double wanted = dead + (calm * own);
    const bool ends = !ringing && (integrating || (4.0 * wanted < lag));
    const double kp = lag / (plant->gain * wanted);
    gains[0] = kp;
    gains[1] = kp / (ends ? (4.0 * wanted) : lag);
    gains[2] = ringing ? (kp * squared(plant->lag) / lag) : 0.0;
}

void identify_denominator(const struct identify_plant *plant, double a[3])
{
    a[0] = 1.0;
    a[1] = plant->lag + plant->lag2;
    a[2] = plant->lag * plant->lag2;
    if (plant->kind == IDENTIFY_RINGING) {
        a[1] = 2.0 * plant->damping * plant->lag;
        a[2] = squared(plant->lag);
    } else if (plant->kind == IDENTIFY_INTEGRATING) {
        a[0] = 0.0;
        a[1] = 1.0;
        a[2] = plant->lag2;
    }
}

// 1 + the controller's answer times the plant's at a frequency, with a filter
// of a tenth of the derivative's time.
static struct number difference_at(double gain, const double a[3], double dead,
                                   const double gains[3], double w)
{
    const double td = gains[2] / gains[0] * w;
    const double filter = 1.0 + squared(td / 10.0);
    const struct number c = {1.0 + (squared(td) / 10.0 / filter),
                             (td / filter) - (gains[1] / gains[0] / w)};
    const struct number d = {a[0] - (a[2] * w * w), a[1] * w};
    const double size = gains[0] * gain / (squared(d.re) + squared(d.im));
    const double re = size * ((c.re * d.re) + (c.im * d.im));
    const double im = size * ((c.im * d.re) - (c.re * d.im));
    const double cosine = cos(w * dead);
    const double sine = sin(w * dead);
    return (struct number){1.0 + (re * cosine) + (im * sine),
                           (im * cosine) - (re * sine)};
}

// By Nyquist 1 + the loop turns by a quarter for each integrator and no more.
double identify_ms(const struct identify_plant *plant, double step,
                   const double gains[3])
{
    const bool integrating = plant->kind == IDENTIFY_INTEGRATING;
    const double dead = plant->dead + (step / 2.0);
    const double low = 0.01 / (plant->lag + plant->lag2 + plant->dead + step +
                               fabs(gains[0] / gains[1]));
    const double factor = exp(log(3.1 / step / low) / (POINTS - 1));
    double a[3];
    identify_denominator(plant, a);
    struct number last = difference_at(plant->gain, a, dead, gains, low);
    double nearest = squared(last.re) + squared(last.im);
    double turned = integrating ? (-2.0 * QUARTER) : -QUARTER;
    double w = low;
    for (int i = 1; i < POINTS; i++) {
        w *= factor;
        const struct number at = difference_at(plant->gain, a, dead, gains, w);
        nearest = fmin(nearest, squared(at.re) + squared(at.im));
        turned += atan2((last.re * at.im) - (last.im * at.re),
                        (last.re * at.re) + (last.im * at.im));
        last = at;
    }
    return (fabs(turned) < 0.8) ? (1.0 / sqrt(nearest)) : UNSTABLE;
}
