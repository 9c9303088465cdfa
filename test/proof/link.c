// SPDX-License-Identifier: MIT
// fixpid_link against its header: any bytes from the wire, in any state. The
// CRC is one of which is known only that equal bytes have an equal one; its
// equation is for the proof of fixpid_record. What fixpid_pid does is for its
// own proofs: here its functions say what they were given, and the controller
// has `config` before and after each command.
//
// No index leaves `bytes` or `frame`. Through a pointer CBMC asks only whether
// it stays in the object, and takes a byte beyond an array as not written; of
// an object by its name it asks for the array. What has the address of a place
// in `frame` cannot leave it behind, because the object ends there, nor in
// front, because `bytes` keep their values.
#include "pid_config.h"

#pragma pack(push, 1)
#include "fixpid_link.h"
#pragma pack(pop)
#include "fixpid_record.h"

#define HAS_HAND ((FIXPID_PID_FEATURES & FIXPID_PID_HAS_MANUAL) != 0u)

struct fixpid_link c; // of any bytes, where a proof begins
struct fixpid_pid pid;
static struct fixpid_pid_config config;
struct fixpid_link nondet_link(void);
struct fixpid_link_board nondet_board(void);

// The CRC of what was received, and of anything else.
#define FIXPID_CHECK_H
static uint16_t check_received;
static uint16_t check;
static const uint8_t *checked; // of what it was asked last
static unsigned checked_bytes;

static uint16_t check_of(const uint8_t bytes[], uint8_t count)
{
    pre(count <= FIXPID_LINK_FRAME);
    pre(__CPROVER_r_ok(bytes, count));
    checked = bytes;
    checked_bytes = count;
    return ((bytes == &c.bytes[1]) || (bytes == &c.bytes[3])) ? check_received
                                                              : check;
}

// How often the controller was changed, and what it has: its gains and limits,
// and the last of the calls that are by hand, with its output.
enum call { NO_CALL, MANUAL_CALL, AUTO_CALL, SEED_CALL };

static unsigned changes;
static struct fixpid_pid_config has;
static enum call last_call;
static int16_t last_output;

static void call_by_hand(enum call call, int16_t output)
{
    changes++;
    last_call = call;
    last_output = output;
}

static uint8_t flags;
static uint8_t state_of[FIXPID_PID_STATE_SIZE];

uint8_t fixpid_pid_flags(const struct fixpid_pid *self)
{
    pre(self == &pid);
    return flags;
}

void fixpid_pid_state(const struct fixpid_pid *self, uint8_t state[])
{
    pre(self == &pid);
    for (unsigned at = 0; at < FIXPID_PID_STATE_SIZE; at++) {
        state[at] = state_of[at];
    }
}

// Legal gains are a bit here, so that the old ones are set again.
static bool gains_are_legal;
static bool integral_is_legal;

bool fixpid_pid_set_gains(struct fixpid_pid *self,
                          const struct fixpid_pid_gains *gains)
{
    const bool old = gains == &config.gains;

    pre(self == &pid);
    if (old || gains_are_legal) {
        changes = old ? changes - 1u : changes + 1u;
        has.gains = *gains;
        return true;
    }
    return false;
}

bool fixpid_pid_set_integral_limits(struct fixpid_pid *self, int16_t low,
                                    int16_t high)
{
    pre(self == &pid);
    if (integral_is_legal) {
        changes++;
        has.integral_min = low;
        has.integral_max = high;
    }
    return integral_is_legal;
}

static struct fixpid_link_board board;

bool fixpid_pid_set_limits(struct fixpid_pid *self, int16_t low, int16_t high)
{
    pre(self == &pid);
    pre(low < high);
    pre(low >= board.output_min);
    pre(high <= board.output_max);
    changes++;
    has.output_min = low;
    has.output_max = high;
    return true;
}

void fixpid_pid_set_manual(struct fixpid_pid *self, int16_t output)
{
    pre(self == &pid);
    call_by_hand(MANUAL_CALL, output);
}

void fixpid_pid_set_auto(struct fixpid_pid *self)
{
    pre(self == &pid);
    call_by_hand(AUTO_CALL, last_output);
}

void fixpid_pid_seed(struct fixpid_pid *self, int16_t output)
{
    pre(self == &pid);
    call_by_hand(SEED_CALL, output);
}

#include "link/fixpid_link.c"
#include "link/fixpid_link_commands.c"
#include "link/fixpid_link_tracked.c"
#include "record/fixpid_record.c"

