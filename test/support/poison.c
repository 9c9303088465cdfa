// SPDX-License-Identifier: MIT
#include "poison.h"

#include <string.h>

unsigned poison_left(void *object, size_t size, void (*init)(void))
{
    static unsigned char after[96];
    const unsigned char *const bytes = object;
    unsigned left = 0;

    (void)memset(object, 0xA5, size);
    init();
    for (size_t at = 0; at < size; at++) {
        after[at] = bytes[at];
    }
    (void)memset(object, 0x5A, size);
    init();
    for (size_t at = 0; at < size; at++) {
        if (bytes[at] != after[at]) {
            left++;
        }
    }
    return left;
}
