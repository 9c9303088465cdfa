// SPDX-License-Identifier: MIT
// What copies a structure, which WebAssembly has as an instruction.
#ifndef STRING_H
#define STRING_H
#define memcpy __builtin_memcpy
#endif
