// SPDX-License-Identifier: MIT
// What the proofs of fixpid_autotune share: the definition of a step, in whole
// numbers, and what an experiment can be.
#ifndef PROOF_AUTOTUNE_H
#define PROOF_AUTOTUNE_H
#include "prove.h"

#include "fixpid_autotune.h"

struct fixpid_autotune c; // of any bytes, where a proof begins
struct fixpid_autotune nondet_autotune(void);

// `state` of an experiment that runs.
enum {
    IN_NOISE = 16,
    IN_FIND,   // the whole range
    IN_CENTRE, // smaller
    IN_FIRST,  // lopsided up
    IN_SECOND, // lopsided down
    IN_THIRD   // lopsided up again
};

enum { LOW_SIDE, HIGH_SIDE };

enum { FRESH_RELAY = 255 }; // `averaged` in a relay's first cycle

enum { FARTHEST = 32767 }; // a deviation

static number lesser(number a, number b)
{
    return (a < b) ? a : b;
}

static number greater(number a, number b)
{
    return (a > b) ? a : b;
}

static number size_of(number x)
{
    return (x < 0) ? -x : x;
}

// A number that is kept in 16 bits, which hold it.
static uint16_t unsigned16(number x)
{
    pre(inside(x, 0, 65535));
    return (uint16_t)x;
}

static int16_t signed16(number x)
{
    pre(inside(x, -32768, 32767));
    return (int16_t)x;
}

static bool legal_config(const struct fixpid_autotune_kept *k)
{
    return (k->output_min < k->output_max) &&
           inside(k->output_rest, k->output_min, k->output_max) &&
           (k->measurement_min < k->measurement_max) &&
           ((k->swing == 0u) || inside(k->swing, 8, 16383)) &&
           inside(k->timeout_steps, 2, 32767) && inside(k->cycles, 1, 4);
}

// Reverse or not, by whichever bits.
static bool same_config(const struct fixpid_autotune_kept *a,
                        const struct fixpid_autotune_kept *b)
{
    return (a->output_min == b->output_min) &&
           (a->output_max == b->output_max) &&
           (a->output_rest == b->output_rest) &&
           (a->measurement_min == b->measurement_min) &&
           (a->measurement_max == b->measurement_max) &&
           (a->swing == b->swing) && (a->timeout_steps == b->timeout_steps) &&
           (a->cycles == b->cycles) &&
           ((a->reverse != 0u) == (b->reverse != 0u));
}

static bool equal_sums(const struct fixpid_autotune_sums *a,
                       const struct fixpid_autotune_sums *b)
{
    return (a->all == b->all) && (a->on == b->on) && (a->rise == b->rise) &&
           (a->steps == b->steps) && (a->on_steps == b->on_steps);
}

static void claim_same(const struct fixpid_autotune *a,
                       const struct fixpid_autotune *b)
{
    claim(a->state == b->state);
    claim(a->side == b->side);
    claim(a->seen == b->seen);
    claim(a->averaged == b->averaged);
    claim(a->output == b->output);
    claim(a->elapsed == b->elapsed);
    claim(a->period == b->period);
    claim(a->last_period == b->last_period);
    claim((a->highest == b->highest) && (a->lowest == b->lowest));
    claim(a->noise == b->noise);
    claim(a->edge == b->edge);
    claim((a->centre == b->centre) && (a->half == b->half));
    claim((a->first_on == b->first_on) && (a->first_steps == b->first_steps));
    claim(same_config(&a->config, &b->config));
    claim(equal_sums(&a->sums[0], &b->sums[0]));
    claim(equal_sums(&a->sums[1], &b->sums[1]));
}

// ---- The noise and the relays ----

// What the noise asks for as hysteresis: 3 standard deviations and 1.
static number asked_by_noise(const struct fixpid_autotune *x)
{
    return 1 + floor_by(x->noise + floor_by(x->noise, 1) + 16, 5);
}

// How far below its centre the relay of a phase goes, and how far above.
static number far_below(const struct fixpid_autotune *x, unsigned phase)
{
    return (phase == IN_CENTRE)   ? (x->half + floor_by(x->half, 1))
           : (phase == IN_SECOND) ? (2 * (number)x->half)
                                  : x->half;
}

