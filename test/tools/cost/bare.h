// SPDX-License-Identifier: MIT
// What the least applications share.
#ifndef BARE_H
#define BARE_H
#include <stdint.h>

#include "compiler.h"
#include "configuration.h"

volatile int16_t bare_input;
volatile int16_t bare_output;

#endif
