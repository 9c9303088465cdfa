// SPDX-License-Identifier: MIT
// What test/support/vectors.c uses of Unity, in a program that is no unit
// test: what is wrong with a recording ends it.
#ifndef UNITY_H
#define UNITY_H
#include <stdio.h>
#include <stdlib.h>

#define TEST_ASSERT_TRUE_MESSAGE(condition, message)                           \
    do {                                                                       \
        if (!(condition)) {                                                    \
            (void)fprintf(stderr, "cost: wrong recording: %s\n", (message));   \
            exit(2);                                                           \
        }                                                                      \
    } while (0)
#define TEST_ASSERT_NOT_NULL_MESSAGE(pointer, message)                         \
    TEST_ASSERT_TRUE_MESSAGE((pointer) != NULL, message)

#endif
