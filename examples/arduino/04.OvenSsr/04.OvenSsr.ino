// SPDX-License-Identifier: MIT
// A boiler or an oven behind a solid-state relay on pin 9, with a sensor on A0.
// It finds its gains when it heats up from cold for the first time, keeps them
// in the EEPROM, and is guarded: an alarm switches the relay off until a person
// sends `a`. `t` tunes anew, from cold, and `h` does that with half the power.
//
// A relay that fails shut heats whatever a program says, and a reset forgets an
// alarm: an oven needs a thermal fuse, too.
#include <EEPROM.h>
#include <fixpid_guard.h>
#include <fixpid_pid.h>
#include <fixpid_reaction.h>
#include <fixpid_record.h>
#include <fixpid_table.h>
#include <fixpid_tpo.h>

// For a thermistor remove the slashes, and adapt the points below.
// #define WITH_NTC

const int RATE = 1;         // steps per second: of tuner, controller and guard
const int RELAY_STEPS = 10; // of each of these: the relay's window
const unsigned long RELAY_MS = 1000 / (RATE * RELAY_STEPS);
static_assert(RELAY_MS * RELAY_STEPS * RATE == 1000,
              "RATE must divide 1000 ms");

const int SSR = 9;
const int16_t FULL = 1000;

// A reading is the sum of ten of A0, 0..10230, or what a curve makes of it. The
// heat-up that tunes ends before it reaches the setpoint. An open or a shorted
// sensor reads beyond SENSOR_MIN or SENSOR_MAX.
#ifdef WITH_NTC
// An NTC of 10 kilohms with a B of 3950 from A0 to GND, and 10 kilohms from A0
// to the supply: sums, and hundredths of a degree.
static const fixpid_table_point ntc_points[] = {
    {162, 16000}, {223, 14500}, {315, 13000},  {453, 11500},
    {585, 10500}, {762, 9500},  {1003, 8500},  {1328, 7500},
    {1766, 6500}, {2348, 5500}, {3100, 4500},  {4032, 3500},
    {5690, 2000}, {7885, 0},    {8731, -1000}, {9343, -2000}};
static const fixpid_table ntc = FIXPID_TABLE(ntc_points);
const int16_t SETPOINT = 9500;
const int16_t SENSOR_MIN = -1000;
const int16_t SENSOR_MAX = 15000;

static int16_t reading_of(int16_t sum)
{
    return fixpid_table_at(&ntc, sum);
}
#else
const int16_t SETPOINT = 6480; // 95 C, where 10230 is 150 C
const int16_t SENSOR_MIN = 100;
const int16_t SENSOR_MAX = 10100;

static int16_t reading_of(int16_t sum)
{
    return sum;
}
#endif

// A sensor's noise, or a relay that knows only tenths of the power, may make
// the reading swing: that is no reason to switch off.
const uint8_t ALARMS = FIXPID_GUARD_ALARMS & ~FIXPID_GUARD_OSCILLATING;

// In the EEPROM. The record of the gains has a check of its own.
struct kept {
    fixpid_record record;
    fixpid_reaction_process plant;
    uint32_t check; // of the plant, and of the unit by its SENSOR_MAX
};

static fixpid_reaction tuner;
static fixpid_pid controller; // refused until there are gains: it puts out 0
static fixpid_guard guard;
static fixpid_tpo relay;
static bool tuning;
static bool off; // by an alarm, until a person acknowledges
static int16_t duty;
static unsigned long last_ms;

static uint32_t check_of(const fixpid_reaction_process &plant)
{
    return ~(plant.slope_q24 + plant.dead_q4 + plant.noise_q4 + SENSOR_MAX);
}

static fixpid_guard_config sensor_alone()
{
    fixpid_guard_config config = fixpid_guard_config();
    config.output_max = FULL;
    config.measurement_min = SENSOR_MIN;
    config.measurement_max = SENSOR_MAX;
    config.band = 1;
    config.patience = 32767;
    return config;
}

static bool start_guard(const fixpid_reaction_process &plant)
{
    fixpid_guard_config config = sensor_alone();
    fixpid_guard_model model = fixpid_guard_model();
    model.slope_q24 = plant.slope_q24;
    model.dead_q4 = plant.dead_q4;
    model.noise_q4 = plant.noise_q4;
    if (!fixpid_guard_from_model(&config, &model) ||
        !fixpid_guard_init(&guard, &config)) {
        return false;
    }
    Serial.print(F("guard: band "));
    Serial.print(config.band);
    Serial.print(F(", patience "));
    Serial.println(config.patience);
    return true;
}

static void print_gains(const fixpid_pid_gains &gains)
{
    Serial.print(F("gains: kp_q8 "));
    Serial.print(gains.kp_q8);
    Serial.print(F(", ki_q24 "));
    Serial.print(gains.ki_q24);
    Serial.print(F(", kd_q8 "));
    Serial.print(gains.kd_q8);
    Serial.print(F(", filter "));
    Serial.println(gains.derivative_filter);
}

// What was found now, or before the power went.
static bool take_over(const fixpid_pid_config &config,
                      const fixpid_reaction_process &plant)
{
    print_gains(config.gains);
    return start_guard(plant) && fixpid_pid_init(&controller, &config);
}

static bool take_over_kept()
{
    kept found;
    fixpid_pid_config config;
    EEPROM.get(0, found);
    return fixpid_record_unpack(&found.record, &config) &&
           found.check == check_of(found.plant) &&
           take_over(config, found.plant);
}

