# SPDX-License-Identifier: MIT
"""A scene for a plant of one's own on one's own hardware, and its first gains: web/own.js in
Python."""
import math

from ._format import precise
from ._library import lib
from ._margins import scale_seconds
from ._metrics import unit_per_count
from ._scene import COMMON, PLANT, REVERSE

STEPS = lib.TUNER_STEPS


def round4(x):
    return precise(x, 4)


def _with_gains(kp, ki, kd=0, derivative_filter=0):
    return {"KP": round4(kp), "KI": round4(ki), "KD": round4(kd), "FILTER": derivative_filter, "WEIGHT": 1}


def simc(s):
    """Skogestad's rules (SIMC) for the plant as kp, ki and kd see it, which are counts per count. The
    hold is half a step of dead time; half of a second lag is dead time, and half lengthens the
    first. The loop's time constant is the dead time, or a tenth of the lag where that is more; of
    what oscillates it is 1 / the natural frequency."""
    per_count = abs(s["GAIN"]) / unit_per_count(s) / max(s["OUTPUT_MAX"], -s["OUTPUT_MIN"])
    hold = s["DEAD"] + 0.5 / s["RATE"]
    if s["PLANT"] == PLANT["OSCILLATOR"]:
        k = per_count * (s["T1"] + hold)
        derivative_filter = min(7, max(0, math.floor(math.log2(s["T1"] * s["RATE"] / 10))))
        return _with_gains(2 * s["DAMPING"] * s["T1"] / k, 1 / k, s["T1"] * s["T1"] / k, derivative_filter)
    if s["PLANT"] == PLANT["INTEGRATOR"]:
        dead = hold + s["T2"] / 2
        kp = 1 / (per_count * 2 * dead)
        return _with_gains(kp, kp / (8 * dead))
    second, first = sorted((s["T1"], s["T2"]))
    lag, dead = first + second / 2, hold + second / 2
    wanted = dead + max(dead, lag / 10)
    kp = lag / (per_count * wanted)
    return _with_gains(kp, kp / min(lag, 4 * wanted))


def with_plant(s):
    """The scene of a state with its own plant and hardware: a setpoint, another one, a load, and
    first gains."""
    low, high = s["SENSOR_LOW"], s["SENSOR_LOW"] + s["SENSOR_RANGE"]
    reach = math.copysign(0.4 * s["SENSOR_RANGE"], s["GAIN"]) if s["PLANT"] == PLANT["INTEGRATOR"] else s["GAIN"]

    def inside(value):
        return round4(min(high, max(low, value)))

    seconds = round4(min(12 * scale_seconds(s), STEPS / s["RATE"]))
    return {**s, "OPTIONS": int(s["OPTIONS"]) | (REVERSE if s["GAIN"] < 0 else 0), "DURATION": seconds,
            "SETPOINT": inside(s["START"] + reach / 2),
            "events": [{"at": round4(0.4 * seconds), "what": "SETPOINT", "a": inside(s["START"] + 0.65 * reach)},
                       {"at": round4(0.72 * seconds), "what": "LOAD", "a": -0.1}],
            **simc(s), "INTEGRAL_MIN": 0, "INTEGRAL_MAX": 0}


# ---- The plant of a model ----


def plant_of_model(model, step, rest):
    """What a scene calls a model that was recorded with a step of this part of full drive, from
    `rest`."""
    gain = model["rise"] / step
    plant = {"GAIN": round4(gain), "T1": round4(model.get("T1", 1)), "T2": round4(model.get("T2", 0)),
             "DEAD": round4(model["dead"]), "START": round4(model["start"] - gain * rest), "PLANT": PLANT["LAGS"]}
    if model["kind"] == "integrating":
        return {**plant, "PLANT": PLANT["INTEGRATOR"], "START": round4(model["start"])}
    if model["kind"] == "ringing":
        return {**plant, "PLANT": PLANT["OSCILLATOR"], "DAMPING": round4(model["damping"])}
    return plant


def range_for(low, high):
    """A sensor's low and range in tidy numbers for these two values, where there is none yet."""
    most = max(abs(low), abs(high)) or 1
    power = 10.0 ** math.ceil(math.log10(most))
    tidy = next((part * power for part in (0.2, 0.25, 0.5, 1) if part * power >= most), power)
    low = -tidy if low < 0 else 0
    return low, tidy - low


def rate_for(s, seconds):
    """About 40 steps in what matters of the plant, or of a recording of so many seconds where
    nothing of the plant has a time: 1, 2 or 5 times a power of ten."""
    wanted = 40 / (scale_seconds({**COMMON, **s, "RATE": math.inf}) or seconds)
    power = 10.0 ** math.floor(math.log10(wanted))
    return min(20000, max(0.01, power * next(one for one in (5, 2, 1) if one * power <= wanted)))
