// SPDX-License-Identifier: MIT
// sim/tuner/libm/math.h beside the system's functions, over the arguments that
// plants and loops have.
#include "../../../sim/tuner/libm/math.h"
#undef fabs
#undef floor
#undef ceil
#undef fmin
#undef fmax
#undef sin
#undef cos
#undef exp
#undef tanh
#undef sqrt
#undef log
#undef atan2
#undef memcpy
#include <math.h>
#include <stdio.h>

#define POINTS 200001
#define MOST 1e-14

typedef double function(double x);

// The largest difference, as a part of the value where that is above 1.
static int compared(const char *name, function *ours, function *theirs,
                    double low, double high)
{
    double worst = 0.0;
    for (int i = 0; i < POINTS; i++) {
        const double x = low + ((high - low) * i / (POINTS - 1));
        const double value = theirs(x);
        const double distance = fabs(ours(x) - value) / fmax(fabs(value), 1.0);
        worst = (distance <= worst) ? worst : distance;
    }
    const int good = worst <= MOST;
    (void)printf("%s libm, %s: at most %.1e away\n", good ? "ok" : "FAILED",
                 name, worst);
    return good;
}

static double our_lower(double x)
{
    return math_fmin(math_floor(x), math_ceil(x)) + math_fmax(x, -x);
}

static double their_lower(double x)
{
    return fmin(floor(x), ceil(x)) + fmax(x, -x);
}

static double our_log(double x)
{
    return math_log(exp2(x));
}

static double their_log(double x)
{
    return log(exp2(x));
}

// In all four quadrants, and at their ends.
static double our_angle(double x)
{
    return math_angle(sin(x), cos(x));
}

static double their_angle(double x)
{
    return atan2(sin(x), cos(x));
}

int main(void)
{
    int good = compared("sin", math_sine, sin, -20.0, 20.0);
    good &= compared("cos", math_cosine, cos, -20.0, 20.0);
    good &= compared("exp", math_exp, exp, -50.0, 50.0);
    good &= compared("tanh", math_tanh, tanh, -30.0, 30.0);
    good &=
        compared("floor, ceil, fmin, fmax", our_lower, their_lower, -9.5, 9.5);
    good &= compared("fabs", math_fabs, fabs, -9.5, 9.5);
    good &= compared("sqrt", math_sqrt, sqrt, 0.0, 1e6);
    good &= compared("log", our_log, their_log, -900.0, 900.0);
    good &= compared("atan2", our_angle, their_angle, -3.5, 3.5);
    return good ? 0 : 1;
}
