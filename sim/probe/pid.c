// SPDX-License-Identifier: MIT
// Shows the host's trace the terms of the application's controller, which the
// build names, as in -DHOST_PROBE_OBJECT=thermostat. With the name of a
// configuration whose gains the application finds, -DPROBE_CONFIG=name, it
// prints them in the end.
#include "fixpid_pid.h"

#include <inttypes.h>
#include <stdio.h> // Deviation 21.6: a program for a PC

#include "host.h"

// Deviation 8.5: an application has no header.
extern FIXPID_DATA struct fixpid_pid HOST_PROBE_OBJECT;

void host_probe(struct host_terms *terms)
{
    terms->proportional =
        (double)fixpid_pid_proportional(&HOST_PROBE_OBJECT) / 256.0;
    terms->integral = (double)fixpid_pid_integral(&HOST_PROBE_OBJECT) / 65536.0;
    terms->derivative =
        (double)fixpid_pid_derivative(&HOST_PROBE_OBJECT) / 256.0;
}

#ifdef PROBE_CONFIG
// Deviation 8.5: an application has no header.
extern struct fixpid_pid_config PROBE_CONFIG;

void host_report(void)
{
    (void)printf("gains: kp_q8 %" PRIu16 ", ki_q24 %" PRIu32 ", kd_q8 %" PRIu16
                 ", filter %u\n",
                 PROBE_CONFIG.gains.kp_q8, PROBE_CONFIG.gains.ki_q24,
                 PROBE_CONFIG.gains.kd_q8,
                 (unsigned)PROBE_CONFIG.gains.derivative_filter);
}
#else
void host_report(void)
{
    // nothing but its terms
}
#endif
