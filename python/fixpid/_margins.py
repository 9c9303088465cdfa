# SPDX-License-Identifier: MIT
"""The margins of the sampled loop near its setpoint, as sim/tuner/margins.h computes them of the
scene's plant and the controller's integers."""
import math

from ._library import ffi, lib
from ._scene import RESULT, lock, put

MARGINS = {"gain_margin": "gain", "lower_gain_margin": "lower_gain", "phase_margin": "phase_degrees", "delay_margin": "delay_s"}


def _put(s, results):
    put(s)
    for name in ("KP", "KI", "KD", "FILTER"):
        lib.tuner_results()[RESULT[name]] = results[name]


def margins_of(s, results):
    """ms, gain_margin, lower_gain_margin, phase_margin (degrees), delay_margin (seconds of further dead
    time), stable, and curve, the loop's points. A margin that there is none of is None, and so is the
    ms of an unstable loop."""
    found = ffi.new("struct loop_margins *")
    with lock:
        _put(s, results)
        lib.tuner_margins(found)
    margins = {name: None if value < 0 else value
               for name, value in ((name, getattr(found, of)) for name, of in MARGINS.items())}
    return {"ms": found.ms if found.stable else None, **margins, "stable": found.stable,
            "curve": [complex(*point) for point in zip(found.re, found.im)]}


def ms_of_each(s, results, plants, full):
    """Ms of the same controller with each of these plants, struct identify_plant *, in the order of
    their size; infinite of a loop that is unstable. `full` is the recording's drive at the highest
    output."""
    with lock:
        _put(s, results)
        found = [lib.tuner_ms(plant, full) for plant in plants]
    return sorted(math.inf if ms < 0 else ms for ms in found)


def scale_seconds(s):
    """The time that matters to the controller: dead time and lags."""
    with lock:
        put(s)
        return lib.tuner_scale_s()
