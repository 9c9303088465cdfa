# SPDX-License-Identifier: MIT
"""A scene of the tuner page: its parameters by their names in sim/tuner/tuner.h, and a run of
it in the same C, bit for bit. web/engine.js in Python."""
import math
import threading
from urllib.parse import quote

from ._format import number, shortest
from ._library import ffi, lib
from ._units import numbers, pair


def _names(enumeration, prefix):
    elements = ffi.typeof(f"enum {enumeration}").elements
    return {name[len(prefix):]: value for value, name in sorted(elements.items()) if name.startswith(prefix)}


PARAM = _names("tuner_param", "PARAM_")
COUNT = _names("tuner_count", "COUNT_")
VALUE = _names("tuner_value", "VALUE_")
METRIC = _names("tuner_metric", "METRIC_")
RESULT = _names("tuner_result", "RESULT_")
EVENT = _names("tuner_event", "EVENT_")
EXPERIMENT = _names("tuner_experiment_kind", "EXPERIMENT_")
PLANT = _names("tuner_plant", "TUNER_")
RULE = {"PI": lib.FIXPID_AUTOTUNE_PI, "PID": lib.FIXPID_AUTOTUNE_PID}
WORD = {"QUICK": lib.FIXPID_AUTOTUNE_QUICK, "SAFE": lib.FIXPID_AUTOTUNE_SAFE, "CALM": lib.FIXPID_AUTOTUNE_CALM}
REVERSE = lib.TUNER_OPTION_REVERSE
DERIVATIVE_ON_ERROR = lib.TUNER_OPTION_DERIVATIVE_ON_ERROR
PROPORTIONAL_ON_MEASUREMENT = lib.TUNER_OPTION_PROPORTIONAL_ON_MEASUREMENT

# What a scene has if nothing else is said.
COMMON = {
    "CONTROLLER": 0, "PLANT": 0, "GAIN": 100, "T1": 1, "T2": 0, "DAMPING": 0.3, "DEAD": 0, "START": 0,
    "SENSOR_BITS": 12, "SENSOR_LOW": 0, "SENSOR_RANGE": 100, "NOISE": 0,
    "OUTPUT_MIN": 0, "OUTPUT_MAX": 1000, "RATE": 20, "DURATION": 60, "SETPOINT": 50,
    "KP": 1, "KI": 0, "KD": 0, "FILTER": 0, "WEIGHT": 1, "OPTIONS": 0, "INTEGRAL_MIN": 0, "INTEGRAL_MAX": 0,
    "EXPERIMENT": 0, "SWING": 0, "CYCLES": 1, "DRIVE": 100, "ROBUSTNESS": 16, "unit": "%", "rule": "PI", "events": []}


def within_reason(s):
    """The scene with lags that can be simulated: shorter ones than a part of a step become that."""
    shortest = 1 / (30 * s["RATE"])
    if s["PLANT"] == PLANT["OVEN"]:
        shortest = max(shortest, s["DURATION"] / 5000)
    return {**s, **{name: max(s[name], shortest) for name in ("T1", "T2") if s[name] > 0}}


def possible(s):
    """The scene; or a ValueError for what a run would cut in silence."""
    seconds = s["DURATION"]
    numbers("duration", seconds, 4 / s["RATE"], lib.TUNER_STEPS / s["RATE"])
    sensor = s["SENSOR_LOW"], s["SENSOR_LOW"] + s["SENSOR_RANGE"]
    numbers("setpoint", s["SETPOINT"], *sensor)
    for event in s["events"]:
        what = event["what"].lower()
        numbers(f"time of {what}", event["at"], 0, seconds - 1 / s["RATE"])
        legal = {"setpoint": sensor, "load": (-math.inf, math.inf)}.get(what, (-32768, 32767))
        values = [numbers(what, event[name], *legal) for name in "ab" if name in event]
        if what == "limits":
            pair(what, values)
    return s


def unit_per_count(s):
    return s["SENSOR_RANGE"] / (2**s["SENSOR_BITS"] - 1)


lock = threading.Lock()  # the C has one scene


