// SPDX-License-Identifier: MIT
// What driver_main.c takes from the PIC's header of this name.
#ifndef COMPILER_H
#define COMPILER_H

#define PORT_CLEAR_WATCHDOG()

#endif
