// SPDX-License-Identifier: MIT
// What a person is told of a recording. Page and Python say the same, because
// both take it here.
#ifndef VERDICT_H
#define VERDICT_H

// What is wrong with a recording that is refused for this reason (of enum
// identify_reason), and what to do about it; "" for IDENTIFY_USABLE.
const char *verdict_sentence(int reason);

#endif