static number far_above(const struct fixpid_autotune *x, unsigned phase)
{
    return (phase == IN_CENTRE)   ? (x->half + floor_by(x->half, 1))
           : (phase == IN_SECOND) ? x->half
                                  : (2 * (number)x->half);
}

static number low_output(const struct fixpid_autotune *x, unsigned phase)
{
    return (phase == IN_FIND)
               ? x->config.output_min
               : greater(x->centre - far_below(x, phase), x->config.output_min);
}

static number high_output(const struct fixpid_autotune *x, unsigned phase)
{
    return (phase == IN_FIND)
               ? x->config.output_max
               : lesser(x->centre + far_above(x, phase), x->config.output_max);
}

// The output at rest, or the one of phase and side.
static number output_of(const struct fixpid_autotune *x)
{
    if (x->state <= IN_NOISE) {
        return x->config.output_rest;
    }
    return (x->side == HIGH_SIDE) ? high_output(x, x->state)
                                  : low_output(x, x->state);
}

// The longest relay is three halves.
static number third_of(number relay)
{
    return greater(floor_by(relay * 85, 8), 2);
}

// At rest near the setpoint a small relay about that output, otherwise the
// whole range.
static void start_as_defined(struct fixpid_autotune *x, number deviation)
{
    const struct fixpid_autotune_kept *const k = &x->config;

    x->side = (deviation <= 0) ? HIGH_SIDE : LOW_SIDE;
    x->elapsed = 0;
    x->lowest = x->highest;
    x->edge = unsigned16(asked_by_noise(x));
    x->centre = k->output_rest;
    x->state = IN_FIND;
    if ((size_of(deviation) < 24 * asked_by_noise(x)) &&
        inside(k->output_rest, (number)k->output_min + 1,
               (number)k->output_max - 1)) {
        x->state = IN_CENTRE;
        x->half = unsigned16(
            third_of(floor_by((number)k->output_max - k->output_min, 3)));
    }
}

static void output_as_defined(struct fixpid_autotune *x)
{
    x->output = signed16(output_of(x));
}

// Domain: the limits of the output are in order, and a relay that has a centre
// has it between them, with half an amplitude of 2 to 21759.
static bool autotune_has_relay(const struct fixpid_autotune *x)
{
    return (x->config.output_min < x->config.output_max) &&
           ((x->state == IN_FIND) ||
            (inside(x->half, 2, 21759) &&
             inside(x->centre, x->config.output_min, x->config.output_max)));
}

// ---- A step ----

// What the definition hands to a part and what the part makes of it. Where the
// code comes to that part, it must hand the same to it, and gets the same. What
// an open part makes of it is anything.
struct part {
    bool open;
    bool due;
    number deviation;
    struct fixpid_autotune before;
    struct fixpid_autotune after;
};

static struct part noise_part, sum_part, turn_part, relay_part, end_part,
    lost_part, centre_part, alike_part;

static void take_part(struct part *part, struct fixpid_autotune *self,
                      number deviation)
{
    claim(part->due);
    claim(part->deviation == deviation);
    claim_same(self, &part->before);
    *self = part->after;
    part->due = false;
}

// Whether nothing is left to do.
static bool begin(struct part *part, struct fixpid_autotune *x,
                  number deviation)
{
    part->due = true;
    part->deviation = deviation;
    part->before = *x;
    if (part->open) {
        const struct fixpid_autotune_kept config = x->config;

        *x = nondet_autotune();
        x->config = config;
        part->after = *x;
    }
    return part->open;
}

static void end(struct part *part, const struct fixpid_autotune *x)
{
    part->after = *x;
}

static void over_as_defined(struct fixpid_autotune *x, unsigned status)
{
    x->state = (uint8_t)status;
    output_as_defined(x);
}

static void noise_as_defined(struct fixpid_autotune *x, number deviation)
{
    const number bend =
        size_of(deviation - (2 * (number)x->highest) + x->lowest);

    if (begin(&noise_part, x, deviation)) {
        return;
    }
    x->elapsed++;
    x->lowest = x->highest;
    x->highest = signed16(deviation);
    if (x->elapsed > 2) {
        x->noise = unsigned16(x->noise + lesser(bend, 1023));
    }
    if (x->elapsed == 34) {
        start_as_defined(x, deviation);
        output_as_defined(x);
    }
    end(&noise_part, x);
}

