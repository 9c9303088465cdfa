// SPDX-License-Identifier: MIT
// Shows the host's trace the terms of the application's controller, which the
// build names: -DPROBE_OBJECT=pendulum.
#include "fixpid_an964.h"
#include "host.h"

extern FIXPID_DATA struct fixpid_an964 PROBE_OBJECT;

void host_probe(struct host_terms *terms)
{
    terms->proportional = (double)fixpid_an964_proportional(&PROBE_OBJECT);
    terms->integral = (double)fixpid_an964_integral(&PROBE_OBJECT);
    terms->derivative = (double)fixpid_an964_derivative(&PROBE_OBJECT);
    terms->accumulated_error = (double)PROBE_OBJECT.sum;
}
