// SPDX-License-Identifier: MIT
#include "link_frames.h"

// SDCC's port for PIC18 has no memcpy.
static void copy(uint8_t to[], const uint8_t from[], unsigned count)
{
    for (unsigned at = 0; at < count; at++) {
        to[at] = from[at];
    }
}

uint16_t link_check(const uint8_t bytes[], unsigned count)
{
    uint16_t check = 0xFFFF;

    // By its polynomial, a byte at a time.
    for (unsigned at = 0; at < count; at++) {
        uint16_t x = (uint16_t)((check >> 8) ^ bytes[at]);

        x ^= (uint16_t)(x >> 4);
        check = (uint16_t)(((uint32_t)check << 8) ^ ((uint32_t)x << 12) ^
                           ((uint32_t)x << 5) ^ x);
    }
    return check;
}

unsigned link_stuffed(const uint8_t bytes[], unsigned count, uint8_t framed[])
{
    unsigned last = 0;

    // As a receiver walks, from 0 to 0.
    copy(framed + 1, bytes, count);
    for (unsigned at = 1; at <= count; at++) {
        if (framed[at] == 0) {
            framed[last] = (uint8_t)(at - last);
            last = at;
        }
    }
    framed[last] = (uint8_t)(count + 1 - last);
    framed[count + 1] = 0;
    return count + 2;
}

unsigned link_command(const uint8_t payload[], unsigned bytes, uint8_t framed[])
{
    uint8_t whole[LINK_FRAMES_MAX] = {0};
    const uint16_t check = link_check(payload, bytes);
    uint8_t *const behind = whole + bytes;

    copy(whole, payload, bytes);
    behind[0] = (uint8_t)check;
    behind[1] = (uint8_t)(check >> 8);
    for (unsigned at = 0; at < bytes; at++) {
        behind[2] = (uint8_t)(behind[2] + payload[at]);
        behind[3] = (uint8_t)(behind[3] + behind[2]);
    }
    return link_stuffed(whole, bytes + 4, framed);
}

unsigned link_payload(const uint8_t framed[], unsigned bytes, uint8_t payload[])
{
    uint8_t whole[LINK_FRAMES_MAX];
    unsigned at = 0;

    if (bytes < 4 || bytes > LINK_FRAMES_MAX) {
        return 0;
    }
    copy(whole, framed, bytes);
    while (at < bytes) {
        const unsigned next = at + framed[at];

        whole[at] = 0;
        if (framed[at] == 0 || next > bytes) {
            return 0;
        }
        at = next;
    }
    bytes -= 3;
    if (link_number(whole + 1 + bytes, 2) != link_check(whole + 1, bytes)) {
        return 0;
    }
    copy(payload, whole + 1, bytes);
    return bytes;
}

uint32_t link_number(const uint8_t bytes[], unsigned count)
{
    uint32_t number = 0;

    for (unsigned at = count; at != 0; at--) {
        number = (number << 8) | bytes[at - 1];
    }
    return number;
}
