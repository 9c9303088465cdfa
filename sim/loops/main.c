// SPDX-License-Identifier: MIT
// What tools/demo prints of plants in counts: `loops TABLE`.
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
        {"comparison", print_comparison},
        {"agreement", print_agreement},
        {"autotune", print_autotune},
        {"failures", print_failures},
    };

    for (size_t i = 0; i < sizeof(tables) / sizeof(tables[0]); i++) {
        if (count == 2 && strcmp(arguments[1], tables[i].name) == 0) {
            tables[i].print();
            return EXIT_SUCCESS;
        }
    }
    (void)fprintf(stderr, "usage: loops TABLE\n");
    return EXIT_FAILURE;
}
