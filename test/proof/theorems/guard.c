// SPDX-License-Identifier: MIT
// What the flags of fixpid_guard tell, each in one sentence. A reader of the
// header keeps notes of what comes in and goes out; whenever a flag comes up,
// the notes say what the header promises. By induction: the guard is one of
// which the notes are true, and so it is after any call.
#include "../guard.c"

// What the object's private bits mean: where the reading is, and was.
#define WITHIN 0x00u // the band
#define UNDER 0x01u
#define OVER 0x02u
#define WHERE 0x03u
#define LAST_SIDE 0x0Cu
#define IS_NOISY 0x40u
#define IS_REVERSED 0x80u

// A guard, what it is given, and the zone in which the header sees the reading.
static struct fixpid_guard was;
static int16_t r;
static int16_t y;
static int16_t u;
static unsigned zone_was;
static unsigned zone;
static uint8_t raised; // flags that come up in this step

static unsigned zone_seen(void)
{
    const number goal = clamp(r, was.reach_min, was.reach_max);
    const number band =
        (zone_was == WITHIN) ? (number)was.band : floor_by(was.band, 1);

    if (apart(goal, y) <= band) {
        return WITHIN;
    }
    return (y < goal) ? UNDER : OVER;
}

static bool within_reach(number x)
{
    return inside(x, was.reach_min, was.reach_max);
}

// Any step of any guard of which `true_of` is true.
static void step(void)
{
    was = c;
    r = nondet_int16();
    y = nondet_int16();
    u = nondet_int16();
    zone_was = was.state & 3u;
    zone = zone_seen();
    raised = fixpid_guard_step(&c, r, y, u) & (uint8_t)~was.flags;
    claim((c.state & 3u) == zone);
}

// Whether the guard starts anew, or a person acknowledges.
static bool begins_anew(void)
{
    struct fixpid_guard_config config = nondet_guard_config();

    config.reverse = any_bool;
    config.noisy = any_bool;
    return fixpid_guard_init(&c, &config);
}

static bool calls_another(void)
{
    if (nondet_bool()) {
        fixpid_guard_acknowledge(&c);
        return true;
    }
    if (nondet_bool()) {
        fixpid_guard_reset(&c);
        return true;
    }
    return false;
}

// Domain: as many readings in a row were outside as the guard has counted, or
// more.
static bool guard_counts_outside(number outside)
{
    return outside >= c.strikes;
}

// Domain: the guard counts equal readings up to `patience`; from there it
// counts those with the output away from where it was then.
static bool guard_counts_equal(number equal, number away, number began)
{
    if (equal < c.patience) {
        return (away == 0) && (c.run == equal);
    }
    return ((away == 0) || (equal >= c.patience + away)) &&
           (c.run == c.patience + away) && (c.hold == began);
}

// Domain: the guard has the last side and the setpoint that a reader has noted,
// and no more crossings; while the loop is settled there is no last side.
static bool guard_counts_crossed(number crossed, unsigned side, number anchor)
{
    return (crossed >= c.swings) && (((c.state >> 2) & 3u) == side) &&
           (c.anchor == anchor) &&
           (((c.flags & FIXPID_GUARD_SETTLED) == 0u) || (side == WITHIN));
}

// Domain: outside the band the loop is not settled; within it the guard has
// counted no more steps than there were, and it is settled after `patience`.
static bool guard_counts_within(number within)
{
    const bool settled = (c.flags & FIXPID_GUARD_SETTLED) != 0u;

    return (((c.state & WHERE) != WITHIN) ? !settled
                                          : (counted(&c) <= within)) &&
           (!settled || (within >= c.patience));
}

