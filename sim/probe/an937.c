// SPDX-License-Identifier: MIT
// Shows the host's trace the terms of the application's controller, which the
// build names, as in -DHOST_PROBE_OBJECT=pendulum.
#include "fixpid_an937.h"
#include "host.h"

// Deviation 8.5: an application has no header.
extern FIXPID_DATA struct fixpid_an937 HOST_PROBE_OBJECT;

void host_probe(struct host_terms *terms)
{
    terms->proportional =
        (double)fixpid_an937_proportional(&HOST_PROBE_OBJECT) / 16.0;
    terms->integral = (double)fixpid_an937_integral(&HOST_PROBE_OBJECT) / 16.0;
    terms->derivative =
        (double)fixpid_an937_derivative(&HOST_PROBE_OBJECT) / 16.0;
    terms->accumulated_error =
        (double)fixpid_an937_accumulated_error(&HOST_PROBE_OBJECT);
}

void host_report(void)
{
    // nothing but its terms
}
