# SPDX-License-Identifier: MIT
"""What a person should know of these settings: web/advice.js in Python. What the controller
refuses, and where a gain is coarse, the loop has little margin or the sensor ends."""
from ._fit import MOST_MS
from ._format import digits, percent, whole
from ._library import lib
from ._margins import scale_seconds
from ._scene import CONTROLLER, PLANT, PROPORTIONAL_ON_MEASUREMENT, REVERSE

COARSE = 50  # below it a step of the integer is more than 2 %
LIMIT_16 = 32767
KI_LEAST = 8  # of 2^24


def _pid_refusals(s, r):
    return [text for wrong, text in (
        (s["KP"] < 0 or s["KI"] < 0 or s["KD"] < 0, "A gain is below 0: turn the sign with “reverse acting”."),
        (r["KP"] > lib.FIXPID_PID_KP_MAX, "kp is above 127.996: scale the sensor or the actuator."),
        (s["KP"] > 0 and r["KP"] == 0, "kp rounds to 0: the smallest is 0.00195."),
        (r["KI"] > lib.FIXPID_PID_KI_MAX, "ki is above 127.996 per step."),
        (s["KI"] > 0 and r["KI"] < KI_LEAST,
         "ki is below 8 / 2²⁴ per step: sample more slowly, or give the actuator more counts."),
        (r["KD"] > lib.FIXPID_PID_KD_MAX, "kd times the rate is above 125.996: raise the derivative filter."),
        (s["KD"] > 0 and r["KD"] == 0, "kd rounds to 0 at this rate and filter."),
        (not 0 <= s["FILTER"] <= 7, "The derivative filter is 0 to 7."),
        (s["WEIGHT"] * 256 < 0.5 and not int(s["OPTIONS"]) & PROPORTIONAL_ON_MEASUREMENT,
         "A setpoint weight of 0 is the option “P on the measurement”."),
        (s["WEIGHT"] > 1.0019, "The setpoint weight is at most 1."),
        (s["OUTPUT_MIN"] >= s["OUTPUT_MAX"], "The lowest output must be below the highest."),
        (s["INTEGRAL_MIN"] < -LIMIT_16, "The integral’s lowest value is −32767 or more."),
        (s["INTEGRAL_MIN"] > s["INTEGRAL_MAX"], "The integral’s lowest value is above its highest.")) if wrong]


def _refusals(s, r):
    if s["CONTROLLER"] == CONTROLLER["PID"]:
        return _pid_refusals(s, r) or ["A value is out of range."]
    return [f"A value is out of range: gains are 0 to {255 if s['CONTROLLER'] == CONTROLLER['AN937'] else 1023}."]


def _coarse(name, integer, least):
    if integer == 0 or integer >= COARSE:
        return []
    return [f"{name} is {integer:.0f} steps of {least}: the next value is {percent(1 / integer, 0)} away."]


def _gains(s, r):
    if s["CONTROLLER"] == CONTROLLER["PID"]:
        return [text for name, least in (("kp", "1/256"), ("ki", "1/2²⁴"), ("kd", "1/256"))
                for text in _coarse(name, r[name.upper()], least)]
    least = "1/16" if s["CONTROLLER"] == CONTROLLER["AN937"] else "1/1023"
    return [text for name in ("kp", "ki", "kd") if r[name.upper()] < 10
            for text in _coarse(name, r[name.upper()], least)]


def _loop(margins):
    if not margins["stable"]:
        return ["The loop is unstable near its setpoint: what is seen is held by the limits."]
    if margins["ms"] > MOST_MS:
        return [f"Little margin: Ms {digits(margins['ms'])} is above {MOST_MS}; small changes of the plant make it swing."]
    return []


def _scene(s, series):
    goals = [s["SETPOINT"], *(event["a"] for event in s["events"] if event["what"] == "SETPOINT")]
    low, high = s["SENSOR_LOW"], s["SENSOR_LOW"] + s["SENSOR_RANGE"]
    last, top = series["MEASUREMENT"][-1], 2**s["SENSOR_BITS"] - 1
    return [text for wrong, text in (
        (s["PLANT"] != PLANT["PENDULUM"] and (s["GAIN"] < 0) != bool(int(s["OPTIONS"]) & REVERSE),
         "More output moves this plant away from its setpoint: change “reverse acting” or the sign of its gain."),
        (s["PLANT"] != PLANT["PENDULUM"] and any(not low <= goal <= high for goal in goals),
         "A setpoint lies beyond the sensor’s range and is taken as its end."),
        (s["DURATION"] * s["RATE"] > lib.TUNER_STEPS, f"Shown are the first {whole(lib.TUNER_STEPS)} steps."),
        (s["PLANT"] < PLANT["MOTOR"] and scale_seconds(s) * s["RATE"] < 8,
         "The plant is only a few steps long: sample faster."),
        (last >= top or (last <= 0 and series["SETPOINT"][-1] > 0),
         "The measurement ends at the end of the sensor.")) if wrong]


def advice_of(s, run, margins):
    """{"refused": sentences, "warnings": sentences}."""
    if run["n"] < 0:
        return {"refused": _refusals(s, run["results"]), "warnings": []}
    return {"refused": [], "warnings": [*_gains(s, run["results"]), *_loop(margins), *_scene(s, run["series"])]}
