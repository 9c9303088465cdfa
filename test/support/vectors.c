// SPDX-License-Identifier: MIT
#include "vectors.h"

#include <stdio.h>
#include <stdlib.h>

#define LINE_SIZE 1024

unsigned vectors_columns;

static FILE *file;
static const char *opened;
static unsigned row; // the header is row 0

static void stop(const char *why)
{
    (void)fprintf(stderr, "%s, row %u: %s\n", opened, row, why);
    exit(2);
}

void vectors_open_file(const char *path)
{
    char header[LINE_SIZE];

    if (file != NULL) {
        (void)fclose(file);
    }
    opened = path;
    row = 0;
    file = fopen(path, "r");
    if (file == NULL || fgets(header, sizeof header, file) == NULL) {
        stop("cannot be read");
    }
}

void vectors_open(const char *name)
{
    static char path[128];

    (void)snprintf(path, sizeof path, "test/support/vectors/%s.csv", name);
    vectors_open_file(path);
}

bool vectors_next(int32_t columns[VECTORS_COLUMNS_MAX])
{
    char line[LINE_SIZE];
    char *rest = line;
    bool more = true;

    if (fgets(line, sizeof line, file) == NULL) {
        (void)fclose(file);
        file = NULL;
        return false;
    }
    row++;
    for (vectors_columns = 0; more; vectors_columns++) {
        char *const number = rest;

        if (vectors_columns == VECTORS_COLUMNS_MAX) {
            stop("has too many columns");
        }
        columns[vectors_columns] = (int32_t)strtoll(number, &rest, 10);
        if (rest == number) {
            stop("is not all numbers");
        }
        more = *rest == ',';
        rest += more ? 1 : 0;
    }
    if (*rest != '\r' && *rest != '\n') {
        stop("is not all numbers");
    }
    return true;
}