static struct fixpid_autotune_sums *sums_now(struct fixpid_autotune *x)
{
    return &x->sums[(x->state == IN_SECOND) ? 1 : 0];
}

static void sum_as_defined(struct fixpid_autotune *x, number deviation)
{
    struct fixpid_autotune_sums *const sums = sums_now(x);
    const number turn = clamp(deviation, -2047, 2047);
    const bool high = x->side == HIGH_SIDE;

    (void)begin(&sum_part, x, deviation);
    sums->all = (int32_t)(sums->all + deviation);
    sums->on = (int32_t)(sums->on + (high ? deviation : 0));
    sums->steps = unsigned16((number)sums->steps + 1);
    sums->on_steps = unsigned16((number)sums->on_steps + (high ? 1 : 0));
    if (x->elapsed == 1u) {
        // The sums of relays that look for the setpoint are only counted.
        claim((x->state <= IN_CENTRE) ||
              inside(sums->rise + (high ? -turn : turn), -32768, 32767));
        sums->rise = (int16_t)(sums->rise + (high ? -turn : turn));
    }
    if (sums->steps == 32767u) {
        over_as_defined(x, FIXPID_AUTOTUNE_TOO_SLOW);
    }
    end(&sum_part, x);
}

static void clear_as_defined(struct fixpid_autotune_sums *sums)
{
    const struct fixpid_autotune_sums none = {0};

    *sums = none;
}

// The load moved, or a cycle is unlike the others.
static void again_as_defined(struct fixpid_autotune *x)
{
    if (x->state == IN_THIRD) {
        x->state = IN_FIRST;
    }
    clear_as_defined(sums_now(x));
    x->averaged = 0;
}

static bool short_half(const struct fixpid_autotune_sums *sums)
{
    const number off_steps = (number)sums->steps - sums->on_steps;

    return lesser(sums->on_steps, off_steps) < floor_by(sums->steps, 3);
}

static unsigned verdict_of(const struct fixpid_autotune *x)
{
    if (short_half(&x->sums[0]) || short_half(&x->sums[1])) {
        return FIXPID_AUTOTUNE_IRREGULAR;
    }
    if (x->last_period < 10u) {
        return FIXPID_AUTOTUNE_TOO_FAST;
    }
    return ((number)x->highest - x->lowest < 4 * asked_by_noise(x))
               ? FIXPID_AUTOTUNE_TOO_SMALL
               : FIXPID_AUTOTUNE_DONE;
}

// |on others - others_on steps| <= allowed others, whichever numbers these are.
bool __CPROVER_uninterpreted_same_share(uint16_t on, uint16_t steps,
                                        uint16_t others_on, uint16_t others,
                                        uint16_t allowed);

static bool same_share(number on, number steps, number others_on, number others,
                       number allowed)
{
    return __CPROVER_uninterpreted_same_share(
        unsigned16(on), unsigned16(steps), unsigned16(others_on),
        unsigned16(others), unsigned16(allowed));
}

static bool alike; // what was said last

// Whether the cycle is like the others: any answer.
static bool is_alike(const struct fixpid_autotune *x, number before)
{
    alike_part.due = true;
    alike_part.deviation = before;
    alike_part.before = *x;
    alike = nondet_bool();
    return alike;
}

static void relay_complete(struct fixpid_autotune *x)
{
    if (x->state == IN_THIRD) {
        const number last = (number)x->sums[0].steps - x->first_steps;
        const number on = (number)x->sums[0].on_steps - x->first_on;

        if (same_share(on, last, x->first_on, x->first_steps,
                       floor_by(last, 6) + 2)) {
            over_as_defined(x, verdict_of(x));
        } else {
            again_as_defined(x);
        }
        return;
    }
    if (x->state == IN_FIRST) {
        x->first_on = x->sums[0].on_steps;
        x->first_steps = x->sums[0].steps;
        clear_as_defined(&x->sums[1]);
    }
    x->averaged = FRESH_RELAY;
    x->state++;
}

