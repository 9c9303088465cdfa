// SPDX-License-Identifier: MIT
// Text and numbers on machines that have putchar and no printf.
#ifndef PUT_H
#define PUT_H
#include <stdint.h>
#include <stdio.h>

static void put_text(const char *text)
{
    while (*text != '\0') {
        putchar(*text);
        text++;
    }
}

// `name` and the number, in decimal.
static void put_number(const char *name, uint32_t number)
{
    char digits[11] = {0};
    uint8_t at = 10;

    put_text(name);
    do {
        at--;
        digits[at] = (char)('0' + number % 10u);
        number /= 10u;
    } while (number != 0u);
    put_text(&digits[at]);
}

// Its eight digits in hexadecimal.
static inline void put_hexadecimal(uint32_t number)
{
    for (uint8_t digit = 0; digit < 8u; digit++) {
        putchar("0123456789abcdef"[(number >> (28u - 4u * digit)) & 15u]);
    }
}

#endif
