// SPDX-License-Identifier: MIT
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unity.h"
#include "vectors.h"

static FILE *file;

void vectors_open(const char *name)
{
    char path[128];
    char header[512];

    if (file != NULL) {
        fclose(file);
    }
    snprintf(path, sizeof path, "test/support/vectors/%s.csv", name);
    file = fopen(path, "r");
    TEST_ASSERT_NOT_NULL_MESSAGE(file, path);
    TEST_ASSERT_NOT_NULL_MESSAGE(fgets(header, sizeof header, file), path);
}

bool vectors_next(int32_t columns[VECTORS_COLUMNS_MAX])
{
    char line[512];
    char *rest = line;

    if (fgets(line, sizeof line, file) == NULL) {
        fclose(file);
        file = NULL;
        return false;
    }
    for (unsigned column = 0; column < VECTORS_COLUMNS_MAX; column++) {
        char *const number = rest;
        columns[column] = (int32_t)strtol(number, &rest, 10);
        TEST_ASSERT_TRUE_MESSAGE(rest != number, line);
        if (*rest != ',') {
            break;
        }
        rest++;
    }
    TEST_ASSERT_TRUE_MESSAGE(*rest == '\r' || *rest == '\n', line);
    return true;
}
