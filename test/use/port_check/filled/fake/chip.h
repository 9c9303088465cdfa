// SPDX-License-Identifier: MIT
// The registers of an imaginary chip, by the names that its compiler's header
// would have. There they are at addresses, here they are variables.
#ifndef FAKE_CHIP_H
#define FAKE_CHIP_H
#include "fake.h"

extern volatile uint8_t fake_timer_control;
extern volatile uint8_t fake_timer_flag;
extern volatile uint8_t fake_interrupts;
extern volatile uint8_t fake_pwm_control;
extern volatile uint8_t fake_pwm_flag;
extern volatile uint8_t fake_outputs;
extern volatile uint8_t fake_levels;
extern volatile uint8_t fake_adc_control;
extern volatile uint8_t fake_adc_channel;
extern volatile uint8_t fake_watchdog;
extern volatile uint8_t fake_uart_flags;
extern volatile uint8_t fake_uart_interrupts;
extern volatile uint16_t fake_uart_byte;
extern volatile uint16_t fake_uart_clocks;
extern volatile uint16_t fake_timer_top;
extern volatile uint16_t fake_pwm_top;
extern volatile uint16_t fake_pwm_duty;
extern volatile uint16_t fake_adc_result;

#define TIMER_CONTROL (*fake_byte(&fake_timer_control)) // 1: it runs
#define TIMER_FLAG (*fake_byte(&fake_timer_flag))       // 1: a period is over
#define TIMER_TOP (*fake_word(&fake_timer_top))         // cycles of it, less 1
#define INTERRUPTS (*fake_byte(&fake_interrupts))       // 1: the timer's
#define PWM_CONTROL (*fake_byte(&fake_pwm_control))     // 1: it runs
#define PWM_FLAG (*fake_byte(&fake_pwm_flag))           // 1: a period is over
#define PWM_TOP (*fake_word(&fake_pwm_top))             // counts of it, less 1
#define PWM_DUTY (*fake_word(&fake_pwm_duty)) // taken at the end of a period
#define OUTPUTS (*fake_byte(&fake_outputs))   // 1: the pin drives
#define LEVELS (*fake_byte(&fake_levels))     // of the pins that drive
#define ADC_CONTROL (*fake_byte(&fake_adc_control)) // bit 0: on, bit 1: busy
#define ADC_CHANNEL (*fake_byte(&fake_adc_channel))
#define ADC_RESULT (*fake_word(&fake_adc_result)) // 12 bits
#define WATCHDOG (*fake_byte(&fake_watchdog))     // 0x5A restarts it

#define UART_FLAGS (*fake_byte(&fake_uart_flags)) // as below
#define UART_INTERRUPTS (*fake_byte(&fake_uart_interrupts))
#define UART_BYTE (*fake_word(&fake_uart_byte))     // written, or that came
#define UART_CLOCKS (*fake_word(&fake_uart_clocks)) // of a bit
#define UART_EMPTY 0x01u                            // it can take a byte
#define UART_CAME 0x02u

// The port's interrupt function of the UART.
void uart_vector(void);

// The port's interrupt function. A chip's compiler has a word for it.
void timer_vector(void);

#endif
