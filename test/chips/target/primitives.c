// SPDX-License-Identifier: MIT
// The arithmetic of fixpid_pid over its whole domain, in the forms that this
// machine does not take by itself: differences of all 2^32 pairs, products of
// all 2^31, the floor of a fifth of 2^32 values, and a hundred million sums,
// each end of whose range comes up. Prints a line for each; exit status 1 if
// one is wrong. -D_PIC14 chooses the narrow product, -DPRIMITIVES_PORTABLE all
// else that is plain C.
#include <inttypes.h>
#include <stdio.h>

#include "numbers.h"

#ifdef PRIMITIVES_PORTABLE
#include "another_compiler.h"
#endif

#include "common/fixpid_signed.h"

static int failed;

static void report(const char *leaf, uint64_t cases, uint64_t wrong)
{
    printf("%s %s: %" PRIu64 " cases, %" PRIu64 " wrong\n",
           wrong == 0 ? "ok" : "FAILED", leaf, cases, wrong);
    failed |= wrong != 0;
}

#ifdef PRIMITIVES_PORTABLE

static void differences(void)
{
    uint64_t wrong = 0;

    for (int32_t left = INT16_MIN; left <= INT16_MAX; left++) {
        for (int32_t right = INT16_MIN; right <= INT16_MAX; right++) {
            const int32_t difference = left - right;
            const int32_t expected = difference > INT16_MAX   ? INT16_MAX
                                     : difference < INT16_MIN ? INT16_MIN
                                                              : difference;

            wrong += sub16_sat((int16_t)left, (int16_t)right) != expected;
        }
    }
    report("differences", UINT64_C(1) << 32, wrong);
}

// By 8 and 16 bits, and by one of the filter's. Five is odd: every remainder is
// met.
static void floors(void)
{
    uint64_t wrong = 0;

    for (int64_t value = INT32_MIN; value <= INT32_MAX; value += 5) {
        const int32_t x = (int32_t)value;
        const uint8_t n = (uint8_t)(value & 7);
        const int64_t remainder8 = value & 255;
        const int64_t remainder16 = value & 65535;

        wrong += shift_right_floor(x, 8) != (value - remainder8) / 256;
        wrong += shift_right_floor(x, 16) != (value - remainder16) / 65536;
        wrong += shift_right_by(x, n) != shift_right_floor(x, n);
    }
    report("floors", (UINT64_C(1) << 32) / 5, wrong);
}

static int32_t any_term(void)
{
    const uint32_t bits = numbers_next();

    switch (bits % 4u) {
    case 0:
        return INT32_MAX - (int32_t)(bits >> 28);
    case 1:
        return INT32_MIN + (int32_t)(bits >> 28);
    default:
        return (int32_t)(bits ^ (bits << 16));
    }
}

static void sums(void)
{
    const uint64_t cases = 100000000;
    uint64_t wrong = 0;

    for (uint64_t n = 0; n < cases; n++) {
        const int32_t a = any_term();
        const int32_t b = any_term();
        const int64_t sum = (int64_t)a + b;
        const int64_t expected = sum > INT32_MAX   ? INT32_MAX
                                 : sum < INT32_MIN ? INT32_MIN
                                                   : sum;

        wrong += add32_sat(a, b) != expected;
    }
    report("sums", cases, wrong);
}

static void all(void)
{
    differences();
    floors();
    sums();
}

#else

static void all(void)
{
    uint64_t wrong = 0;

    for (uint32_t gain = 0; gain <= INT16_MAX; gain++) {
        for (int32_t x = INT16_MIN; x <= INT16_MAX; x++) {
            const int32_t expected = (int32_t)gain * x;

            wrong += mul16((uint16_t)gain, (int16_t)x) != expected;
        }
    }
    report("products", UINT64_C(1) << 31, wrong);
}

#endif

int main(void)
{
    all();
    return failed;
}
