# SPDX-License-Identifier: MIT
"""From a recording to a header: a fit, its gains, and the loop that comes of it."""
import math
from dataclasses import dataclass
from typing import Dict, List, Optional, Tuple

from . import _scene
from ._advice import advice_of
from ._columns import LEAST_ROWS, jump_of, median, outliers_of, thinned
from ._core import numpy
from ._fit import fit_models, model_at
from ._header import header_of
from ._margins import margins_of, scale_seconds
from ._metrics import limited_steps, metrics_of, unit_per_count, units_of
from ._modules import AutotuneCause, AutotuneState, ReactionState
from ._own import plant_of_model, range_for, rate_for, with_plant
from ._pid import Pid
from ._units import Actuator, Sensor, number

KINDS = {"lags": "LAGS", "oscillator": "OSCILLATOR", "integrator": "INTEGRATOR", "oven": "OVEN"}
TUNERS = {"autotune": ("RELAY", AutotuneState), "reaction": ("HEAT_UP", ReactionState)}
OUT_OF_RANGE = "A gain is out of its range: take PI, a finer measurement or another rate."
BOUNDS = {"gain": (-1e6, 1e6), "lag": (0, 1e5), "dead": (0, 1e5), "lag2": (0, 1e5), "start": (-1e6, 1e6),
          "damping": (1e-3, 100)}  # as on the page


def _array(values):
    return values if numpy is None else numpy.array(values)


@dataclass(frozen=True)
class Plant:
    """What is controlled, in units of the measurement and seconds. `gain` is what full drive makes
    of the measurement at rest, of an integrator in each second. `kind` is lags (`lag` and, if it
    is not 0, `lag2`), integrator (with a lag of `lag2`), oscillator (a period of 2 pi `lag`, with
    `damping`) or oven (an element with `lag2` warms a body with `lag`)."""

    gain: float
    lag: float = 1.0
    dead: float = 0.0
    lag2: float = 0.0
    start: float = 0.0
    kind: str = "lags"
    damping: float = 0.3
    unit: str = ""

    def __post_init__(self):
        if self.kind not in KINDS:
            raise ValueError(f"kind = {self.kind!r} is refused: {', '.join(KINDS)} are legal")
        for name, (low, high) in BOUNDS.items():
            if not low <= number(name, getattr(self, name)) <= high:
                raise ValueError(f"{name} = {getattr(self, name)} is refused: {low:g} to {high:g} is legal")
        if (self.lag == 0 and self.kind != "integrator") or (self.lag2 == 0 and self.kind == "oven"):
            raise ValueError(f"lag = {self.lag}, lag2 = {self.lag2} is refused: {self.kind} needs it above 0")

    def _state(self):
        return {"PLANT": _scene.PLANT[KINDS[self.kind]], "GAIN": self.gain, "T1": self.lag, "T2": self.lag2,
                "DEAD": self.dead, "START": self.start, "DAMPING": self.damping, "unit": self.unit}


