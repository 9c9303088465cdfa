// SPDX-License-Identifier: MIT
// What differs between the compilers of a PIC: SDCC, XC8, and any other, which
// stands in for them where the ports are only checked, not run.
//
// PORT_REGISTER declares a special function register, PORT_BITS one of them by
// its bits: SDCC tests a volatile bit in place only so. XC8 has its own; SDCC
// wants each of them defined once, in support/registers.c, which says
// PORT_REGISTERS_HERE. PORT_BYTE defines a byte that an interrupt reaches
// without choosing a bank: in bank 0 of a PIC16, in the access bank of a PIC18;
// SDCC wants to be told its address. PORT_TICK_INTERRUPT is the head of tick(),
// the one interrupt function, in C, and PORT_UART_INTERRUPT that of what it
// goes on to when it is not a tick's; PORT_CLEAR_WATCHDOG is an instruction.
#ifndef PORT_PIC_COMPILER_H
#define PORT_PIC_COMPILER_H
#include <stdint.h>

#if defined(__SDCC)
#if defined(PORT_REGISTERS_HERE)
#define PORT_REGISTER(address, name) __sfr __at(address) name
#define PORT_BITS(address, type, name) volatile type __at(address) name
#else
#define PORT_REGISTER(address, name) extern __sfr __at(address) name
#define PORT_BITS(address, type, name) extern volatile type __at(address) name
#endif
#define PORT_CLEAR_WATCHDOG() __asm__("clrwdt")
// Without a number: it has no vector, and returns as an interrupt.
#define PORT_UART_INTERRUPT() void port_uart_interrupt(void) __interrupt
#if defined(__SDCC_pic14)
#define PORT_BYTE(address, name) static volatile uint8_t __at(address) name
#define PORT_TICK_INTERRUPT() static void tick(void) __interrupt(0)
#else
// Not static: SDCC 4.2.0 would define it twice.
#define PORT_BYTE(address, name) volatile uint8_t __at(address) name
// 1 is the vector of high priority.
#define PORT_TICK_INTERRUPT() static void tick(void) __interrupt(1)
#endif

#elif defined(__XC8)
#include <xc.h>
// Declares nothing: <xc.h> has the register at the same name.
#define PORT_REGISTER(address, name) struct port_register_of_xc_h
#define PORT_BITS(address, type, name) struct port_register_of_xc_h
#define PORT_CLEAR_WATCHDOG() CLRWDT()
#define PORT_BYTE(address, name) static volatile __near uint8_t name
#if defined(_PIC18)
#define PORT_TICK_INTERRUPT() static void __interrupt(high_priority) tick(void)
#else
#define PORT_TICK_INTERRUPT() static void __interrupt() tick(void)
#endif

#else
#define PORT_REGISTER(address, name) extern volatile uint8_t name
#define PORT_BITS(address, type, name) extern volatile type name
#define PORT_BYTE(address, name) static volatile uint8_t name
#define PORT_CLEAR_WATCHDOG() ((void)0)
#define PORT_TICK_INTERRUPT()                                                  \
    void tick(void);                                                           \
    void tick(void)
#endif

// It is called by the interrupt, elsewhere.
#ifndef PORT_UART_INTERRUPT
#define PORT_UART_INTERRUPT()                                                  \
    void port_uart_interrupt(void);                                            \
    void port_uart_interrupt(void)
#endif

#endif
