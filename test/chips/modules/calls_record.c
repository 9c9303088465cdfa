// SPDX-License-Identifier: MIT
#include "calls.h"
#include "fixpid_record.h"
#include "numbers.h"
#include "numbers_control.h"
#include "numbers_pid.h"

static struct fixpid_pid_config config;
static struct fixpid_pid_config unpacked;
static struct fixpid_record record;

// Its bytes as the header says, which no compiler's padding or order changes.
static uint8_t defined_byte(uint8_t at)
{
    const uint16_t words[] = {
        config.gains.kp_q8, (uint16_t)(config.gains.ki_q24 & 0xFFFFu),
        (uint16_t)(config.gains.ki_q24 >> 16), config.gains.kd_q8};
    const uint16_t limits[] = {
        (uint16_t)config.output_min, (uint16_t)config.output_max,
        (uint16_t)config.integral_min, (uint16_t)config.integral_max,
        config.setpoint_weight_q8};

    if (at == 0u) {
        return 1;
    }
    if (at < 9u) {
        return (uint8_t)(words[(at - 1u) / 2u] >> (8u * ((at - 1u) % 2u)));
    }
    if (at == 9u) {
        return config.gains.derivative_filter;
    }
    if (at < 20u) {
        return (uint8_t)(limits[(at - 10u) / 2u] >> (8u * (at % 2u)));
    }
    return (uint8_t)((config.reverse ? 0x80u : 0u) |
                     (config.derivative_on_error ? 0x40u : 0u) |
                     (config.proportional_on_measurement ? 0x20u : 0u));
}

// The check by its polynomial, a byte at a time.
static uint16_t defined_check(void)
{
    uint16_t check = 0xFFFF;

    for (uint8_t at = 0; at < 21u; at++) {
        uint16_t x = (uint16_t)((check >> 8) ^ defined_byte(at));

        x ^= (uint16_t)(x >> 4);
        check = (uint16_t)(((uint32_t)check << 8) ^ ((uint32_t)x << 12) ^
                           ((uint32_t)x << 5) ^ x);
    }
    return check;
}

static void pack(void)
{
    uint16_t check;

    fixpid_record_pack(&record, &config);
    for (uint8_t at = 0; at < 21u; at++) {
        calls_answer(record.bytes[at], defined_byte(at));
    }
    check = defined_check();
    calls_answer(record.bytes[21], check & 0xFFu);
    calls_answer(record.bytes[22], (uint32_t)check >> 8);
}

static void unpack(bool good)
{
    calls_answer(fixpid_record_unpack(&record, &unpacked) ? 1u : 0u,
                 good ? 1u : 0u);
    calls_answer(unpacked.gains.kp_q8, config.gains.kp_q8);
    calls_answer(unpacked.gains.ki_q24, config.gains.ki_q24);
    calls_answer(unpacked.gains.kd_q8, config.gains.kd_q8);
    calls_answer(unpacked.gains.derivative_filter,
                 config.gains.derivative_filter);
    calls_answer((uint16_t)unpacked.output_min, (uint16_t)config.output_min);
    calls_answer((uint16_t)unpacked.output_max, (uint16_t)config.output_max);
    calls_answer((uint16_t)unpacked.integral_min,
                 (uint16_t)config.integral_min);
    calls_answer((uint16_t)unpacked.integral_max,
                 (uint16_t)config.integral_max);
    calls_answer(unpacked.setpoint_weight_q8, config.setpoint_weight_q8);
    calls_answer(unpacked.reverse ? 1u : 0u, config.reverse ? 1u : 0u);
    calls_answer(unpacked.derivative_on_error ? 1u : 0u,
                 config.derivative_on_error ? 1u : 0u);
    calls_answer(unpacked.proportional_on_measurement ? 1u : 0u,
                 config.proportional_on_measurement ? 1u : 0u);
}

void calls_rows(void)
{
}

// A good record is unpacked, and then the same with one to three wrong bits,
// each in another third.
void calls_random(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint8_t wrong = (uint8_t)(1u + numbers_below(3));

        numbers_pid_config(&config);
        pack();
        unpack(true);
        for (uint8_t third = 0; third < wrong; third++) {
            const uint8_t at = (uint8_t)(7u * third + numbers_below(7));

            record.bytes[at] ^= (uint8_t)(1u << numbers_below(8));
        }
        unpack(false);
    }
}
