// SPDX-License-Identifier: MIT
// A board for the test of the live card, as WebAssembly: the loop of
// docs/link.md with a plant of its own, a gain of 4, a lag of 64 steps and a
// dead time of 8. The test gives it what the page sent and takes what it sends.
#include "fixpid_link.h"
#include "fixpid_pid.h"

#define BYTES 1048576
#define DEAD 8

static struct fixpid_pid pid;
static struct fixpid_pid_config config;
static struct fixpid_link wire;
static const struct fixpid_link_board board = {.period_us = 10000,
                                               .manual_steps = 300,
                                               .setpoint_min = 0,
                                               .setpoint_max = 900,
                                               .output_min = 0,
                                               .output_max = 255,
                                               .name = "oven"};
static uint8_t in[BYTES];
static uint8_t out[BYTES];
static int32_t state; // 1/65536 of a count
static int16_t late[DEAD];
static uint32_t noise;
static uint16_t own_kp; // what the program makes of any record; 0: nothing
static int16_t lie;     // by which it says more than its controller gave

uint8_t *board_in(void)
{
    return in;
}

uint8_t *board_out(void)
{
    return out;
}

// From power-on; the program allows this.
void board_begin(int allowed)
{
    config = (struct fixpid_pid_config){.gains = {256, 246000, 512, 3},
                                        .output_max = 255};
    (void)fixpid_pid_init(&pid, &config);
    fixpid_link_init(&wire, 300);
    fixpid_link_allow(&wire, (uint8_t)allowed);
    state = INT32_C(20) << 16;
    noise = 1;
    lie = 0;
    for (int i = 0; i < DEAD; i++) {
        late[i] = 0;
    }
}

static int16_t measure(int16_t output)
{
    const int16_t arrived = late[0];

    for (int i = 1; i < DEAD; i++) {
        late[i - 1] = late[i];
    }
    late[DEAD - 1] = output;
    state += (((4 * arrived + 20) << 16) - state) / 64;
    noise = noise * 1664525u + 1013904223u;
    return (int16_t)((state >> 16) + (int16_t)(noise >> 30) - 1);
}

static int send(int at, uint8_t bytes)
{
    for (int i = 0; i < bytes; i++) {
        out[at + i] = wire.frame[i];
    }
    return at + bytes;
}

// Steps with what came before the first of them; returns the bytes that are
// sent.
int board_run(int received, int steps)
{
    int from = 0;
    int sent = 0;
    static int16_t output;

    for (int i = 0; i < steps; i++) {
        int16_t setpoint;
        int16_t measurement;

        while (from < received && !fixpid_link_receive(&wire, in[from])) {
            from++;
        }
        from += (from < received) ? 1 : 0;
        sent = send(sent, fixpid_link_answer(&wire, &board, &pid, &config));
        config.gains.kp_q8 = (own_kp != 0) ? own_kp : config.gains.kp_q8;
        setpoint = fixpid_link_setpoint(&wire);
        measurement = measure(output);
        output = fixpid_pid_step(&pid, setpoint, measurement);
        output = (int16_t)(output + lie);
        sent = send(
            sent, fixpid_link_step(&wire, &pid, setpoint, measurement, output));
    }
    return sent;
}

void board_meddle(int kp)
{
    own_kp = (uint16_t)kp;
}

void board_lie(int counts)
{
    lie = (int16_t)counts;
}

// The program changes its own gains, and says so.
void board_retune(int kp)
{
    config.gains.kp_q8 = (uint16_t)kp;
    (void)fixpid_pid_set_gains(&pid, &config.gains);
    fixpid_link_changed(&wire);
}

// The kp that the board runs with, and its setpoint.
int board_kp(void)
{
    return config.gains.kp_q8;
}

int board_setpoint(void)
{
    return fixpid_link_setpoint(&wire);
}
