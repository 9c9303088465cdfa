// SPDX-License-Identifier: MIT
// For Arduino, which looks for headers in src/ only.
#include "fixpid.h"

#include "../include/fixpid_reaction.h"
