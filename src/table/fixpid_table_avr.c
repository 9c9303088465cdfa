// SPDX-License-Identifier: MIT
#include "fixpid_table.h"

// This file is empty for other chips. The points are read as words of the lower
// 64 KiB of flash: `__flash`, which also reads them, is not a keyword of C++
// and C99.
#if defined(__AVR__)
#include <avr/pgmspace.h>

FIXPID_INLINE int16_t read_flash(const int16_t *value)
{
    return (int16_t)pgm_read_word(value);
}

#define fixpid_table_valid fixpid_table_valid_P
#define fixpid_table_at fixpid_table_at_P
#define READ read_flash
#include "fixpid_table_text.h"
#undef fixpid_table_valid
#undef fixpid_table_at
#endif
