// SPDX-License-Identifier: MIT
// Holds a temperature: its sensor is on A0, and pin 9 drives the heater with PWM.
// The serial plotter shows setpoint, measurement and output.
#include <fixpid_pid.h>

const int RATE = 10; // steps per second: of loop() and of the gains
const unsigned long PERIOD_MS = 1000 / RATE;
static_assert(PERIOD_MS * RATE == 1000, "RATE must divide 1000 ms");

const int16_t SETPOINT = 600; // in counts of A0

// kp, ki per second, kd in seconds, steps per second, derivative filter
static const fixpid_pid_gains gains = FIXPID_PID_GAINS(2.5, 1.6, 0.5, RATE, 2);
static fixpid_pid heater;
static unsigned long last_ms;

void setup()
{
    fixpid_pid_config config = fixpid_pid_config();
    config.gains = gains;
    config.output_max = 255; // the full power of analogWrite

    pinMode(9, OUTPUT);
    Serial.begin(115200);
    if (!fixpid_pid_init(&heater, &config)) {
        Serial.println(F("refused"));
    }
    last_ms = millis();
}

void loop()
{
    if (millis() - last_ms < PERIOD_MS) {
        return;
    }
    last_ms += PERIOD_MS;

    const int16_t measurement = analogRead(A0);
    const int16_t output = fixpid_pid_step(&heater, SETPOINT, measurement);
    analogWrite(9, output);

    Serial.print(F("setpoint:"));
    Serial.print(SETPOINT);
    Serial.print(F(",measurement:"));
    Serial.print(measurement);
    Serial.print(F(",output:"));
    Serial.println(output);
}