class Fit:
    """A model of a recorded step: `kind` is first (one lag), second (two), integrating or ringing. It
    has gain, of a unit of the output; lag, lag2 and damping, of which those that its kind has not
    are None; dead, the dead time; start and rise. The period of a ringing one is 2 pi lag.

    `worth` says how well it fits, `part` which part of the rise is left on average, `error` the same
    in units, and `r2` is 1 where it explains all. `refused` is the reason why it is not to be used,
    or None. `models` has all four by their kinds, and `notes` says what was left out of the
    recording. t (seconds after the step) and y are what was fitted, `outliers` pairs that were not;
    u rose by `step` from `before`.
    """

    kind: str
    lag: Optional[float]
    lag2: Optional[float]
    damping: Optional[float]
    dead: float
    start: float
    rise: float
    worth: str
    part: float
    error: float
    r2: float
    refused: Optional[str]
    models: Dict[str, "Fit"]
    t: List[float]
    y: List[float]
    before: float
    step: float
    outliers: List[Tuple[float, float]]
    notes: List[str]

    def __init__(self, model, recording, models):
        self._model, self.models = model, models
        self.kind, self.dead, self.start, self.rise = (model[name] for name in ("kind", "dead", "start", "rise"))
        self.lag, self.lag2, self.damping = (model.get(name) for name in ("T1", "T2", "damping"))
        self.worth, self.refused, self.part, self.error, self.r2 = (
            model[name] for name in ("word", "refused", "part", "error", "r2"))
        self.t, self.y, self.before, self.step, self.outliers, self.notes = (
            recording[name] for name in ("t", "y", "before", "step", "outliers", "notes"))

    @property
    def gain(self) -> float:
        """What a unit of u makes of the measurement; of an integrating one in each second."""
        return self.rise / self.step

    @property
    def rest(self) -> float:
        """The measurement with no output; of an integrating one, where it begins."""
        return self.start - (0 if self.kind == "integrating" else self.gain * self.before)

    def at(self, t) -> float:
        """The fitted response at t seconds after the step."""
        return model_at(self._model, t)

    def plant(self, full: float = 1.0) -> Plant:
        """The Plant for `simulate`; `full` is full drive in units of u."""
        kind = {"integrating": "integrator", "ringing": "oscillator"}.get(self.kind, "lags")
        numbers = {name: value for name in ("lag", "lag2", "damping") for value in [getattr(self, name)] if value is not None}
        return Plant(gain=self.gain * full, dead=self.dead, start=self.rest, kind=kind, **numbers)

    def plot(self, axes=None):
        """The recording, the fit and what was left out, by matplotlib. Returns its axes."""
        axes = _axes(axes)
        axes.plot(self.t, self.y, ".", color="0.6", label="recorded")
        axes.plot(self.t, [self.at(t) for t in self.t], color="tab:blue", label=self._numbers(" s"))
        if self.outliers:
            axes.plot(*zip(*self.outliers), "x", color="tab:red", label="left out")
        axes.set_xlabel("seconds after the step")
        axes.set_title(self.refused or f"{self.kind}: {self.worth}, R² = {self.r2:.4f}", wrap=True)
        axes.legend()
        return axes

    def _numbers(self, second=""):
        units = {"gain": "", "lag": second, "lag2": second, "damping": "", "dead": second}
        known = [(name, getattr(self, name), unit) for name, unit in units.items()]
        return " ".join(f"{name}={value:.4g}{unit}" for name, value, unit in known if value is not None)

    def __repr__(self):
        return f"<Fit {self.kind} {self._numbers()} rest={self.rest:.4g}: {self.refused or self.worth}>"


def _axes(axes):
    if axes is None:
        try:
            from matplotlib import pyplot
        except ImportError:
            raise ImportError("plot() needs matplotlib: pip install fixpid[plot]") from None
        axes = pyplot.subplots(constrained_layout=True)[1]
    return axes


def _seconds(t):
    """Times in seconds after the first one: numbers, or what a difference of dates is."""
    first = t[0]
    if hasattr(first - first, "total_seconds"):
        return [(one - first).total_seconds() for one in t]
    if type(first).__name__ == "datetime64":
        return [float((one - first) / type(first - first)(1, "s")) for one in t]
    return [float(one) - float(first) for one in t]


