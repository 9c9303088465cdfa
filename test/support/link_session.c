// SPDX-License-Identifier: MIT
#include "link_session.h"

#include <string.h>

#include "fixpid_record.h"
#include "numbers.h"

#define PATIENCE 40u // steps without an answer, and a command is sent again
#define PAUSE 150u   // steps from one command to the next
#define ONE_IN 100u  // bytes of a noisy wire

// Steps with a key frame among them, and time to begin. Of others, one in a
// hundred may not be compared, as the twin begins anew with each record.
#define TURN 300u

// A command, what permission it needs, and the answer if that is given.
struct link_order {
    uint8_t command;
    uint8_t needs;
    uint8_t result;
    int16_t value;                 // of a setpoint or an output
    struct fixpid_pid_gains gains; // of a record
    int16_t narrower;              // its output_max, by so much
};

static const struct link_order orders[] = {
    {LINK_SET_SETPOINT, FIXPID_LINK_SETPOINT, LINK_DONE, 300, {0}, 0},
    {LINK_WRITE, FIXPID_LINK_GAINS, LINK_DONE, 0, {900, 90000, 700, 3}, 0},
    {LINK_ASK_RECORD, 0, LINK_DONE, 0, {0}, 0},
    {LINK_SET_SETPOINT, FIXPID_LINK_SETPOINT, LINK_REFUSED, 2000, {0}, 0},
    {LINK_SET_MANUAL, FIXPID_LINK_MANUAL, LINK_DONE, 120, {0}, 0},
    {LINK_SET_AUTO, FIXPID_LINK_MANUAL, LINK_DONE, 0, {0}, 0},
    {LINK_SET_SEED, FIXPID_LINK_MANUAL, LINK_DONE, 80, {0}, 0},
    {LINK_WRITE, FIXPID_LINK_GAINS, LINK_NOT_ALLOWED, 0, {700, 30, 0, 0}, 5},
    {LINK_WRITE, FIXPID_LINK_GAINS, LINK_REFUSED, 0, {40000, 30, 0, 0}, 0},
    {LINK_ASK_RECORD, 0, LINK_DONE, 0, {0}, 0},
    {LINK_SET_SETPOINT, FIXPID_LINK_SETPOINT, LINK_DONE, 700, {0}, 0},
    {LINK_WRITE, FIXPID_LINK_GAINS, LINK_DONE, 0, {450, 7000, 0, 0}, 0},
    {LINK_ASK_RECORD, 0, LINK_DONE, 0, {0}, 0},
};
#define ORDERS (sizeof orders / sizeof orders[0])

static const char *const names[LINK_PARTS] = {"clean", "noisy", "clean again"};

void link_session_init(struct link_session *self, uint8_t allowed,
                       unsigned long clean, unsigned long noisy,
                       unsigned long again)
{
    memset(self, 0, sizeof *self);
    numbers_seed(16684);
    link_twin_init(&self->twin);
    self->twin.wants_record = true;
    self->allowed = allowed;
    self->ends[LINK_CLEAN] = clean;
    self->ends[LINK_NOISY] = clean + noisy;
    self->ends[LINK_CLEAN_AGAIN] = clean + noisy + again;
}

bool link_session_over(const struct link_session *self)
{
    return self->part == LINK_PARTS;
}

// ---- The wire ----

// What becomes of a byte: nothing, a wrong bit, or two of it. Returns how many.
static unsigned carried(struct link_session *self, uint8_t *byte)
{
    if (self->part != LINK_NOISY || numbers_below(ONE_IN) != 0) {
        return 1;
    }
    self->spoilt++;
    switch (numbers_below(3)) {
    case 0:
        return 0;
    case 1:
        *byte ^= (uint8_t)(1u << numbers_below(8));
        return 1;
    default:
        return 2;
    }
}

static void transmit(struct link_session *self)
{
    self->silence = 0;
    self->out_count = 0;
    self->out_at = 0;
    for (unsigned at = 0; at < self->twin.command_bytes; at++) {
        uint8_t byte = self->twin.command[at];

        for (unsigned n = carried(self, &byte); n != 0; n--) {
            self->out[self->out_count] = byte;
            self->out_count++;
        }
    }
}

