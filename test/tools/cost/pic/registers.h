// SPDX-License-Identifier: MIT
// A PIC18 without a port has the core's registers only.
#include "compiler.h"