static void begin(void)
{
    c = nondet_link();
    config = any_config();
    board = nondet_board();
    gains_are_legal = any_bool;
    integral_is_legal = any_bool;
    flags = nondet_uint8();
    for (unsigned at = 0; at < FIXPID_PID_STATE_SIZE; at++) {
        state_of[at] = nondet_uint8();
    }
    has = config;
    last_call = NO_CALL;
    last_output = nondet_int16();
    changes = 0;
    check = nondet_uint16();
    check_received = nondet_uint16();
}

// Whether two are the same but for what is to be sent. (They are values because
// CBMC has less to ask of them.)
static bool alike(struct fixpid_link a, struct fixpid_link b)
{
    bool same_bytes = true;

    for (unsigned at = 0; at < FIXPID_LINK_COMMAND; at++) {
        same_bytes = same_bytes && (a.bytes[at] == b.bytes[at]);
    }
    return same_bytes && (a.steps == b.steps) && (a.setpoint == b.setpoint) &&
           (a.last_sent_setpoint == b.last_sent_setpoint) &&
           (a.manual == b.manual) && (a.allowed == b.allowed) &&
           (a.stream_interval == b.stream_interval) &&
           (a.steps_since_frame == b.steps_since_frame) &&
           (a.frames_until_key_frame == b.frames_until_key_frame) &&
           (a.key_frame_reasons == b.key_frame_reasons) && (a.tag == b.tag) &&
           (a.command == b.command) && (a.result == b.result) &&
           (a.count == b.count);
}

static bool same_frame(struct fixpid_link a, struct fixpid_link b)
{
    bool same_bytes = true;

    for (unsigned at = 0; at < FIXPID_LINK_FRAME; at++) {
        same_bytes = same_bytes && (a.frame[at] == b.frame[at]);
    }
    return same_bytes;
}

// A frame in the making is its payload here, and where it begins. What becomes
// of it is for the proof `framed`.
static uint8_t sent[FIXPID_LINK_FRAME];
static unsigned sent_bytes;
static const uint8_t *sent_from;

uint8_t fixpid_link_framed_contract(uint8_t *frame, uint8_t bytes)
{
    const struct fixpid_link any = nondet_link();

    pre((bytes == 4u) || (bytes == 7u) || (bytes == 9u) || (bytes == 10u) ||
        (bytes == 12u) || (bytes == 24u) || (bytes == 25u));
    pre((frame == c.frame) || (frame == &c.frame[1]));
    sent_from = frame;
    sent_bytes = bytes;
    for (unsigned at = 0; at < 26u; at++) {
        sent[at] = frame[at + 1u];
    }
    for (unsigned at = 0; at < 29u; at++) {
        frame[at] = any.frame[at];
    }
    return (uint8_t)(bytes + 4u);
}

// A number at a place of what is sent, the lowest byte first.
static uint16_t sent_number(unsigned at)
{
    return (uint16_t)(sent[at] | ((unsigned)sent[at + 1u] << 8));
}

// An init leaves no stream, no permission and nothing of what the memory held.
void prove_init(void)
{
    const int16_t setpoint = nondet_int16();
    struct fixpid_link first;

    begin();
    fixpid_link_init(&c, setpoint);
    first = c;
    claim(c.steps == 0u);
    claim(c.setpoint == setpoint);
    claim(c.manual == 0u);
    claim(c.allowed == 0u);
    claim(c.stream_interval == 0u);
    claim(c.frames_until_key_frame == 0u);
    claim(c.key_frame_reasons == 0u);
    claim(c.count == 0u);
    c = nondet_link();
    fixpid_link_init(&c, setpoint);
    claim(alike(c, first));
    claim(same_frame(c, first));
}

// Each changes what it says, and nothing else.
void prove_setters(void)
{
    const uint8_t allowed = nondet_uint8();
    struct fixpid_link wanted;

    begin();
    wanted = c;
    fixpid_link_allow(&c, allowed);
    wanted.allowed = allowed;
    claim(alike(c, wanted) && same_frame(c, wanted));
    wanted = c;
    fixpid_link_changed(&c);
    wanted.key_frame_reasons |= 8u;
    claim(alike(c, wanted) && same_frame(c, wanted));
    wanted = c;
    fixpid_link_taken(&c);
    wanted.manual = 0;
    wanted.key_frame_reasons |= 8u;
    claim(alike(c, wanted) && same_frame(c, wanted));
    wanted = c;
    fixpid_link_lost(&c);
    wanted.key_frame_reasons |= 16u;
    claim(alike(c, wanted) && same_frame(c, wanted));
    claim(fixpid_link_setpoint(&c) == c.setpoint);
}

