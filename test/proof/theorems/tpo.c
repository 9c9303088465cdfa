// SPDX-License-Identifier: MIT
// What a user may rely on of fixpid_tpo, in one sentence.
#include "../tpo.c"

static struct fixpid_tpo_config config;
// What all windows were asked for less what was given, full in each step on.
static number owed;

// Domain: less is left of the window than its length.
static bool tpo_is_begun(const struct fixpid_tpo *x)
{
    return x->left < x->window;
}

static number least_on(void)
{
    return (config.minimum_on == 0u) ? 1 : config.minimum_on;
}

static number least_off(void)
{
    return (config.minimum_off == 0u) ? 1 : config.minimum_off;
}

// What a window may leave to the next: less than the shortest pulse or gap.
static bool is_carry(number credit)
{
    return (credit < of_full(least_on())) && (credit > -of_full(least_off()));
}

// Domain: the credit is less than the shortest pulse or gap; or it will be,
// once the rest of the window is on; or the pulse ends in time for the gap.
static bool tpo_is_on_its_way(void)
{
    const number rest = of_full(c.left);

    if ((c.left == 0u) || (c.on == 0u)) {
        return is_carry(c.credit);
    }
    if (c.whole != 0u) {
        return is_carry(c.credit - rest);
    }
    return (c.credit >= 0) &&
           ((c.credit < c.full) ||
            (c.credit < rest + c.full - of_full(config.minimum_off)));
}

// What the product with `full` is known for, here: a step more is `full` more.
static void assume_products(void)
{
    const number window = config.window;

    assume(of_full(1) == config.full);
    assume(of_full(window) == of_full(window - 1) + config.full);
    assume((c.left == 0u) ||
           (of_full(c.left) == of_full((number)c.left - 1) + config.full));
    assume(of_full(window + 1 - config.minimum_off) ==
           of_full(window) + config.full - of_full(config.minimum_off));
    assume_growth(config.minimum_on, window + 1 - config.minimum_off);
    assume_growth(1, least_on());
    assume_growth(1, least_off());
    assume_growth(least_on(), window);
    assume(of_full(window) <= (number)32767 * 32767);
}

// What a window's first step asks for.
static void assume_asked(number asked)
{
    assume(inside(asked, 0, of_full(config.window)));
}

// Theorem: Over any number of whole windows since init or reset, what
// fixpid_tpo has given, `full` in each step that is on, is what was asked for,
// to within less than the shortest pulse or gap, which count as one step at
// least. Assumed: that a window's first step asks for duty * window, from 0 to
// full * window; tools/prove primitives tpo tries all duties in all windows.
void prove_tpo_exact(void)
{
    number asked = 0;

    config = nondet_tpo_config();
    assume(tpo_is_legal(&config));
    c = nondet_tpo();
    c.full = config.full;
    c.window = config.window;
    c.pulse_least = (int32_t)of_full(config.minimum_on);
    c.whole_least =
        (int32_t)of_full((number)config.window + 1 - config.minimum_off);
    assume(tpo_is_begun(&c));
    assume_products();
    if (nondet_bool()) {
        fixpid_tpo_reset(&c); // as init does
        owed = 0;
    } else {
        const bool opens = c.left == 0u;
        bool on;

        owed = c.credit;
        assume(tpo_is_on_its_way());
        on = fixpid_tpo_step(&c, nondet_int16());
        if (opens) {
            asked = ((number)c.credit + (on ? config.full : 0)) - owed;
            assume_asked(asked);
        }
        owed += asked - (on ? config.full : 0);
    }
    claim(c.credit == owed);
    claim(tpo_is_on_its_way());
    if (c.left == 0u) {
        claim(is_carry(owed));
    }
}
