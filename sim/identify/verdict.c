// SPDX-License-Identifier: MIT
#include "verdict.h"

static const char *const SENTENCES[IDENTIFY_REASONS] = {
    [IDENTIFY_USABLE] = "",
    [IDENTIFY_FEW_LINES] = "Fewer than 8 lines: record more often.",
    [IDENTIFY_TIME] = "The time goes back or stands still: take a part of the "
                      "recording in which it rises.",
    [IDENTIFY_DRIVE_STANDS] =
        "The output never changes: was it off before the first line?",
    [IDENTIFY_NO_RESPONSE] =
        "The measurement does not follow the output: make a larger step. Is it "
        "the sensor of this plant?",
    [IDENTIFY_NO_MODEL] = "No model fits: was there a load, an open door or "
                          "another heater?",
    [IDENTIFY_SLOW_LINES] =
        "The answer is over between two lines: record faster.",
    [IDENTIFY_UNSURE_GAIN] =
        "The recording does not tell the gain: make a larger step.",
    [IDENTIFY_UNSURE_LAG] = "The recording does not tell the lag: record for "
                            "longer, or make a smaller step.",
    [IDENTIFY_UNSURE_DEAD] =
        "The recording does not tell the dead time: record faster.",
    [IDENTIFY_UNSURE_START] =
        "The measurement moved before the output did: wait until it stands "
        "still and then make the step, or record a second step.",
};

const char *verdict_sentence(int reason)
{
    return ((reason >= 0) && (reason < IDENTIFY_REASONS)) ? SENTENCES[reason]
                                                          : "";
}

// Sorts ms, which are few.
static void verdict_of(double ms[IDENTIFY_PLANTS], struct verdict *to)
{
    to->above = 0;
    for (int i = 0; i < IDENTIFY_PLANTS; i++) {
        const double one = ms[i];
        int at = i;
        for (; (at > 0) && (ms[at - 1] > one); at--) {
            ms[at] = ms[at - 1];
        }
        ms[at] = one;
        to->above += (one > VERDICT_MOST_MS) ? 1 : 0;
    }
    to->low = ms[0];
    to->high = ms[(9 * IDENTIFY_PLANTS) / 10];
}

double verdict_of_simc(const struct identify_plant *model, double calm,
                       const struct identify_plant plants[IDENTIFY_PLANTS],
                       struct verdict *to)
{
    const double step = (model->lag + model->lag2 + model->dead) / 40.0;
    double gains[3];
    double ms[IDENTIFY_PLANTS];
    identify_simc(model, step, calm, gains);
    for (int i = 0; i < IDENTIFY_PLANTS; i++) {
        ms[i] = identify_ms(&plants[i], step, gains);
    }
    verdict_of(ms, to);
    return identify_ms(model, step, gains);
}

void verdict_of_loop(const struct identify_plant plants[IDENTIFY_PLANTS],
                     double unit_per_count, double drive_per_count,
                     const struct loop_controller *controller, double step_s,
                     struct verdict *to)
{
    static struct loop_margins margins; // its curve is too large for a stack
    double ms[IDENTIFY_PLANTS];
    for (int i = 0; i < IDENTIFY_PLANTS; i++) {
        struct loop_plant plant;
        loop_plant_of(&plant, &plants[i], unit_per_count, drive_per_count);
        loop_margins(&plant, controller, step_s, &margins);
        ms[i] = margins.stable ? margins.ms : VERDICT_UNSTABLE;
    }
    verdict_of(ms, to);
}
