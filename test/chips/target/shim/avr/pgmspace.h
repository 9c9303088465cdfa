// SPDX-License-Identifier: MIT
// For the tables of test/chips/avr/vectors_table.rb where flash is plain
// memory.
#ifndef PGMSPACE_H
#define PGMSPACE_H
#include <stdint.h>

#define PROGMEM
#define pgm_get_far_address(object) ((uintptr_t) & (object)[0])
#define pgm_read_byte_far(address) (*(const uint8_t *)(address))
#define pgm_read_word_far(address) (*(const uint16_t *)(address))
#define pgm_read_dword_far(address) (*(const uint32_t *)(address))

#endif
