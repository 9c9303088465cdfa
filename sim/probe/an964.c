// SPDX-License-Identifier: MIT
// Shows the host's trace the terms of the application's controller, which the
// build names, as in -DHOST_PROBE_OBJECT=pendulum.
#include "fixpid_an964.h"
#include "host.h"

// Deviation 8.5: an application has no header.
extern FIXPID_DATA struct fixpid_an964 HOST_PROBE_OBJECT;

void host_probe(struct host_terms *terms)
{
    terms->proportional = (double)fixpid_an964_proportional(&HOST_PROBE_OBJECT);
    terms->integral = (double)fixpid_an964_integral(&HOST_PROBE_OBJECT);
    terms->derivative = (double)fixpid_an964_derivative(&HOST_PROBE_OBJECT);
    terms->accumulated_error = (double)(int16_t)HOST_PROBE_OBJECT.sum;
}

void host_report(void)
{
    // nothing but its terms
}
