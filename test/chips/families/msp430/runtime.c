// SPDX-License-Identifier: MIT
// The functions of TI's ABI that clang calls, and Debian has no library of:
// without a multiplier, in the least C. Costs of what calls them depend on it.
#include <stdint.h>

uint32_t __mspabi_divul(uint32_t dividend, uint32_t divisor);
uint32_t __mspabi_remul(uint32_t dividend, uint32_t divisor);
int32_t __mspabi_divli(int32_t dividend, int32_t divisor);
void *memset(void *to, int value, unsigned size);
void *memcpy(void *to, const void *from, unsigned size);

#define PRODUCT(name, type)                                                    \
    type name(type a, type b);                                                 \
    type name(type a, type b)                                                  \
    {                                                                          \
        type product = 0;                                                      \
                                                                               \
        for (; b != 0u; b >>= 1) {                                             \
            if ((b & 1u) != 0u) {                                              \
                product += a;                                                  \
            }                                                                  \
            a <<= 1;                                                           \
        }                                                                      \
        return product;                                                        \
    }

PRODUCT(__mspabi_mpyl, uint32_t)
PRODUCT(__mspabi_mpyi, uint16_t)

#define SHIFT(name, type, by_one)                                              \
    type name(type x, uint16_t n);                                             \
    type name(type x, uint16_t n)                                              \
    {                                                                          \
        while (n-- != 0u) {                                                    \
            x = (type)(x by_one 1);                                            \
        }                                                                      \
        return x;                                                              \
    }

SHIFT(__mspabi_srll, uint32_t, >>)
SHIFT(__mspabi_sral, int32_t, >>)
SHIFT(__mspabi_slll, uint32_t, <<)
SHIFT(__mspabi_srli, uint16_t, >>)
SHIFT(__mspabi_srai, int16_t, >>)
SHIFT(__mspabi_slli, uint16_t, <<)

uint32_t __mspabi_divul(uint32_t dividend, uint32_t divisor)
{
    uint32_t quotient = 0;
    uint32_t rest = 0;

    for (uint8_t bit = 32; bit != 0u; bit--) {
        rest = (rest << 1) | (dividend >> 31);
        dividend <<= 1;
        quotient <<= 1;
        if (rest >= divisor) {
            rest -= divisor;
            quotient |= 1u;
        }
    }
    return quotient;
}

uint32_t __mspabi_remul(uint32_t dividend, uint32_t divisor)
{
    return dividend - __mspabi_divul(dividend, divisor) * divisor;
}

int32_t __mspabi_divli(int32_t dividend, int32_t divisor)
{
    const uint32_t above =
        (dividend < 0) ? 0u - (uint32_t)dividend : (uint32_t)dividend;
    const uint32_t below =
        (divisor < 0) ? 0u - (uint32_t)divisor : (uint32_t)divisor;
    const uint32_t quotient = __mspabi_divul(above, below);

    return (int32_t)(((dividend < 0) != (divisor < 0)) ? 0u - quotient
                                                       : quotient);
}

void *memset(void *to, int value, unsigned size)
{
    uint8_t *byte = to;

    while (size-- != 0u) {
        *byte++ = (uint8_t)value;
    }
    return to;
}

void *memcpy(void *to, const void *from, unsigned size)
{
    uint8_t *byte = to;
    const uint8_t *source = from;

    while (size-- != 0u) {
        *byte++ = *source++;
    }
    return to;
}
