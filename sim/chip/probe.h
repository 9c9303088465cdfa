// SPDX-License-Identifier: MIT
// The application as the co-simulation sees it: its objects, which are bytes to
// copy from the chip's RAM before host_probe() and host_report() look at them,
// and its loop.
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

// The port's function that its loop calls for ticks.
extern const char *const probe_wait;

#endif
