// SPDX-License-Identifier: MIT
// <limits.h> of the machine that is proved for, as in stdint.h here.
#ifndef PROOF_LIMITS_H
#define PROOF_LIMITS_H

#define CHAR_BIT 8
#if PROOF_WORD == 16
#define INT_MAX 32767
#define UINT_MAX 65535u
#else
#define INT_MAX 2147483647
#define UINT_MAX 4294967295u
#endif

#endif
