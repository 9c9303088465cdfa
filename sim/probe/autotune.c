// SPDX-License-Identifier: MIT
// An application with an experiment alone has no controller to look at. In the
// end this program does what its PC would do: it takes the record, which the
// build names as in -DHOST_PROBE_OBJECT=measured, and prints the gains.
#include "fixpid_autotune.h"

#include <inttypes.h>
#include <stdio.h> // Deviation 21.6: a program for a PC

#include "host.h"

// Deviation 8.5: an application has no header.
extern struct fixpid_autotune_record HOST_PROBE_OBJECT;

void host_probe(struct host_terms *terms)
{
    (void)terms; // all 0
}

void host_report(void)
{
    struct fixpid_autotune tuner;
    struct fixpid_pid_config found = {.output_min = 0};

    if (!fixpid_autotune_unpack(&tuner, &HOST_PROBE_OBJECT)) {
        (void)printf("no record\n");
        return;
    }
    (void)printf("record:");
    for (unsigned at = 0; at < FIXPID_AUTOTUNE_RECORD_SIZE; at++) {
        (void)printf(" %02x", (unsigned)HOST_PROBE_OBJECT.bytes[at]);
    }
    (void)printf("\n");
    if (fixpid_autotune_result(&tuner, FIXPID_AUTOTUNE_PI, FIXPID_AUTOTUNE_SAFE,
                               &found)) {
        (void)printf("gains: kp_q8 %" PRIu16 ", ki_q24 %" PRIu32
                     ", kd_q8 %" PRIu16 ", filter %u\n",
                     found.gains.kp_q8, found.gains.ki_q24, found.gains.kd_q8,
                     (unsigned)found.gains.derivative_filter);
    } else {
        (void)printf("no gains: status %u, reason %u\n",
                     (unsigned)fixpid_autotune_status(&tuner),
                     (unsigned)fixpid_autotune_reason(
                         &tuner, FIXPID_AUTOTUNE_PI, FIXPID_AUTOTUNE_SAFE));
    }
}
