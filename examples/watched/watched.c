// SPDX-License-Identifier: MIT
// A motor's speed by fixpid_pid, each step of which goes out over the UART:
// docs/link.md says what a program at the other end makes of it. Nothing that
// comes in can change the controller.
#include "fixpid_link.h"
#include "fixpid_pid.h"
#include "port.h"
#include "port_uart.h"

#define CONTROL_PERIOD_TICKS 2u
#define STEPS_PER_SECOND 500u
#define MICROSECONDS 1000000u

#if (CONTROL_PERIOD_TICKS * STEPS_PER_SECOND) != PORT_TICKS_PER_SECOND
#error "STEPS_PER_SECOND is not that of the loop"
#endif

static const struct fixpid_pid_config config = {
    .gains = FIXPID_PID_GAINS(1.5, 12.0, 0, STEPS_PER_SECOND, 0),
    .output_min = -PORT_DRIVE_FULL,
    .output_max = PORT_DRIVE_FULL};

// Deviation 8.4: the application's one controller, found by its name.
FIXPID_DATA struct fixpid_pid motor;
// Deviation 8.4: its link, likewise.
FIXPID_DATA struct fixpid_link wire;

// All of a frame or nothing of it: the loop never waits for the UART.
static void transmit(uint8_t bytes)
{
    if (bytes > port_uart_room()) {
        fixpid_link_lost(&wire);
        return;
    }
    for (uint8_t at = 0; at < bytes; at++) {
        port_uart_put(wire.frame[at]);
    }
}

// The set point is a potentiometer: its range is the converter's.
static void serve(void)
{
    static const struct fixpid_link_board board = {
        .period_us = MICROSECONDS / STEPS_PER_SECOND,
        .setpoint_max = 1023,
        .output_min = -PORT_DRIVE_FULL,
        .output_max = PORT_DRIVE_FULL,
        .name = {'m', 'o', 't', 'o', 'r', 0, 0, 0, 0, 0}};

    while (port_uart_waiting() != 0u) {
        (void)fixpid_link_receive(&wire, port_uart_get());
    }
    if (port_uart_room() >= FIXPID_LINK_FRAME) {
        transmit(fixpid_link_answer_stream(&wire, &board, &config));
    }
}

static void control(void)
{
    const int16_t setpoint = (int16_t)port_read(PORT_SETPOINT);
    const int16_t measurement = (int16_t)port_read(PORT_TACHOMETER);
    const int16_t output = fixpid_pid_step(&motor, setpoint, measurement);

    port_drive(output);
    transmit(fixpid_link_step(&wire, &motor, setpoint, measurement, output));
}

int main(void)
{
    port_init();
    port_uart_init();
    (void)fixpid_pid_init(&motor, &config);
    fixpid_link_init(&wire, 0);
    while (port_running()) {
        (void)port_wait_ticks(CONTROL_PERIOD_TICKS);
        control();
        serve();
    }
    return 0;
}