// A frame has one 0, its last byte, and each other 0 is the way to the next.
// Nothing beside it changes. The length is a constant each time, which the
// solver is fast at.
static void prove_frame_of(uint8_t bytes, unsigned from)
{
    uint8_t *const frame = &c.frame[from];
    const unsigned end = bytes + 3u;
    uint8_t plain[FIXPID_LINK_FRAME] = {0};
    struct fixpid_link was;
    unsigned next = end;
    bool stays;

    begin();
    was = c;
    for (unsigned i = 1; i < end; i++) {
        plain[i] = (i <= bytes) ? frame[i]
                                : (uint8_t)(check >> (8u * (i - bytes - 1u)));
    }
    claim(fixpid_link_framed(frame, bytes) == end + 1u);
    claim((checked == &frame[1]) && (checked_bytes == bytes));
    claim(frame[end] == 0u);
    for (unsigned i = end; i-- > 0u;) {
        claim(frame[i] == ((plain[i] == 0u) ? next - i : (unsigned)plain[i]));
        if (plain[i] == 0u) {
            next = i;
        }
    }
    stays = c.bytes[29] == was.bytes[29];
    for (unsigned i = 0; i < FIXPID_LINK_FRAME; i++) {
        stays = stays && (((i >= from) && (i <= from + end)) ||
                          (c.frame[i] == was.frame[i]));
    }
    claim(stays);
}

// All lengths of payloads: first those of steps, then those of answers, of
// which the longest ends where `frame` does. A key frame is as long as that.
void prove_framed(void)
{
    prove_frame_of(7, 0);
    prove_frame_of(9, 0);
    prove_frame_of(10, 0);
    prove_frame_of(12, 0);
    prove_frame_of(4, 1);
    prove_frame_of(24, 1);
    prove_frame_of(25, 1);
}

// Any byte in any state: what is not the end of a command changes only what was
// received.
void prove_receive(void)
{
    struct fixpid_link was;
    const uint8_t byte = nondet_uint8();
    bool whole;

    begin();
    was = c;
    whole = fixpid_link_receive(&c, byte);
    claim(whole == ((was.count != 0xFFu) && (c.count == 0xFFu)));
    if (whole) {
        claim(inside(c.bytes[1], 0x40, 0x47));
        claim(inside(was.count, 7, FIXPID_LINK_COMMAND));
    }
    if ((was.count != 0xFFu) && (byte == 0u)) {
        claim(whole || (c.count == 0u));
        was.count = c.count;
        for (unsigned at = 0; at < FIXPID_LINK_COMMAND; at++) {
            was.bytes[at] = c.bytes[at];
        }
    } else if (was.count < FIXPID_LINK_COMMAND) {
        for (unsigned at = 0; at < FIXPID_LINK_COMMAND; at++) {
            was.bytes[at] = (at == was.count) ? byte : was.bytes[at];
        }
        was.count++;
    } else if (was.count != 0xFFu) {
        claim(inside(c.count, FIXPID_LINK_COMMAND + 1, 0xFE));
        was.count = c.count;
    }
    claim(alike(c, was));
    claim(same_frame(c, was));
}

// The bytes of the payload of a command, 0 for what is none.
static unsigned payload_of(uint8_t command)
{
    switch (command) {
    case 0x40:
    case 0x41:
    case 0x45:
        return 2;
    case 0x42:
        return 3;
    case 0x43:
    case 0x44:
    case 0x46:
        return 4;
    case 0x47:
        return 25;
    default:
        return 0;
    }
}

