// SPDX-License-Identifier: MIT
// A machine as the subject of an experiment.
#ifndef MACHINE_SUBJECT_H
#define MACHINE_SUBJECT_H
#include "families.h"

// Draws it, with a rate at which its own oscillation takes 16 steps at least,
// where its kind leaves that open. The subject points to the machine.
struct subject draw_machine_subject(struct machine *machine,
                                    enum machine_kind kind, unsigned long seed,
                                    long number);

#endif
