// SPDX-License-Identifier: MIT
// AN964's products in assembly against those in C, on the chip: all operands,
// and for the largest product every value of one with a walk of the other.
// -DPRODUCTS_8BIT for the 8-bit form's.
#include "fixpid_arith.h"

#include "compiler.h"
#include "configuration.h"
#include "fixpid_an964_pic14.h"

volatile uint8_t finished;
uint32_t compared;
uint16_t different;

static void compare(uint16_t in_assembly, uint16_t in_c)
{
    compared++;
    if (in_assembly != in_c) {
        different++;
    }
}

// Functions apart from the loops: SDCC 4.2.0 takes a loop's variable for
// constant where a copy of it is made beside an instruction in assembly.
#ifdef PRODUCTS_8BIT

static void compare_7x7(uint8_t x, uint8_t k)
{
    const uint8_t up = 0xFF;
    uint16_t product;

    FIXPID_LIMITED_7X7(product, x, k, 0u, 2, 4, FIXPID_WORD(127));
    compare(fixpid_kernel_7x7_2(0, x, k), product);
    FIXPID_LIMITED_7X7(product, x, k, up, 2, 4, FIXPID_WORD(127));
    compare(fixpid_kernel_7x7_2(up, x, k), product);
    FIXPID_BYTE_7X7(product, x, k, 3, 3);
    compare(fixpid_kernel_7x7_3(x, k), product);
    FIXPID_PRODUCT_7X7(product, x, k, 5, 1);
    compare(fixpid_kernel_7x7_5(x, k), product);
}

static void walk(void)
{
    for (uint8_t x = 0; x < 128u; x++) {
        for (uint8_t k = 0; k < 128u; k++) {
            PORT_CLEAR_WATCHDOG();
            compare_7x7(x, k);
        }
    }
}

#else

static void compare_10x8(uint16_t x, uint8_t k)
{
    const uint8_t up = 0xFF;
    uint16_t product;

    FIXPID_LIMITED_10X8(product, x, k, 0u, 5, 3, FIXPID_WORD(255));
    compare(fixpid_kernel_10x8_5(k, x, 0), product);
    FIXPID_LIMITED_10X8(product, x, k, up, 5, 3, FIXPID_WORD(255));
    compare(fixpid_kernel_10x8_5(k, x, up), product);
    if (k < 128u) {
        FIXPID_PRODUCT_10X8(product, x, k, 4, 3);
        compare(fixpid_kernel_10x8_4(k, x), product);
    }
}

static void compare_14x10(uint16_t x, uint16_t k)
{
    uint16_t product;

    FIXPID_PRODUCT_14X10(product, x, k);
    compare(fixpid_kernel_14x10(x, k), product);
}

static void walk(void)
{
    for (uint16_t x = 0; x < FIXPID_WORD(1024); x++) {
        uint8_t k = 0;
        do {
            PORT_CLEAR_WATCHDOG();
            compare_10x8(x, k);
            k++;
        } while (k != 0u);
    }
    for (uint16_t x = 0; x < FIXPID_WORD(16384); x++) {
        for (uint16_t k = x & 31u; k < FIXPID_WORD(1024); k += 97u) {
            PORT_CLEAR_WATCHDOG();
            compare_14x10(x, k);
        }
    }
}

#endif

void main(void)
{
    walk();
    finished = 1;
    for (;;) {
        PORT_CLEAR_WATCHDOG();
    }
}
