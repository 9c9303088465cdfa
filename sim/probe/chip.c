// SPDX-License-Identifier: MIT
// A home for the application's objects where there is no application: the
// co-simulation fills them from the chip's RAM. The build names the controller,
// as in -DPROBE_HEADER="fixpid_an964.h" -DPROBE_TYPE=fixpid_an964, the port's
// function that the application's loop calls for ticks, -DPROBE_WAIT="name",
// and where there is one, the configuration whose gains the application has
// found: -DPROBE_CONFIG=name.
//
// They have no pointer, and the build leaves no room between their members, so
// they have the same bytes here and under SDCC, on any machine that stores the
// low byte first.
#include "probe.h"

// For tools that read this file alone.
#ifndef PROBE_HEADER
#define PROBE_HEADER "fixpid_an964.h"
#define PROBE_TYPE fixpid_an964
#define PROBE_WAIT "port_wait_tick"
#endif

#include PROBE_HEADER

#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)

#define HOME(object)                                                           \
    {                                                                          \
        TEXT(object), &(object), sizeof(object)                                \
    }

// Deviation 8.5: an application has no header.
extern struct PROBE_TYPE HOST_PROBE_OBJECT;
struct PROBE_TYPE HOST_PROBE_OBJECT;

#ifdef PROBE_CONFIG
// Deviation 8.5: an application has no header.
extern struct fixpid_pid_config PROBE_CONFIG;
struct fixpid_pid_config PROBE_CONFIG;
#define HOME_OF_CONFIG HOME(PROBE_CONFIG),
#else
#define HOME_OF_CONFIG
#endif

const struct probe_object probe_objects[] = {
    HOME(HOST_PROBE_OBJECT),
    HOME_OF_CONFIG // or nothing
};
const size_t probe_object_count =
    sizeof(probe_objects) / sizeof(probe_objects[0]);
const char *const probe_wait = PROBE_WAIT;
