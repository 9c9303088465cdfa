// SPDX-License-Identifier: MIT
// What is included after this is preprocessed as for a compiler that nobody
// knows, with an int of 16 bits: the forms in plain C that neither gcc nor
// clang takes by itself. The types stay as they are.
#ifndef ANOTHER_COMPILER_H
#define ANOTHER_COMPILER_H
#include <limits.h>
#include <stdint.h>

#pragma GCC system_header // to undefine __has_builtin without a warning
#undef __GNUC__
#undef __has_builtin
#undef __AVR_HAVE_MOVW__
#undef __AVR_HAVE_MUL__
#undef INT_MAX
#define INT_MAX 32767

#endif
