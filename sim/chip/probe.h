// SPDX-License-Identifier: MIT
// The application's objects as the co-simulation sees them: bytes to copy from
// the chip's RAM before host_probe() and host_report() look at them.
#ifndef PROBE_H
#define PROBE_H
#include <stddef.h>

struct probe_object {
    const char *name; // in the firmware
    void *bytes;
    size_t size;
};

// Deviation 8.11: each application has its own number of them.
extern const struct probe_object probe_objects[];
extern const size_t probe_object_count;

#endif
