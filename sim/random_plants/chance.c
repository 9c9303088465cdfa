// SPDX-License-Identifier: MIT
#include "chance.h"

#include <math.h>

#define TURN 6.283185307179586

uint64_t chance_bits(struct chance *self)
{
    uint64_t bits;

    self->state += UINT64_C(0x9E3779B97F4A7C15);
    bits = self->state;
    bits = (bits ^ (bits >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    bits = (bits ^ (bits >> 27)) * UINT64_C(0x94D049BB133111EB);
    return bits ^ (bits >> 31);
}

double chance_share(struct chance *self)
{
    return (double)(chance_bits(self) >> 11) / 9007199254740992.0;
}

bool chance_happens(struct chance *self, double share)
{
    return chance_share(self) < share;
}

double chance_between(struct chance *self, double low, double high)
{
    return low + ((high - low) * chance_share(self));
}

double chance_factor(struct chance *self, double low, double high)
{
    return low * exp(log(high / low) * chance_share(self));
}

int chance_index(struct chance *self, int count)
{
    return (int)(chance_share(self) * count);
}

// Box and Muller's.
double chance_noise(struct chance *self)
{
    const double radius = sqrt(-2.0 * log(chance_share(self) + 1e-300));

    return radius * cos(TURN * chance_share(self));
}
