# SPDX-License-Identifier: MIT
"""What a run is worth: web/metrics.js in Python. How the first setpoint is reached, what a load
does, and what the integers cost beside double precision."""
import math

from ._scene import CONTROLLER, PLANT


def unit_per_count(s):
    return s["SENSOR_RANGE"] / (2**s["SENSOR_BITS"] - 1)


def units_of(s, counts):
    return s["SENSOR_LOW"] + counts * s["SENSOR_RANGE"] / (2**s["SENSOR_BITS"] - 1)


def _pieces(s, n):
    """Steps from one thing that happens to the next: (what, from, to)."""
    starts = [("START", 0)] + [(event["what"], math.floor(event["at"] * s["RATE"] + 0.5))
                               for event in sorted(s["events"], key=lambda event: event["at"])
                               if event["at"] * s["RATE"] < n and event["at"] > 0]
    ends = [begin for _, begin in starts[1:]] + [n]
    return [(what, begin, end) for (what, begin), end in zip(starts, ends)]


def _sign(value):
    return (value > 0) - (value < 0)


def _step_response(s, series, begin, end):
    """The overshoot as a part of the step; seconds of its rise and until it has settled, or None."""
    y = series["VALUE_TRUE"]
    start, goal = y[0], units_of(s, series["SETPOINT"][0])
    span, way = abs(goal - start) or 1, _sign(goal - start) or 1
    band = max(0.02 * span, (1 + s["NOISE"]) * unit_per_count(s))
    over, rise, settled = 0, None, None
    for i in range(begin, end):
        over = max(over, way * (y[i] - goal))
        if rise is None and abs(y[i] - start) >= 0.9 * span and way * (y[i] - start) > 0:
            rise = i
        if abs(y[i] - goal) > band:
            settled = None
        elif settled is None:
            settled = i
    return {"overshoot": over / span, "rise": None if rise is None else rise / s["RATE"],
            "settled": None if settled is None else settled / s["RATE"]}


def limited_steps(s, run):
    """Of each step, whether its output was limited."""
    series = run["series"]
    if s["CONTROLLER"] == CONTROLLER["PID"]:
        return [int(flags & 3 != 0) for flags in series["FLAGS"]]
    return [int(output >= s["OUTPUT_MAX"] or output <= s["OUTPUT_MIN"]) for output in series["OUTPUT"]]


def metrics_of(s, run):
    """overshoot (a part of the step), rise and settled (seconds), load (the largest error after
    it), meanError, moved (counts of output a step), limited (a part of the steps), and twin: the
    difference from double precision in counts of the sensor, most and rms."""
    n, series = run["n"], run["series"]
    pieces = _pieces(s, n)
    errors = [abs(y - units_of(s, r)) for y, r in zip(series["VALUE_TRUE"], series["SETPOINT"])]
    load = next((errors[begin:end] for what, begin, end in pieces if what == "LOAD" and end > begin), None)
    moves = sum(abs(after - before) for before, after in zip(series["OUTPUT"], series["OUTPUT"][1:]))
    per_unit = 1 / unit_per_count(s)
    differences = [(y - twin) * per_unit for y, twin in zip(series["VALUE_TRUE"], series["VALUE_TWIN"])]
    found = {
        **_step_response(s, series, *next((begin, end) for _, begin, end in pieces if end > begin)),
        "load": None if load is None else max(load), "meanError": sum(errors) / n, "moved": moves / n,
        "limited": sum(limited_steps(s, run)) / n,
        "twin": {"most": max(map(abs, differences)), "rms": math.sqrt(sum(one * one for one in differences) / n)}}
    if s["PLANT"] == PLANT["PENDULUM"]:
        found["travel"] = max(map(abs, series["VALUE_BASE"]))
    return found
