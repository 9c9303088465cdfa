// SPDX-License-Identifier: MIT
// fixpid_autotune: its step is total, its output within its range, and what is
// final stays so. The experiment itself is compared with a model by
// test/model/autotune; its result is more arithmetic than a solver takes.
#include "prove.h"

#include "fixpid_autotune.h"

struct fixpid_autotune c; // of any bytes, where a proof begins
struct fixpid_autotune nondet_autotune(void);
struct fixpid_autotune_config nondet_autotune_config(void);

#include "autotune/fixpid_autotune.c"
#include "autotune/fixpid_autotune_cycle.c"

static bool legal_config(const struct fixpid_autotune_config *k)
{
    return (k->output_min < k->output_max) &&
           inside(k->output_rest, k->output_min, k->output_max) &&
           (k->measurement_min < k->measurement_max) &&
           ((k->swing == 0u) || inside(k->swing, 8, 16383)) &&
           inside(k->timeout_steps, 2, 32767) && inside(k->cycles, 1, 4) &&
           ((k->options & 0x7Fu) == 0u);
}

static bool same_config(const struct fixpid_autotune_config *a,
                        const struct fixpid_autotune_config *b)
{
    return (a->output_min == b->output_min) &&
           (a->output_max == b->output_max) &&
           (a->output_rest == b->output_rest) &&
           (a->measurement_min == b->measurement_min) &&
           (a->measurement_max == b->measurement_max) &&
           (a->swing == b->swing) && (a->timeout_steps == b->timeout_steps) &&
           (a->cycles == b->cycles) && (a->options == b->options);
}

static void claim_started(bool legal)
{
    claim(fixpid_autotune_status(&c) ==
          (legal ? FIXPID_AUTOTUNE_RUNNING : FIXPID_AUTOTUNE_REFUSED));
    claim(c.output == c.config.output_rest);
    claim((c.elapsed == 0u) && (c.noise == 0u) && (c.seen == 0u));
    claim(legal || ((c.config.output_min == 0) && (c.config.output_max == 0) &&
                    (c.config.cycles == 0u)));
}

void prove_init(void)
{
    const struct fixpid_autotune_config config = nondet_autotune_config();
    const bool legal = legal_config(&config);

    c = nondet_autotune();
    claim(fixpid_autotune_init(&c, &config) == legal);
    claim(!legal || same_config(&c.config, &config));
    claim_started(legal);
    fixpid_autotune_reset(&c);
    claim_started(legal);
}

// Of any bytes: nothing undefined, it ends, and the output is within the range
// as it stands; an experiment that is over stays so.
void prove_total(void)
{
    const int16_t measurement = nondet_int16();
    struct fixpid_autotune was;
    number out;

    c = nondet_autotune();
    was = c;
    out = fixpid_autotune_step(&c, nondet_int16(), measurement);
    if (was.config.output_min <= was.config.output_max) {
        claim(inside(out, was.config.output_min, was.config.output_max));
    } else {
        claim((out == was.config.output_min) || (out == was.config.output_max));
    }
    claim(same_config(&c.config, &was.config));
    if (was.state < PHASE_NOISE) {
        claim((c.state == was.state) && (c.output == was.output));
    } else if ((measurement <= was.config.measurement_min) ||
               (measurement >= was.config.measurement_max)) {
        claim((c.state == FIXPID_AUTOTUNE_SATURATED) &&
              (c.output == was.config.output_rest));
    } else if (was.elapsed >= was.config.timeout_steps) {
        claim((c.state == FIXPID_AUTOTUNE_NO_OSCILLATION) &&
              (c.output == was.config.output_rest));
    }
}
