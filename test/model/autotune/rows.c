// SPDX-License-Identifier: MIT
// Plays the rows that table.rb compiled in, on any machine, and compares them
// with what was recorded. Prints the rows that differ, their values in the
// order and the form of the table's comments, and at last
//
//   COUNT rows, COUNT different, DIGEST
#include <stdio.h>

#include "table.h"

static uint32_t values[PLAYER_VALUES];

static void say(const char *text)
{
    while (*text != '\0') {
        putchar(*text);
        text++;
    }
}

static void say_hexadecimal(uint32_t value)
{
    for (uint8_t digit = 0; digit < 8u; digit++) {
        putchar("0123456789abcdef"[(value >> (28u - 4u * digit)) & 15u]);
    }
}

static void say_decimal(uint16_t value)
{
    if (value >= 10u) {
        say_decimal(value / 10u);
    }
    putchar('0' + value % 10u);
}

static void say_different(uint16_t row)
{
    say("row ");
    say_decimal((uint16_t)(row + 1u));
    for (uint8_t i = 0; i < PLAYER_VALUES; i++) {
        putchar(' ');
        say_hexadecimal(values[i]);
    }
    putchar('\n');
}

int main(void)
{
    uint32_t digest = PLAYER_DIGEST;
    uint16_t different = 0;

    for (uint16_t row = 0; row < table_count; row++) {
        player_play(&table_rows[row].row, values);
        digest = player_digest(digest, values);
        if (player_digest(PLAYER_DIGEST, values) != table_rows[row].recorded) {
            say_different(row);
            different++;
        }
    }
    say_decimal(table_count);
    say(" rows, ");
    say_decimal(different);
    say(" different, ");
    say_hexadecimal(digest);
    putchar('\n');
    return different == 0 ? 0 : 1;
}
