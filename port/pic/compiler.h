// SPDX-License-Identifier: MIT
// What differs between the compilers of a PIC: SDCC, XC8, and any other, which
// stands in for them where the ports are only checked, not run.
//
// PORT_REGISTER declares a special function register. XC8 has its own; SDCC
// wants each of them defined once, in support/registers.c, which says
// PORT_REGISTERS_HERE. PORT_TICK_INTERRUPT is the head of tick(), the one
// interrupt function; PORT_CLEAR_WATCHDOG and PORT_NOP are instructions.
#ifndef PORT_PIC_COMPILER_H
#define PORT_PIC_COMPILER_H
#include <stdint.h>

#if defined(__SDCC)
#if defined(PORT_REGISTERS_HERE)
#define PORT_REGISTER(address, name) __sfr __at(address) name
#else
#define PORT_REGISTER(address, name) extern __sfr __at(address) name
#endif
#define PORT_CLEAR_WATCHDOG() __asm__("clrwdt")
#define PORT_NOP() __asm__("nop")
#if defined(__SDCC_pic14)
#define PORT_TICK_INTERRUPT() static void tick(void) __interrupt(0)
#else
// 1 is the vector of high priority.
#define PORT_TICK_INTERRUPT() static void tick(void) __interrupt(1)
#endif

#elif defined(__XC8)
#include <xc.h>
// Declares nothing: <xc.h> has the register at the same name.
#define PORT_REGISTER(address, name) struct port_register_of_xc_h
#define PORT_CLEAR_WATCHDOG() CLRWDT()
#define PORT_NOP() NOP()
#if defined(_PIC18)
#define PORT_TICK_INTERRUPT() static void __interrupt(high_priority) tick(void)
#else
#define PORT_TICK_INTERRUPT() static void __interrupt() tick(void)
#endif

#else
#define PORT_REGISTER(address, name) extern volatile uint8_t name
#define PORT_CLEAR_WATCHDOG() ((void)0)
#define PORT_NOP() ((void)0)
#define PORT_TICK_INTERRUPT()                                                  \
    void tick(void);                                                           \
    void tick(void)
#endif

#endif
