// SPDX-License-Identifier: MIT
// What test/use/port_check/run wants to know of a chip, to run a port on a PC:
// how its hardware moves on, what is on the pins, and how to give it an
// interrupt. You write these functions for your chip, in fake/chip.c beside
// your port.c; filled/fake/ is an example with every one of them.
//
// Its registers are variables. The names that port.c uses are macros in
// headers that stand in fake/ for those of the compiler:
//   #define PWM_DUTY (*fake_word(&fake_pwm_duty))
// With each use of a register the time goes on, so that a loop that waits for a
// flag ends, and so that the check sees the pins between any two uses.
//
// A variable does not tell that it was written with what it was. Where that
// matters, as for a flag that a written 1 clears, keep a bit set in it that the
// chip has not: atmega328p/chip.c does.
#ifndef FAKE_H
#define FAKE_H
#include <stdbool.h>
#include <stdint.h>

// --- yours, in fake/chip.c, which uses the variables without the macros ---

// All registers as they are after a power-on. A PWM that is not running yet may
// hold any duty.
void chip_reset(void);

// Time goes on a little: PWM periods and conversions end after some calls. A
// duty takes effect where the chip has it so, at the end of a period if that is
// how it works. Reads the input chip_inputs[channel] where a conversion
// samples.
void chip_moves(void);

// PWM periods that have ended since the reset.
unsigned chip_periods(void);

// What is on the bridge: the duty in counts of PORT_DRIVE_FULL, whatever the
// direction; the direction, true for reverse; and whether its pins are outputs.
int32_t chip_duty(void);
bool chip_reverse(void);
bool chip_is_output(void);

// The timer's period is over: sets its flag and, if the port has enabled it,
// calls the port's interrupt function. False if the timer does not run.
bool chip_tick(void);

// Times that the watchdog was restarted since the reset.
unsigned chip_feeds(void);

// Conversions started since the reset.
unsigned chip_conversions(void);

// The greatest code of the converter, and the channel that port_read(n) of the
// board converts.
extern const uint32_t chip_code_most;
unsigned chip_input_of(uint8_t channel);

// --- the same, of a UART: only where there is a port_uart.c ---

// The UART can take a byte: calls the port's interrupt function if the port has
// enabled that interrupt, or, `late`, as if it had been disabled too late.
// Returns the byte that was written, or -1.
int chip_uart_sends(bool late);

// A byte has come: calls the port's interrupt function if that is enabled.
void chip_uart_receives(uint8_t byte);

// Bits a second, as the port has set it.
uint32_t chip_uart_baud(void);

// --- the check's, for those ---

#define FAKE_INPUTS 32u
extern uint32_t chip_inputs[FAKE_INPUTS]; // codes, 0..chip_code_most

// The register, after the time has gone on.
volatile uint8_t *fake_byte(volatile uint8_t *its);
volatile uint16_t *fake_word(volatile uint16_t *its);

#endif