def _rows(t, u, y, at):
    """Columns of seconds after the first line, output and measurement in the order of the times,
    without lines that are no numbers; the moment `at` in these seconds; and notes."""
    t, y = list(t), list(y)
    u = list(u) if hasattr(u, "__iter__") else [number("u", u)] * len(t)
    if not len(t) == len(u) == len(y):
        raise ValueError(f"t, u and y have {len(t)}, {len(u)} and {len(y)} elements")
    if len(t) < LEAST_ROWS:
        raise ValueError(f"t has {len(t)} elements: {LEAST_ROWS} or more are wanted")
    seconds = _seconds(t if at is None else [*t, at])
    rows = [(s, float(a), float(b)) for s, a, b in zip(seconds, u, y)]
    good = [row for row in rows if all(map(math.isfinite, row))]
    if len(good) < LEAST_ROWS:
        raise ValueError(f"t, u and y have {len(good)} lines of numbers: {LEAST_ROWS} or more are wanted")
    rows = sorted(good, key=lambda row: row[0])
    begin = rows[0][0]
    if rows[-1][0] <= begin:
        raise ValueError("t is refused: the time stands still")
    notes = [f"Lines that are no numbers left out: {len(t) - len(good)}."] * (len(good) < len(t))
    return [[row[0] - begin for row in rows], *map(list, list(zip(*rows))[1:])], None if at is None else seconds[-1] - begin, notes


def _step_of(u):
    """The jump of the output, which stands still before and after it."""
    if min(u) == max(u):
        raise ValueError(f"u = {u[0]:g} is refused: it has no step; if the recording begins with it, call fit(t, STEP, y)")
    jump = jump_of(u)
    if jump is None:
        raise ValueError("u is refused: it has no step between two values that stand still; if you know the step, cut "
                         "the recording to it, or call fit(t, STEP, y, at=TIME)")
    return jump


def fit(t, u, y, at=None, refuse=True) -> Fit:
    """The model that fits a recorded step best, a Fit: of times, what the actuator got, and the
    measurement, as lists, arrays or pandas Series; the times may be uneven, or dates.

    The step is found in u, which may move again later: what comes then is left out. A single number
    is a step of so much, from no output, at the first time or at the time `at`. Single values far
    from their neighbours are left out. A ValueError says why there is no model that can be used;
    with refuse=False the best one comes all the same, with the reason in `refused`, to look at it.
    """
    (times, drive, values), asked, notes = _rows(t, u, y, at)
    far = set(outliers_of(values))
    left_out = [(times[i], values[i]) for i in sorted(far)]
    times, drive, values = ([one for i, one in enumerate(column) if i not in far] for column in (times, drive, values))
    if hasattr(u, "__iter__"):
        jump = _step_of(drive)
    else:
        jump = {"at": 0, "first": 0, "next": len(times), "from": 0.0, "to": number("u", u)}
    before, step, begin = jump["from"], jump["to"] - jump["from"], jump["at"]
    if step == 0:
        raise ValueError("u = 0 is refused: a step is not 0")
    step_at = asked if asked is not None else 0.0 if begin == 0 else (times[begin - 1] + times[begin]) / 2
    every = median([after - one for one, after in zip(times, times[1:])])
    if left_out:
        notes.append(f"Left out as outliers: {', '.join(f'{value:g} at {s:g} s' for s, value in left_out[:4])}"
                     f"{f' and {len(left_out) - 4} more' if len(left_out) > 4 else ''}.")
    if jump["next"] < len(times):
        notes.append(f"Used up to {times[jump['next'] - 1]:g} s, after which u moves again.")
    times, values = thinned(times[jump["first"]:jump["next"]], values[jump["first"]:jump["next"]])
    found = fit_models(times, values, step_at, every)
    if "refused" in found:
        raise ValueError(found["refused"])
    recording = {"t": [one - step_at for one in times], "y": values, "before": before, "step": step, "notes": notes,
                 "outliers": [(one - step_at, value) for one, value in left_out]}
    models = {}
    for one in found["models"]:
        models[one["kind"]] = Fit(one, recording, models)
    best = models[found["chosen"]]
    if refuse and best.refused is not None:
        raise ValueError(best.refused)
    if begin == 0 and asked is None and best.dead > max(5 * every, 0.3 * (best.lag or 0)):
        notes.append("The first line is taken as the moment of the step: if there was rest before it, say at=TIME.")
    if best.kind == "integrating":
        notes.append("A lag far longer than the recording would look the same, and gets the same gains.")
    return best


