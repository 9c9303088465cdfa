// SPDX-License-Identifier: MIT
#include "verdict.h"

#include "identify.h"

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
