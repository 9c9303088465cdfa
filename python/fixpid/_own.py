# SPDX-License-Identifier: MIT
"""A scene for a plant of one's own on one's own hardware, and its first gains: web/own.js in
Python."""
import math

from ._format import precise
from ._library import ffi, lib
from ._margins import scale_seconds
from ._scene import COMMON, PLANT, REVERSE, unit_per_count

STEPS = lib.TUNER_STEPS


def round4(x):
    return precise(x, 4)


def simc(s, calm):
    """Skogestad's rules (SIMC) for the plant as kp, ki and kd see it, which are counts per count; the
    loop's time constant is `calm` times that of the rule."""
    kind = {PLANT["OSCILLATOR"]: lib.IDENTIFY_RINGING, PLANT["INTEGRATOR"]: lib.IDENTIFY_INTEGRATING}.get(
        s["PLANT"], lib.IDENTIFY_SECOND)
    lag2, lag = (s["T2"], 0) if kind == lib.IDENTIFY_INTEGRATING else sorted((s["T1"], s["T2"]))
    per_count = abs(s["GAIN"]) / unit_per_count(s) / max(s["OUTPUT_MAX"], -s["OUTPUT_MIN"])
    plant = ffi.new("struct identify_plant *", {"kind": kind, "gain": per_count, "lag": lag, "lag2": lag2,
                                                "damping": s["DAMPING"], "dead": s["DEAD"]})
    gains = ffi.new("double[3]")
    lib.identify_simc(plant, 1 / s["RATE"], calm, gains)
    kp, ki, kd = map(round4, gains)
    filtered = kind == lib.IDENTIFY_RINGING
    derivative_filter = min(7, max(0, math.floor(math.log2(s["T1"] * s["RATE"] / 10)))) if filtered else 0
    return {"KP": kp, "KI": ki, "KD": kd, "FILTER": derivative_filter, "WEIGHT": 1}


def with_plant(s, calm):
    """The scene of a state with its own plant and hardware: a setpoint, another one, a load, and
    first gains, those of SIMC."""
    low, high = s["SENSOR_LOW"], s["SENSOR_LOW"] + s["SENSOR_RANGE"]
    reach = math.copysign(0.4 * s["SENSOR_RANGE"], s["GAIN"]) if s["PLANT"] == PLANT["INTEGRATOR"] else s["GAIN"]

    def inside(value):
        return round4(min(high, max(low, value)))

    seconds = round4(min(12 * scale_seconds(s), STEPS / s["RATE"]))
    return {**s, "OPTIONS": int(s["OPTIONS"]) | (REVERSE if s["GAIN"] < 0 else 0), "DURATION": seconds,
            "SETPOINT": inside(s["START"] + reach / 2),
            "events": [{"at": round4(0.4 * seconds), "what": "SETPOINT", "a": inside(s["START"] + 0.65 * reach)},
                       {"at": round4(0.72 * seconds), "what": "LOAD", "a": -0.1}],
            **simc(s, calm), "INTEGRAL_MIN": 0, "INTEGRAL_MAX": 0}


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
