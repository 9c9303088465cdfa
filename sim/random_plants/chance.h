// SPDX-License-Identifier: MIT
// Random numbers, the same on every machine.
#ifndef CHANCE_H
#define CHANCE_H
#include <stdbool.h>
#include <stdint.h>

struct chance {
    uint64_t state;
};

// 64 random bits, by SplitMix64.
uint64_t chance_bits(struct chance *self);

// 0 or more, below 1.
double chance_share(struct chance *self);

bool chance_happens(struct chance *self, double share);

double chance_between(struct chance *self, double low, double high);

// Each factor between low and high, both above 0, is as likely as the others.
double chance_factor(struct chance *self, double low, double high);

// 0..count - 1.
int chance_index(struct chance *self, int count);

// Normal noise of standard deviation 1.
double chance_noise(struct chance *self);

#endif
