// SPDX-License-Identifier: MIT
// Which field fixpid_tpo_init refuses, in a file of its own because SDCC links
// whole object files.
#include "fixpid_tpo.h"

#define WINDOW_MAX 32767u

enum fixpid_tpo_problem fixpid_tpo_check(const struct fixpid_tpo_config *config)
{
    FIXPID_ASSERT(config != 0);
    if (config->full < 1) {
        return FIXPID_TPO_BAD_FULL;
    }
    if (config->window < 1u) {
        return FIXPID_TPO_BAD_WINDOW;
    }
    if (config->window > WINDOW_MAX) {
        return FIXPID_TPO_BAD_WINDOW;
    }
    if (config->minimum_on > config->window) {
        return FIXPID_TPO_BAD_MINIMUM_ON;
    }
    if (config->minimum_off > (uint16_t)(config->window - config->minimum_on)) {
        return FIXPID_TPO_BAD_MINIMUM_OFF;
    }
    return FIXPID_TPO_OK;
}
