// SPDX-License-Identifier: MIT
// AN937's sum in assembly for a PIC18 under SDCC: FIXPID_PRODUCT=4, which
// fixpid_arith.h explains. Any other compiler gets its twin in C. Both are
// leaves of fixpid_arith.h and obey what is written there.
//
// In assembly the operands are not copied: FSR0 points at the first number,
// which must be in parts and lie, with its gain and the others, as in struct
// fixpid_an937; `sum` is not used.
#ifndef FIXPID_AN937_PIC18_H
#define FIXPID_AN937_PIC18_H
#include <stdint.h>

#if defined(__SDCC_pic16)

struct fixpid_kernel {
    int32_t sum;
    uint16_t low; // product
};

extern struct fixpid_kernel fixpid_kernel;
void fixpid_kernel_products(void);
uint8_t fixpid_kernel_sixteenth(void); // returns the flags

extern __sfr __at(0xFE9) FSR0L;
extern __sfr __at(0xFEA) FSR0H;

// SDCC drops the first two lines, which spare it a warning.
#define FIXPID_KERNEL_PRODUCTS(sum, gain_0, number_0, gain_1, number_1,        \
                               gain_2, number_2, room)                         \
    do {                                                                       \
        const uint16_t address_ = (uint16_t) & (number_0);                     \
        (sum) = 0;                                                             \
        (void)(sum);                                                           \
        FSR0L = (uint8_t)address_;                                             \
        FSR0H = (uint8_t)(address_ >> 8);                                      \
        fixpid_kernel_products();                                              \
    } while (0)
#define FIXPID_KERNEL_SIXTEENTH(sum, flags)                                    \
    do {                                                                       \
        (flags) = (uint8_t)(fixpid_kernel_sixteenth() | (flags));              \
    } while (0)
#define FIXPID_KERNEL_RESULT(sum) (fixpid_kernel.sum)

#else

int32_t fixpid_kernel_product(uint8_t gain, uint16_t magnitude,
                              uint8_t negative);
int32_t fixpid_kernel_sixteenth(int32_t sum);
uint8_t fixpid_kernel_flags(int32_t sum);

#define FIXPID_KERNEL_PRODUCT(gain, number)                                    \
    fixpid_kernel_product((gain), (number).parts.magnitude,                    \
                          (number).parts.negative)
#define FIXPID_KERNEL_PRODUCTS(sum, gain_0, number_0, gain_1, number_1,        \
                               gain_2, number_2, room)                         \
    do {                                                                       \
        (sum) = FIXPID_KERNEL_PRODUCT(gain_0, number_0) +                      \
                FIXPID_KERNEL_PRODUCT(gain_1, number_1) +                      \
                FIXPID_KERNEL_PRODUCT(gain_2, number_2);                       \
    } while (0)
#define FIXPID_KERNEL_SIXTEENTH(sum, flags)                                    \
    do {                                                                       \
        (flags) = (uint8_t)(fixpid_kernel_flags(sum) | (flags));               \
        (sum) = fixpid_kernel_sixteenth(sum);                                  \
    } while (0)
#define FIXPID_KERNEL_RESULT(sum) (sum)

#endif

#endif
