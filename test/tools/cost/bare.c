// SPDX-License-Identifier: MIT
// The least application with a controller, for its size: -DBARE_AN937 and so
// on. Without one of these it is the application without a controller.
#include <stdint.h>

#include "compiler.h"
#include "configuration.h"

volatile int16_t bare_input;
volatile int16_t bare_output;

#if defined(BARE_AN937)
#include "fixpid_an937.h"

FIXPID_DATA struct fixpid_an937 FIXPID_AN937_PLACE an937_controller;

void main(void)
{
    static const struct fixpid_an937_config config = {96, 80, 16, 4000, 4};

    (void)fixpid_an937_init(&an937_controller, &config);
    for (;;) {
        fixpid_an937_tick(&an937_controller);
        bare_output = (int16_t)fixpid_an937_step(&an937_controller, bare_input);
    }
}
#elif defined(BARE_AN964)
#include "fixpid_an964.h"

FIXPID_DATA struct fixpid_an964 an964_controller;

void main(void)
{
    static const struct fixpid_an964_gains gains = {500, 300, 200};

    (void)fixpid_an964_init(&an964_controller, &gains);
    for (;;) {
        bare_output = fixpid_an964_step(&an964_controller, bare_input);
    }
}
#elif defined(BARE_AN964_8BIT)
#include "fixpid_an964_8bit.h"

FIXPID_DATA struct fixpid_an964_8bit an964_8bit_controller;

void main(void)
{
    static const struct fixpid_an964_8bit_gains gains = {50, 30, 20};

    (void)fixpid_an964_8bit_init(&an964_8bit_controller, &gains);
    for (;;) {
        bare_output =
            fixpid_an964_8bit_step(&an964_8bit_controller, (int8_t)bare_input);
    }
}
#elif defined(BARE_PID)
#include "fixpid_pid.h"

FIXPID_DATA struct fixpid_pid FIXPID_PID_PLACE pid_controller;

void main(void)
{
    static const struct fixpid_pid_config config = {
        FIXPID_PID_GAINS(2, 0.5, 2, 10, 0), 0, 1023, 0, 1023, 256, 0};

    (void)fixpid_pid_init(&pid_controller, &config);
    for (;;) {
        bare_output = fixpid_pid_step(&pid_controller, 512, bare_input);
    }
}
#else
void main(void)
{
    for (;;) {
        bare_output = bare_input;
    }
}
#endif
