/* SPDX-License-Identifier: MIT */
/* A program in C90 with a controller: the first output is P, 2 times 10. */
#include "heater.h"

int main(void)
{
    return (heater_init() && heater_step(600, 590) == 20) ? 0 : 1;
}