bool link_session_give(struct link_session *self, uint8_t *byte)
{
    if (self->out_at == self->out_count) {
        return false;
    }
    *byte = self->out[self->out_at];
    self->out_at++;
    return true;
}

// ---- Commands ----

static void send_order(struct link_session *self)
{
    const struct link_order *const order = self->order;
    const uint8_t value[] = {(uint8_t)order->value,
                             (uint8_t)((uint16_t)order->value >> 8)};
    struct fixpid_record record;

    self->sent = self->config;
    switch (order->command) {
    case LINK_WRITE:
        self->sent.gains = order->gains;
        self->sent.output_max =
            (int16_t)(self->sent.output_max - order->narrower);
        fixpid_record_pack(&record, &self->sent);
        link_twin_send(&self->twin, LINK_WRITE, record.bytes,
                       sizeof record.bytes);
        break;
    case LINK_ASK_RECORD:
    case LINK_SET_AUTO:
        link_twin_send(&self->twin, order->command, value, 0);
        break;
    default:
        link_twin_send(&self->twin, order->command, value, sizeof value);
        break;
    }
}

static void send_next(struct link_session *self)
{
    static const uint8_t each[] = {1};

    self->order = NULL;
    if (!self->asked) {
        link_twin_send(&self->twin, LINK_ASK_HELLO, each, 0);
        self->asked = true;
    } else if (self->twin.wants_record) {
        link_twin_send(&self->twin, LINK_ASK_RECORD, each, 0);
    } else if (!self->begun) {
        link_twin_send(&self->twin, LINK_SET_STREAM, each, sizeof each);
        self->begun = true;
    } else if (self->steps % PAUSE == 0) {
        self->order = &orders[self->next_order % ORDERS];
        self->next_order++;
        send_order(self);
    } else {
        return;
    }
    transmit(self);
}

static bool same(const struct fixpid_pid_config *one,
                 const struct fixpid_pid_config *other)
{
    struct fixpid_record packed[2];

    fixpid_record_pack(&packed[0], one);
    fixpid_record_pack(&packed[1], other);
    return memcmp(&packed[0], &packed[1], sizeof packed[0]) == 0;
}

static void compare_record(struct link_session *self)
{
    self->begun = false; // the twin begins anew, too
    if (!self->trusts) {
        self->config = self->twin.config;
        self->trusts = true;
        return;
    }
    self->records++;
    self->wrong += same(&self->config, &self->twin.config) ? 0 : 1;
}

static void took_effect(struct link_session *self)
{
    self->done++;
    self->config = self->sent;
    if (self->order->command == LINK_SET_SETPOINT) {
        self->setpoint = self->order->value;
        self->setpoint_known = true;
    }
}

// The command under way is answered.
static void answered(struct link_session *self)
{
    const struct link_order *const order = self->order;
    uint8_t right;

    if (self->twin.payload[0] == LINK_ASK_RECORD) {
        compare_record(self);
        return;
    }
    if (order == NULL) {
        return;
    }
    right = ((order->needs & self->allowed) == order->needs) ? order->result
                                                             : LINK_NOT_ALLOWED;
    self->wrong += (self->twin.result == right) ? 0 : 1;
    if (self->twin.result == LINK_DONE) {
        took_effect(self);
    } else if (self->twin.result == LINK_REFUSED) {
        self->refused++;
    } else {
        self->not_allowed++;
    }
}

// A step was equal, so its setpoint is what the board has: the last one, or
// the one under way.
static void compare_setpoint(struct link_session *self)
{
    const bool under_way = self->twin.command_bytes != 0 &&
                           self->order != NULL &&
                           self->order->command == LINK_SET_SETPOINT &&
                           self->order->value == self->twin.setpoint;

    if ((self->allowed & FIXPID_LINK_SETPOINT) == 0) {
        return; // the program has its own
    }
    if (!self->setpoint_known) {
        self->setpoint = self->twin.setpoint;
        self->setpoint_known = true;
    }
    if (self->twin.setpoint != self->setpoint && !under_way) {
        self->wrong++;
    }
}

