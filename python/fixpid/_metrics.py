# SPDX-License-Identifier: MIT
"""What a run is worth: how the first setpoint is reached, what a load does, and what the integers
cost beside double precision."""
import math


def unit_per_count(s):
    return s["SENSOR_RANGE"] / (2**s["SENSOR_BITS"] - 1)


def units_of(s, counts):
    return s["SENSOR_LOW"] + counts * s["SENSOR_RANGE"] / (2**s["SENSOR_BITS"] - 1)


def _pieces(s, n):
    """Steps from one thing that happens to the next: (what, from, to), each of one step or more."""
    begins = [("START", 0), *((event["what"], math.floor(event["at"] * s["RATE"] + 0.5))
                              for event in sorted(s["events"], key=lambda event: event["at"]) if 0 < event["at"] * s["RATE"] < n)]
    return [(what, begin, end) for (what, begin), (_, end) in zip(begins, [*begins[1:], ("", n)]) if end > begin]


def _step_response(s, y, goal):
    """The overshoot as a part of the step; seconds of its rise and until it has settled, or None."""
    span, way = abs(goal - y[0]) or 1, -1 if goal < y[0] else 1
    band = max(0.02 * span, (1 + s["NOISE"]) * unit_per_count(s))
    rise = next((i for i, one in enumerate(y) if way * (one - y[0]) >= 0.9 * span), None)
    settled = max((i + 1 for i, one in enumerate(y) if abs(one - goal) > band), default=0)
    return {"overshoot": max(0, max(way * (one - goal) for one in y)) / span,
            "rise": None if rise is None else rise / s["RATE"],
            "settled": settled / s["RATE"] if settled < len(y) else None}


def limited_steps(run):
    """Of each step, whether its output was limited."""
    return [int(flags & 3 != 0) for flags in run["series"]["FLAGS"]]


def metrics_of(s, run):
    """overshoot (a part of the step), rise and settled (seconds), load (the largest error after
    it), mean_error, iae (the absolute error over all of the run, in units times seconds), moved
    (counts of output a step), limited (a part of the steps), and twin: the difference from double
    precision in counts of the sensor, most and rms."""
    n, series = run["n"], run["series"]
    y, output = series["VALUE_TRUE"], series["OUTPUT"]
    wanted = [units_of(s, one) for one in series["SETPOINT"]]
    errors = [abs(one - goal) for one, goal in zip(y, wanted)]
    pieces = _pieces(s, n)
    differences = [(one - twin) / unit_per_count(s) for one, twin in zip(y, series["VALUE_TWIN"])]
    return {**_step_response(s, y[:pieces[0][2]], wanted[0]),
            "load": next((max(errors[begin:end]) for what, begin, end in pieces if what == "LOAD"), None),
            "mean_error": sum(errors) / n, "iae": sum(errors) / s["RATE"],
            "moved": sum(abs(after - before) for before, after in zip(output, output[1:])) / n,
            "limited": sum(limited_steps(run)) / n,
            "twin": {"most": max(map(abs, differences)), "rms": math.sqrt(sum(one * one for one in differences) / n)}}
