// SPDX-License-Identifier: MIT
// <stdint.h> of the machine that is proved for. PROOF_WORD is 16 (an int of 16
// bits, a long of 32), 32 (both have 32) or 64 (an int of 32, a long of 64).
#ifndef PROOF_STDINT_H
#define PROOF_STDINT_H

typedef signed char int8_t;
typedef unsigned char uint8_t;
typedef short int16_t;
typedef unsigned short uint16_t;
typedef long long int64_t;
typedef unsigned long long uint64_t;
#if PROOF_WORD == 16
typedef long int32_t;
typedef unsigned long uint32_t;
#define INT32_C(value) value##L
#define UINT32_C(value) value##UL
#define UINT16_MAX 0xFFFFu
#else
typedef int int32_t;
typedef unsigned int uint32_t;
#define INT32_C(value) value
#define UINT32_C(value) value##U
#define UINT16_MAX 0xFFFF
#endif
typedef int int_fast16_t;
typedef unsigned int uint_fast16_t;
typedef unsigned char uint_fast8_t;

#define INT16_MAX 32767
#define INT16_MIN (-INT16_MAX - 1)
#define UINT8_MAX 255
#define INT32_MAX INT32_C(2147483647)
#define INT32_MIN (-INT32_MAX - 1)
#define UINT32_MAX UINT32_C(0xFFFFFFFF)

#endif
