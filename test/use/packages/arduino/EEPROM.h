// SPDX-License-Identifier: MIT
// Of Arduino's EEPROM what the sketches call, for a PC: the file eeprom.bin,
// which is erased if there is none.
#ifndef EEPROM_H
#define EEPROM_H
#include <stdio.h>
#include <string.h>

struct EEPROM_ {
    template <class T> void get(int, T &value)
    {
        FILE *const file = fopen("eeprom.bin", "rb");

        memset(&value, 0xFF, sizeof value);
        if (file != nullptr) {
            (void)fread(&value, 1, sizeof value, file);
            (void)fclose(file);
        }
    }
    template <class T> void put(int, const T &value)
    {
        FILE *const file = fopen("eeprom.bin", "wb");

        (void)fwrite(&value, 1, sizeof value, file);
        (void)fclose(file);
    }
};
static EEPROM_ EEPROM;

#endif
