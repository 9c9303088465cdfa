// SPDX-License-Identifier: MIT
#include "kept_host.h"

#include <stddef.h>

int application_main(void);
#define main application_main
#include "examples/kept/kept.c"
#undef main

uint8_t kept_eeprom[KEPT_EEPROM];

// Here `previous` is a word of 32 bits, and there one of 16, which is 0 before
// the first step.
#define PREVIOUS_AT offsetof(struct fixpid_pid, previous)
#define REST_AT (PREVIOUS_AT + sizeof oven.previous)
#define REST_SIZE                                                              \
    (offsetof(struct fixpid_pid, output) + sizeof oven.output - REST_AT)

uint8_t kept_byte(unsigned at)
{
    const uint8_t *const bytes = (const uint8_t *)&oven;

    if (at < PREVIOUS_AT) {
        return bytes[at];
    }
    return (at < PREVIOUS_AT + 2u) ? 0u
                                   : bytes[REST_AT + at - PREVIOUS_AT - 2u];
}

const unsigned kept_object_size = PREVIOUS_AT + 2u + REST_SIZE;

void port_init(void)
{
}

bool port_running(void)
{
    return false;
}

uint8_t port_wait_ticks(uint8_t n)
{
    return n;
}

uint16_t port_read(uint8_t channel)
{
    return channel;
}

void port_drive(int16_t duty)
{
    (void)duty;
}

uint8_t port_eeprom_read(uint8_t address)
{
    return kept_eeprom[address];
}

void port_eeprom_write(uint8_t address, uint8_t value)
{
    kept_eeprom[address] = value;
}

static struct fixpid_pid_config config_of(unsigned which)
{
    struct fixpid_pid_config config = tunings[which == KEPT_BRISK ? 1 : 0];

    if (which == KEPT_OTHER) {
        config.gains.kp_q8 = 777;
        config.output_max = 600;
    }
    if (which == KEPT_REFUSED) {
        config.output_max = config.output_min;
    }
    return config;
}

void kept_store(unsigned which)
{
    const struct fixpid_pid_config config = config_of(which);
    struct fixpid_record packed;

    fixpid_record_pack(&packed, &config);
    for (unsigned i = 0; i < FIXPID_RECORD_SIZE; i++) {
        kept_eeprom[KEPT_RECORD_AT + i] = packed.bytes[i];
    }
}

void kept_start(void)
{
    start();
}

void kept_expect(unsigned which)
{
    const struct fixpid_pid_config config = config_of(which);

    (void)fixpid_pid_init(&oven, &config);
}
