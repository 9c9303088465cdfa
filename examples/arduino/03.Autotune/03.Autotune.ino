// SPDX-License-Identifier: MIT
// Finds the gains of a controller by an experiment on the plant, and then controls
// with them. Nothing has to be wired: the plant is simulated. For a real one,
// measure and drive in `plant`.
#include <fixpid_autotune.h>
#include <fixpid_pid.h>

// Steps per second, of the experiment and of the controller: the gains that the
// one finds are right for the other only if both take steps at the same rate.
const int RATE = 100;
const unsigned long PERIOD_MS = 1000 / RATE;
static_assert(PERIOD_MS * RATE == 1000, "RATE must divide 1000 ms");

const int16_t SETPOINT = 400;
const int16_t HIGHER = 500;

static fixpid_autotune tuner;
static fixpid_pid controller;

static void wait_for_step()
{
    static unsigned long last_ms = millis();

    while (millis() - last_ms < PERIOD_MS) {
    }
    last_ms += PERIOD_MS;
}

// A first-order lag behind a dead time of 8 steps: the measurement that follows
// one step with this drive.
static int16_t plant(int16_t drive)
{
    static int32_t heat;
    static int16_t pipe[8];
    static uint8_t newest;

    heat += (pipe[newest] * 1024L - heat) / 64;
    pipe[newest] = drive;
    newest = (newest + 1) % 8;
    return (int16_t)(heat / 256);
}

static void print_progress(unsigned steps)
{
    fixpid_autotune_stage stage;
    fixpid_autotune_progress(&tuner, &stage);
    Serial.print(F("step "));
    Serial.print(steps);
    Serial.print(F(": phase "));
    Serial.print(stage.phase);
    Serial.print(F(", "));
    Serial.print(100u * stage.done / stage.expected);
    Serial.println(F(" %"));
}

// The drive that the experiment ends with.
static int16_t tune()
{
    fixpid_autotune_config experiment = fixpid_autotune_config();
    experiment.output_max = 255;
    experiment.measurement_min = -1; // no measurement is beyond these
    experiment.measurement_max = 1023;
    experiment.timeout_steps = 2000;
    experiment.cycles = 1;
    (void)fixpid_autotune_init(&tuner, &experiment);

    int16_t drive = 0;
    unsigned steps = 0;
    while (fixpid_autotune_status(&tuner) == FIXPID_AUTOTUNE_RUNNING) {
        if (steps % 100 == 0) {
            print_progress(steps);
        }
        wait_for_step();
        drive = fixpid_autotune_step(&tuner, SETPOINT, plant(drive));
        steps++;
    }
    print_progress(steps);
    Serial.print(F("status "));
    Serial.print(fixpid_autotune_status(&tuner));
    Serial.print(F(" after "));
    Serial.print(steps);
    Serial.println(F(" steps"));
    return drive;
}

void setup()
{
    Serial.begin(115200);
    int16_t drive = tune();

    fixpid_pid_config config = fixpid_pid_config();
    config.output_max = 255;
    if (!fixpid_autotune_result(&tuner, FIXPID_AUTOTUNE_PI,
                                FIXPID_AUTOTUNE_SAFE, &config)) {
        // A number of enum fixpid_autotune_cause: the header says what to do.
        Serial.print(F("no gains, reason "));
        Serial.println(fixpid_autotune_reason(&tuner, FIXPID_AUTOTUNE_PI,
                                              FIXPID_AUTOTUNE_SAFE));
        return;
    }
    Serial.print(F("kp_q8 "));
    Serial.print(config.gains.kp_q8);
    Serial.print(F(", ki_q24 "));
    Serial.print(config.gains.ki_q24);
    Serial.print(F(", kd_q8 "));
    Serial.println(config.gains.kd_q8);

    (void)fixpid_pid_init(&controller, &config);
    fixpid_autotune_process found;
    if (fixpid_autotune_model(&tuner, &found)) {
        fixpid_pid_seed(&controller, found.holding); // no bump at the change
    }
    // It holds the setpoint, and goes to another one.
    for (int step = 0; step < 500; step++) {
        const int16_t setpoint = (step < 100) ? SETPOINT : HIGHER;
        wait_for_step();
        const int16_t measurement = plant(drive);
        drive = fixpid_pid_step(&controller, setpoint, measurement);
        Serial.print(F("setpoint:"));
        Serial.print(setpoint);
        Serial.print(F(",measurement:"));
        Serial.print(measurement);
        Serial.print(F(",output:"));
        Serial.println(drive);
    }
    Serial.println(F("done"));
}

void loop()
{
}