// What the last cycle makes: its proof says which relay it is.
static void some_relay(struct fixpid_autotune *x)
{
    const number low = low_output(x, x->state);
    const number high = high_output(x, x->state);

    (void)begin(&centre_part, x, 0);
    x->centre = (int16_t)clamp(nondet_int16(), low, high);
    x->half = (uint16_t)clamp(nondet_uint16(), 2, 21759);
    x->edge = (uint16_t)clamp(nondet_uint16(), 1, 30208);
    end(&centre_part, x);
}

// Much like the one that it was made from, or there were too many.
static bool fits_as_defined(const struct fixpid_autotune *x, number centre,
                            number half)
{
    return (x->seen >= 20u) ||
           ((size_of(x->centre - centre) <= half) && (x->half <= 2 * half) &&
            (half <= 2 * (number)x->half));
}

static void centre_as_defined(struct fixpid_autotune *x)
{
    const number centre = x->centre;
    const number half = x->half;

    some_relay(x);
    x->averaged = FRESH_RELAY;
    if (x->state == IN_FIND) {
        x->state = IN_CENTRE;
    } else if (fits_as_defined(x, centre, half)) {
        x->state = IN_FIRST;
        clear_as_defined(&x->sums[0]);
    }
}

static void cycle_as_defined(struct fixpid_autotune *x)
{
    const number before = x->last_period;

    x->last_period = x->period;
    x->period = 0;
    x->seen++;
    if (x->seen >= 48u) {
        over_as_defined(x, FIXPID_AUTOTUNE_IRREGULAR);
    } else if (x->averaged == FRESH_RELAY) {
        x->averaged = 0;
    } else if (x->state <= IN_CENTRE) {
        centre_as_defined(x);
    } else if (!is_alike(x, before)) {
        again_as_defined(x);
    } else {
        x->averaged++;
        if (x->averaged == x->config.cycles) {
            relay_complete(x);
        }
    }
}

// After the switch to high.
static void end_as_defined(struct fixpid_autotune *x, number deviation)
{
    (void)begin(&end_part, x, deviation);
    cycle_as_defined(x);
    x->elapsed = 0;
    if (x->state >= IN_NOISE) {
        x->highest = signed16(deviation);
        x->lowest = signed16(deviation);
        output_as_defined(x);
    }
    end(&end_part, x);
}

static void turn_as_defined(struct fixpid_autotune *x, number deviation)
{
    if (begin(&turn_part, x, deviation)) {
        return;
    }
    if ((x->side == HIGH_SIDE) && (deviation > x->edge)) {
        x->side = LOW_SIDE;
        x->elapsed = 0;
        output_as_defined(x);
    } else if ((x->side == LOW_SIDE) && (deviation < -(number)x->edge)) {
        x->side = HIGH_SIDE;
        end_as_defined(x, deviation);
    }
    x->elapsed = unsigned16((number)x->elapsed + 1);
    end(&turn_part, x);
}

static bool autotune_may_lose(const struct fixpid_autotune *x);

// The setpoint is beyond the side that does not reach it. With that side at the
// end of the range it is waited for.
static void lost_as_defined(struct fixpid_autotune *x)
{
    const number level = x->output;
    const bool high = x->side == HIGH_SIDE;

    (void)begin(&lost_part, x, 0);
    claim(turn_part.open || autotune_may_lose(x));
    if (level != (high ? x->config.output_max : x->config.output_min)) {
        x->seen = (uint8_t)(x->seen + 4);
        if (x->seen >= 48u) {
            over_as_defined(x, FIXPID_AUTOTUNE_IRREGULAR);
        } else {
            clear_as_defined(&x->sums[0]);
            x->state = IN_CENTRE;
            x->averaged = FRESH_RELAY;
            x->period = 0;
            x->elapsed = 1;
            x->half = (uint16_t)((x->half < 10000u) ? (2 * x->half) : x->half);
            x->centre =
                high ? signed16(lesser(level + x->half, x->config.output_max))
                     : signed16(greater(level - x->half, x->config.output_min));
            output_as_defined(x);
        }
    }
    end(&lost_part, x);
}

