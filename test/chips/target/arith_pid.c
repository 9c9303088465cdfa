// SPDX-License-Identifier: MIT
#include "arith.h"
#if defined(__SDCC_pic16) && !defined(FIXPID_NO_ASSEMBLY)
#include "pid/fixpid_pid_pic18.h"
#else
#include "common/fixpid_signed.h"
#endif

#define RANDOM_CASES 32u

static uint32_t state;

// Around each power of 2 and its mirror image, with number 0..255: 16 powers,
// two images, -4..3.
static int16_t nasty16(uint8_t number)
{
    uint16_t bits = (uint16_t)(UINT32_C(1) << (number >> 4));

    bits = (uint16_t)(bits + (number & 7u) - 4u);
    if ((number & 8u) != 0u) {
        bits = (uint16_t)~bits;
    }
    return (int16_t)bits;
}

// Likewise of 32 bits, with number 0..511.
static int32_t nasty32(uint16_t number)
{
    uint32_t bits = UINT32_C(1) << (number >> 4);

    bits = bits + (number & 7u) - 4u;
    if ((number & 8u) != 0u) {
        bits = ~bits;
    }
    return (int32_t)bits;
}

static int32_t any32(void)
{
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return (int32_t)state;
}

// To take 0 away makes a carry on a PIC, which must not come into a product.
static volatile int16_t nothing;

static void add_16(int16_t a, int16_t b)
{
    ARITH_OPERANDS(a, b);
    arith_add((uint32_t)(int32_t)sub16_sat(a, b));
    arith_add((uint32_t)mul16((uint16_t)a & 0x7FFFu, b));
    arith_add((uint32_t)mul16((uint16_t)a & 0x7FFFu, (int16_t)(b - nothing)));
}

static void add_32(int32_t a, int32_t b)
{
    ARITH_OPERANDS(a, b);
    arith_add((uint32_t)add32_sat(a, b));
    arith_add((uint32_t)add32_sat(b, a));
}

static void add_shifts(int32_t x, uint8_t options)
{
    ARITH_OPERANDS(x, options);
    arith_add((uint32_t)shift_right_floor(x, 8));
    arith_add((uint32_t)shift_right_floor(x, 16));
    arith_add((uint32_t)shift_right_by(x, options));
    arith_add((uint32_t)shift_left((int16_t)x, 8));
    arith_add((uint32_t)shift_left((int16_t)x, 16));
    arith_add((uint32_t)(int32_t)complement((int16_t)x));
    arith_add((uint32_t)clamp32(x, -0x7FFFFF, 0x7FFFFF));
}

static void add_random(void)
{
    uint8_t count;

    state = arith_row + 1u;
    for (count = 0; count < RANDOM_CASES; count++) {
        const int32_t a = any32();
        const int32_t b = any32();

        add_16((int16_t)a, (int16_t)b);
        add_32(a, b);
        add_shifts(a, count);
    }
}

void pid_arith(void)
{
    uint8_t number = 0;

    arith_begin();
    do {
        add_16(nasty16((uint8_t)arith_row), nasty16(number));
        add_16(nasty16(number), nasty16((uint8_t)arith_row));
        add_32(nasty32(arith_row), nasty32(number));
        add_32(nasty32(arith_row), nasty32(number + 256u));
        add_32(nasty32(arith_row + 256u), nasty32(number + 256u));
        number++;
    } while (number != 0u);
    for (number = 0; number < 64u; number++) {
        add_shifts(nasty32((uint16_t)(2u * arith_row)), number);
    }
    add_random();
}
