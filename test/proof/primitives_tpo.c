// SPDX-License-Identifier: MIT
// What a window of fixpid_tpo asks for, duty * window, with all duties and all
// windows: a solver is slow at the product. A program for the host, like
// primitives.c.
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "tpo/fixpid_tpo.c"

static uint64_t cases;

// At first nothing is owed; a step that is on has paid `full`.
void prove_windows(void)
{
    for (int32_t window = 1; window <= 32767; window++) {
        struct fixpid_tpo c;
        const struct fixpid_tpo_config config = {32767, (uint16_t)window, 0, 0};

        if (!fixpid_tpo_init(&c, &config)) {
            printf("refused: a window of %" PRId32 "\n", window);
            exit(1);
        }
        for (int32_t duty = 0; duty <= 32767; duty++) {
            int64_t owed;

            fixpid_tpo_reset(&c);
            owed = fixpid_tpo_step(&c, (int16_t)duty) ? 32767 : 0;
            owed += c.credit;
            cases++;
            if (owed != (int64_t)duty * window) {
                printf("a duty of %" PRId32 " in a window of %" PRId32
                       " asks for %" PRId64 "\n",
                       duty, window, owed);
                exit(1);
            }
        }
    }
}

int main(void)
{
    prove_windows();
    printf("%" PRIu64 " cases\n", cases);
    return 0;
}
