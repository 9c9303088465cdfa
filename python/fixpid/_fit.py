# SPDX-License-Identifier: MIT
"""A recorded step response as gain, lag and dead time: web/fit.js in Python. First by the
times at 28.3 and 63.2 %, then by the least sum of squares."""
import math

from ._format import precise
from ._library import lib
from ._scene import REVERSE

STEPS = lib.TUNER_STEPS


def _mean(values):
    return sum(values) / len(values)


def _time_at(times, values, level, up):
    for i in range(1, len(values)):
        if values[i] >= level if up else values[i] <= level:
            part = (level - values[i - 1]) / ((values[i] - values[i - 1]) or 1)
            return times[i - 1] + (times[i] - times[i - 1]) * min(1, max(0, part))
    return None


def shape(t, lag, dead):
    """The part of the rise that is done at t."""
    return 0.0 if t <= dead else 1 - math.exp(-(t - dead) / lag)


def _straightened(times, values, lag, dead):
    """The start and the rise that fit best with this lag and dead time: a line through the
    points (shape, value)."""
    x = [shape(t, lag, dead) for t in times]
    mx, my = _mean(x), _mean(values)
    sxx = sum((one - mx)**2 for one in x) or 1e-12
    sxy = sum((one - mx) * (value - my) for one, value in zip(x, values))
    rise = sxy / sxx
    start = my - rise * mx
    squares = sum((value - start - rise * one)**2 for one, value in zip(x, values))
    return {"start": start, "rise": rise, "lag": lag, "dead": dead, "error": math.sqrt(squares / len(times))}


def fit_step(times, values):
    """start, rise, lag, dead, error and seconds of a step response whose times begin at 0, or
    None where it shows no step."""
    tail = max(3, len(values) // 12)
    start, end = values[0], _mean(values[-tail:])
    if abs(end - start) < 1e-9 * max(1, abs(end)):
        return None
    up = end > start
    early = _time_at(times, values, start + 0.283 * (end - start), up)
    late = _time_at(times, values, start + 0.632 * (end - start), up)
    if early is None or late is None or late <= early:
        return None
    lag = 1.5 * (late - early)
    best = _straightened(times, values, lag, max(0, late - lag))
    move = 0.2
    while move > 1e-4:  # both are moved while that makes the error less, by ever smaller steps
        lag, dead = best["lag"], best["dead"]
        more, less, later, sooner = lag * (1 + move), lag / (1 + move), dead + move * lag, max(0, dead - move * lag)
        tried = min((_straightened(times, values, *one) for one in (
            (more, dead), (less, dead), (lag, later), (lag, sooner), (more, sooner), (less, later))),
            key=lambda one: one["error"])
        if tried["error"] < best["error"] * (1 - 1e-9):
            best = tried
        else:
            move /= 2
    return {**best, "seconds": times[-1]}


def _range_of(fit, gain):
    """The page's sensor for this response, where there is none yet: low and range."""
    most = abs(gain) + abs(fit["start"])
    power = 10 ** math.ceil(math.log10(most))
    tidy = next((part * power for part in (0.2, 0.25, 0.5, 1) if part * power >= most), power)
    low = -tidy if min(0, fit["start"], fit["start"] + gain) < 0 else 0
    return low, tidy - low


def _rate_of(fit):
    """About 40 steps in lag and dead time: 1, 2 or 5 times a power of ten."""
    wanted = 40 / (fit["lag"] + fit["dead"])
    power = 10.0 ** math.floor(math.log10(wanted))
    return max(0.01, power * next(one for one in (5, 2, 1) if one * power <= wanted))


def simc(s):
    """Skogestad's rules (SIMC) for a lag with dead time, in counts: the loop's time constant is the
    dead time with half a step for the hold, or a tenth of the lag where that is more."""
    per_count = abs(s["GAIN"]) / (s["SENSOR_RANGE"] / (2**s["SENSOR_BITS"] - 1)) / max(s["OUTPUT_MAX"], -s["OUTPUT_MIN"])
    dead = s["DEAD"] + 0.5 / s["RATE"]
    wanted = dead + max(dead, s["T1"] / 10)
    kp = s["T1"] / (per_count * wanted)
    return {"KP": precise(kp, 4), "KI": precise(kp / min(s["T1"], 4 * wanted), 4), "KD": 0, "FILTER": 0, "WEIGHT": 1}


def state_of_fit(fit, step, sensor=None, actuator=None, rate=None):
    """A scene with this plant; `step` is the part of full drive that the recording was made with.
    The hardware that is not given is the page's: 12 bits, 1000 counts, 40 steps or more in the
    response."""
    def inside(value):
        return precise(min(low + span, max(low, value)), 4)

    gain = fit["rise"] / step
    low, span = _range_of(fit, gain) if sensor is None else (sensor.low, sensor.high - sensor.low)
    rate = _rate_of(fit) if rate is None else rate
    lag, dead = precise(fit["lag"], 4), precise(fit["dead"], 4)
    start, gain = precise(fit["start"], 4), precise(gain, 4)
    seconds = precise(min(12 * (lag + dead), STEPS / rate), 4)
    found = {
        "GAIN": gain, "T1": lag, "T2": 0, "DEAD": dead, "START": start,
        "SENSOR_BITS": 12 if sensor is None else sensor.bits, "SENSOR_LOW": low, "SENSOR_RANGE": span,
        "OUTPUT_MIN": 0 if actuator is None else actuator.lowest,
        "OUTPUT_MAX": 1000 if actuator is None else actuator.highest, "RATE": rate, "DURATION": seconds,
        "SETPOINT": inside(start + gain / 2), "OPTIONS": REVERSE if gain < 0 else 0,
        "events": [{"at": precise(0.4 * seconds, 4), "what": "SETPOINT", "a": inside(start + 0.65 * gain)},
                   {"at": precise(0.72 * seconds, 4), "what": "LOAD", "a": -0.1}]}
    return {**found, **simc(found)}
