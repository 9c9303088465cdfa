// SPDX-License-Identifier: MIT
// The definition of the controllers in 64-bit arithmetic, written from the
// notes' equations and not from src/. Vectors, fuzzing and primitives compare
// with it.
#ifndef REFERENCE_H
#define REFERENCE_H
#include <stdbool.h>
#include <stdint.h>

struct reference_an937 {
    int64_t kp, ki, kd, limit, period;
    bool pending, overrun, limited, saturated;
    int64_t error, accumulated, delta, previous, countdown;
    int64_t proportional, integral, derivative, sum;
};

void reference_an937_init(struct reference_an937 *self, int64_t kp, int64_t ki,
                          int64_t kd, int64_t limit, int64_t period);
void reference_an937_tick(struct reference_an937 *self);
int64_t reference_an937_step(struct reference_an937 *self, int64_t error);
uint8_t reference_an937_stat1(const struct reference_an937 *self);

// Both forms of AN964 are one law with other widths and divisors.
struct reference_an964_form {
    int64_t error_limit;
    int64_t sum_low, sum_high;
    int64_t sum_divisor, ki_divisor, kd_divisor, kp_divisor;
    int64_t integral_limit, term_limit, total_limit, output_limit;
};

struct reference_an964 {
    struct reference_an964_form form;
    int64_t kp, ki, kd;
    int64_t sum, history[3];
    int64_t proportional, integral, derivative;
    bool sum_limited, output_limited;
};

struct reference_an964_form reference_an964_10bit(void);
struct reference_an964_form reference_an964_8bit(void);
int64_t reference_an964_step(struct reference_an964 *self, int64_t error);

int64_t reference_floor_divide(int64_t dividend, int64_t divisor);
int64_t reference_clamp(int64_t value, int64_t low, int64_t high);

#endif
