// SPDX-License-Identifier: MIT
// What the sketches heat, on the PC and around the simulated chip. A
// converter's reading, 0..1023, is one step, with the drive of analogWrite,
// 0..255.
#ifndef ROOM_H
#define ROOM_H

static long room_steps;

#ifdef WITH_NTC
#define OVEN
#endif

#ifndef OVEN
// Of the sketch Heater: a lag of 16 steps, and a sensor that lags by 4, without
// which no gain would be too large.
#define HEATER_LAG 16
#define SENSOR_LAG 4

static inline int room_counts(int drive)
{
    static long heat; // in 1/256 of a count, above the room's temperature
    static long sensor;

    heat += ((drive * 800L) - heat) / HEATER_LAG;
    sensor += (heat - sensor) / SENSOR_LAG;
    room_steps++;
    return 100 + (int)(sensor / 256);
}

#else
// Of the sketch OvenSsr: an espresso boiler of 1300 W and 2.4 kJ/K, in which
// the heat is 3 s on its way, with a sensor that lags by 8 s and has half a
// count of noise, another one for each number in SEED. 61 W hold it at 95 C. A
// step is one of the relay, 0.1 s.
#include <math.h>
#include <stdlib.h>

#define STEP_S 0.1
#define FULL_W 1300.0
#define HEAT_J_K 2400.0
#define LOSS_W_K 0.83
#define ON_ITS_WAY 30 // steps
#define SENSOR_S 8.0
#define ROOM_C 22.0
#define NOISE_COUNTS 0.5
#define FALLS_OFF 30000 // the sensor, which then reads the room
#define IS_BACK 40000
#define KEY 42000 // a person sends `a`

// The sum of twelve numbers has a deviation of 1.
static double room_noise(void)
{
    static unsigned long state;
    double sum = -6.0;

    if (room_steps == 0) {
        const char *const seed = getenv("SEED");
        state = (seed != NULL) ? strtoul(seed, NULL, 10) : 1u;
    }
    for (int i = 0; i < 12; i++) {
        state = (state * 1664525u + 1013904223u) & 0xFFFFFFFFu;
        sum += (double)state / 4294967296.0;
    }
    return sum;
}

#ifdef WITH_NTC
// 10 kilohms to ground, 10 to the supply.
static double converted(double degrees)
{
    const double ohms =
        1e4 * exp(3950.0 * (1.0 / (degrees + 273.15) - 1.0 / 298.15));
    return 1023.0 * ohms / (ohms + 1e4);
}
#else
static double converted(double degrees)
{
    return degrees * 1023.0 / 150.0;
}
#endif

static inline int room_counts(int drive)
{
    static double boiler_c = ROOM_C;
    static double sensor_c = ROOM_C;
    static int line[ON_ITS_WAY];
    int *const arrives = &line[room_steps % ON_ITS_WAY];
    const double noise = NOISE_COUNTS * room_noise();
    double counts;

    boiler_c += STEP_S *
                (*arrives * FULL_W / 255.0 - LOSS_W_K * (boiler_c - ROOM_C)) /
                HEAT_J_K;
    *arrives = drive;
    sensor_c += STEP_S * (boiler_c - sensor_c) / SENSOR_S;
    room_steps++;
    counts = converted(sensor_c) + noise + 0.5;
    if ((room_steps > FALLS_OFF) && (room_steps <= IS_BACK)) {
        counts = converted(ROOM_C) + noise + 0.5;
    }
    return (int)((counts < 1023.0) ? counts : 1023.0);
}
#endif

#endif
