// SPDX-License-Identifier: MIT
// Shows the host's trace the terms of the application's controller, which the
// build names, as in -DHOST_PROBE_OBJECT=thermostat. With the name of a
// configuration whose gains the application finds, -DPROBE_CONFIG=name, it
// prints them in the end; and with that of the tuner that finds them,
// -DPROBE_TUNER=name, how far this is, when a row of the trace is due.
#include "fixpid_pid.h"

#include <inttypes.h>
#include <stdio.h> // Deviation 21.6: a program for a PC

#include "host.h"
#ifdef PROBE_TUNER
#include "fixpid_reaction.h"
#include "world.h"
#endif

// Deviation 8.5: an application has no header.
extern FIXPID_DATA struct fixpid_pid HOST_PROBE_OBJECT;

#ifdef PROBE_TUNER
// Deviation 8.5: an application has no header.
extern FIXPID_DATA struct fixpid_reaction PROBE_TUNER;

// A line for each change; before its init it is at 100, too.
static void tell_progress(void)
{
    static int told = 100;
    const int percent = fixpid_reaction_progress(&PROBE_TUNER);

    if (percent != told) {
        told = percent;
        (void)printf("progress: %.1f s, %d %%, status %u\n", world_time_s(),
                     percent, (unsigned)fixpid_reaction_status(&PROBE_TUNER));
    }
}
#else
static void tell_progress(void)
{
    // there is none
}
#endif

void host_probe(struct host_terms *terms)
{
    tell_progress();
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