// Theorem: FIXPID_GUARD_SENSOR_LOW and FIXPID_GUARD_SENSOR_HIGH come up only
// after four readings in a row outside measurement_min..measurement_max, of
// which the last is below or above.
void prove_flag_sensor(void)
{
    number outside = nondet_uint32(); // readings in a row

    c = nondet_guard();
    if (begins_anew()) {
        claim(c.strikes == 0u);
        return;
    }
    c = nondet_guard();
    assume(guard_is_sound(&c));
    assume(guard_counts_outside(outside));
    if (!calls_another()) {
        step();
        outside = inside(y, was.measurement_min, was.measurement_max)
                      ? 0
                      : outside + 1;
        if ((raised & FIXPID_GUARD_SENSOR_LOW) != 0u) {
            claim((outside >= 4) && (y < was.measurement_min));
        }
        if ((raised & FIXPID_GUARD_SENSOR_HIGH) != 0u) {
            claim((outside >= 4) && (y > was.measurement_max));
        }
    }
    claim(guard_counts_outside(outside));
}

// Theorem: FIXPID_GUARD_FROZEN comes up only after `patience` equal readings
// within reach and then `patience` more, in each of which the output was more
// than a quarter of its range from where it was when they began, or the sensor
// is a noisy one.
void prove_flag_frozen(void)
{
    number equal = nondet_uint32();
    number away = nondet_uint32(); // after `patience` of them
    number began = nondet_int16(); // the output then

    c = nondet_guard();
    if (begins_anew()) {
        claim(c.run == 0u);
        return;
    }
    c = nondet_guard();
    assume(guard_is_sound(&c));
    assume(guard_counts_equal(equal, away, began));
    if (calls_another()) {
        equal = 0;
        away = 0;
    } else {
        const number quarter = floor_by((number)c.output_max - c.output_min, 2);

        step();
        if ((y != was.last) || !within_reach(y)) {
            equal = 0;
            away = 0;
        } else {
            equal++;
            if (equal == was.patience) {
                began = u;
            } else if (equal > was.patience) {
                away += (((was.state & IS_NOISY) != 0u) ||
                         (apart(u, began) > quarter))
                            ? 1
                            : 0;
            }
        }
        if ((raised & FIXPID_GUARD_FROZEN) != 0u) {
            claim((away == was.patience) &&
                  (equal >= 2 * (number)was.patience));
        }
        if (away == was.patience) { // and the count begins anew
            equal = 0;
            away = 0;
        }
        claim(c.last == y);
    }
    claim(guard_counts_equal(equal, away, began));
}

// Whether the output is at the end that pushes the reading out of a zone.
static bool pushes(unsigned from)
{
    const bool reverse = (was.state & IS_REVERSED) != 0u;

    if ((from == UNDER) == reverse) {
        return u <= was.output_min;
    }
    return u >= was.output_max;
}

// Steps with the output at an end.
static struct pushed {
    number
        outside; // not in a row, since the reading left the band or came nearer
    number farthest; // reading from the setpoint since then
    number up; // in the band: in a row, at the end that raises the reading
    number down;
} pushed;

// Domain: outside the band the guard has counted no more steps with the output
// at that end than there were since the farthest reading; within it, no more
// than there were at the end that it watches.
static bool guard_counts_pushed(void)
{
    const unsigned end = (c.state >> 4) & 3u;

    if ((c.state & WHERE) != WITHIN) {
        return (counted(&c) <= pushed.outside) && (c.mark == pushed.farthest);
    }
    return ((counted(&c) >= 0) ||
            (-counted(&c) <= ((end == UNDER) ? pushed.up : pushed.down)));
}

static number less_one(number steps)
{
    return (steps > 0) ? (steps - 1) : 0;
}

static void note_outside(void)
{
    number nearer;

    if (zone != zone_was) {
        pushed.farthest = y;
        pushed.outside = 0;
    }
    nearer = (zone == UNDER) ? (y - pushed.farthest) : (pushed.farthest - y);
    if (nearer >= was.band) {
        pushed.farthest = y;
        pushed.outside = 0;
    } else {
        pushed.farthest = (nearer < 0) ? y : pushed.farthest;
        pushed.outside += pushes(zone) ? 1 : 0;
    }
}

