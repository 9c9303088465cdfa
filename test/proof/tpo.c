// SPDX-License-Identifier: MIT
// fixpid_tpo against the equations of its header.
#include "prove.h"

#include "fixpid_tpo.h"

struct fixpid_tpo c; // of any bytes, where a proof begins
struct fixpid_tpo nondet_tpo(void);
struct fixpid_tpo_config nondet_tpo_config(void);

#include "tpo/fixpid_tpo.c"
#include "tpo/fixpid_tpo_check.c"

// Domain: a configuration that init accepts: full is at least 1, the window has
// 1 to 32767 steps, and the shortest pulse and the shortest gap fit into it.
static bool tpo_is_legal(const struct fixpid_tpo_config *config)
{
    return (config->full >= 1) && inside(config->window, 1, 32767) &&
           ((number)config->minimum_on + config->minimum_off <= config->window);
}

// Domain: before the first step of a window: full is at least 1, and the credit
// is from -32766 * 32767 to 32767 * 32767.
static bool tpo_is_between(const struct fixpid_tpo *x)
{
    return (x->full >= 1) && (x->left == 0u) &&
           inside(x->credit, -(number)32766 * 32767, (number)32767 * 32767);
}

// Domain: within a window: full is at least 1, and everything else is any.
static bool tpo_is_within(const struct fixpid_tpo *x)
{
    return (x->full >= 1) && (x->left != 0u);
}

// What init makes of a configuration. The products are those of 32 bits, as in
// the code: that they fit is checked with it.
static bool configured(const struct fixpid_tpo *x,
                       const struct fixpid_tpo_config *config)
{
    return (x->full == config->full) && (x->window == config->window) &&
           (x->pulse_least == (int32_t)config->minimum_on * config->full) &&
           (x->whole_least ==
            ((int32_t)config->window + 1 - (int32_t)config->minimum_off) *
                config->full);
}

static bool at_rest(const struct fixpid_tpo *x)
{
    return (x->credit == 0) && (x->left == 0u) && (x->on == 0u) &&
           (x->whole == 0u);
}

void prove_init(void)
{
    const struct fixpid_tpo_config config = nondet_tpo_config();

    c = nondet_tpo();
    claim(fixpid_tpo_init(&c, &config) == tpo_is_legal(&config));
    claim(at_rest(&c));
    if (tpo_is_legal(&config)) {
        claim(configured(&c, &config));
    } else {
        claim((c.full == 0) && !fixpid_tpo_step(&c, nondet_int16()));
    }
}

// The fields that are legal, up to the one that check names.
void prove_check(void)
{
    const struct fixpid_tpo_config config = nondet_tpo_config();
    const unsigned problem = (unsigned)fixpid_tpo_check(&config);
    const number rest = (number)config.window - config.minimum_on;
    const bool good[] = {true, config.full >= 1,
                         inside(config.window, 1, 32767), rest >= 0,
                         config.minimum_off <= rest};

    c = nondet_tpo();
    claim(fixpid_tpo_init(&c, &config) == (problem == FIXPID_TPO_OK));
    claim(problem <= FIXPID_TPO_BAD_MINIMUM_OFF);
    for (unsigned field = 1; field < sizeof good; field++) {
        claim(good[field] || ((problem != 0u) && (problem <= field)));
        claim((problem != field) || !good[field]);
    }
}

void prove_reset(void)
{
    struct fixpid_tpo was;

    c = nondet_tpo();
    was = c;
    fixpid_tpo_reset(&c);
    claim(at_rest(&c));
    claim((c.full == was.full) && (c.window == was.window) &&
          (c.pulse_least == was.pulse_least) &&
          (c.whole_least == was.whole_least));
}

// So many steps times `full`: of the product a proof knows that it grows by
// `full` with each step, and with the number of steps.
uint32_t __CPROVER_uninterpreted_of_full(uint16_t steps);

