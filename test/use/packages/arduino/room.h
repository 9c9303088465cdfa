// SPDX-License-Identifier: MIT
// What the sketch Heater heats, on the PC and around the simulated chip: a lag
// of 16 steps, and a sensor that lags by 4, without which no gain would be too
// large. A converter's reading, 0..1023, is one step, with the drive of
// analogWrite, 0..255.
#ifndef ROOM_H
#define ROOM_H

static inline int room_counts(int drive)
{
    static long heat; // in 1/256 of a count, above the room's temperature
    static long sensor;

    heat += ((drive * 800L) - heat) / 16;
    sensor += (heat - sensor) / 4;
    return 100 + (int)(sensor / 256);
}

#endif
