// SPDX-License-Identifier: MIT
// What the proofs of both AN964 controllers say of their objects, which have
// the same members. To be included once GAIN_MAX and the types `controller` and
// `controller_gains` are defined.
#ifndef PROOF_AN964_H
#define PROOF_AN964_H

static bool legal_gains(const controller_gains *gains)
{
    return (gains->kp <= GAIN_MAX) && (gains->ki <= GAIN_MAX) &&
           (gains->kd <= GAIN_MAX);
}

static bool same_gains(const controller *a, const controller *b)
{
    return (a->gains.kp == b->gains.kp) && (a->gains.ki == b->gains.ki) &&
           (a->gains.kd == b->gains.kd) && (a->ready == b->ready);
}

static bool same_state(const controller *a, const controller *b)
{
    return (a->sum == b->sum) && (a->error[0] == b->error[0]) &&
           (a->error[1] == b->error[1]) && (a->error[2] == b->error[2]) &&
           (a->integral == b->integral) && (a->derivative == b->derivative) &&
           (a->sum_limited == b->sum_limited) &&
           (a->output_limited == b->output_limited);
}

static bool at_rest(const controller *x)
{
    return ((x->sum | x->error[0] | x->error[1] | x->error[2] | x->integral |
             x->derivative) == 0u) &&
           ((x->sum_limited | x->output_limited) == 0u);
}

#endif
