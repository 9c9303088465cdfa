// SPDX-License-Identifier: MIT
#ifndef FAKE_AVR_INTERRUPT_H
#define FAKE_AVR_INTERRUPT_H
#include <stdbool.h>

#define ISR(vector) void vector(void)
void TIMER0_COMPA_vect(void);
void USART_UDRE_vect(void);
void USART_RX_vect(void);

extern volatile bool fake_interrupts_on;
#define sei() (fake_interrupts_on = true)

#endif
