// SPDX-License-Identifier: MIT
// Shows the host's trace the terms of the application's controller, which the
// build names: -DPROBE_OBJECT=pendulum.
#include "fixpid_an937.h"
#include "host.h"

extern FIXPID_DATA struct fixpid_an937 PROBE_OBJECT;

void host_probe(struct host_terms *terms)
{
    terms->proportional =
        (double)fixpid_an937_proportional(&PROBE_OBJECT) / 16.0;
    terms->integral = (double)fixpid_an937_integral(&PROBE_OBJECT) / 16.0;
    terms->derivative = (double)fixpid_an937_derivative(&PROBE_OBJECT) / 16.0;
    terms->accumulated_error =
        (double)fixpid_an937_accumulated_error(&PROBE_OBJECT);
}