class Loop:
    """A loop that was simulated, as the tuner page would: the library's integers on a plant.

    t, setpoint, measurement, true (before the sensor) and twin (beside a controller in double
    precision) are in units, output in the actuator's; p, i and d are its terms, flags what the
    controller says, limited whether its output was. `metrics`, `margins` and `advice` are what
    the page shows of it.
    """

    def __init__(self, state, actuator):
        self.state, self._actuator = state, actuator
        run = _scene.run(state)
        if run["n"] < 0:
            raise ValueError(" ".join(advice_of(state, run, None)["refused"]))
        self._run = run
        self.margins = margins_of(state, run["results"])
        self.metrics = metrics_of(state, run)
        self.advice = advice_of(state, run, self.margins)["warnings"]
        series = run["series"]
        per_count = actuator.unit_per_count
        self.t = _array([i / state["RATE"] for i in range(run["n"])])
        self.setpoint, self.measurement = (_array([units_of(state, one) for one in series[name]])
                                           for name in ("SETPOINT", "MEASUREMENT"))
        self.true, self.twin = _array(series["VALUE_TRUE"]), _array(series["VALUE_TWIN"])
        self.output = _array([actuator.units(one) for one in series["OUTPUT"]])
        self.p, self.i, self.d = (_array([one * per_count / scale for one in series[name]])
                                  for name, scale in (("P", 256), ("I", 65536), ("D", 256)))
        self.flags, self.limited = _array(series["FLAGS"]), _array(limited_steps(run))

    @property
    def gains(self) -> tuple:
        """kp, ki and kd in units of the actuator and the sensor."""
        factor = self._actuator.unit_per_count / unit_per_count(self.state)
        return tuple(self.state[name] * factor for name in ("KP", "KI", "KD"))

    @property
    def pid(self) -> Pid:
        """A new Pid like that of this loop, with its sensor and its actuator."""
        s, per_count = self.state, self._actuator.unit_per_count
        kp, ki, kd = self.gains
        ends = s["INTEGRAL_MIN"], s["INTEGRAL_MAX"]
        return Pid(kp=kp, ki=ki, kd=kd, rate=s["RATE"], setpoint=min(s["SETPOINT"], s["SENSOR_LOW"] + s["SENSOR_RANGE"]), filter=int(s["FILTER"]),
                   sensor=Sensor(s["SENSOR_LOW"], s["SENSOR_LOW"] + s["SENSOR_RANGE"], s["SENSOR_BITS"], s["unit"]),
                   actuator=self._actuator, reverse=bool(s["OPTIONS"] & _scene.REVERSE),
                   setpoint_weight=0 if s["OPTIONS"] & _scene.PROPORTIONAL_ON_MEASUREMENT else s["WEIGHT"],
                   output_limits=(s["OUTPUT_MIN"] * per_count, s["OUTPUT_MAX"] * per_count),
                   integral_limits=None if ends == (0, 0) else tuple(one * per_count for one in ends),
                   derivative_on_error=bool(s["OPTIONS"] & _scene.DERIVATIVE_ON_ERROR))

    def header(self) -> str:
        """The header for the firmware, as the page writes it: the integers, what they are from, and
        LOOP_RATE and LOOP_COUNTS(x) for the rest of the program."""
        return header_of(self.state, self._run["results"], self.margins, self.link()[1:])

    def link(self, page: str = "") -> str:
        """A link that opens this loop in the tuner page, whose address is `page`."""
        return f"{page}#{_scene.fragment(self.state)}"

    def plot(self, axes=None):
        """The measurement and the output, by matplotlib: one axes for both, or a pair. Returns
        the axes of the measurement."""
        if axes is None:
            axes = _axes(None)
        first, second = axes if hasattr(axes, "__len__") else (axes, axes.twinx())
        first.step(self.t, self.setpoint, where="post", color="0.6", label="setpoint")
        first.plot(self.t, self.measurement, color="tab:blue", label="measurement")
        second.step(self.t, self.output, where="post", color="tab:orange", linewidth=0.8, label="output")
        first.set_xlabel("seconds")
        first.set_ylabel(self.state["unit"] or "measurement")
        second.set_ylabel(self._actuator.unit or "output")
        first.set_title("kp {:.4g}, ki {:.4g}, kd {:.4g}; Ms {:.2f}".format(*self.gains, self.margins["ms"]))
        first.legend()
        return first

    def __repr__(self):
        kp, ki, kd = self.gains
        found = self.metrics
        settled = "never" if found["settled"] is None else f"{found['settled']:.4g} s"
        return (f"<Loop kp={kp:.4g} ki={ki:.4g} kd={kd:.4g}: overshoot {100 * found['overshoot']:.1f} %, "
                f"settled {settled}, Ms {self.margins['ms']:.2f}{'' if self.margins['stable'] else ', unstable'}>")


