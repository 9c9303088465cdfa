// SPDX-License-Identifier: MIT
// What the library adds to a program: this one alone (-DBARE_NOTHING), with an
// experiment alone, and with the whole tuner (-DBARE_WHOLE). Its record is the
// one byte array that an application has to keep.
#include "fixpid_autotune.h"

#if defined(_PIC18) || defined(__SDCC_pic16)
#include "compiler.h"
#include "configuration.h"
#endif

volatile int16_t setpoint;
volatile int16_t measurement;
volatile int16_t output;
volatile uint8_t shown;

#ifdef BARE_NOTHING
static void start(void)
{
    shown = 1;
}

static void step(void)
{
    output = (int16_t)(setpoint - measurement);
}
#else
FIXPID_DATA struct fixpid_autotune tuner;

static void start(void)
{
    static const struct fixpid_autotune_config config = {
        0, 1000, 0, 0, 1023, 85, 4000, 2, false};

    shown = fixpid_autotune_init(&tuner, &config) ? 1u : 0u;
}

#ifdef BARE_WHOLE
static void finish(void)
{
    struct fixpid_pid_config found;
    struct fixpid_autotune_process process;

    shown = fixpid_autotune_reason(&tuner, FIXPID_AUTOTUNE_PI,
                                   FIXPID_AUTOTUNE_SAFE);
    if (fixpid_autotune_result(&tuner, FIXPID_AUTOTUNE_PI, FIXPID_AUTOTUNE_SAFE,
                               &found)) {
        output = (int16_t)found.gains.kp_q8;
        measurement = (int16_t)found.gains.ki_q24;
    }
    if (fixpid_autotune_model(&tuner, &process)) {
        output = process.holding;
    }
}
#else
struct fixpid_autotune_record record;

static void finish(void)
{
    (void)fixpid_autotune_pack(&tuner, &record);
    shown = record.bytes[60];
}
#endif

static void step(void)
{
    struct fixpid_autotune_stage stage;

    output = fixpid_autotune_step(&tuner, setpoint, measurement);
    fixpid_autotune_progress(&tuner, &stage);
    shown = stage.done;
    if (fixpid_autotune_status(&tuner) != FIXPID_AUTOTUNE_RUNNING) {
        finish();
    }
}
#endif

#if defined(__SDCC) || defined(__msp430__) || defined(__MSP430__)
void main(void)
#else
int main(void)
#endif
{
    start();
    for (;;) {
        step();
    }
}
