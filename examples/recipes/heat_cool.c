// SPDX-License-Identifier: MIT
// Heat and cool by one controller, with a gap in which both rest, and with
// modes. A chamber is held at 25.0 degrees while its surroundings swing around
// that, first by 20 degrees, then by 1. Without the gap noise alone makes the
// two take turns.
#include <math.h>
#include <stdio.h>

#include "fixpid_pid.h"
#include "fixpid_tpo.h"
#include "plant_counts.h"

#define STEPS 100000 // of 1 s
#define ROW 10       // steps
#define SETPOINT 250
#define CALM_FROM 40000
#define HEAT_FROM 80000
#define COOL_FROM 85000
#define OFF_FROM 90000
#define BOTH_FROM 95000
#define POWER 400.0 // degrees above or below the surroundings, in tenths

// recipe
#define FULL 1000
#define GAP 50
#define REST 60 // steps from one of the two to the other, at least

enum mode { MODE_OFF, MODE_HEAT, MODE_COOL, MODE_BOTH };

static struct fixpid_pid pid; // its output: below 0 cools, above 0 heats
static struct fixpid_tpo heater;
static struct fixpid_tpo cooler;
static int16_t gap = GAP;

static void set_mode(enum mode mode)
{
    const bool heats = mode == MODE_HEAT || mode == MODE_BOTH;
    const bool cools = mode == MODE_COOL || mode == MODE_BOTH;
    const int16_t range = (int16_t)(gap + FULL);

    if (mode == MODE_OFF) {
        fixpid_pid_set_manual(&pid, 0);
    } else {
        (void)fixpid_pid_set_limits(&pid, (int16_t)(cools ? -range : 0),
                                    (int16_t)(heats ? range : 0));
        fixpid_pid_set_auto(&pid);
    }
}

// shown
static void control(int16_t setpoint, int16_t measurement, bool *heat,
                    bool *cool)
{
    static uint8_t heater_rests = 0; // for so many steps yet
    static uint8_t cooler_rests = 0;
    const int16_t output = fixpid_pid_step(&pid, setpoint, measurement);
    const int16_t hot = (int16_t)(output - gap); // below 0 is none
    const int16_t cold = (int16_t)(-output - gap);

    *heat = fixpid_tpo_step(&heater, (heater_rests == 0u) ? hot : 0);
    *cool = fixpid_tpo_step(&cooler, (cooler_rests == 0u) ? cold : 0);
    heater_rests = (uint8_t)(heater_rests - ((heater_rests != 0u) ? 1u : 0u));
    cooler_rests = (uint8_t)(cooler_rests - ((cooler_rests != 0u) ? 1u : 0u));
    if (*cool) {
        heater_rests = REST;
    }
    if (*heat) {
        cooler_rests = REST;
    }
}
// end of shown
// end of recipe

static void start(void)
{
    static const struct fixpid_pid_config config = {
        .gains = FIXPID_PID_GAINS(15, 0.05, 0, 1, 0),
        .output_min = -FULL,
        .output_max = FULL};
    static const struct fixpid_tpo_config pulses = {
        .full = FULL, .window = 60, .minimum_on = 10, .minimum_off = 10};

    (void)fixpid_pid_init(&pid, &config);
    (void)fixpid_tpo_init(&heater, &pulses);
    (void)fixpid_tpo_init(&cooler, &pulses);
    set_mode(MODE_BOTH);
}

static void change_mode(int k)
{
    if (k == HEAT_FROM) {
        set_mode(MODE_HEAT);
    } else if (k == COOL_FROM) {
        set_mode(MODE_COOL);
    } else if (k == OFF_FROM) {
        set_mode(MODE_OFF);
    } else if (k == BOTH_FROM) {
        set_mode(MODE_BOTH);
    }
}

// Tenths of a degree: half a turn of the sine is an hour.
static double surroundings(int k)
{
    const double swing = (k >= CALM_FROM && k < HEAT_FROM) ? 10.0 : 200.0;

    return SETPOINT + swing * sin(k / 3600.0 * 3.14159265);
}

// Of ROW steps.
struct row {
    double value;
    int output;
    int heat; // steps in which it is on
    int cool;
    int fights; // one of them is on within REST steps of the other
};

static void run(int16_t wanted_gap, struct row *rows)
{
    static const struct plant_counts chamber = {.gain = 1.0,
                                                .lag_steps = 600.0,
                                                .delay_steps = 1,
                                                .noise_counts = 1,
                                                .sensor_max = 4095.0};
    struct motion motion;
    int heated = -STEPS;
    int cooled = -STEPS;

    gap = wanted_gap;
    start();
    motion_start(&motion, &chamber);
    motion.value = 200.0;
    for (int k = 0; k < STEPS; k++) {
        struct row *const row = &rows[k / ROW];
        bool heat;
        bool cool;

        change_mode(k);
        control(SETPOINT, motion_read(&motion), &heat, &cool);
        heated = heat ? k : heated;
        cooled = cool ? k : cooled;
        row->heat += heat ? 1 : 0;
        row->cool += cool ? 1 : 0;
        row->fights +=
            ((heat && k - cooled <= REST) || (cool && k - heated <= REST)) ? 1
                                                                           : 0;
        motion_move(&motion, surroundings(k) + (heat ? POWER : 0.0) -
                                 (cool ? POWER : 0.0));
        row->value = motion.value;
        row->output = fixpid_pid_output(&pid);
    }
}

int main(void)
{
    static struct row with[STEPS / ROW];
    static struct row without[STEPS / ROW];

    run(GAP, with);
    run(1, without);
    (void)printf("time_s,setpoint,value,output,heat,cool,fights,"
                 "value_without,heat_without,cool_without,surroundings\n");
    for (int k = 0; k < STEPS / ROW; k++) {
        (void)printf("%d,%.1f,%.6g,%d,%d,%d,%d,%.6g,%d,%d,%.6g\n", k * ROW,
                     SETPOINT / 10.0, with[k].value / 10.0, with[k].output,
                     with[k].heat, with[k].cool, with[k].fights,
                     without[k].value / 10.0, without[k].heat, without[k].cool,
                     surroundings(k * ROW) / 10.0);
    }
    return 0;
}
