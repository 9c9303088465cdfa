// SPDX-License-Identifier: MIT
// A program for a PIC that the assembly of src/ is linked with: claims.txt has
// claims about its functions, which nobody calls here.
#include <stdint.h>

#include "compiler.h"
#include "configuration.h"

#ifdef FIXPID_AN937_OBJECT
#include "fixpid_an937.h"
FIXPID_DATA struct fixpid_an937 FIXPID_AN937_PLACE FIXPID_AN937_OBJECT;
#endif

// With EXAMPLES it runs each example of an instruction in turn.
#ifdef EXAMPLES
extern void examples(void);
#else
static volatile uint8_t idle;

static void examples(void)
{
    idle = 0;
}
#endif

void main(void)
{
    for (;;) {
        examples();
    }
}
