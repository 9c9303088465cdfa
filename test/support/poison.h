// SPDX-License-Identifier: MIT
// Whether init sets every member, whatever the memory held.
#ifndef POISON_H
#define POISON_H
#include <stddef.h>

// The bytes of an object that depend on what it held before `init`, which is
// called twice: the padding of its struct, if init is right.
unsigned poison_left(void *object, size_t size, void (*init)(void));

// The padding behind the last member, a byte; there is no other.
#define POISON_PADDING(type, last)                                             \
    (sizeof(type) - offsetof(type, last) - sizeof(((type *)0)->last))

#endif