static void note_inside(void)
{
    const bool waits = (zone == WITHIN) && (y != r) && within_reach(r);
    const bool up = waits && pushes(UNDER);
    const bool down = waits && pushes(OVER);

    if ((zone != WITHIN) || (zone_was != WITHIN)) {
        pushed.up = 0;
        pushed.down = 0;
    }
    pushed.up = up ? (pushed.up + 1) : less_one(down ? 0 : pushed.up);
    pushed.down = down ? (pushed.down + 1) : less_one(up ? 0 : pushed.down);
}

// Theorem: FIXPID_GUARD_NOT_RISING comes up only after `patience` steps with
// the output at the end that raises the reading: below the band, since the
// reading has come a band nearer to the setpoint; within the band, while the
// reading was not the setpoint, where every other step takes one back.
// FIXPID_GUARD_NOT_FALLING is the mirror of it.
void prove_flag_stuck(void)
{
    pushed.outside = nondet_uint32();
    pushed.farthest = nondet_int16();
    pushed.up = nondet_uint32();
    pushed.down = nondet_uint32();
    c = nondet_guard();
    if (begins_anew()) {
        claim((c.count == 0u) && ((c.state & WHERE) == WITHIN));
        return;
    }
    c = nondet_guard();
    assume(guard_is_sound(&c));
    assume(guard_counts_pushed());
    if (!calls_another()) {
        step();
        note_outside();
        note_inside();
        if ((raised & FIXPID_GUARD_NOT_RISING) != 0u) {
            claim((zone == WITHIN)
                      ? (pushed.up >= was.patience)
                      : ((zone == UNDER) && (pushed.outside >= was.patience)));
        }
        if ((raised & FIXPID_GUARD_NOT_FALLING) != 0u) {
            claim((zone == WITHIN)
                      ? (pushed.down >= was.patience)
                      : ((zone == OVER) && (pushed.outside >= was.patience)));
        }
    }
    claim(guard_counts_pushed());
}

// Theorem: FIXPID_GUARD_OSCILLATING comes up only after the reading has gone
// twelve times from one side of the band to the other, each time with a
// setpoint within a band of the same one, while the loop did not settle.
void prove_flag_oscillating(void)
{
    number crossed = nondet_uint32();
    unsigned side = nondet_uint8(); // on which it was last
    number anchor = nondet_int16();

    c = nondet_guard();
    if (begins_anew()) {
        claim((c.swings == 0u) && (c.anchor == 0) &&
              ((c.state & LAST_SIDE) == 0u));
        return;
    }
    c = nondet_guard();
    assume(guard_is_sound(&c));
    assume(guard_counts_crossed(crossed, side, anchor));
    if (nondet_bool()) {
        fixpid_guard_acknowledge(&c);
    } else if (nondet_bool()) {
        fixpid_guard_reset(&c);
        anchor = 0;
        side = WITHIN;
    } else {
        step();
        if ((zone != WITHIN) && (zone != zone_was)) {
            if (apart(r, anchor) > was.band) {
                anchor = r;
                crossed = 0;
            } else if ((side != WITHIN) && (side != zone)) {
                crossed++;
            }
            side = zone;
        }
        if ((raised & FIXPID_GUARD_OSCILLATING) != 0u) {
            claim((crossed >= 12) && (apart(r, anchor) <= was.band));
        }
        if ((raised & FIXPID_GUARD_SETTLED) != 0u) {
            crossed = 0;
            side = WITHIN;
        }
    }
    claim(guard_counts_crossed(crossed, side, anchor));
}

// Theorem: While FIXPID_GUARD_SETTLED is set, the reading is in the band, and
// has been there for `patience` steps at least.
void prove_flag_settled(void)
{
    number within = nondet_uint32(); // steps in a row

    c = nondet_guard();
    if (begins_anew()) {
        claim((c.count == 0u) && (c.flags == 0u) &&
              ((c.state & WHERE) == WITHIN));
        return;
    }
    c = nondet_guard();
    assume(guard_is_sound(&c));
    assume(guard_counts_within(within));
    if (!calls_another()) {
        step();
        within = (zone == WITHIN) ? ((zone_was == WITHIN) ? within + 1 : 1) : 0;
    }
    claim(guard_counts_within(within));
}
