// SPDX-License-Identifier: MIT
// A program that is compiled with other definitions than the library: it
// defines the objects `one` and `two`, and makes one call for the first, which
// is USE, or init with a configuration of the type ..._CONFIGURED.
#include "fixpid_an937.h"
#include "fixpid_an964.h"
#include "fixpid_an964_8bit.h"
#include "fixpid_autotune.h"
#include "fixpid_guard.h"
#include "fixpid_link.h"
#include "fixpid_pid.h"
#include "fixpid_reaction.h"

#define CAT_(a, b) a##b
#define CAT(a, b) CAT_(a, b)
#define CONTROLLER CAT(fixpid_, NOUN)

FIXPID_DATA struct CONTROLLER one;
FIXPID_DATA struct CONTROLLER two;

#ifdef CONFIGURED
static const struct CAT(CONTROLLER, CONFIGURED) config;
#define USE CAT(CONTROLLER, _init)(&one, &config)
#endif

int main(void)
{
    (void)USE;
    return 0;
}
