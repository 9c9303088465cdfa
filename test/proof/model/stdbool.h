// SPDX-License-Identifier: MIT
// <stdbool.h> of the machine that is proved for.
#ifndef PROOF_STDBOOL_H
#define PROOF_STDBOOL_H

#define bool _Bool
#define true 1
#define false 0

#endif
