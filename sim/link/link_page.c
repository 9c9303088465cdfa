// SPDX-License-Identifier: MIT
#include "link_page.h"

#include <string.h>

#include "fixpid_record.h"
#include "link_twin.h"

// A step's frame has 11 bytes, one without a setpoint.
#define STEPS_MAX (LIVE_BYTES / 11 + 1)

static struct link_twin twin;
static uint8_t bytes[LIVE_BYTES];
static int32_t steps[STEPS_MAX][LINK_PAGE_STEP];
static int32_t counts[LINK_PAGE_COUNTS];
static int32_t config[LINK_PAGE_CONFIG];
static int step_count;

void live_begin(int asks)
{
    link_twin_init(&twin);
    twin.asks = asks != 0;
}

uint8_t *live_bytes(void)
{
    return bytes;
}

static void put_step(void)
{
    int32_t *const step = steps[step_count];
    const bool is_key = twin.frame[0] == LINK_KEY;
    const uint8_t *const measured = twin.frame + (is_key ? 9 : 3);

    step[LIVE_NUMBER] = (int32_t)twin.last;
    step[LIVE_IS_KEY] = is_key;
    step[LIVE_SETPOINT] = twin.setpoint;
    step[LIVE_MEASUREMENT] = (int16_t)link_number(measured, 2);
    step[LIVE_OUTPUT] = (int16_t)link_number(measured + 2, 2);
    step[LIVE_FLAGS] = is_key ? twin.frame[13] : twin.frame[0] & ~LINK_STEP;
    step[LIVE_COMPARED] = twin.compared;
    step[LIVE_P] = fixpid_pid_proportional(&twin.pid);
    step[LIVE_I] = fixpid_pid_integral(&twin.pid);
    step[LIVE_D] = fixpid_pid_derivative(&twin.pid);
    step_count++;
}

int live_take(int from, int to)
{
    int at = from;

    step_count = 0;
    twin.frame_bytes = 0;
    while (at < to) {
        const bool whole = link_twin_receive(&twin, bytes[at]);

        at++;
        if (!whole) {
            continue;
        }
        if (twin.frame[0] == LINK_KEY || (twin.frame[0] & LINK_STEP) != 0) {
            put_step();
        } else {
            return at;
        }
    }
    twin.frame_bytes = 0;
    return at;
}

const uint8_t *live_payload(void)
{
    return twin.frame;
}

int live_payload_bytes(void)
{
    return (int)twin.frame_bytes;
}

int live_steps(void)
{
    return step_count;
}

const int32_t *live_step_numbers(void)
{
    return steps[0];
}

const int32_t *live_counts(void)
{
    counts[LIVE_FRAMES] = (int32_t)twin.frames;
    counts[LIVE_SPOILT] = (int32_t)twin.spoilt;
    counts[LIVE_EQUAL] = (int32_t)twin.equal;
    counts[LIVE_DIFFERENT] = (int32_t)twin.different;
    counts[LIVE_GAPS] = (int32_t)twin.gaps;
    for (int i = 0; i < LINK_TWIN_REASONS; i++) {
        counts[LIVE_LEFT_BEGINNING + i] = (int32_t)twin.by_reason[i];
    }
    counts[LIVE_WANTS_RECORD] = twin.wants_record;
    counts[LIVE_RUNNING] = twin.running;
    counts[LIVE_WAITING] = twin.command_bytes != 0;
    counts[LIVE_FIRST_NUMBER] = (int32_t)twin.first.number;
    counts[LIVE_FIRST_OUTPUT] = twin.first.output;
    counts[LIVE_FIRST_OWN_OUTPUT] = twin.first.own_output;
    counts[LIVE_FIRST_FLAGS] = twin.first.flags;
    counts[LIVE_FIRST_OWN_FLAGS] = twin.first.own_flags;
    counts[LIVE_FIRST_STATE] = twin.first.state;
    return counts;
}

int live_command(int command, int count)
{
    link_twin_send(&twin, (uint8_t)command, bytes, (unsigned)count);
    memcpy(bytes, twin.command, sizeof twin.command);
    return (int)twin.command_bytes;
}

void live_forget(void)
{
    twin.command_bytes = 0;
}

const int32_t *live_config(void)
{
    struct fixpid_record record;

    if (!twin.known) {
        return 0;
    }
    fixpid_record_pack(&record, &twin.config);
    config[LIVE_KP] = twin.config.gains.kp_q8;
    config[LIVE_KI] = (int32_t)twin.config.gains.ki_q24;
    config[LIVE_KD] = twin.config.gains.kd_q8;
    config[LIVE_FILTER] = twin.config.gains.derivative_filter;
    config[LIVE_OUTPUT_MIN] = twin.config.output_min;
    config[LIVE_OUTPUT_MAX] = twin.config.output_max;
    config[LIVE_INTEGRAL_MIN] = twin.config.integral_min;
    config[LIVE_INTEGRAL_MAX] = twin.config.integral_max;
    config[LIVE_WEIGHT] = twin.config.setpoint_weight_q8;
    config[LIVE_OPTIONS] = record.bytes[20];
    return config;
}

int live_record(int kp, uint32_t ki, int kd, int filter)
{
    struct fixpid_pid_config wanted = twin.config;
    struct fixpid_record record;

    if (!twin.known) {
        return 0;
    }
    wanted.gains.kp_q8 = (uint16_t)kp;
    wanted.gains.ki_q24 = ki;
    wanted.gains.kd_q8 = (uint16_t)kd;
    wanted.gains.derivative_filter = (uint8_t)filter;
    fixpid_record_pack(&record, &wanted);
    memcpy(bytes, record.bytes, sizeof record.bytes);
    return FIXPID_RECORD_SIZE;
}
