// SPDX-License-Identifier: MIT
#include "kept_host.h"

#include <stddef.h>

int application_main(void);
#define main application_main
#include "examples/kept/kept.c"
#undef main

uint8_t kept_eeprom[KEPT_EEPROM];
const unsigned char *const kept_object = (const unsigned char *)&oven;
const unsigned kept_object_size =
    offsetof(struct fixpid_pid, status) + sizeof oven.status;

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