// What came is a command if the way from one 0 to the next comes to its end, it
// has the length that its first byte says, and its CRC and its two sums are
// behind it. A byte of 0, which none is that came, would be a way of 256.
static void prove_whole_of(uint8_t bytes)
{
    const unsigned count = bytes + 5u;
    uint8_t plain[FIXPID_LINK_COMMAND] = {0};
    struct fixpid_link was;
    unsigned next = 0;
    uint8_t sum = 0;
    uint8_t sums = 0;
    bool came;

    begin();
    c.count = (uint8_t)count;
    was = c;
    for (unsigned i = 0; i < count; i++) {
        plain[i] = was.bytes[i];
        if (i == next) {
            plain[i] = 0;
            next = i + ((was.bytes[i] == 0u) ? 256u : was.bytes[i]);
        }
    }
    came = fixpid_link_receive(&c, 0);
    for (unsigned i = 1; i < count; i++) {
        claim(c.bytes[i] == plain[i]);
    }
    for (unsigned i = 1; i <= bytes; i++) {
        sum += c.bytes[i];
        sums += sum;
    }
    claim(came ==
          ((next == count) && (payload_of(plain[1]) == bytes) &&
           (c.bytes[bytes + 1u] == (check_received & 0xFFu)) &&
           (c.bytes[bytes + 2u] == (check_received >> 8)) &&
           (c.bytes[bytes + 3u] == sum) && (c.bytes[bytes + 4u] == sums)));
    claim(!came || ((checked == &c.bytes[1]) && (checked_bytes == bytes)));
}

void prove_whole(void)
{
    prove_whole_of(2);
    prove_whole_of(3);
    prove_whole_of(4);
    prove_whole_of(25);
}

// Whatever waits: nothing changes without permission, or if it is refused, and
// no limit of the board is passed.
void prove_answer(void)
{
    struct fixpid_link was;
    struct fixpid_pid_config config_was;
    uint8_t bytes;
    uint8_t kind;

    begin();
    was = c;
    config_was = config;
    kind = was.bytes[1];
    bytes = fixpid_link_answer(&c, &board, &pid, &config);
    claim(bytes <= FIXPID_LINK_FRAME);
    claim((bytes == 0u) == (was.count != 0xFFu));
    claim((bytes == 0u) || (c.count == 0u));
    if ((kind <= 0x41u) || (bytes == 0u) || (c.result != 0u)) {
        claim(changes == 0u);
        claim(same_config(&config, &config_was));
        claim(c.setpoint == was.setpoint);
    }
    claim((was.allowed & 1u) != 0u || c.setpoint == was.setpoint);
    claim((was.allowed & 2u) != 0u || same_config(&config, &config_was));
    claim((was.allowed & 10u) != 0u || changes == 0u);
    claim((was.allowed & 4u) != 0u || same_limits(&config, &config_was));
    claim((c.setpoint == was.setpoint) ||
          inside(c.setpoint, board.setpoint_min, board.setpoint_max));
    claim(c.allowed == was.allowed);
    claim(c.steps == was.steps);
}

// A command that waits, of which only the first byte is known.
static void command(uint8_t kind)
{
    begin();
    c.count = 0xFFu;
    c.bytes[1] = kind;
}

// An answer of this kind and of so many bytes, and the object is what it should
// be.
static void claim_answered(uint8_t bytes, uint8_t kind, unsigned payload,
                           const struct fixpid_link *wanted)
{
    claim((bytes == payload + 5u) && (sent_bytes == payload));
    claim((sent_from == &c.frame[1]) && (c.frame[0] == 0u));
    claim((sent[0] == kind) && (sent[1] == wanted->bytes[2]));
    claim(alike(c, *wanted));
}

// Whoever says hello gets what the board is, and counts anew.
// By contract: fixpid_link_framed.
void prove_hello(void)
{
    struct fixpid_link wanted;
    uint8_t bytes;

    command(0x40);
    wanted = c;
    wanted.count = 0;
    wanted.tag = 0;
    bytes = any_bool ? fixpid_link_answer(&c, &board, &pid, &config)
                     : fixpid_link_answer_stream(&c, &board, &config);
    claim_answered(bytes, 3, 24, &wanted);
    claim(sent[2] == FIXPID_LINK_VERSION);
    claim(sent[3] == FIXPID_VERSION_MAJOR);
    claim(sent[4] == FIXPID_VERSION_MINOR);
    claim(sent[5] == FIXPID_VERSION_PATCH);
    claim(sent[6] == FIXPID_PID_FEATURES);
    claim(sent[7] == wanted.allowed);
    claim(sent_number(8) + ((uint32_t)sent_number(10) << 16) ==
          board.period_us);
    claim(sent_number(12) == board.manual_steps);
    for (unsigned at = 0; at < FIXPID_LINK_NAME; at++) {
        claim(sent[14u + at] == board.name[at]);
    }
}

