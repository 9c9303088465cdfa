// SPDX-License-Identifier: MIT
// How far the experiment is. It has its own file because SDCC links whole
// object files.
#include "fixpid_autotune.h"

#include "fixpid_autotune_private.h"

#define PHASE_OVER 22u
#define CYCLES_BEFORE 4u // two each to find the setpoint

void fixpid_autotune_progress(FIXPID_DATA const struct fixpid_autotune *self,
                              struct fixpid_autotune_stage *stage)
{
    uint8_t each;
    uint8_t phase;
    uint8_t done = 0;

    FIXPID_ASSERT(VALID_SELF);
    FIXPID_ASSERT(stage != 0);
    each = (uint8_t)(SELF.config.cycles + 1u);
    phase = SELF.state;
    stage->expected = 0;
    if (SELF.config.cycles != 0u) {
        stage->expected = (uint8_t)(CYCLES_BEFORE + each + each + each);
    }
    stage->period = SELF.last_period;
    if (phase < PHASE_NOISE) {
        phase = PHASE_OVER;
        done = stage->expected;
    } else {
        if (SELF.averaged != FRESH) {
            done = (uint8_t)(SELF.averaged + 1u);
        }
        if (phase >= PHASE_CENTRE) {
            done = (uint8_t)(done + 2u);
        }
        if (phase >= PHASE_FIRST) {
            done = (uint8_t)(done + 2u);
        }
        if (phase >= PHASE_SECOND) {
            done = (uint8_t)(done + each);
        }
        if (phase >= PHASE_THIRD) {
            done = (uint8_t)(done + each);
        }
    }
    stage->phase = (uint8_t)(phase - PHASE_NOISE);
    stage->done = done;
}
