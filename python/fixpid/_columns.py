# SPDX-License-Identifier: MIT
"""The columns of a recording as numbers: web/columns.js in Python. The step of the drive, and
which values are none."""
import math

from ._core import numpy

LEAST_ROWS = 8
POINTS_KEPT = 2000
REACH = 3  # neighbours on each side that an outlier is compared with


def quantile(values, part):
    """The value below which this part of them is."""
    ordered = sorted(values) if numpy is None else numpy.sort(values)
    return float(ordered[math.floor(part * (len(ordered) - 1) + 0.5)])


def median(values):
    return quantile(values, 0.5)


def jump_of(column):
    """The jump of a column that stands still before and after it: {"at", "first" and "next", the
    lines between which it has these two levels, "from", "to"}, or None."""
    moves = [(i, abs(column[i] - column[i - 1])) for i in range(1, len(column)) if column[i] != column[i - 1]]
    at, most = -1, 0
    for i, move in moves:
        if move > most * (1 + 1e-9):
            at, most = i, move
    if at < 0:
        return None
    large = [i for i, move in moves if move > 0.25 * most]
    first = max((i for i in large if i < at), default=0)
    end = min((i for i in large if i > at), default=len(column))
    before, after = median(column[first:at]), median(column[at:end])
    quiet = sum(abs(column[i] - (before if i < at else after)) <= 0.05 * abs(after - before) for i in range(first, end))
    if len(large) > 6 or quiet < 0.97 * (end - first) or end - at < LEAST_ROWS:
        return None
    return {"at": at, "first": first, "next": end, "from": before, "to": after}


def outliers_of(values):
    """The places of values that stand alone, far from the neighbours on both sides, which agree."""
    sizes = [0.0] * len(values)
    for i in range(1, len(values) - 1):
        near = sorted(values[max(0, i - REACH):i + REACH + 1])
        sizes[i] = abs(values[i] - near[len(near) // 2])
    limit = max(8 * 1.4826 * median(sizes), 0.15 * (quantile(values, 0.95) - quantile(values, 0.05)))

    def alone(i):
        before, behind = median(values[max(0, i - REACH):i]), median(values[i + 1:i + 1 + REACH])
        return abs(before - behind) < 0.3 * min(abs(values[i] - before), abs(values[i] - behind))

    far = [i for i, size in enumerate(sizes) if size > limit and alone(i)]
    return [] if len(far) > 0.05 * len(values) else far


def thinned(times, values, most=POINTS_KEPT):
    """Means of neighbours, so that at most `most` points are left."""
    every = -(-len(times) // most)
    if every <= 1:
        return times, values

    def means(column):
        return [sum(part) / len(part) for part in (column[i:i + every] for i in range(0, len(column), every))]

    return means(times), means(values)