def put(s):
    params = lib.tuner_params()
    for name, at in PARAM.items():
        params[at] = s[name]
    events = lib.tuner_events()
    size = lib.TUNER_EVENT_SIZE
    for at in range(lib.TUNER_EVENTS * size):
        events[at] = 0
    for i, event in enumerate(sorted(s["events"], key=lambda event: event["at"])[:lib.TUNER_EVENTS]):
        events[i * size:(i + 1) * size] = [event["at"], EVENT[event["what"]], event.get("a", 0), event.get("b") or 0]


def _results():
    found = lib.tuner_results()
    return {name: found[at] for name, at in RESULT.items()}


def _series(n):
    found = {name: ffi.unpack(lib.tuner_counts(at), n) if n else [] for name, at in COUNT.items()}
    found.update((f"VALUE_{name}", ffi.unpack(lib.tuner_values(at), n) if n else []) for name, at in VALUE.items())
    return found


def run(s):
    """{"n", "results", "series", "metrics"}; n is -1 where the controller refuses a value. What there
    is none of in the metrics is None."""
    with lock:
        put(s)
        n = lib.tuner_run()
        found = {"n": n, "results": _results(), "series": _series(max(n, 0))}
        worth = lib.tuner_metrics()
        found["metrics"] = {name.lower(): None if worth[at] < 0 else worth[at] for name, at in METRIC.items() if name != "TRAVEL"}
    most = found["results"]["DEAD_S"] + 1 / s["RATE"]
    if n > 0 and s["DEAD"] > most:
        raise ValueError(f"dead = {s['DEAD']:g} is refused: with these lags a run has at most {most:.4g} s of it at rate = {s['RATE']:g}: "
                         "take a lower rate")
    return found


def experiment(s, rules):
    """The scene's tuner in the controller's place: {"n", "results", "rules"}, with {"has", "results"}
    for each pair of a rule and a robustness."""
    with lock:
        put(s)
        n = lib.tuner_experiment()
        found = {"n": n, "results": _results(), "rules": []}
        for rule, robustness in rules:
            lib.tuner_params()[PARAM["ROBUSTNESS"]] = robustness
            has = lib.tuner_rule(RULE[rule]) == 1
            found["rules"].append({"rule": rule, "robustness": robustness, "has": has, "results": _results()})
        return found


def gains_of_rule(s, results):
    """The integers of a rule as the scene's real units, which fold to them again."""
    def ki_fold(ki):
        return int(ki * 16777216 / s["RATE"] + 0.5)

    def kd_fold(kd):
        return int(kd * 256 * s["RATE"] / 2**results["FILTER"] + 0.5)

    kept = int(s["OPTIONS"]) & ~PROPORTIONAL_ON_MEASUREMENT
    return {"KP": results["KP"] / 256, "KI": shortest(results["KI"] * s["RATE"] / 16777216, ki_fold),
            "KD": shortest(results["KD"] * 2**results["FILTER"] / 256 / s["RATE"], kd_fold),
            "FILTER": results["FILTER"], "WEIGHT": 1 if results["WEIGHT"] == 0 else results["WEIGHT"] / 256,
            "OPTIONS": kept | int(results["OPTIONS"])}


# The page's own plants, by what a link begins with; it says all the rest.
PRESETS = {"LAGS": "flow", "OSCILLATOR": "spring", "INTEGRATOR": "axis", "OVEN": "oven"}


def fragment(s):
    """What stands after the # of a link into the tuner page, for a fixpid_pid."""
    plant = next(name for name, value in PLANT.items() if value == s["PLANT"])
    events = "~".join("_".join([event["what"].lower(), *(number(event.get(name) or 0) for name in ("at", "a", "b"))])
                      for event in s["events"])
    return "&".join([f"p={PRESETS[plant]}", *(f"{name.lower()}={number(s[name])}" for name in PARAM
                                             if name not in ("CONTROLLER", "PLANT")),
                     f"unit={quote(s['unit'], safe='')}", *([f"loop={s['loop']}"] if s.get("loop") else []), f"rule={s['rule']}", f"events={events}"])
