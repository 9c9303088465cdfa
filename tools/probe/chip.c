// SPDX-License-Identifier: MIT
// A home for the application's controller where there is no application: the
// co-simulation fills it from the chip's RAM. The build names the controller,
// as in -DPROBE_HEADER="fixpid_an964.h" -DPROBE_TYPE=fixpid_an964.
//
// A controller has no padding and no pointer, so it has the same bytes here and
// under SDCC, on any machine that stores the low byte first.
#include "probe.h"

// For tools that read this file alone.
#ifndef PROBE_HEADER
#define PROBE_HEADER "fixpid_an964.h"
#define PROBE_TYPE fixpid_an964
#endif

#include PROBE_HEADER

#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)

// Deviation 8.5: an application has no header.
extern struct PROBE_TYPE HOST_PROBE_OBJECT;
struct PROBE_TYPE HOST_PROBE_OBJECT;

const char *const probe_name = TEXT(HOST_PROBE_OBJECT);
void *const probe_object = &HOST_PROBE_OBJECT;
const size_t probe_size = sizeof(HOST_PROBE_OBJECT);
