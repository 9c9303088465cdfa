// SPDX-License-Identifier: MIT
// The hardware of an imaginary chip, as far as a port sees it: see fake.h.
#include "chip.h"

#define PWM_PERIOD 7u // uses of a register
#define CONVERSION 5u // the same
#define REVERSE 0x01u // pins
#define BRIDGE 0x03u
#define ADC_ON 0x01u
#define ADC_BUSY 0x02u
#define RESTART 0x5Au

volatile uint8_t fake_timer_control;
volatile uint8_t fake_timer_flag;
volatile uint8_t fake_interrupts;
volatile uint8_t fake_pwm_control;
volatile uint8_t fake_pwm_flag;
volatile uint8_t fake_outputs;
volatile uint8_t fake_levels;
volatile uint8_t fake_adc_control;
volatile uint8_t fake_adc_channel;
volatile uint8_t fake_watchdog;
volatile uint8_t fake_uart_flags;
volatile uint8_t fake_uart_interrupts;
volatile uint16_t fake_uart_byte;
volatile uint16_t fake_uart_clocks;
volatile uint16_t fake_timer_top;
volatile uint16_t fake_pwm_top;
volatile uint16_t fake_pwm_duty;
volatile uint16_t fake_adc_result;

const uint32_t chip_code_most = 4095;

static uint16_t duty_made;
static unsigned periods;
static unsigned feeds;
static unsigned conversions;

void chip_reset(void)
{
    fake_pwm_duty = 0xFFFFu; // not known after a power-on
    fake_pwm_top = 0xFFFFu;
    fake_timer_top = 0xFFFFu;
    duty_made = 0;
}

static void pwm_moves(void)
{
    static unsigned in_period = 0;

    if (fake_pwm_control == 0u) {
        return;
    }
    in_period++;
    if (in_period == PWM_PERIOD) {
        in_period = 0;
        periods++;
        duty_made = fake_pwm_duty;
        fake_pwm_flag = 1;
    }
}

static void converter_moves(void)
{
    static unsigned converting = 0;
    static uint8_t channel = 0; // as most chips, it takes it as one begins

    if ((fake_adc_control & (ADC_ON | ADC_BUSY)) != (ADC_ON | ADC_BUSY)) {
        return;
    }
    if (converting == 0u) {
        conversions++;
        channel = fake_adc_channel % FAKE_INPUTS;
    }
    converting++;
    if (converting == CONVERSION) {
        converting = 0;
        fake_adc_control = ADC_ON;
        fake_adc_result = (uint16_t)chip_inputs[channel];
    }
}

// It is entered until the port has cleared the flag; twice shows that it has
// not.
static void interrupt_if_due(void)
{
    static bool inside = false;

    for (int i = 0; (i < 2) && !inside; i++) {
        if ((fake_interrupts != 0u) && (fake_timer_flag != 0u)) {
            inside = true;
            timer_vector();
            inside = false;
        }
    }
}

void chip_moves(void)
{
    pwm_moves();
    converter_moves();
    if (fake_watchdog == RESTART) {
        fake_watchdog = 0;
        feeds++;
    }
    interrupt_if_due();
}

unsigned chip_periods(void)
{
    return periods;
}

int32_t chip_duty(void)
{
    return (fake_pwm_control != 0u) ? (int32_t)duty_made : 0;
}

bool chip_reverse(void)
{
    return (fake_levels & REVERSE) != 0u;
}

bool chip_is_output(void)
{
    return (fake_outputs & BRIDGE) == BRIDGE;
}

bool chip_tick(void)
{
    if (fake_timer_control == 0u) {
        return false;
    }
    fake_timer_flag = 1;
    interrupt_if_due();
    return true;
}

unsigned chip_feeds(void)
{
    return feeds;
}

unsigned chip_conversions(void)
{
    return conversions;
}

unsigned chip_input_of(uint8_t channel)
{
    return channel;
}

// --- the UART ---

#define UNWRITTEN 0x100u
#define CLOCK_HZ 16000000u

static void uart_says(uint8_t flag)
{
    fake_uart_flags |= flag;
    if ((fake_uart_interrupts & flag) != 0u) {
        uart_vector();
    }
    fake_uart_flags &= (uint8_t)~UART_EMPTY;
}

int chip_uart_sends(bool late)
{
    const uint8_t before = fake_uart_interrupts;

    fake_uart_byte = UNWRITTEN;
    fake_uart_interrupts |= late ? UART_EMPTY : 0u;
    uart_says(UART_EMPTY);
    fake_uart_interrupts = late ? before : fake_uart_interrupts;
    return (fake_uart_byte == UNWRITTEN) ? -1 : (int)fake_uart_byte;
}

void chip_uart_receives(uint8_t byte)
{
    fake_uart_byte = byte;
    uart_says(UART_CAME);
}

uint32_t chip_uart_baud(void)
{
    return (fake_uart_clocks == 0u) ? 0u : CLOCK_HZ / fake_uart_clocks;
}
