// SPDX-License-Identifier: MIT
// What a step costs on a core in QEMU, in instructions.
//
// Build with the driver of a controller and
//
//   -DCONTROLLER="an964" -DREPLY=an964_reply -DEXCHANGE=an964_exchange
//   -DSTEP="fixpid_an964_step" -Wl,--wrap=fixpid_an964_step
//
// so that the driver's call of the step comes here.
#include <stdio.h>
#include <string.h>

#include "metered.h"
#include "search.h"

METERED("__wrap_" STEP, "__real_" STEP);

static uint32_t step(const union question *question, union answer *answer)
{
    const struct controller *const controller = controller_named(CONTROLLER);

    metered_ticks = UINT32_MAX;
    memcpy(&EXCHANGE, question, controller->question_size);
    REPLY();
    memcpy(answer, &EXCHANGE, controller->answer_size);
    return metered_ticks == UINT32_MAX ? 0u : instructions();
}

int main(void)
{
    const struct search_plan plan = {controller_named(CONTROLLER),
                                     step,
                                     ROW,
                                     RANDOM_STEPS,
                                     DIRECTED_STEPS,
                                     RUNS,
                                     SEED,
                                     OUTPUTS_ONLY,
                                     QUESTIONS};

    calibrate();
    return search_run(&plan) == 0u ? 0 : 1;
}
