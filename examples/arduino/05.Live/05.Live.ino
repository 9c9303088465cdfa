// SPDX-License-Identifier: MIT
// Holds a temperature as the sketch Heater does, and lets a program on a PC watch
// each step, and change setpoint and gains: docs/link.md says what it sends. The
// sensor is on A0, and pin 9 drives the heater with PWM.
//
// The link has Serial for itself: print nothing while a program watches.
#include <fixpid_link.h>
#include <fixpid_pid.h>

const int RATE = 50; // steps per second: of loop() and of the gains
const unsigned long PERIOD_US = 1000000UL / RATE;
static_assert(PERIOD_US * RATE == 1000000UL, "RATE must divide 1000000 us");

// A byte takes ten bits. A step's frame has up to 13 bytes, and each 256th 29.
const unsigned long BAUD = 115200;
static_assert(BAUD / 10 >= 14UL * RATE, "BAUD is too low for RATE");

const int16_t SETPOINT = 600; // in counts of A0, until the PC sends another

// What the PC cannot go beyond: the period in microseconds; after so many steps
// without a word an output by hand ends; setpoints; outputs; and a name.
static const fixpid_link_board board = {
    PERIOD_US, 5 * RATE, 0, 900, 0, 255, "heater"};
const uint8_t ALLOWED =
    FIXPID_LINK_SETPOINT | FIXPID_LINK_GAINS | FIXPID_LINK_MANUAL;

// kp, ki per second, kd in seconds, steps per second, derivative filter
static const fixpid_pid_gains gains = FIXPID_PID_GAINS(2.5, 1.6, 0.2, RATE, 2);
static fixpid_pid_config config; // what the controller runs with
static fixpid_pid heater;
static fixpid_link wire;
static unsigned long last_us;

// All of a frame or nothing of it: loop() never waits for the wire.
static void send(uint8_t bytes)
{
    if (Serial.availableForWrite() >= bytes) {
        Serial.write(wire.frame, bytes);
    } else {
        fixpid_link_lost(&wire);
    }
}

static void serve()
{
    while (Serial.available() > 0) {
        (void)fixpid_link_receive(&wire, (uint8_t)Serial.read());
    }
    if (Serial.availableForWrite() >= (int)FIXPID_LINK_FRAME) {
        send(fixpid_link_answer(&wire, &board, &heater, &config));
    }
}

void setup()
{
    config.gains = gains;
    config.output_max = 255; // the full power of analogWrite

    pinMode(9, OUTPUT);
    Serial.begin(BAUD);
    if (!fixpid_pid_init(&heater, &config)) {
        Serial.println(F("refused"));
    }
    fixpid_link_init(&wire, SETPOINT);
    fixpid_link_allow(&wire, ALLOWED);
    last_us = micros();
}

void loop()
{
    serve();
    if (micros() - last_us < PERIOD_US) {
        return;
    }
    last_us += PERIOD_US;

    const int16_t setpoint = fixpid_link_setpoint(&wire);
    const int16_t measurement = analogRead(A0);
    const int16_t output = fixpid_pid_step(&heater, setpoint, measurement);
    analogWrite(9, output);
    send(fixpid_link_step(&wire, &heater, setpoint, measurement, output));
}
