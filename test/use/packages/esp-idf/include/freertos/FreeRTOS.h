// SPDX-License-Identifier: MIT
// Of FreeRTOS what the example calls; its time does not pass.
#ifndef FREERTOS_H
#define FREERTOS_H

#define pdMS_TO_TICKS(ms) ((ms) / 10u)

#endif
