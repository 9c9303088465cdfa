// SPDX-License-Identifier: MIT
// The few functions of math.h that the plants, their identification and the
// margins use, for the tuner: WebAssembly has no libm, and a page whose numbers
// equal the Python package's needs the same bits from both. They are made of
// + - * / and of what both have exactly; without contraction
// (-ffp-contract=off) each operation is IEEE 754's.
//
// They are within 1e-14 of the system's for the arguments that plants and loops
// have, which test/web/tuner checks. NaN and signed zeros get no care.
#ifndef MATH_H
#define MATH_H
#include <stdint.h>
#include <string.h>

static inline double math_fabs(double x)
{
    return __builtin_fabs(x);
}

static inline double math_floor(double x)
{
    return __builtin_floor(x);
}

static inline double math_ceil(double x)
{
    return __builtin_ceil(x);
}

static inline double math_fmin(double a, double b)
{
    return (a < b) ? a : b;
}

static inline double math_fmax(double a, double b)
{
    return (a > b) ? a : b;
}

// sin r and cos r, for |r| <= pi / 4, by Taylor's series: what is left out is
// below 1e-17.
static inline double math_sine_part(double r)
{
    const double z = r * r;
    double sum = 1.0;
    for (int n = 16; n > 0; n -= 2) {
        sum = 1.0 - (sum * z / (double)(n * (n + 1)));
    }
    return r * sum;
}

static inline double math_cosine_part(double r)
{
    const double z = r * r;
    double sum = 1.0;
    for (int n = 17; n > 0; n -= 2) {
        sum = 1.0 - (sum * z / (double)(n * (n + 1)));
    }
    return sum;
}

// sin(x + quarter pi / 2), for |x| below some thousands.
static inline double math_wave(double x, int quarter)
{
    const double turns = math_floor((x * 0.63661977236758134308) + 0.5);
    const double r =
        (x - (turns * 1.57079632679489655800)) - (turns * 6.1232339957367e-17);
    const int at = ((int)turns + quarter) & 3;
    const double value =
        ((at & 1) != 0) ? math_cosine_part(r) : math_sine_part(r);
    return ((at & 2) != 0) ? -value : value;
}

static inline double math_sine(double x)
{
    return math_wave(x, 0);
}

static inline double math_cosine(double x)
{
    return math_wave(x, 1);
}

// For |x| < 700.
static inline double math_exp(double x)
{
    const double twos = math_floor((x * 1.44269504088896340736) + 0.5);
    const double r = (x - (twos * 6.93147180369123816490e-01)) -
                     (twos * 1.90821492927058770002e-10);
    double sum = 1.0;
    for (int n = 14; n > 0; n--) {
        sum = 1.0 + (sum * r / (double)n);
    }
    const uint64_t bits = (uint64_t)((int64_t)twos + 1023) << 52;
    double power;
    (void)memcpy(&power, &bits, sizeof(power));
    return sum * power;
}

static inline double math_tanh(double x)
{
    if (math_fabs(x) > 20.0) {
        return (x > 0.0) ? 1.0 : -1.0;
    }
    const double square = math_exp(2.0 * x);
    return (square - 1.0) / (square + 1.0);
}

static inline double math_sqrt(double x)
{
    return __builtin_sqrt(x);
}

// For x above 0, by the series of 2 artanh((m - 1) / (m + 1)) for a fraction m
// of sqrt(1/2)..sqrt(2): what is left out is below 1e-18.
static inline double math_log(double x)
{
    uint64_t bits;
    (void)memcpy(&bits, &x, sizeof(bits));
    int64_t twos = (int64_t)(bits >> 52) - 1023;
    bits = (bits & UINT64_C(0x000fffffffffffff)) | UINT64_C(0x3ff0000000000000);
    double m;
    (void)memcpy(&m, &bits, sizeof(m));
    if (m > 1.41421356237309504880) {
        m /= 2.0;
        twos++;
    }
    const double z = (m - 1.0) / (m + 1.0);
    double sum = 0.0;
    for (int n = 21; n > 0; n -= 2) {
        sum = (sum * z * z) + (1.0 / (double)n);
    }
    return (2.0 * z * sum) + ((double)twos * 0.69314718055994530942);
}

// The angle whose tangent is 0..1: that of an eighth of it, by the series. What
// is left out is below 1e-20.
static inline double math_angle_part(double x)
{
    for (int i = 0; i < 3; i++) {
        x /= 1.0 + math_sqrt(1.0 + (x * x));
    }
    double sum = 0.0;
    for (int n = 19; n > 0; n -= 2) {
        sum = (1.0 / (double)n) - (sum * x * x);
    }
    return 8.0 * x * sum;
}

static inline double math_angle(double y, double x)
{
    const double a = math_fabs(x);
    const double b = math_fabs(y);
    if (math_fmax(a, b) == 0.0) {
        return 0.0;
    }
    const double steep = math_angle_part(math_fmin(a, b) / math_fmax(a, b));
    const double first = (b > a) ? (1.57079632679489661923 - steep) : steep;
    const double angle = (x < 0.0) ? (3.14159265358979323846 - first) : first;
    return (y < 0.0) ? -angle : angle;
}

// They have names of their own, as a compiler may call the system's for a
// builtin.
#define fabs math_fabs
#define floor math_floor
#define ceil math_ceil
#define fmin math_fmin
#define fmax math_fmax
#define sin math_sine
#define cos math_cosine
#define exp math_exp
#define tanh math_tanh
#define sqrt math_sqrt
#define log math_log
#define atan2 math_angle

#endif
