// SPDX-License-Identifier: MIT
// fixpid: fixed-point PID controllers without float, heap or hardware.
//
// This header holds compiler facts only. Each controller has a header of its
// own that is also its manual: fixpid_an937.h, fixpid_an964.h,
// fixpid_an964_8bit.h and fixpid_pid.h.
#ifndef FIXPID_H
#define FIXPID_H

#define FIXPID_VERSION_MAJOR 0
#define FIXPID_VERSION_MINOR 1
#define FIXPID_VERSION_PATCH 0

// Where a controller lives. SDCC's PIC ports reach a `__data` pointer with a
// few instructions and a plain one with a library call; elsewhere it is empty.
// Define controllers with it: `FIXPID_DATA struct fixpid_an964 pendulum;`.
#ifndef FIXPID_DATA
#if defined(__SDCC_pic14) || defined(__SDCC_pic16)
#define FIXPID_DATA __data
#else
#define FIXPID_DATA
#endif
#endif

// What a broken caller meets: a null pointer, or, in object mode, a second
// controller. Define it before this header (-DFIXPID_ASSERT=assert and
// -include assert.h) to stop there; by default it is checked by the compiler
// only and costs nothing.
#ifndef FIXPID_ASSERT
#define FIXPID_ASSERT(condition) ((void)sizeof(condition))
#endif

// `value` as an unsigned constant; does not compile where `legal`, a constant
// condition, is false.
#ifdef __cplusplus
#define FIXPID_CHECKED(value, legal)                                           \
    ((unsigned)(value) + (0u * sizeof(char[(legal) ? 1 : -1])))
#elif defined(__GNUC__)
#define FIXPID_CHECKED(value, legal)                                           \
    ((unsigned)(value) +                                                       \
     (__extension__(                                                           \
         0u * sizeof(struct { unsigned out_of_range : (legal) ? 1 : -1; }))))
#else
#define FIXPID_CHECKED(value, legal)                                           \
    ((unsigned)(value) +                                                       \
     (0u * sizeof(struct { unsigned out_of_range : (legal) ? 1 : -1; })))
#endif

#ifdef __cplusplus
#define FIXPID_C_BEGIN extern "C" {
#define FIXPID_C_END }
#else
#define FIXPID_C_BEGIN
#define FIXPID_C_END
#endif

#endif
