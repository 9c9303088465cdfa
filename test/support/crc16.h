// SPDX-License-Identifier: MIT
// The check of records, from the definition in their headers and not from src/.
#ifndef CRC16_H
#define CRC16_H
#include <stdint.h>

// Of so many bytes, bit by bit, the highest one first; `first` is 0xFFFF.
uint16_t crc16(const uint8_t bytes[], unsigned count, uint16_t first);

#endif
