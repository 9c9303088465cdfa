// SPDX-License-Identifier: MIT
// Stands in for XC8's <xc.h>, for a check of syntax, types and names only: what
// the ports use of it besides registers, in its spelling. The chip's registers
// and bits are those of gputils' header, by device.rb.
#ifndef XC_H
#define XC_H

#define __interrupt(...) __attribute__((used))
#define CLRWDT() ((void)0)
#define __near

#include "xc_device.h"

#endif