def _events(events):
    """What happens: {"at", "what", "a", "b"}, with `what` as the page has it."""
    found = []
    for event in events:
        at, what, *values = event
        what = str(what).upper()
        if _scene.EVENT.get(what, 0) == 0 or len(values) != {"AUTO": 0, "LIMITS": 2}.get(what, 1):
            known = ", ".join(name.lower() for name in _scene.EVENT if name != "NONE")
            raise ValueError(f"event {event!r} is refused: (seconds, what, value) is wanted, and what is one of {known}")
        found.append({"at": number("at", at), "what": what, **{name: number("value", value) for name, value in zip("ab", values)}})
    if len(found) > _scene.lib.TUNER_EVENTS:
        raise ValueError(f"events are refused: {len(found)} of them, and at most {_scene.lib.TUNER_EVENTS} happen")
    return found


def simulate(plant, pid, duration=None, setpoint=None, events=(), noise=0.0) -> Loop:
    """The loop of a Plant, or of a Fit, and a Pid, from rest: a Loop.

    It lasts `duration` seconds, 4 to 20000 steps; without one, ten times what matters of the
    plant. `setpoint` is the Pid's own if it is not given. `events` are (seconds, what, value):
    setpoint in units, load as a part of full drive, manual, limits and feedforward in counts,
    auto. `noise` is of the sensor, in counts to each side. The Pid itself stays as it is.
    """
    if pid.rate is None or pid._tunings is None and "gains" not in pid._said[1]:
        raise ValueError("pid is refused: it needs a rate and gains")
    sensor = pid.sensor or Sensor(0, 2**15 - 1, 15)
    config = pid._said[1]
    actuator = pid.actuator or Actuator(config.get("output_min", 0), config["output_max"])
    plant = plant.plant(actuator.full or actuator.most) if isinstance(plant, Fit) else plant
    factor = pid.counts_per_unit
    kp, ki, kd = (value * factor for value in pid.tunings)
    options = sum(bit for name, bit in (("reverse", _scene.REVERSE), ("derivative_on_error", _scene.DERIVATIVE_ON_ERROR),
                                        ("proportional_on_measurement", _scene.PROPORTIONAL_ON_MEASUREMENT))
                  if config.get(name))
    state = {**_scene.COMMON, **plant._state(), "SENSOR_BITS": sensor.bits, "SENSOR_LOW": sensor.low,
             "SENSOR_RANGE": sensor.high - sensor.low, "NOISE": number("noise", noise),
             "OUTPUT_MIN": config.get("output_min", 0), "OUTPUT_MAX": config["output_max"], "RATE": pid.rate,
             "KP": kp, "KI": ki, "KD": kd, "FILTER": config.get("gains", {}).get("derivative_filter", 0),
             "WEIGHT": (config.get("setpoint_weight_q8") or 256) / 256, "OPTIONS": options,
             "INTEGRAL_MIN": config.get("integral_min", 0), "INTEGRAL_MAX": config.get("integral_max", 0),
             "SETPOINT": pid.setpoint if setpoint is None else number("setpoint", setpoint),
             "events": _events(events)}
    if sensor.unit:
        state["unit"] = sensor.unit
    usual = max(4 / pid.rate, min(10 * scale_seconds(state), _scene.lib.TUNER_STEPS / pid.rate))
    state["DURATION"] = usual if duration is None else number("duration", duration)
    return Loop(_scene.within_reason(_scene.possible(state)), actuator)


