// SPDX-License-Identifier: MIT
// The boiler of the quick start, broken for good in eight ways, without
// fixpid_guard and with it:
//
//   boiler STEPS_PER_SECOND NOISE
//
// 1 and 0 are the quick start's own; NOISE is the sensor's standard deviation
// in tenths of a degree. A line for each step:
//   time_s, then for each fault: the temperature without and with the guard,
//   and the guard's alarms
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "chance.h"
#include "fixpid_guard.h"
#include "fixpid_pid.h"

#define SETPOINT 600 // tenths of a degree, as all temperatures here
#define ROOM 200
#define SENSOR_MAX 2000
#define BROKEN_FROM 60 // seconds
#define SECONDS 420

// The model: counts of temperature for one of power, seconds, and the dead
// time, which is the step between a power and the reading that shows it.
#define GAIN 4.0
#define LAG_S 8
#define DEAD_STEPS 1.0
#define FULL_POWER 255

enum fault {
    STUCK_3,   // the sensor stays 0.3 degrees below the setpoint
    STUCK_100, // 10 degrees below
    FALLEN,    // it falls off, and cools to the room by a lag of 4 s
    SHORTED,   // it reads 0
    OPEN,      // it reads full scale
    SHUT,      // the relay of the heater stays shut
    SIGN,      // the drive is full less the power
    BURNT,     // the heater is burnt out
    FAULTS
};

static const char *const names[FAULTS] = {"stuck_3", "stuck_100", "fallen",
                                          "shorted", "open",      "shut",
                                          "sign",    "burnt"};

struct boiler {
    struct fixpid_pid pid;
    struct fixpid_guard guard;
    int32_t heat; // the quick start's, times the steps per second
    double sensor;
    struct chance chance;
    uint8_t alarms;
};

static int32_t rate; // steps per second
static double noise;

static void start_guard(struct boiler *self)
{
    const struct fixpid_guard_model model = {
        .slope_q24 = (uint32_t)lrint(GAIN / LAG_S / rate * 16777216.0),
        .dead_q4 = (uint32_t)(DEAD_STEPS * 16.0),
        .noise_q4 = (uint16_t)lrint(noise * 16.0),
        .gain_q8 = (uint32_t)(GAIN * 256.0)};
    struct fixpid_guard_config config = {
        .output_max = FULL_POWER,
        .measurement_min = 1,
        .measurement_max = SENSOR_MAX - 1,
        .reach_min = ROOM + 50,
        .reach_max = ROOM + 750, // on a supply 20 % low
    };

    (void)fixpid_guard_from_model(&config, &model);
    (void)fixpid_guard_init(&self->guard, &config);
}

static void start(struct boiler *self)
{
    static const struct fixpid_pid_config slow = {
        .gains = FIXPID_PID_GAINS(1.0, 0.3, 0, 1, 0), .output_max = FULL_POWER};
    static const struct fixpid_pid_config fast = {
        .gains = FIXPID_PID_GAINS(1.0, 0.3, 0, 10, 0),
        .output_max = FULL_POWER};

    (void)fixpid_pid_init(&self->pid, rate == 1 ? &slow : &fast);
    start_guard(self);
    self->heat = 0;
    self->sensor = ROOM;
    self->chance.state = 1;
    self->alarms = 0;
}

static int32_t temperature(const struct boiler *self)
{
    return ROOM + self->heat / rate / 2;
}

// What the sensor reads, before its noise.
static double sensed(struct boiler *self, int fault)
{
    self->sensor = fault == FALLEN
                       ? self->sensor + (ROOM - self->sensor) / (4.0 * rate)
                       : temperature(self);
    return self->sensor;
}

static int16_t reading(struct boiler *self, int fault)
{
    const double random = noise * chance_noise(&self->chance);

    switch (fault) {
    case STUCK_3:
        return SETPOINT - 3;
    case STUCK_100:
        return SETPOINT - 100;
    case SHORTED:
        return 0;
    case OPEN:
        return SENSOR_MAX;
    default:
        return (int16_t)floor(sensed(self, fault) + random + 0.5);
    }
}

static int32_t drive(int fault, int32_t power)
{
    switch (fault) {
    case SHUT:
        return FULL_POWER;
    case SIGN:
        return FULL_POWER - power;
    case BURNT:
        return 0;
    default:
        return power;
    }
}

// From an alarm on the supply is cut: no fault of the heater lets it heat.
static void step(struct boiler *self, int fault, bool guarded)
{
    const int16_t measured = reading(self, fault);
    const int16_t power = fixpid_pid_step(&self->pid, SETPOINT, measured);
    const uint8_t flags =
        fixpid_guard_step(&self->guard, SETPOINT, measured, power);

    self->alarms |= flags & FIXPID_GUARD_ALARMS;
    self->heat -= self->heat / rate / LAG_S;
    if (!guarded || self->alarms == 0u) {
        self->heat += drive(fault, power);
    }
}

static void run(void)
{
    static struct boiler without[FAULTS];
    static struct boiler with[FAULTS];

    for (int fault = 0; fault < FAULTS; fault++) {
        start(&without[fault]);
        start(&with[fault]);
        printf("%s,%s_without,%s_with,%s_alarms", fault == 0 ? "time_s" : "",
               names[fault], names[fault], names[fault]);
    }
    for (int32_t n = 0; n < SECONDS * rate; n++) {
        printf("\n%.1f", (double)n / rate);
        for (int fault = 0; fault < FAULTS; fault++) {
            const int now = n < BROKEN_FROM * rate ? FAULTS : fault;

            printf(",%.1f,%.1f,%u", temperature(&without[fault]) / 10.0,
                   temperature(&with[fault]) / 10.0, with[fault].alarms);
            step(&without[fault], now, false);
            step(&with[fault], now, true);
        }
    }
    printf("\n");
}

int main(int argc, char *argv[])
{
    rate = argc == 3 ? atoi(argv[1]) : 0;
    if (rate != 1 && rate != 10) {
        fprintf(stderr, "usage: boiler 1|10 NOISE\n");
        return 2;
    }
    noise = atof(argv[2]);
    run();
    return 0;
}
