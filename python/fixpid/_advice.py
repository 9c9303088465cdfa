# SPDX-License-Identifier: MIT
"""What a person should know of these settings: what the controller refuses,
and where a gain is coarse, the loop has little margin or the sensor ends."""
from ._fit import MOST_MS
from ._format import digits, percent
from ._library import lib
from ._margins import scale_seconds
from ._scene import REVERSE

COARSE = 50  # below it a step of the integer is more than 2 %
KI_LEAST = 8  # of 2^24


def _refusals(s, r):
    """Of gains that a rule has found; those of a Pid are legal."""
    return [text for wrong, text in (
        (r["KP"] > lib.FIXPID_PID_KP_MAX, "kp is above 127.996: scale the sensor or the actuator."),
        (s["KP"] > 0 and r["KP"] == 0, "kp rounds to 0: the smallest is 0.00195."),
        (r["KI"] > lib.FIXPID_PID_KI_MAX, "ki is above 127.996 per step."),
        (s["KI"] > 0 and r["KI"] < KI_LEAST,
         "ki is below 8 / 2²⁴ per step: sample more slowly, or give the actuator more counts."),
        (r["KD"] > lib.FIXPID_PID_KD_MAX, "kd times the rate is above 125.996: raise the derivative filter."),
        (s["KD"] > 0 and r["KD"] == 0, "kd rounds to 0 at this rate and filter.")) if wrong] or ["A value is out of range."]


def _coarse(name, integer, least):
    if integer == 0 or integer >= COARSE:
        return []
    return [f"{name} is {integer:.0f} steps of {least}: the next value is {percent(1 / integer, 0)} away."]


def _gains(r):
    return [text for name, least in (("kp", "1/256"), ("ki", "1/2²⁴"), ("kd", "1/256"))
            for text in _coarse(name, r[name.upper()], least)]


def _loop(margins):
    if not margins["stable"]:
        return ["The loop is unstable near its setpoint: what is seen is held by the limits."]
    if margins["ms"] > MOST_MS:
        return [f"Little margin: Ms {digits(margins['ms'])} is above {MOST_MS}; small changes of the plant make it swing."]
    return []


def _scene(s, series):
    last, top = series["MEASUREMENT"][-1], 2**s["SENSOR_BITS"] - 1
    return [text for wrong, text in (
        ((s["GAIN"] < 0) != bool(int(s["OPTIONS"]) & REVERSE),
         "More output moves this plant away from its setpoint: change “reverse acting” or the sign of its gain."),
        (scale_seconds(s) * s["RATE"] < 8, "The plant is only a few steps long: sample faster."),
        (last >= top or (last <= 0 and series["SETPOINT"][-1] > 0),
         "The measurement ends at the end of the sensor.")) if wrong]


def advice_of(s, run, margins):
    """{"refused": sentences, "warnings": sentences}."""
    if run["n"] < 0:
        return {"refused": _refusals(s, run["results"]), "warnings": []}
    return {"refused": [], "warnings": [*_gains(run["results"]), *_loop(margins), *_scene(s, run["series"])]}
