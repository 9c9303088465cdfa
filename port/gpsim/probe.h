// SPDX-License-Identifier: MIT
// The application's controller as the co-simulation sees it: bytes to copy from
// the chip's RAM before host_probe() looks at them.
#ifndef PROBE_H
#define PROBE_H
#include <stddef.h>

extern const char *const probe_name; // its name in the firmware
extern void *const probe_object;
extern const size_t probe_size;

#endif
