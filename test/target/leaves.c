// SPDX-License-Identifier: MIT
// The leaves of fixpid_pid over their whole domain, in every form of C:
// differences of all 2^32 pairs, products of all 2^31, the floor of all 2^32
// values for the two constant shifts, and a hundred million sums, each end of
// whose range comes up. Prints a line per leaf; exit status 1 if one is wrong.
#include <inttypes.h>
#include <stdio.h>

#include "fixpid_pid_arith.h"
#include "numbers.h"

static int failed;

static void report(const char *leaf, uint64_t cases, uint64_t wrong)
{
    printf("%s %s: %" PRIu64 " cases, %" PRIu64 " wrong\n",
           wrong == 0 ? "ok" : "FAILED", leaf, cases, wrong);
    failed |= wrong != 0;
}

static void differences(void)
{
    uint64_t wrong = 0;

    for (int32_t left = INT16_MIN; left <= INT16_MAX; left++) {
        const int16_t a = (int16_t)left;

        for (int32_t right = INT16_MIN; right <= INT16_MAX; right++) {
            const int16_t b = (int16_t)right;
            const int32_t difference = left - right;
            const int32_t expected = difference > INT16_MAX   ? INT16_MAX
                                     : difference < INT16_MIN ? INT16_MIN
                                                              : difference;
            int16_t wide, narrow;

            FIXPID_DIFFERENCE_WIDE(wide, a, b);
            FIXPID_DIFFERENCE_NARROW(narrow, a, b);
            wrong += (wide != expected) + (narrow != expected);
        }
    }
    report("differences", UINT64_C(1) << 32, wrong);
}

static void products(void)
{
    uint64_t wrong = 0;

    for (uint32_t left = 0; left <= INT16_MAX; left++) {
        const uint16_t gain = (uint16_t)left;

        for (int32_t right = INT16_MIN; right <= INT16_MAX; right++) {
            const int16_t x = (int16_t)right;
            const int32_t expected = (int32_t)left * right;
            int32_t multiply, bytes;

            FIXPID_SIGNED_MULTIPLY(multiply, gain, x);
            FIXPID_SIGNED_BYTES(bytes, gain, x);
            wrong += (multiply != expected) + (bytes != expected);
        }
    }
    report("products", UINT64_C(1) << 31, wrong);
}

// For the shifts by 8 and 16, and the filter's seven over a part.
static void floors(void)
{
    uint64_t wrong = 0;

    for (int64_t value = INT32_MIN; value <= INT32_MAX; value++) {
        const int32_t x = (int32_t)value;
        const uint8_t n = (uint8_t)(1 + (value & 1023) % 7);
        int32_t by;
        const int64_t remainder8 = ((value % 256) + 256) % 256;
        const int64_t remainder16 = ((value % 65536) + 65536) % 65536;

        wrong += FIXPID_FLOOR_SHIFT(x, 8) != (value - remainder8) / 256;
        wrong += FIXPID_FLOOR_PORTABLE(x, 8) != (value - remainder8) / 256;
        wrong += FIXPID_FLOOR_SHIFT(x, 16) != (value - remainder16) / 65536;
        wrong += FIXPID_FLOOR_PORTABLE(x, 16) != (value - remainder16) / 65536;
        FIXPID_FLOOR_BY_STEPS(by, x, n);
        wrong += FIXPID_FLOOR_SHIFT(x, n) != FIXPID_FLOOR_PORTABLE(x, n);
        wrong += FIXPID_FLOOR_SHIFT(x, n) != by;
    }
    report("floors", UINT64_C(1) << 32, wrong);
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
        int32_t portable, flag;

        FIXPID_SUM_PORTABLE(portable, a, b);
        FIXPID_SUM_FLAG(flag, a, b);
        wrong += (portable != expected) + (flag != expected);
    }
    report("sums", cases, wrong);
}

int main(void)
{
    differences();
    products();
    floors();
    sums();
    return failed;
}
