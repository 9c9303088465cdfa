// SPDX-License-Identifier: MIT
// AN937's sum in assembly for a PIC18 under SDCC: FIXPID_PRODUCT=4, which
// fixpid_arith.h explains. Any other compiler gets its twin in C. Both are
// leaves of fixpid_arith.h and obey what is written there.
//
// In assembly the operands are not copied: FSR0 points at a gain, behind which
// its number lies in parts, and the sum is fixpid_kernel_sum. So FIXPID_SUM_...
// are called in order, with gains as neighbours of their numbers, and `sum` is
// not used.
#ifndef FIXPID_KERNEL_PIC18_H
#define FIXPID_KERNEL_PIC18_H
#include <stdint.h>

#if defined(__SDCC_pic16)

extern int32_t fixpid_kernel_sum;
void fixpid_kernel_start(void);
void fixpid_kernel_add_product(void);
uint8_t fixpid_kernel_sixteenth(void); // returns the flags

extern __sfr __at(0xFE9) FSR0L;
extern __sfr __at(0xFEA) FSR0H;

#define FIXPID_KERNEL_POINT_AT(gain)                                           \
    do {                                                                       \
        const uint16_t address_ = (uint16_t) & (gain);                         \
        FSR0L = (uint8_t)address_;                                             \
        FSR0H = (uint8_t)(address_ >> 8);                                      \
    } while (0)

// SDCC drops the first two lines, which spare it a warning.
#define FIXPID_KERNEL_START(sum, gain, number, room)                           \
    do {                                                                       \
        (sum) = 0;                                                             \
        (void)(sum);                                                           \
        FIXPID_KERNEL_POINT_AT(gain);                                          \
        fixpid_kernel_start();                                                 \
    } while (0)
#define FIXPID_KERNEL_ADD_PRODUCT(sum, gain, number, room)                     \
    do {                                                                       \
        FIXPID_KERNEL_POINT_AT(gain);                                          \
        fixpid_kernel_add_product();                                           \
    } while (0)
#define FIXPID_KERNEL_SIXTEENTH(sum, flags)                                    \
    do {                                                                       \
        (flags) = (uint8_t)(fixpid_kernel_sixteenth() | (flags));              \
    } while (0)
#define FIXPID_KERNEL_RESULT(sum) fixpid_kernel_sum

#else

int32_t fixpid_kernel_product(uint8_t gain, uint16_t magnitude,
                              uint8_t negative);
int32_t fixpid_kernel_sixteenth(int32_t sum);
uint8_t fixpid_kernel_flags(int32_t sum);

#define FIXPID_KERNEL_START(sum, gain, number, room)                           \
    do {                                                                       \
        (sum) = fixpid_kernel_product((gain), (number).parts.magnitude,        \
                                      (number).parts.negative);                \
    } while (0)
#define FIXPID_KERNEL_ADD_PRODUCT(sum, gain, number, room)                     \
    do {                                                                       \
        (sum) += fixpid_kernel_product((gain), (number).parts.magnitude,       \
                                       (number).parts.negative);               \
    } while (0)
#define FIXPID_KERNEL_SIXTEENTH(sum, flags)                                    \
    do {                                                                       \
        (flags) = (uint8_t)(fixpid_kernel_flags(sum) | (flags));               \
        (sum) = fixpid_kernel_sixteenth(sum);                                  \
    } while (0)
#define FIXPID_KERNEL_RESULT(sum) (sum)

#endif

#endif