// As long as a cycle was; the first one may have been half of one.
static number longest_cycle_of(const struct fixpid_autotune *x)
{
    return (x->seen < 2u) ? floor_by(x->config.timeout_steps, 4)
                          : x->last_period;
}

static void relay_as_defined(struct fixpid_autotune *x, number deviation)
{
    if (begin(&relay_part, x, deviation)) {
        return;
    }
    x->highest = signed16(greater(x->highest, deviation));
    x->lowest = signed16(lesser(x->lowest, deviation));
    if (x->elapsed != 0u) {
        x->period = unsigned16((number)x->period + 1);
        if (x->averaged != FRESH_RELAY) {
            sum_as_defined(x, deviation);
        }
    }
    if (x->state >= IN_NOISE) {
        turn_as_defined(x, deviation);
    }
    if ((x->state >= IN_CENTRE) &&
        (floor_by(x->elapsed, 2) > longest_cycle_of(x))) {
        lost_as_defined(x);
    }
    end(&relay_part, x);
}

static void step_as_defined(struct fixpid_autotune *x, number setpoint,
                            number measurement)
{
    number deviation =
        clamp(measurement - setpoint, -(number)FARTHEST, FARTHEST);

    if ((measurement <= x->config.measurement_min) ||
        (measurement >= x->config.measurement_max)) {
        over_as_defined(x, FIXPID_AUTOTUNE_SATURATED);
    } else if (x->elapsed >= x->config.timeout_steps) {
        over_as_defined(x, FIXPID_AUTOTUNE_NO_OSCILLATION);
    } else {
        deviation = (x->config.reverse != 0u) ? -deviation : deviation;
        if (x->state == IN_NOISE) {
            noise_as_defined(x, deviation);
        } else {
            relay_as_defined(x, deviation);
        }
    }
}

// ---- What an experiment can be ----

static bool is_deviation(number deviation)
{
    return inside(deviation, -(number)FARTHEST, FARTHEST);
}

// A solver is quicker at this than at the product.
static number farthest_times(number steps)
{
    return (steps << 15) - steps;
}

// Sums of so many turns, which can take one step more.
static bool sound_sums(const struct fixpid_autotune_sums *sums, number turns)
{
    return (sums->steps < 32767u) && (sums->on_steps <= sums->steps) &&
           (size_of(sums->all) <= farthest_times(sums->steps)) &&
           (size_of(sums->on) <= farthest_times(sums->on_steps)) &&
           (size_of(sums->rise) <= (turns << 11) - turns);
}

static bool fresh(const struct fixpid_autotune *x)
{
    return x->averaged == FRESH_RELAY;
}

// The turns in the sums of this phase, of which those of a relay that looks for
// the setpoint have any number.
static number turns_now(const struct fixpid_autotune *x)
{
    const number before = (x->state == IN_THIRD) ? x->config.cycles : 0;

    if (x->state <= IN_CENTRE) {
        return 17;
    }
    if (fresh(x)) {
        return 2 * before;
    }
    return (2 * (before + x->averaged)) + ((x->side == LOW_SIDE) ? 1 : 0) +
           ((x->elapsed > 1u) ? 1 : 0);
}

// From the second phase on, the sums of the first begin with those that are
// noted.
static bool sound_first(const struct fixpid_autotune *x)
{
    return (x->state <= IN_FIRST) || ((x->first_on <= x->sums[0].on_steps) &&
                                      (x->first_steps <= x->sums[0].steps));
}

// A cycle that counts is in the sums of its phase.
static bool counted_cycle(const struct fixpid_autotune *x)
{
    return fresh(x) || (x->state <= IN_CENTRE) ||
           (x->period <= x->sums[(x->state == IN_SECOND) ? 1 : 0].steps);
}

// Its cycles, of which the last began with a switch to high. In the first half
// of all there was none.
static bool sound_cycle(const struct fixpid_autotune *x)
{
    const bool low = x->side == LOW_SIDE;
    const number before = low ? 32766 : 0; // of this cycle, before this half

    return inside(x->seen, 0, 47) && (x->last_period <= 65534u) &&
           (fresh(x) ||
            (x->averaged < ((x->state > IN_CENTRE) ? x->config.cycles : 1))) &&
           (x->period <= before + greater((number)x->elapsed - 1, 0)) &&
           (fresh(x) || (x->elapsed > 0u)) && counted_cycle(x) &&
           (fresh(x) || !low ||
            (((number)x->highest > x->edge) && (x->period >= x->elapsed)));
}

