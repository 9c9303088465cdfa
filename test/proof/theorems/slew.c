// SPDX-License-Identifier: MIT
// What a user may rely on of fixpid_slew, each in one sentence.
#include "../slew.c"

static number distance(number a, number b)
{
    return (a < b) ? (b - a) : (a - b);
}

// Theorem: A step of fixpid_slew never passes its target, and comes nearer to
// it by the rate of its direction, or reaches it if that is less: n steps move
// by n times the rate, and the target is reached after as many as it takes.
void prove_slew_reaches(void)
{
    const int16_t target = nondet_int16();
    const number goal = target * ONE;
    number before;
    number rate;
    number out;

    c = nondet_slew();
    assume(slew_is_sound(&c));
    before = fixpid_slew_value(&c);
    rate = (goal > before) ? c.rise_q16 : c.fall_q16;
    out = fixpid_slew_step(&c, target);
    if (goal >= before) {
        claim(inside(fixpid_slew_value(&c), before, goal));
        claim(inside(out, floor_by(before + (ONE / 2), 16), target));
    } else {
        claim(inside(fixpid_slew_value(&c), goal, before));
        claim(inside(out, target, floor_by(before + (ONE / 2), 16)));
    }
    if (distance(goal, before) > rate) {
        claim(distance(goal, fixpid_slew_value(&c)) ==
              distance(goal, before) - rate);
    } else {
        claim((fixpid_slew_value(&c) == goal) && (out == target));
    }
    claim(slew_is_sound(&c));
}