// The record of `config`, and nothing changes.
// By contract: fixpid_link_framed.
void prove_config(void)
{
    struct fixpid_record record;
    struct fixpid_link wanted;
    uint8_t bytes;

    command(0x41);
    wanted = c;
    wanted.count = 0;
    bytes = any_bool ? fixpid_link_answer(&c, &board, &pid, &config)
                     : fixpid_link_answer_stream(&c, &board, &config);
    claim_answered(bytes, 4, 25, &wanted);
    fixpid_record_pack(&record, &config);
    for (unsigned at = 0; at < FIXPID_RECORD_SIZE; at++) {
        claim(sent[2u + at] == record.bytes[at]);
    }
}

// Whether the command that waits was carried out before; if not, it is the last
// one from now on, with this result.
static bool is_again(struct fixpid_link *wanted, uint8_t result)
{
    const uint8_t tag = wanted->bytes[2];
    const uint8_t kind = wanted->bytes[1];
    const bool again =
        (tag != 0u) && (tag == wanted->tag) && (kind == wanted->command);

    wanted->count = 0;
    if (!again) {
        wanted->tag = tag;
        wanted->command = kind;
        wanted->result = result;
    }
    return again;
}

// The answer says the command and its result.
static void claim_result(uint8_t bytes, const struct fixpid_link *wanted)
{
    claim_answered(bytes, 2, 4, wanted);
    claim((sent[2] == wanted->bytes[1]) && (sent[3] == wanted->result));
}

// Without the other commands: a stream is carried out, from the next step on,
// and nothing else is allowed.
// By contract: fixpid_link_framed.
void prove_stream(void)
{
    uint8_t kind = 0x42;
    struct fixpid_link wanted;
    uint8_t bytes;

    command(kind);
    wanted = c;
    if (any_bool) {
        bytes = fixpid_link_answer(&c, &board, &pid, &config);
    } else {
        kind = nondet_uint8();
        assume(inside(kind, 0x42, 0x47));
        c.bytes[1] = kind;
        wanted = c;
        bytes = fixpid_link_answer_stream(&c, &board, &config);
    }
    if (!is_again(&wanted, (kind == 0x42u) ? 0u : 1u) && (kind == 0x42u)) {
        wanted.stream_interval = wanted.bytes[3];
        wanted.key_frame_reasons |= 2u;
        claim((c.stream_interval == 0u) ||
              (c.steps_since_frame == c.stream_interval - 1));
        wanted.steps_since_frame = c.steps_since_frame;
    }
    claim_result(bytes, &wanted);
}

// Whether a command has the permission that it needs; a key frame is due then.
static bool may(struct fixpid_link *wanted, uint8_t permission)
{
    const bool allowed = (wanted->allowed & permission) != 0u;

    if (allowed) {
        wanted->key_frame_reasons |= 4u;
    }
    return allowed;
}

// A setpoint within the board's, an output by hand if the board has a time for
// it, automatic and a seed.
// By contract: fixpid_link_framed.
void prove_command(void)
{
    const uint8_t kind = nondet_uint8();
    const bool is_setpoint = kind == 0x43u;
    enum call call = NO_CALL;
    struct fixpid_link wanted;
    int16_t value;
    uint8_t bytes;

    assume(inside(kind, 0x43, 0x46));
    command(kind);
    wanted = c;
    value = (int16_t)(wanted.bytes[3] | ((unsigned)wanted.bytes[4] << 8));
    bytes = fixpid_link_answer(&c, &board, &pid, &config);
    if (!is_again(&wanted, 1) && may(&wanted, is_setpoint ? 1u : 8u)) {
        wanted.result = 0;
        if (is_setpoint &&
            inside(value, board.setpoint_min, board.setpoint_max)) {
            wanted.setpoint = value;
        } else if (is_setpoint || !HAS_HAND ||
                   ((kind == 0x44u) && (board.manual_steps == 0u))) {
            wanted.result = 2;
        } else if (kind == 0x44u) {
            wanted.manual = board.manual_steps;
            call = MANUAL_CALL;
        } else if (kind == 0x45u) {
            wanted.manual = 0;
            call = AUTO_CALL;
        } else {
            call = SEED_CALL;
        }
    }
    claim_result(bytes, &wanted);
    claim(last_call == call);
    claim((call != MANUAL_CALL && call != SEED_CALL) || (last_output == value));
}

// The result of a record that may be written.
static uint8_t result_of(const struct fixpid_pid_config *wants, bool limits_too)
{
    if (!same_kind(wants, &config) || (wants->output_min < board.output_min) ||
        (wants->output_max > board.output_max) ||
        (wants->output_min >= wants->output_max)) {
        return 2;
    }
    if (!limits_too && !same_limits(wants, &config)) {
        return 1;
    }
    return (gains_are_legal && integral_is_legal) ? 0 : 2;
}

