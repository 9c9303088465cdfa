// SPDX-License-Identifier: MIT
// The comparisons of tools/demo: `loops TABLE`, or `loops scene NAME`.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "loops.h"

int main(int count, char **arguments)
{
    static const struct {
        const char *name;
        void (*print)(void);
    } tables[] = {
        {"comparison", print_comparison}, {"slow", print_slow},
        {"agreement", print_agreement},   {"bumps", print_bumps},
        {"drift", print_drift},           {"autotune", print_autotune},
        {"failures", print_failures},     {"recovery", print_recovery},
    };

    for (size_t i = 0; i < sizeof(tables) / sizeof(tables[0]); i++) {
        if (count == 2 && strcmp(arguments[1], tables[i].name) == 0) {
            tables[i].print();
            return EXIT_SUCCESS;
        }
    }
    if (count == 3 && strcmp(arguments[1], "scene") == 0 &&
        print_scene(arguments[2])) {
        return EXIT_SUCCESS;
    }
    (void)fprintf(stderr, "usage: loops TABLE, or loops scene NAME\n");
    return EXIT_FAILURE;
}
