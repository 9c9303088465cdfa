// SPDX-License-Identifier: MIT
// What the sources of fixpid_autotune share: how they reach the experiment, its
// phases and its relays.
#include "fixpid_autotune.h"

#undef SELF
#undef VALID_SELF
#define SELF FIXPID_AUTOTUNE_SELF
#define VALID_SELF FIXPID_AUTOTUNE_VALID_SELF

#ifndef FIXPID_AUTOTUNE_PRIVATE_H
#define FIXPID_AUTOTUNE_PRIVATE_H

// `state` while the experiment runs; each is above every status.
#define PHASE_NOISE 16u
#define PHASE_FIND 17u   // the whole range: where is the setpoint?
#define PHASE_CENTRE 18u // about the output that holds it
#define PHASE_FIRST 19u  // two halves up, one down
#define PHASE_SECOND 20u // one up, two down
#define PHASE_THIRD 21u  // the first again: is the load the same?

#define AT_LOW 0u
#define AT_HIGH 1u

#define FRESH 255u // `averaged`: a relay's first cycle, which never counts

// These functions have the marks of the others.
#define fixpid_autotune_sums_of_phase FIXPID_SUFFIXED(autotune, sums_of_phase)
#define fixpid_autotune_clear FIXPID_SUFFIXED(autotune, clear)
#define fixpid_autotune_level FIXPID_SUFFIXED(autotune, level)
#define fixpid_autotune_span FIXPID_SUFFIXED(autotune, span)
#define fixpid_autotune_legal FIXPID_SUFFIXED(autotune, legal)
#define fixpid_autotune_noise_band FIXPID_SUFFIXED(autotune, noise_band)
#define fixpid_autotune_same_share FIXPID_SUFFIXED(autotune, same_share)
#define fixpid_autotune_drive FIXPID_SUFFIXED(autotune, drive)
#define fixpid_autotune_start_relay FIXPID_SUFFIXED(autotune, start_relay)
#define fixpid_autotune_fit_relay FIXPID_SUFFIXED(autotune, fit_relay)
#define fixpid_autotune_widen_relay FIXPID_SUFFIXED(autotune, widen_relay)
#define fixpid_autotune_finish FIXPID_SUFFIXED(autotune, finish)
#define fixpid_autotune_end_cycle FIXPID_SUFFIXED(autotune, end_cycle)
#define fixpid_autotune_lose_cycle FIXPID_SUFFIXED(autotune, lose_cycle)

bool fixpid_autotune_legal(const struct fixpid_autotune_config *config);

// The sums that the present phase adds to.
FIXPID_DATA struct fixpid_autotune_sums *fixpid_autotune_sums_of_phase(
    FIXPID_DATA struct fixpid_autotune *self);

void fixpid_autotune_clear(FIXPID_DATA struct fixpid_autotune_sums *sums);

// The relay's output on a side in a phase, within the output range.
int16_t fixpid_autotune_level(FIXPID_DATA const struct fixpid_autotune *self,
                              uint8_t phase, uint8_t side);

// The difference of both, 1..65535.
uint16_t fixpid_autotune_span(FIXPID_DATA const struct fixpid_autotune *self,
                              uint8_t phase);

// The hysteresis that the noise asks for, counts each side: 1..1536.
uint16_t fixpid_autotune_noise_band(
    FIXPID_DATA const struct fixpid_autotune *self);

// |on * others - others_on * steps| <= allowed * others: two parts of cycles
// are the same, within `allowed` of the steps of the first one.
// pre: allowed <= 1024, and the other numbers are at most 32767
bool fixpid_autotune_same_share(uint16_t on, uint16_t steps, uint16_t others_on,
                                uint16_t others, uint16_t allowed);

// Outputs what phase and side ask for.
void fixpid_autotune_drive(FIXPID_DATA struct fixpid_autotune *self);

// Starts the relay when the noise is measured. `highest` is the deviation.
void fixpid_autotune_start_relay(FIXPID_DATA struct fixpid_autotune *self);

// Centre, half and hysteresis of the next relay, from the cycle that has just
// ended in PHASE_FIND or PHASE_CENTRE.
void fixpid_autotune_fit_relay(FIXPID_DATA struct fixpid_autotune *self);

// PHASE_CENTRE with twice the relay beyond the present output, on whose side
// the output is that holds the setpoint.
void fixpid_autotune_widen_relay(FIXPID_DATA struct fixpid_autotune *self);

// Ends the experiment.
void fixpid_autotune_finish(FIXPID_DATA struct fixpid_autotune *self,
                            uint8_t status);

// The relay has switched to high: a cycle is a half at high and the half at low
// before that switch, of which `elapsed` is the length.
void fixpid_autotune_end_cycle(FIXPID_DATA struct fixpid_autotune *self,
                               int16_t deviation);

// The relay has not switched for far longer than a cycle, in PHASE_CENTRE or
// later: on with a wider one, unless the range ends at the present output.
void fixpid_autotune_lose_cycle(FIXPID_DATA struct fixpid_autotune *self);

#endif