// While a relay runs.
static bool sound_while_relay(const struct fixpid_autotune *x)
{
    const number all_turns = 2 * (number)x->config.cycles;
    const bool second = x->state == IN_SECOND;

    return autotune_has_relay(x) && sound_cycle(x) &&
           (x->lowest <= x->highest) && (x->noise <= 32736u) &&
           inside(x->edge, 1, 30208) && sound_first(x) &&
           sound_sums(&x->sums[0], second ? all_turns : turns_now(x)) &&
           sound_sums(&x->sums[1], second ? turns_now(x) : all_turns);
}

// Domain: a step of a relay: the configuration is legal, the phase and the side
// are a relay's, its timeout is not reached, and sums, noise and extremes are
// what so many steps can make.
static bool autotune_may_switch(const struct fixpid_autotune *x,
                                number deviation)
{
    return is_deviation(deviation) && legal_config(&x->config) &&
           inside(x->state, IN_FIND, IN_THIRD) && (x->side <= HIGH_SIDE) &&
           (x->elapsed < x->config.timeout_steps) &&
           (x->output == output_of(x)) && (x->highest != INT16_MIN) &&
           (x->lowest != INT16_MIN) && sound_while_relay(x);
}

// Domain: the end of a cycle: the configuration is legal, the phase and the
// side are a relay's, the output is still the low one, noise, extremes and sums
// are what they can be, and unless the relay is fresh its cycle has switched on
// both sides.
static bool autotune_may_end(const struct fixpid_autotune *x, number deviation)
{
    const number cycles = x->config.cycles;
    const bool finding = x->state <= IN_CENTRE;

    return is_deviation(deviation) && legal_config(&x->config) &&
           inside(x->state, IN_FIND, IN_THIRD) && autotune_has_relay(x) &&
           (x->output == low_output(x, x->state)) && (x->noise <= 32736u) &&
           inside(x->edge, 1, 30208) && (x->side <= HIGH_SIDE) &&
           inside(x->seen, 0, 47) && is_deviation(x->highest) &&
           is_deviation(x->lowest) && (x->lowest <= x->highest) &&
           (fresh(x) ||
            ((x->averaged < (finding ? 1 : cycles)) &&
             (x->period >= x->elapsed) && ((number)x->highest > x->edge) &&
             (x->lowest < -(number)x->edge))) &&
           (x->sums[0].on_steps <= x->sums[0].steps) &&
           (x->sums[1].on_steps <= x->sums[1].steps) && sound_first(x) &&
           (x->sums[0].steps < 32767u) && (x->sums[1].steps < 32767u) &&
           counted_cycle(x) && (x->period <= 65534u) &&
           (x->last_period <= 65534u);
}

// What init and reset establish from any bytes, and a step keeps.
// Domain: it was refused, or it is over, or so many steps can have made it; and
// its output is that of its phase and side.
static bool autotune_is_sound(const struct fixpid_autotune *x)
{
    if (x->config.cycles == 0u) {
        return (x->state == FIXPID_AUTOTUNE_REFUSED) &&
               (x->config.output_min == 0) && (x->config.output_max == 0);
    }
    if (!legal_config(&x->config) || (x->output != output_of(x))) {
        return false;
    }
    if (x->state < IN_NOISE) {
        return inside(x->state, FIXPID_AUTOTUNE_DONE, FIXPID_AUTOTUNE_TOO_SLOW);
    }
    if ((x->state > IN_THIRD) || (x->side > HIGH_SIDE) ||
        (x->elapsed > x->config.timeout_steps) || (x->highest == INT16_MIN) ||
        (x->lowest == INT16_MIN)) {
        return false;
    }
    if (x->state == IN_NOISE) {
        return (x->elapsed < 34u) && (x->seen == 0u) && (x->period == 0u) &&
               (x->last_period == 0u) && (x->first_on == 0u) && fresh(x) &&
               (x->noise <= 1023 * greater((number)x->elapsed - 2, 0)) &&
               sound_sums(&x->sums[0], 0) && sound_sums(&x->sums[1], 0);
    }
    return sound_while_relay(x);
}

