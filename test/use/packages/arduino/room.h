// SPDX-License-Identifier: MIT
// What the sketch Heater heats, on the PC and around the simulated chip: a lag
// of 16 steps, and a sensor that lags by 4, without which no gain would be too
// large. A converter's reading, 0..1023, is one step, with the drive of
// analogWrite, 0..255.
#ifndef ROOM_H
#define ROOM_H

#ifdef OVEN // of the sketch OvenSsr: steps of its relay
#define HEATER_LAG 300
#define SENSOR_LAG 40
#define FALLS_OFF 30000 // the sensor, which then reads the room
#define IS_BACK 40000
#define KEY 42000 // a person sends `a`
#else
#define HEATER_LAG 16
#define SENSOR_LAG 4
#endif

static long room_steps;

static inline int room_counts(int drive)
{
    static long heat; // in 1/256 of a count, above the room's temperature
    static long sensor;

    heat += ((drive * 800L) - heat) / HEATER_LAG;
    sensor += (heat - sensor) / SENSOR_LAG;
    room_steps++;
#ifdef OVEN
    if ((room_steps > FALLS_OFF) && (room_steps <= IS_BACK)) {
        return 100;
    }
#endif
    return 100 + (int)(sensor / 256);
}

#endif
