// SPDX-License-Identifier: MIT
// An oven that keeps its tuning in the chip's EEPROM. It starts with what is
// there, or with the gentle tuning if that is no record or a spoilt one. A
// switch chooses a tuning and keeps it.
#include "fixpid_pid.h"
#include "fixpid_record.h"
#include "port.h"
#include "port_eeprom.h"

#include "../oven_sensor.h"

#define CONTROL_PERIOD_TICKS 100u
#define STEPS_PER_SECOND 10.0

// Where the record begins; address 0 is left free, as a chip that loses its
// supply may spoil that one.
#define RECORD_AT 1u

// The switch is on a ladder of resistors: a quarter of the converter's range
// for each position, and the first two keep what there is.
#define READING_TO_POSITION 8u
#define POSITION_GENTLE 2u

static const struct fixpid_pid_config tunings[] = {
    {.gains = FIXPID_PID_GAINS(0.6, 0.05, 0, STEPS_PER_SECOND, 0),
     .output_min = 0,
     .output_max = PORT_DRIVE_FULL / 2}, // gentle: half of the power
    {.gains = FIXPID_PID_GAINS(1.3, 0.35, 0.8, STEPS_PER_SECOND, 1),
     .output_min = 0,
     .output_max = PORT_DRIVE_FULL}};
#define GENTLE (&tunings[0])

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_pid oven;

static struct fixpid_record record;
static uint8_t written = FIXPID_RECORD_SIZE; // bytes of it, in the EEPROM

static void start(void)
{
    struct fixpid_pid_config stored;
    bool good = false;

    for (uint8_t i = 0; i < FIXPID_RECORD_SIZE; i++) {
        record.bytes[i] = port_eeprom_read((uint8_t)(RECORD_AT + i));
    }
    if (fixpid_record_unpack(&record, &stored)) {
        good = fixpid_pid_init(&oven, &stored);
    }
    if (!good) {
        (void)fixpid_pid_init(&oven, GENTLE);
    }
}

// The controller goes on from its output with another tuning.
static void choose(const struct fixpid_pid_config *tuning)
{
    const int16_t output = fixpid_pid_output(&oven);

    (void)fixpid_pid_init(&oven, tuning);
    fixpid_pid_seed(&oven, output);
    fixpid_record_pack(&record, tuning);
    written = 0;
}

// A position counts when it is read twice, and once.
static void follow_switch(void)
{
    static uint8_t last = 0;
    static uint8_t taken = 0;
    const uint8_t now =
        (uint8_t)(port_read(PORT_SELECTOR) >> READING_TO_POSITION);

    if ((now == last) && (now != taken)) {
        taken = now;
        if (now >= POSITION_GENTLE) {
            choose(&tunings[now - POSITION_GENTLE]);
        }
    }
    last = now;
}

// One byte in a pass, as it takes milliseconds. A record that the supply leaves
// half written is a spoilt one.
static void keep(void)
{
    if (written < FIXPID_RECORD_SIZE) {
        port_eeprom_write((uint8_t)(RECORD_AT + written),
                          record.bytes[written]);
        written++;
    }
}

// Without a sensor the heater is off, and the controller rests. A heater cannot
// cool, whatever limits were kept.
static void control(void)
{
    const int16_t setpoint = set_temperature();
    const int16_t measurement = temperature();
    int16_t duty = 0;

    if (sensed(measurement)) {
        duty = fixpid_pid_step(&oven, setpoint, measurement);
    }
    if (duty < 0) {
        duty = 0;
    }
    port_drive(duty);
}

int main(void)
{
    port_init();
    start();
    while (port_running()) {
        (void)port_wait_ticks(CONTROL_PERIOD_TICKS);
        follow_switch();
        control();
        keep();
    }
    return 0;
}