// Domain: such an experiment that runs.
static bool autotune_is_running(const struct fixpid_autotune *x)
{
    return autotune_is_sound(x) && (x->state >= IN_NOISE);
}

// What the parts rely on. Those before them show it where they are called.

// Domain: a step of the noise: the outputs are legal, and noise and readings
// are what so many steps can make.
static bool autotune_may_listen(const struct fixpid_autotune *x,
                                number deviation)
{
    return is_deviation(deviation) && (x->state == IN_NOISE) &&
           (x->config.output_min < x->config.output_max) &&
           inside(x->config.output_rest, x->config.output_min,
                  x->config.output_max) &&
           (x->elapsed < 34u) && (x->highest != INT16_MIN) &&
           (x->lowest != INT16_MIN) &&
           (x->noise <= 1023 * greater((number)x->elapsed - 2, 0));
}

// Domain: the phase and the side are a relay's, and the sums of a relay that
// measures are of at most 15 or 16 turns.
static bool autotune_may_sum(const struct fixpid_autotune *x, number deviation)
{
    const struct fixpid_autotune_sums *const sums =
        &x->sums[(x->state == IN_SECOND) ? 1 : 0];

    return is_deviation(deviation) && inside(x->state, IN_FIND, IN_THIRD) &&
           (x->side <= HIGH_SIDE) &&
           sound_sums(sums, (x->state <= IN_CENTRE) ? 17
                            : (x->elapsed == 1u)    ? 15
                                                    : 16);
}

// Domain: the phase and the side are a relay's, the hysteresis is 1 to 30208,
// and where a cycle ends the domain of its end holds.
static bool autotune_may_turn(const struct fixpid_autotune *x, number deviation)
{
    const bool ends = (x->side == LOW_SIDE) && (deviation < -(number)x->edge);

    return is_deviation(deviation) && inside(x->state, IN_FIND, IN_THIRD) &&
           (x->side <= HIGH_SIDE) && (x->elapsed < 32767u) &&
           inside(x->edge, 1, 30208) && autotune_has_relay(x) &&
           (!ends || autotune_may_end(x, deviation));
}

// Domain: a relay that looks for its centre: the configuration is legal, the
// output is still the low one, and the cycle has switched on both sides.
static bool autotune_may_recentre(const struct fixpid_autotune *x)
{
    return legal_config(&x->config) && inside(x->state, IN_FIND, IN_CENTRE) &&
           (x->output == low_output(x, x->state)) && autotune_has_relay(x) &&
           (x->noise <= 32736u) && inside(x->edge, 1, 30208) &&
           is_deviation(x->highest) && is_deviation(x->lowest) &&
           ((number)x->highest > x->edge) && (x->lowest < -(number)x->edge);
}

// Domain: a relay that has not switched, from the centre on, with an output
// within the range.
static bool autotune_may_lose(const struct fixpid_autotune *x)
{
    return inside(x->state, IN_CENTRE, IN_THIRD) && (x->side <= HIGH_SIDE) &&
           inside(x->seen, 0, 47) && autotune_has_relay(x) &&
           inside(x->config.output_rest, x->config.output_min,
                  x->config.output_max) &&
           inside(x->output, x->config.output_min, x->config.output_max);
}

// Domain: it was refused, or 1 to 4 cycles are asked for, the phase or the end
// exists, and no more cycles are done than its phase has.
static bool autotune_is_on_its_way(const struct fixpid_autotune *x)
{
    const number cycles = x->config.cycles;
    const number done = x->averaged;

    if (cycles == 0) {
        return x->state == FIXPID_AUTOTUNE_REFUSED;
    }
    return inside(cycles, 1, 4) &&
           (inside(x->state, IN_NOISE, IN_THIRD) ||
            inside(x->state, FIXPID_AUTOTUNE_DONE, FIXPID_AUTOTUNE_TOO_SLOW)) &&
           (fresh(x) || (done < ((x->state >= IN_FIRST) ? cycles : 1)));
}

#endif
