// SPDX-License-Identifier: MIT
// Before all else of a file, it makes today's compiler refuse what GCC 4.5 has
// not, the compiler of XC16 and XC32: what came with GCC 4.6 to 10, and C11.
// The standard headers are the compiler's own and come first.
#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A file that asks whether these are there is told that they are not.
#undef __has_attribute
#undef __has_builtin
#undef __has_c_attribute
#undef __has_extension
#undef __has_feature
#undef __has_include
#undef __has_include_next
#define __has_include_next(header) 0 // clang's <limits.h> asks each time
#undef __BYTE_ORDER__
#undef __ORDER_LITTLE_ENDIAN__
#undef __ORDER_BIG_ENDIAN__
#undef __SIZEOF_INT128__
#undef __STDC_VERSION__
#define __STDC_VERSION__ 199901L

#pragma GCC poison __builtin_add_overflow __builtin_sub_overflow
#pragma GCC poison __builtin_mul_overflow __builtin_sadd_overflow
#pragma GCC poison __builtin_saddl_overflow __builtin_ssub_overflow
#pragma GCC poison __builtin_smul_overflow __builtin_uadd_overflow
#pragma GCC poison __builtin_usub_overflow __builtin_umul_overflow
#pragma GCC poison __builtin_add_overflow_p __builtin_mul_overflow_p
#pragma GCC poison __builtin_assume_aligned __builtin_bswap16
#pragma GCC poison __builtin_clrsb __builtin_clrsbl __builtin_assume
#pragma GCC poison __auto_type __int128 fallthrough __fallthrough__
#pragma GCC poison _Alignas _Alignof _Atomic _Generic _Noreturn _Static_assert
#pragma GCC poison _Thread_local __atomic_load_n __atomic_store_n
