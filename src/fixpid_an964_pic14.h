// SPDX-License-Identifier: MIT
// AN964's products in assembly for a PIC16 under SDCC, and their twins in C for
// every other compiler: FIXPID_PRODUCT=4. fixpid_arith.h says what they obey.
//
// The arguments and the temporaries lie in the 16 bytes that all banks share,
// so there is no bank to select.
#ifndef FIXPID_KERNEL_PIC14_H
#define FIXPID_KERNEL_PIC14_H
#include <stdint.h>

// x * k / 16. pre: x < 1024
uint16_t fixpid_kernel_10x8_4(uint8_t k, uint16_t x);

// x * k / 32, rounded up if up is 0xFF and not 0; at most 255. pre: x < 1024
uint8_t fixpid_kernel_10x8_5(uint8_t k, uint16_t x, uint8_t up);

// x * k / 1024. pre: x < 2^14, k < 1024
uint16_t fixpid_kernel_14x10(uint16_t x, uint16_t k);

// x * k / 4, rounded up likewise, and x * k / 8, both at most 127, and
// x * k / 32. pre: x and k are below 128
uint8_t fixpid_kernel_7x7_2(uint8_t up, uint8_t x, uint8_t k);
uint8_t fixpid_kernel_7x7_3(uint8_t x, uint8_t k);
uint16_t fixpid_kernel_7x7_5(uint8_t x, uint8_t k);

#endif
