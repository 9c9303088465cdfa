// SPDX-License-Identifier: MIT
// Stands in for XC8's <xc.h>, for a check of syntax, types and names only: what
// the ports and most programs use of it besides registers, in its spelling. The
// chip's registers and bits are those of gputils' header, by device.rb.
#ifndef XC_H
#define XC_H

#define __interrupt(...) __attribute__((used))
#define CLRWDT() ((void)0)
#define NOP() ((void)0)
#define SLEEP() ((void)0)
#define RESET() ((void)0)
#define ei() ((void)0)
#define di() ((void)0)
#define __delay_us(time) ((void)((time) * (_XTAL_FREQ / 4000000.0)))
#define __delay_ms(time) ((void)((time) * (_XTAL_FREQ / 4000.0)))
#define __near
#define __bit _Bool
#define __at(address)

#include "xc_device.h"

#endif
