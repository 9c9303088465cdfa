// SPDX-License-Identifier: MIT
// The functions for points in PROGMEM. Where there is one kind of memory, and
// for XC8, they are those for any points.
#ifndef TABLE_IN_FLASH_H
#define TABLE_IN_FLASH_H

#if defined(__AVR__) && !defined(__XC8)
#include <avr/pgmspace.h>
#else
#define PROGMEM
#define fixpid_table_at_P fixpid_table_at
#define fixpid_table_valid_P fixpid_table_valid
#endif

#endif