// All of a record is set, and `config` is what it says, or nothing changes.
// By contract: fixpid_link_framed.
void prove_write(void)
{
    struct fixpid_pid_config wants;
    struct fixpid_link wanted;
    bool is_record;
    uint8_t bytes;

    command(0x47);
    wanted = c;
    wants = config;
    is_record =
        fixpid_record_unpack((const struct fixpid_record *)&c.bytes[3], &wants);
    if (!is_again(&wanted, 1) && may(&wanted, 2)) {
        wanted.result =
            is_record ? result_of(&wants, (wanted.allowed & 4u) != 0u) : 2;
        if (wanted.result != 0u) {
            wants = config;
        }
    } else {
        wants = config;
    }
    bytes = fixpid_link_answer(&c, &board, &pid, &config);
    claim_result(bytes, &wanted);
    claim(same_config(&config, &wants));
    claim(same_config(&has, &wants));
}

// The payload of a step is that of the header: each so many steps, but while a
// command waits, and a key frame if there is a reason. A hand's time ends by
// itself. Without a frame the last one stays.
// By contract: fixpid_link_framed.
void prove_step(void)
{
    const int16_t setpoint = nondet_int16();
    const int16_t measurement = nondet_int16();
    const int16_t output = nondet_int16();
    const int16_t applied = nondet_int16();
    const uint8_t shift = nondet_uint8();
    const bool tracked = any_bool;
    unsigned output_at = 5;
    unsigned end = 7;
    struct fixpid_link was;
    struct fixpid_link wanted;
    uint8_t bytes;
    bool due;

    begin();
    flags &= (uint8_t)~8u; // which says that it is a frame of a step
    was = c;
    wanted = c;
    wanted.steps++;
    wanted.steps_since_frame++;
    due = (was.stream_interval != 0u) && (was.count != 0xFFu) &&
          (wanted.steps_since_frame >= was.stream_interval);
    if ((was.stream_interval != 0u) && (was.count == 0xFFu)) {
        wanted.key_frame_reasons |= 16u;
    }
    if (due) {
        wanted.steps_since_frame = 0;
        wanted.last_sent_setpoint = setpoint;
        wanted.frames_until_key_frame--;
        wanted.key_frame_reasons |=
            (wanted.frames_until_key_frame == 0u) ? 1u : 0u;
    }
    was.key_frame_reasons = wanted.key_frame_reasons;
    if (due && (was.key_frame_reasons != 0u)) {
        wanted.key_frame_reasons = 0;
        wanted.frames_until_key_frame = 0;
    }
    if (HAS_HAND && (was.manual != 0u)) {
        wanted.manual--;
        wanted.key_frame_reasons |= (wanted.manual == 0u) ? 8u : 0u;
    }
    sent_bytes = 0;
    bytes = tracked ? fixpid_link_step_tracked(&c, &pid, setpoint, measurement,
                                               output, applied, shift)
                    : fixpid_link_step(&c, &pid, setpoint, measurement, output);
    claim(alike(c, wanted));
    claim(last_call ==
          ((HAS_HAND && (was.manual == 1u)) ? AUTO_CALL : NO_CALL));
    if (!due) {
        claim(bytes == 0u);
        claim(same_frame(c, was));
        return;
    }
    if (was.key_frame_reasons != 0u) {
        output_at = 11;
        end = 25;
        claim((sent[0] == 1u) && (sent[1] == was.key_frame_reasons) &&
              (sent[2] == was.tag));
        claim(sent_number(3) + ((uint32_t)sent_number(5) << 16) == was.steps);
        for (unsigned at = 2; at < 14u; at++) {
            claim(sent[11u + at] == state_of[at]);
        }
    } else {
        claim(sent[0] == flags + 8u);
        claim(sent_number(1) == (was.steps & 0x3FFFu));
        if (setpoint != was.last_sent_setpoint) {
            end = 9;
        }
        if (tracked) {
            claim((int16_t)sent_number(end) == applied);
            claim(sent[end + 2u] == shift);
        }
    }
    claim((end == 7u) || ((int16_t)sent_number(7) == setpoint));
    claim((int16_t)sent_number(output_at - 2u) == measurement);
    claim((int16_t)sent_number(output_at) == output);
    if (tracked && (end != 25u)) {
        end += 3u;
    }
    claim((sent_from == c.frame) && (sent_bytes == end) && (bytes == end + 4u));
}
