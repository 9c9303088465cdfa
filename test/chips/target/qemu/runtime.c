// SPDX-License-Identifier: MIT
// Start-up and a C library in miniature for a core in QEMU. Text and the exit
// status leave through semihosting.
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "semihosting.h"

#define SYS_WRITEC 0x03u
#define SYS_EXIT 0x18u
#define APPLICATION_EXIT 0x20026u // ADP_Stopped_ApplicationExit
#define RUN_TIME_ERROR 0x20023u   // ADP_Stopped_RunTimeErrorUnknown

extern uint8_t data_in_flash[], data_start[], data_end[];
extern uint8_t bss_start[], bss_end[];

int main(void);

static void stop(uint32_t reason)
{
    for (;;) {
        semihosting(SYS_EXIT, (const void *)(uintptr_t)reason);
    }
}

void reset_handler(void)
{
    memcpy(data_start, data_in_flash, (size_t)(data_end - data_start));
    memset(bss_start, 0, (size_t)(bss_end - bss_start));
    stop(main() == 0 ? APPLICATION_EXIT : RUN_TIME_ERROR);
}

void fault_handler(void)
{
    stop(RUN_TIME_ERROR);
}

int putchar(int character)
{
    const char byte = (char)character;

    semihosting(SYS_WRITEC, &byte);
    return character;
}

void *memcpy(void *to, const void *from, size_t size)
{
    uint8_t *target = to;
    const uint8_t *source = from;

    while (size-- > 0u) {
        *target++ = *source++;
    }
    return to;
}

void *memset(void *to, int value, size_t size)
{
    uint8_t *target = to;

    while (size-- > 0u) {
        *target++ = (uint8_t)value;
    }
    return to;
}

int memcmp(const void *left, const void *right, size_t size)
{
    const uint8_t *a = left, *b = right;

    for (; size > 0u; size--, a++, b++) {
        if (*a != *b) {
            return *a < *b ? -1 : 1;
        }
    }
    return 0;
}

int strcmp(const char *left, const char *right)
{
    while (*left == *right && *left != '\0') {
        left++;
        right++;
    }
    return (uint8_t)*left - (uint8_t)*right;
}