static number assume_of_full(number steps)
{
    const number p = __CPROVER_uninterpreted_of_full((uint16_t)steps);

    assume((steps != 0) || (p == 0));
    assume(p <= (number)0x7FFF0000);
    return p;
}

static number of_full(number steps)
{
    return assume_of_full(steps);
}

static void assume_growth(number steps, number than)
{
    assume((steps > than) || (of_full(steps) <= of_full(than)));
    assume((steps < than) || (of_full(steps) >= of_full(than)));
}

// floor(owed / full) is `steps`: any number that has its two inequalities.
static void assume_quotient(number steps, number owed, number full)
{
    assume(of_full(1) == full);
    assume((owed < 0) || (of_full(steps) <= owed));
    assume((owed < 0) || (of_full(steps + 1) > owed));
}

// The first step of a window makes a pulse of what is owed.
void prove_open(void)
{
    const struct fixpid_tpo_config config = nondet_tpo_config();
    const number full = config.full;
    const number window = config.window;
    const number pulse_least = config.minimum_on;
    const number whole_least = window + 1 - config.minimum_off;
    const number steps = nondet_uint16();
    number owed;
    number pulse;
    bool out;

    assume(tpo_is_legal(&config));
    c = nondet_tpo();
    c.full = config.full;
    c.window = config.window;
    c.left = 0;
    c.pulse_least = (int32_t)of_full(pulse_least);
    c.whole_least = (int32_t)of_full(whole_least);
    out = fixpid_tpo_step(&c, nondet_int16());
    owed = c.credit + (out ? full : 0);

    assume_quotient(steps, owed, full);
    assume_growth(1, steps);
    assume_growth(pulse_least, steps);
    assume_growth(pulse_least, steps + 1);
    assume_growth(whole_least, steps);
    assume_growth(whole_least, steps + 1);
    pulse = (owed < 0) ? 0 : steps;
    if (pulse < config.minimum_on) {
        pulse = 0;
    }
    if ((pulse > window) || (window - pulse < config.minimum_off)) {
        pulse = window;
    }
    claim(out == (pulse > 0));
    claim(c.left == window - 1);
    if (c.on == 0u) {
        claim(pulse == 0);
    } else if (c.whole != 0u) {
        claim(pulse == window);
    } else {
        claim(pulse == steps);
    }
}

// What is owed is the carry and duty * window, in windows of a power of two: a
// solver is slow at others. primitives_tpo.c tries all duties in all windows.
void prove_owed(void)
{
    for (unsigned bits = 0; bits < 15u; bits++) {
        const int16_t duty = nondet_int16();
        struct fixpid_tpo was;
        bool out;

        c = nondet_tpo();
        assume(tpo_is_between(&c));
        c.window = (uint16_t)(1u << bits);
        was = c;
        out = fixpid_tpo_step(&c, duty);
        claim((number)c.credit + (out ? was.full : 0) ==
              was.credit + (clamp(duty, 0, was.full) << bits));
    }
}

// A later step of a window: on while what is owed makes a step, or to the end.
void prove_later(void)
{
    struct fixpid_tpo was;
    bool out;

    c = nondet_tpo();
    assume(tpo_is_within(&c));
    was = c;
    out = fixpid_tpo_step(&c, nondet_int16());
    claim(out ==
          ((was.on != 0u) && ((was.whole != 0u) || (was.credit >= was.full))));
    claim(c.left == was.left - 1u);
    if (was.credit >= -INT32_C(0x7FFF0000)) {
        claim(c.credit == (number)was.credit - (out ? was.full : 0));
    }
    claim((c.on == was.on) && (c.whole == was.whole));
    claim((c.full == was.full) && (c.window == was.window));
}

// Of any bytes: nothing undefined. Both outputs are legal.
void prove_total(void)
{
    c = nondet_tpo();
    (void)fixpid_tpo_step(&c, nondet_int16());
    (void)fixpid_tpo_step(&c, nondet_int16());
}
