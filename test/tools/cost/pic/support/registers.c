// SPDX-License-Identifier: MIT
// For SDCC only: the core registers.
#include "../../../../../port/pic/pic16/support/registers.c"
