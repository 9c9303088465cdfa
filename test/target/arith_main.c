// SPDX-License-Identifier: MIT
// The digests of pid_arith on a machine whose program can print: each line is
// of a sixteenth of the rows.
#include <stdio.h>

#include "arith.h"

int main(void)
{
    uint32_t digest = 0;

    for (arith_row = 0; arith_row < 256u; arith_row++) {
        pid_arith();
        digest = digest * UINT32_C(16777619) + arith_digest;
        if (arith_row % 16u == 15u) {
            printf("rows to %u digest %08lx\n", (unsigned)arith_row,
                   (unsigned long)digest);
        }
    }
    return 0;
}
