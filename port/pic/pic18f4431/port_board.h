// SPDX-License-Identifier: MIT
// The board of the motor and the ovens: PIC18F4431 at 40 MHz, wired as the
// PIC18F4520's.
#include "../pic18f4520/port_board.h"