void link_session_take(struct link_session *self, uint8_t byte)
{
    for (unsigned n = carried(self, &byte); n != 0; n--) {
        const bool under_way = self->twin.command_bytes != 0;
        const unsigned equal = self->twin.equal;

        link_twin_receive(&self->twin, byte);
        if (under_way && self->twin.command_bytes == 0) {
            answered(self);
        }
        if (self->twin.equal != equal) {
            compare_setpoint(self);
        }
    }
}

void link_session_step(struct link_session *self)
{
    if (link_session_over(self)) {
        return;
    }
    self->steps++;
    if (self->steps == self->ends[self->part]) {
        self->part++;
        if (!link_session_over(self)) {
            self->at[self->part] = self->twin;
        }
    }
    if (self->twin.command_bytes == 0) {
        send_next(self);
        return;
    }
    self->silence++;
    if (self->silence == PATIENCE) {
        transmit(self);
    }
}

// ---- What came of it ----

struct counts {
    unsigned long steps;
    unsigned equal;
    unsigned different;
    unsigned not_compared;
    unsigned gaps;
};

static struct counts counts_of(const struct link_session *self, unsigned part)
{
    const bool last = part + 1 == LINK_PARTS;
    const struct link_twin *const from = &self->at[part];
    const struct link_twin *const to = last ? &self->twin : &self->at[part + 1];

    return (struct counts){
        self->ends[part] - (part == 0 ? 0 : self->ends[part - 1]),
        to->equal - from->equal, to->different - from->different,
        to->not_compared - from->not_compared, to->gaps - from->gaps};
}

static bool must(bool holds, const char *where, const char *what, FILE *to)
{
    if (!holds) {
        (void)fprintf(to, "link: %s: %s\n", where, what);
    }
    return holds;
}

static bool good_part(const struct link_session *self, unsigned part, FILE *to)
{
    const struct counts counts = counts_of(self, part);
    const char *const name = names[part];
    bool good = true;

    (void)fprintf(to,
                  "link %s: %lu steps, %u equal, %u different, "
                  "%u not compared, %u gaps\n",
                  name, counts.steps, counts.equal, counts.different,
                  counts.not_compared, counts.gaps);
    good &= must(counts.different == 0, name, "a step is different", to);
    if (part == LINK_NOISY) {
        good &= must(counts.gaps > 0, name, "no frame is missing", to);
        good &= must(counts.not_compared > 0, name, "all is compared", to);
        good &= must(counts.equal > 0, name, "nothing is equal", to);
        return good;
    }
    good &= must(counts.equal + TURN + counts.steps / 100 > counts.steps, name,
                 "too few steps are equal", to);
    good &= must(counts.gaps <= (part == LINK_CLEAN ? 0 : 1), name,
                 "frames are missing", to);
    return good;
}

bool link_session_good(const struct link_session *self, FILE *to)
{
    bool good = must(link_session_over(self), "all", "it is not over", to);

    (void)fprintf(to,
                  "link commands: %u done, %u not allowed, %u refused, "
                  "%u records compared, %u wrong; %u bytes spoilt\n",
                  self->done, self->not_allowed, self->refused, self->records,
                  self->wrong, self->spoilt);
    good &= must(self->wrong == 0, "commands", "not all are right", to);
    good &= must(self->records > 0, "commands", "no record was compared", to);
    good &= must(self->not_allowed > 0, "commands", "all is allowed", to);
    if (self->allowed != 0) {
        good &= must(self->done > 2 * ORDERS / 3, "commands",
                     "too few are carried out", to);
        good &= must(self->refused > 0, "commands", "none is refused", to);
    }
    for (unsigned part = 0; part < LINK_PARTS; part++) {
        good &= good_part(self, part, to);
    }
    return good;
}