def tune(fit, rule="PI", rate=None, sensor=None, actuator=None, robustness="safe", tuner="autotune") -> Loop:
    """The Loop with the gains of a rule for a Fit.

    `rule` is PI or PID, with a `robustness` of quick, safe, calm or 8..64, as a tuner finds them in
    its experiment on the fitted plant: `tuner` is autotune, which swings it about the setpoint, or
    reaction, which heats it up from rest towards the setpoint. Or it is SIMC, Skogestad's.
    `sensor`, `actuator` and `rate` are your hardware's; u of the fit is in the actuator's units, or with no actuator a part
    of full drive. ValueError, with what to do, where the rule has no gains.
    """
    if not isinstance(fit, Fit):
        raise TypeError(f"fit = {fit!r} is refused: a fixpid.Fit is wanted")
    if fit.refused is not None:
        raise ValueError(fit.refused)
    word = str(robustness).upper()
    robust = _scene.WORD.get(word, robustness)
    if robust not in range(8, 65):
        raise ValueError(f"robustness = {robustness!r} is refused: quick, safe, calm and 8..64 are legal")
    if rule not in ("PI", "PID", "SIMC"):
        raise ValueError(f"rule = {rule!r} is refused: PI, PID and SIMC are legal")
    if tuner not in TUNERS:
        raise ValueError(f"tuner = {tuner!r} is refused: {' and '.join(TUNERS)} are legal")
    given = Actuator(0, 1000, full=1.0) if actuator is None else actuator
    full = given.full or given.most
    plant = plant_of_model(fit._model, fit.step / full, fit.before / full)
    rate = rate_for(plant, fit.t[-1]) if rate is None else number("rate", rate)
    if sensor is None:
        ends = fit.y if fit.kind == "integrating" else (plant["START"], plant["START"] + plant["GAIN"])
        low, span = range_for(min(ends), max(ends))
    else:
        low, span = sensor.low, sensor.high - sensor.low
    state = _scene.within_reason(with_plant({**_scene.COMMON, **plant, "RATE": rate, "SENSOR_BITS": sensor.bits if sensor else 12,
                        "SENSOR_LOW": low, "SENSOR_RANGE": span, "OUTPUT_MIN": given.lowest, "OUTPUT_MAX": given.highest,
                        "ROBUSTNESS": robust, "rule": "PI" if rule == "SIMC" else rule, "unit": sensor.unit if sensor else ""}))
    if rule != "SIMC":
        kind, states = TUNERS[tuner]
        state["EXPERIMENT"] = _scene.EXPERIMENT[kind]
        tried = _scene.experiment(state, [(rule, robust)])
        status = states(int(tried["results"]["STATUS"]))
        if status is states.RUNNING:
            raise ValueError(f"no gains: the experiment is not over after the {_scene.lib.TUNER_STEPS} steps that a run has, which are "
                             f"{_scene.lib.TUNER_STEPS / rate:g} s at rate = {rate:g}: take a lower rate")
        if status is not states.DONE:
            raise ValueError(f"no gains: {status.advice}")
        if not tried["rules"][0]["has"]:
            reason = AutotuneCause(int(tried["rules"][0]["results"]["REASON"]))
            raise ValueError(f"no gains: {reason.advice if tuner == 'autotune' else OUT_OF_RANGE}")
        state.update(_scene.gains_of_rule(state, tried["rules"][0]["results"]))
    return Loop(state, given)
