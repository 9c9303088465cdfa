// SPDX-License-Identifier: MIT
// fixpid_autotune: its step is total, its output within its range, what is
// final stays so, and a record is the experiment. What a step does is proved in
// autotune_step.c and autotune_cycle.c, but for the quotients of a new centre
// and which cycles are alike (unproved.txt); the result is for its recorded
// rows.
#include "autotune.h"

struct fixpid_autotune_stage nondet_stage(void);
struct fixpid_autotune_record nondet_record(void);

#include "autotune/fixpid_autotune.c"
#include "autotune/fixpid_autotune_cycle.c"
#include "autotune/fixpid_autotune_more.c"
#include "autotune/fixpid_autotune_record.c"
#include "autotune/fixpid_autotune_relay.c"

static void claim_started(bool legal)
{
    claim(fixpid_autotune_status(&c) ==
          (legal ? FIXPID_AUTOTUNE_RUNNING : FIXPID_AUTOTUNE_REFUSED));
    claim(c.output == c.config.output_rest);
    claim((c.elapsed == 0u) && (c.noise == 0u) && (c.seen == 0u));
    claim((c.last_period == 0u) && (c.period == 0u));
    claim(legal || ((c.config.output_min == 0) && (c.config.output_max == 0) &&
                    (c.config.cycles == 0u)));
}

void prove_init(void)
{
    const struct fixpid_autotune_config config = {
        .output_min = nondet_int16(),
        .output_max = nondet_int16(),
        .output_rest = nondet_int16(),
        .measurement_min = nondet_int16(),
        .measurement_max = nondet_int16(),
        .swing = nondet_uint16(),
        .timeout_steps = nondet_uint16(),
        .cycles = nondet_uint8(),
        .reverse = any_bool};
    const struct fixpid_autotune_kept kept = {
        config.output_min,      config.output_max,      config.output_rest,
        config.measurement_min, config.measurement_max, config.swing,
        config.timeout_steps,   config.cycles,          config.reverse};
    const bool legal = legal_config(&kept);

    c = nondet_autotune();
    claim(fixpid_autotune_init(&c, &config) == legal);
    claim(!legal || same_config(&c.config, &kept));
    claim_started(legal);
    claim(autotune_is_sound(&c));
    fixpid_autotune_reset(&c);
    claim_started(legal);
    claim(autotune_is_sound(&c));
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
    if (was.state < 16u) {
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

// In every state that an experiment can be in: 16 for noise, 17 and 18 for the
// two before the relays, which are 19 to 21.
void prove_progress(void)
{
    static const uint8_t relays[] = {0, 0, 2, 4, 4, 4}; // before each phase
    struct fixpid_autotune_stage stage = nondet_stage();
    uint8_t phase;
    number each;
    number done;

    c = nondet_autotune();
    assume(autotune_is_on_its_way(&c));
    fixpid_autotune_progress(&c, &stage);
    each = c.config.cycles + 1;
    claim(stage.expected ==
          ((c.config.cycles == 0u) ? 0 : (7 + (3 * c.config.cycles))));
    claim(stage.period == c.last_period);
    if (fixpid_autotune_status(&c) != FIXPID_AUTOTUNE_RUNNING) {
        claim((stage.phase == 6u) && (stage.done == stage.expected));
    } else {
        phase = (uint8_t)(c.state - 16u);
        done = relays[phase] + ((phase > 3u) ? ((phase - 3u) * each) : 0);
        done += (c.averaged == 255u) ? 0 : (c.averaged + 1);
        claim((stage.phase == phase) && (stage.done == done));
        claim(stage.done < stage.expected);
    }
}

static bool over(uint8_t status)
{
    return inside(status, FIXPID_AUTOTUNE_DONE, FIXPID_AUTOTUNE_TOO_SLOW);
}

// A function of the bytes, whichever it is: test/proof/record.c has the one
// that it is.
uint16_t check_of_contract(const uint8_t bytes[], uint8_t count)
{
    static uint8_t checked[60];
    static uint16_t check;
    static bool known;
    bool same = known;

    pre(count == 60u);
    for (unsigned at = 0; at < 60u; at++) {
        same = same && (bytes[at] == checked[at]);
        checked[at] = bytes[at];
    }
    if (!same) {
        check = nondet_uint16();
    }
    known = true;
    return check;
}

// Of any bytes: what was packed is unpacked, if it is legal. By contract:
// check_of.
void prove_pack(void)
{
    const struct fixpid_autotune_record given = nondet_record();
    struct fixpid_autotune_record record = given;
    struct fixpid_autotune was;
    const uint8_t at = nondet_uint8();

    assume(at < FIXPID_AUTOTUNE_RECORD_SIZE);
    c = nondet_autotune();
    was = c;
    claim(fixpid_autotune_pack(&c, &record) == over(was.state));
    if (over(was.state)) {
        c = nondet_autotune();
        claim(record.bytes[0] == FIXPID_AUTOTUNE_RECORD_VERSION);
        claim(record.bytes[17] == was.state);
        claim(record.bytes[59] == (((uint16_t)was.lowest) >> 8));
        claim(fixpid_autotune_unpack(&c, &record) == legal_config(&was.config));
        if (legal_config(&was.config)) {
            claim(same_config(&c.config, &was.config));
            claim(equal_sums(&c.sums[0], &was.sums[0]));
            claim(equal_sums(&c.sums[1], &was.sums[1]));
            claim((c.state == was.state) && (c.centre == was.centre) &&
                  (c.half == was.half) && (c.last_period == was.last_period) &&
                  (c.edge == was.edge) && (c.noise == was.noise) &&
                  (c.highest == was.highest) && (c.lowest == was.lowest));
            claim(c.output == was.config.output_rest);
        }
    } else {
        claim(record.bytes[at] == given.bytes[at]);
    }
}

// Nothing but what an experiment can be is unpacked, and packed again it is the
// record. By contract: check_of.
void prove_unpack(void)
{
    const struct fixpid_autotune_record record = nondet_record();
    const uint16_t check = check_of(record.bytes, 60u);
    struct fixpid_autotune_record again = nondet_record();
    struct fixpid_autotune was;
    const uint8_t at = nondet_uint8();

    assume(at < FIXPID_AUTOTUNE_RECORD_SIZE);
    c = nondet_autotune();
    was = c;
    if (fixpid_autotune_unpack(&c, &record)) {
        claim(legal_config(&c.config) && over(c.state));
        claim(record.bytes[0] == FIXPID_AUTOTUNE_RECORD_VERSION);
        claim(record.bytes[16] <= 1u);
        claim(record.bytes[60] == (check & 0xFFu));
        claim(record.bytes[61] == (check >> 8));
        claim(fixpid_autotune_pack(&c, &again));
        claim(again.bytes[at] == record.bytes[at]);
    } else {
        claim_same(&c, &was);
    }
}