static bool take_over_found()
{
    kept found;
    fixpid_pid_config config = fixpid_pid_config();
    config.output_max = FULL;
    config.setpoint_weight_q8 = 128; // from cold without an overshoot
    if (!fixpid_reaction_model(&tuner, &found.plant)) {
        return false; // the status says why
    }
    if (!fixpid_reaction_result(&tuner, FIXPID_REACTION_PID,
                                FIXPID_REACTION_SAFE, &config.gains)) {
        Serial.println(F("a gain is out of range: measure in tenths or "
                         "hundredths of a degree"));
        return false;
    }
    if (!take_over(config, found.plant)) {
        Serial.println(F("no guard: it needs a slower rate"));
        return false;
    }
    fixpid_record_pack(&found.record, &config);
    found.check = check_of(found.plant);
    EEPROM.put(0, found);
    Serial.println(F("kept"));
    return true;
}

static void start_tuning(int16_t power)
{
    const fixpid_guard_config config = sensor_alone();
    fixpid_reaction_config heat_up = fixpid_reaction_config();
    heat_up.output_drive = power;
    heat_up.measurement_stop = SETPOINT;
    (void)fixpid_reaction_init(&tuner, &heat_up);
    (void)fixpid_guard_init(&guard, &config);
    controller = fixpid_pid();
    tuning = true;
    Serial.println(F("tuning"));
}

// Without a step of the heat-up, `duty` is still 0.
static void print_limit(int16_t reading)
{
    if ((reading >= SETPOINT) && (duty == 0)) {
        Serial.println(F(": it reads above SETPOINT. Let it cool; if it is "
                         "cold, check SETPOINT, or define WITH_NTC"));
    } else {
        Serial.println(F(": too near the setpoint. Let it cool, then send h"));
    }
}

static void print_end(uint8_t status, int16_t reading)
{
    Serial.print(F("status "));
    Serial.print(status);
    switch (status) {
    case FIXPID_REACTION_DONE:
        Serial.println(F(": it has measured"));
        break;
    case FIXPID_REACTION_MOVING:
        Serial.println(F(": it was not at rest. Let it cool, then send t"));
        break;
    case FIXPID_REACTION_NO_MOVEMENT:
        Serial.println(F(": it got no warmer. Check heater and sensor"));
        break;
    case FIXPID_REACTION_WRONG_WAY:
        Serial.println(F(": its reading fell. Check sensor and wiring; an NTC "
                         "needs WITH_NTC"));
        break;
    case FIXPID_REACTION_LIMIT:
        print_limit(reading);
        break;
    case FIXPID_REACTION_LEVELS_OFF:
        Serial.println(F(": it responds late. Try fixpid_autotune"));
        break;
    default:
        Serial.println(F(": it is too slow for this rate"));
        break;
    }
}

// The controller goes on in the step in which the heat-up ends. Without gains
// it puts out 0.
static int16_t tuning_step(int16_t reading)
{
    const int16_t output = fixpid_reaction_step(&tuner, reading);
    const uint8_t status = fixpid_reaction_status(&tuner);
    if (status == FIXPID_REACTION_RUNNING) {
        return output;
    }
    tuning = false;
    print_end(status, reading);
    if (!take_over_found()) {
        Serial.println(F("no gains: off"));
    }
    return fixpid_pid_step(&controller, SETPOINT, reading);
}

static void print_alarms(uint8_t alarms)
{
    Serial.print(F("ALARM 0x"));
    Serial.print(alarms, HEX);
    if ((alarms & FIXPID_GUARD_NOT_RISING) != 0) {
        Serial.print(F(", it gets no warmer"));
    }
    if ((alarms & FIXPID_GUARD_NOT_FALLING) != 0) {
        Serial.print(F(", it does not cool: cut the supply"));
    }
    if ((alarms & FIXPID_GUARD_FROZEN) != 0) {
        Serial.print(F(", its reading stands still"));
    }
    if ((alarms & FIXPID_GUARD_SENSOR_LOW) != 0) {
        Serial.print(F(", it reads below SENSOR_MIN"));
    }
    if ((alarms & FIXPID_GUARD_SENSOR_HIGH) != 0) {
        Serial.print(F(", it reads above SENSOR_MAX"));
    }
    Serial.println(F(": off. Check, then send a"));
}

// Once a step: the duty of the next window. While it tunes, the guard judges
// the sensor alone.
static int16_t step(int16_t reading)
{
    if (off) {
        return 0;
    }
    const int16_t output =
        tuning ? tuning_step(reading)
               : fixpid_pid_step(&controller, SETPOINT, reading);
    const int16_t wanted = tuning ? reading : SETPOINT;
    const uint8_t alarms =
        fixpid_guard_step(&guard, wanted, reading, output) & ALARMS;
    if (alarms == 0) {
        return output;
    }
    off = true;
    tuning = false;
    print_alarms(alarms);
    return 0;
}

static void obey(char key)
{
    if (key == 'a' && off) {
        off = false;
        fixpid_guard_acknowledge(&guard);
        fixpid_pid_reset(&controller);
        Serial.println(F("acknowledged"));
    } else if (key == 't' && !off) {
        start_tuning(FULL);
    } else if (key == 'h' && !off) {
        start_tuning(FULL / 2);
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
    if (!take_over_kept()) {
        start_tuning(FULL);
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
        const int16_t reading = reading_of(sum);
        duty = step(reading);
        Serial.print(F("setpoint:"));
        Serial.print(SETPOINT);
        Serial.print(F(",reading:"));
        Serial.print(reading);
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
