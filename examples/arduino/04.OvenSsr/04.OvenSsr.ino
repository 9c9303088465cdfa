// SPDX-License-Identifier: MIT
// An oven behind a solid-state relay on pin 9, with a sensor on A0. It finds its
// gains through the relay, keeps the experiment in the EEPROM, and is guarded: an
// alarm switches the relay off until a person sends `a`. `t` tunes anew.
//
// A relay that fails shut heats whatever a program says, and a reset forgets an
// alarm: an oven needs a thermal fuse, too.
#include <EEPROM.h>
#include <fixpid_autotune.h>
#include <fixpid_guard.h>
#include <fixpid_pid.h>
#include <fixpid_tpo.h>

const int RATE = 1;         // steps per second: of tuner, controller and guard
const int RELAY_STEPS = 10; // of each of these: the relay's window
const unsigned long RELAY_MS = 1000 / (RATE * RELAY_STEPS);
static_assert(RELAY_MS * RELAY_STEPS * RATE == 1000,
              "RATE must divide 1000 ms");

const int SSR = 9;
const int16_t FULL = 1000;
const int16_t SETPOINT = 4000; // a reading is the sum of ten of A0: 0..10230
const int16_t SENSOR_MIN = 100; // an open or a shorted sensor reads beyond
const int16_t SENSOR_MAX = 10100;

static fixpid_autotune tuner;
static fixpid_pid controller; // refused until there are gains: it puts out 0
static fixpid_guard guard;
static fixpid_tpo relay;
static bool tuning;
static bool off; // by an alarm, until a person acknowledges
static int16_t duty;
static unsigned long last_ms;

static void start_guard(uint16_t band, uint16_t patience, bool noisy)
{
    fixpid_guard_config config = fixpid_guard_config();
    config.output_max = FULL;
    config.measurement_min = SENSOR_MIN;
    config.measurement_max = SENSOR_MAX;
    config.band = band;
    config.patience = patience;
    config.noisy = noisy;
    if (!fixpid_guard_init(&guard, &config)) {
        off = true;
        Serial.println(F("guard refused"));
    }
}

// The rule of fixpid_guard.h, rounded up as there.
static void guard_by(const fixpid_autotune_process &found)
{
    uint32_t band = (found.noise_q4 + 1u) / 2 + 4;
    if (found.gain_q8 != FIXPID_AUTOTUNE_INTEGRATING) {
        band = max(band, (found.gain_q8 + 127) / 128);
    }
    // 2 L + 20 band / (slope * FULL) over one denominator
    const uint64_t slope = (uint64_t)found.slope_q24 * FULL;
    const uint64_t patience =
        (found.dead_q4 * slope + (160ull * band << 24) + 8 * slope - 1) /
        (8 * slope);
    const uint16_t steps = max(min(patience, 32767ull), 4ull);
    start_guard(band, steps, found.noise_q4 >= 16 && steps >= 16);
    Serial.print(F("guard: band "));
    Serial.print(band);
    Serial.print(F(", patience "));
    Serial.println(steps);
}

// From an experiment that is over, now or before the power went.
static bool take_over()
{
    fixpid_pid_config config = fixpid_pid_config();
    fixpid_autotune_process found;
    config.output_max = FULL;
    if (!fixpid_autotune_result(&tuner, FIXPID_AUTOTUNE_PI,
                                FIXPID_AUTOTUNE_SAFE, &config) ||
        !fixpid_autotune_model(&tuner, &found)) {
        return false;
    }
    (void)fixpid_pid_init(&controller, &config);
    guard_by(found);
    return true;
}

static void start_tuning()
{
    fixpid_autotune_config experiment = fixpid_autotune_config();
    experiment.output_max = FULL;
    experiment.measurement_min = SENSOR_MIN;
    experiment.measurement_max = SENSOR_MAX;
    experiment.swing = 800;
    experiment.timeout_steps = 3600;
    experiment.cycles = 2;
    (void)fixpid_autotune_init(&tuner, &experiment);
    start_guard(1, 32767, false); // until there is a model: the sensor alone
    controller = fixpid_pid();
    tuning = true;
    Serial.println(F("tuning"));
}

static int16_t tuning_step(int16_t reading)
{
    const int16_t output = fixpid_autotune_step(&tuner, SETPOINT, reading);
    if (fixpid_autotune_status(&tuner) != FIXPID_AUTOTUNE_RUNNING) {
        fixpid_autotune_record record;
        tuning = false;
        if (take_over() && fixpid_autotune_pack(&tuner, &record)) {
            EEPROM.put(0, record);
            Serial.println(F("kept"));
        } else {
            off = true;
            Serial.print(F("no gains, reason "));
            Serial.println(fixpid_autotune_reason(&tuner, FIXPID_AUTOTUNE_PI,
                                                  FIXPID_AUTOTUNE_SAFE));
        }
    }
    return output;
}

// Once a step: the duty of the next window.
static int16_t step(int16_t reading)
{
    int16_t output = 0;
    uint8_t flags;
    if (off) {
        return 0;
    }
    if (tuning) {
        output = tuning_step(reading);
        flags = fixpid_guard_step(&guard, reading, reading, output);
    } else {
        output = fixpid_pid_step(&controller, SETPOINT, reading);
        flags = fixpid_guard_step(&guard, SETPOINT, reading, output);
    }
    if ((flags & FIXPID_GUARD_ALARMS) != 0) {
        off = true;
        tuning = false;
        Serial.print(F("ALARM 0x"));
        Serial.print(flags & FIXPID_GUARD_ALARMS, HEX);
        Serial.println(F(": off. Look, then send a"));
        if ((flags & FIXPID_GUARD_NOT_FALLING) != 0) {
            Serial.println(F("cut the supply"));
        }
    }
    return off ? 0 : output;
}

static void obey(char key)
{
    if (key == 'a' && off) {
        off = false;
        fixpid_guard_acknowledge(&guard);
        fixpid_pid_reset(&controller);
        Serial.println(F("acknowledged"));
    } else if (key == 't' && !off) {
        start_tuning();
    }
}

void setup()
{
    fixpid_tpo_config windows = fixpid_tpo_config();
    windows.full = FULL;
    windows.window = RELAY_STEPS;
    (void)fixpid_tpo_init(&relay, &windows);
    pinMode(SSR, OUTPUT);
    Serial.begin(115200);

    fixpid_autotune_record record;
    EEPROM.get(0, record);
    if (!fixpid_autotune_unpack(&tuner, &record) || !take_over()) {
        start_tuning();
    }
    last_ms = millis();
}

void loop()
{
    static int ticks;
    static int16_t sum;

    if (millis() - last_ms < RELAY_MS) {
        return;
    }
    last_ms += RELAY_MS;

    if (Serial.available() > 0) {
        obey(Serial.read());
    }
    sum += analogRead(A0);
    if (++ticks == RELAY_STEPS) {
        duty = step(sum);
        Serial.print(F("setpoint:"));
        Serial.print(SETPOINT);
        Serial.print(F(",reading:"));
        Serial.print(sum);
        Serial.print(F(",duty:"));
        Serial.println(duty);
        ticks = 0;
        sum = 0;
    }
    if (off) {
        fixpid_tpo_reset(&relay);
    }
    digitalWrite(SSR, fixpid_tpo_step(&relay, duty) ? HIGH : LOW);
}
