// SPDX-License-Identifier: MIT
// Holds the temperature of a heater that is simulated in this sketch: nothing has
// to be wired. Open Tools > Serial Plotter at 115200 baud, and change the gains.
#include <fixpid_pid.h>

const int RATE = 20; // steps per second: of loop() and of the gains
const unsigned long PERIOD_MS = 1000 / RATE;
static_assert(PERIOD_MS * RATE == 1000, "RATE must divide 1000 ms");

const int16_t WARM = 400; // in tenths of a degree
const int16_t HOT = 600;
const int16_t STEPS = 8 * RATE; // at each of the two: 8 seconds

// kp, ki per second, kd in seconds, steps per second, derivative filter
static const fixpid_pid_gains gains = FIXPID_PID_GAINS(1.2, 0.9, 0, RATE, 0);
static fixpid_pid controller;
static int16_t output;
static unsigned long last_ms;

// What follows one step with this output, 0..255: a heater that settles in 3
// seconds, 90 degrees above a room of 20, and a sensor that lags by a quarter
// of a second. It has fractions of a tenth of a degree: 256 are one.
static int16_t simulated(int16_t output)
{
    static int32_t heater;
    static int32_t sensor;

    heater += (output * 900L - heater) / (3 * RATE);
    sensor += (heater - sensor) / (RATE / 4);
    return 200 + (int16_t)(sensor / 256);
}

static void plot(int16_t setpoint, int16_t temperature, int16_t output)
{
    Serial.print(F("setpoint:"));
    Serial.print(setpoint);
    Serial.print(F(",temperature:"));
    Serial.print(temperature);
    Serial.print(F(",output:"));
    Serial.println(output);
}

void setup()
{
    fixpid_pid_config config = fixpid_pid_config();
    config.gains = gains;
    config.output_max = 255;

    Serial.begin(115200);
    if (!fixpid_pid_init(&controller, &config)) {
        Serial.println(F("refused"));
    }
    last_ms = millis();
}

void loop()
{
    static int16_t steps;
    static int16_t setpoint = HOT;

    if (millis() - last_ms < PERIOD_MS) {
        return;
    }
    last_ms += PERIOD_MS;

    const int16_t temperature = simulated(output);
    output = fixpid_pid_step(&controller, setpoint, temperature);
    plot(setpoint, temperature, output);

    steps++;
    if (steps == STEPS) {
        steps = 0;
        setpoint = (setpoint == HOT) ? WARM : HOT;
    }
}
