// SPDX-License-Identifier: MIT
// The experiment as bytes. It has its own file because SDCC links whole object
// files.
#include "fixpid_autotune.h"

#include "../common/fixpid_bytes.h"
#include "../common/fixpid_check.h"
#include "fixpid_autotune_private.h"

// Where each number begins. The configuration and what follows the sums are
// numbers of 2 bytes.
#define VERSION_AT 0u
#define CONFIG_AT 1u
#define CYCLES_AT 15u
#define REVERSE_AT 16u
#define STATUS_AT 17u
#define SUMS_AT 18u
#define SUMS_SIZE 14u
#define RELAY_AT 46u
#define CHECKED_BYTES 60u

static void put_sums(uint8_t bytes[],
                     FIXPID_DATA const struct fixpid_autotune_sums *sums)
{
    put32(&bytes[0], (uint32_t)sums->all);
    put32(&bytes[4], (uint32_t)sums->on);
    put(&bytes[8], (uint16_t)sums->rise);
    put(&bytes[10], sums->steps);
    put(&bytes[12], sums->on_steps);
}

static void get_sums(FIXPID_DATA struct fixpid_autotune_sums *sums,
                     const uint8_t bytes[])
{
    sums->all = (int32_t)get32(&bytes[0]);
    sums->on = (int32_t)get32(&bytes[4]);
    sums->rise = (int16_t)get(&bytes[8]);
    sums->steps = get(&bytes[10]);
    sums->on_steps = get(&bytes[12]);
}

// Statuses from DONE on are final; REFUSED and RUNNING are below it.
static bool is_over(uint8_t state)
{
    if (state < (uint8_t)FIXPID_AUTOTUNE_DONE) {
        return false;
    }
    return state <= (uint8_t)FIXPID_AUTOTUNE_TOO_SLOW;
}

static void put_relay(uint8_t bytes[],
                      FIXPID_DATA const struct fixpid_autotune *self)
{
    put(&bytes[0], (uint16_t)SELF.centre);
    put(&bytes[2], SELF.half);
    put(&bytes[4], SELF.last_period);
    put(&bytes[6], SELF.edge);
    put(&bytes[8], SELF.noise);
    put(&bytes[10], (uint16_t)SELF.highest);
    put(&bytes[12], (uint16_t)SELF.lowest);
}

bool fixpid_autotune_pack(FIXPID_DATA const struct fixpid_autotune *self,
                          struct fixpid_autotune_record *record)
{
    uint8_t *bytes;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(record != 0);
    if (!is_over(SELF.state)) {
        return false;
    }
    bytes = record->bytes;
    bytes[VERSION_AT] = FIXPID_AUTOTUNE_RECORD_VERSION;
    put(&bytes[CONFIG_AT], (uint16_t)SELF.config.output_min);
    put(&bytes[CONFIG_AT + 2u], (uint16_t)SELF.config.output_max);
    put(&bytes[CONFIG_AT + 4u], (uint16_t)SELF.config.output_rest);
    put(&bytes[CONFIG_AT + 6u], (uint16_t)SELF.config.measurement_min);
    put(&bytes[CONFIG_AT + 8u], (uint16_t)SELF.config.measurement_max);
    put(&bytes[CONFIG_AT + 10u], SELF.config.swing);
    put(&bytes[CONFIG_AT + 12u], SELF.config.timeout_steps);
    bytes[CYCLES_AT] = SELF.config.cycles;
    bytes[REVERSE_AT] = (SELF.config.reverse != 0u) ? 1u : 0u;
    bytes[STATUS_AT] = SELF.state;
    put_sums(&bytes[SUMS_AT], &SELF.sums[0]);
    put_sums(&bytes[SUMS_AT + SUMS_SIZE], &SELF.sums[1]);
    put_relay(&bytes[RELAY_AT], self);
    put(&bytes[CHECKED_BYTES], check_of(bytes, CHECKED_BYTES));
    return true;
}

static void get_config(struct fixpid_autotune_config *config,
                       const uint8_t bytes[])
{
    config->output_min = (int16_t)get(&bytes[CONFIG_AT]);
    config->output_max = (int16_t)get(&bytes[CONFIG_AT + 2u]);
    config->output_rest = (int16_t)get(&bytes[CONFIG_AT + 4u]);
    config->measurement_min = (int16_t)get(&bytes[CONFIG_AT + 6u]);
    config->measurement_max = (int16_t)get(&bytes[CONFIG_AT + 8u]);
    config->swing = get(&bytes[CONFIG_AT + 10u]);
    config->timeout_steps = get(&bytes[CONFIG_AT + 12u]);
    config->cycles = bytes[CYCLES_AT];
    config->reverse = bytes[REVERSE_AT] != 0u;
}

static void get_relay(FIXPID_DATA struct fixpid_autotune *self,
                      const uint8_t bytes[])
{
    SELF.centre = (int16_t)get(&bytes[0]);
    SELF.half = get(&bytes[2]);
    SELF.last_period = get(&bytes[4]);
    SELF.edge = get(&bytes[6]);
    SELF.noise = get(&bytes[8]);
    SELF.highest = (int16_t)get(&bytes[10]);
    SELF.lowest = (int16_t)get(&bytes[12]);
}

bool fixpid_autotune_unpack(FIXPID_DATA struct fixpid_autotune *self,
                            const struct fixpid_autotune_record *record)
{
    struct fixpid_autotune_config config;
    const uint8_t *bytes;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(record != 0);
    bytes = record->bytes;
    if (bytes[VERSION_AT] != FIXPID_AUTOTUNE_RECORD_VERSION) {
        return false;
    }
    if (get(&bytes[CHECKED_BYTES]) != check_of(bytes, CHECKED_BYTES)) {
        return false;
    }
    if (!is_over(bytes[STATUS_AT])) {
        return false;
    }
    if (bytes[REVERSE_AT] > 1u) {
        return false;
    }
    get_config(&config, bytes);
    if (!fixpid_autotune_legal(&config)) {
        return false;
    }
    (void)fixpid_autotune_init(self, &config);
    SELF.state = bytes[STATUS_AT];
    get_sums(&SELF.sums[0], &bytes[SUMS_AT]);
    get_sums(&SELF.sums[1], &bytes[SUMS_AT + SUMS_SIZE]);
    get_relay(self, &bytes[RELAY_AT]);
    return true;
}
