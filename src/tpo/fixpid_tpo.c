// SPDX-License-Identifier: MIT
#include "fixpid_tpo.h"

#include "../common/fixpid_bits.h"

#undef SELF
#undef VALID_SELF
#define SELF (*self)
#define VALID_SELF (self != 0)

#define WINDOW_MAX 32767u

static bool window_legal(const struct fixpid_tpo_config *config)
{
    if (config->full < 1) {
        return false;
    }
    if (config->window < 1u) {
        return false;
    }
    if (config->window > WINDOW_MAX) {
        return false;
    }
    if (config->minimum_on > config->window) {
        return false;
    }
    return config->minimum_off <=
           (uint16_t)(config->window - config->minimum_on);
}

bool fixpid_tpo_init(FIXPID_DATA struct fixpid_tpo *self,
                     const struct fixpid_tpo_config *config)
{
    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(config != 0);
    SELF.pulse_least = 0;
    SELF.whole_least = 0;
    SELF.full = 0;
    SELF.window = 0;
    fixpid_tpo_reset(self);
    if (!window_legal(config)) {
        return false;
    }
    SELF.full = config->full;
    SELF.window = config->window;
    // 32767 * 32767 and 32768 * 32767 at most. A minimum of 0 does the same as
    // 1: below a whole step no pulse comes, nor any gap.
    SELF.pulse_least = (int32_t)config->minimum_on * config->full;
    SELF.whole_least =
        ((int32_t)config->window + 1 - (int32_t)config->minimum_off) *
        config->full;
    return true;
}

void fixpid_tpo_reset(FIXPID_DATA struct fixpid_tpo *self)
{
    FIXPID_ASSERT(VALID_SELF);
    SELF.credit = 0;
    SELF.left = 0;
    SELF.on = 0;
    SELF.whole = 0;
}

static int16_t limited(int16_t duty, int16_t full)
{
    if (duty < 0) {
        return 0;
    }
    if (duty > full) {
        return full;
    }
    return duty;
}

// The pulse of this window: the credit in whole steps, or nothing, or all of
// it.
static void open_window(FIXPID_DATA struct fixpid_tpo *self, int16_t duty)
{
    // Less than pulse_least is carried over, so that with the window's
    // 32767 * 32767 the credit stays below 2 * 32767^2 = 2147352578. It is not
    // below -32766 * 32767, the debt of a window whose gap was left out.
    SELF.credit = fixpid_add32(SELF.credit, (int32_t)limited(duty, SELF.full) *
                                                (int32_t)SELF.window);
    SELF.left = SELF.window;
    SELF.on = 0;
    SELF.whole = 0;
    if (SELF.credit >= SELF.pulse_least) {
        SELF.on = 1;
    }
    if (SELF.credit >= SELF.whole_least) { // not below pulse_least
        SELF.whole = 1;
    }
}

bool fixpid_tpo_step(FIXPID_DATA struct fixpid_tpo *self, int16_t duty)
{
    FIXPID_ASSERT(VALID_SELF);
    if (SELF.full == 0) {
        return false;
    }
    if (SELF.left == 0u) {
        open_window(self, duty);
    }
    SELF.left--;
    if (SELF.on == 0u) {
        return false;
    }
    if (SELF.whole == 0u) {
        if (SELF.credit < SELF.full) { // the rest of this window is a gap
            return false;
        }
    }
    SELF.credit = fixpid_sub32(SELF.credit, SELF.full);
    return true;
}
