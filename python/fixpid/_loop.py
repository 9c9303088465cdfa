# SPDX-License-Identifier: MIT
"""From a recording to a header: a fit, its gains, and the loop that comes of it."""
import math
from typing import Any, Dict, Iterable, List, Optional, Tuple, Union

from . import _scene
from ._advice import advice_of
from ._core import numpy
from ._fit import Fit, axes_of, verdict_of
from ._header import header_of
from ._margins import margins_of, ms_of_each, scale_seconds
from ._modules import AutotuneCause, AutotuneState, ReactionState
from ._own import range_for, rate_for, round4, with_plant
from ._pid import Pid
from ._plant import Plant
from ._units import Actuator, Sensor, number

TUNERS = {"autotune": ("RELAY", AutotuneState), "reaction": ("HEAT_UP", ReactionState)}
DRIVES = 100, 50, 25, 12.5  # of a heat-up, in percent, until it does not go too far
OUT_OF_RANGE = "A gain is out of its range: take PI, a finer measurement or another rate."


def _array(values):
    return values if numpy is None else numpy.array(values)


class Loop:
    """A loop that was simulated, as the tuner page would: the library's integers on a plant.

    t, setpoint, measurement, true (before the sensor) and twin (beside a controller in double
    precision) are in units, output in the actuator's; p, i and d are its terms, flags what the
    controller says, limited whether its output was. `metrics`, `margins` and `advice` are what
    the page shows of it, the metrics by enum tuner_metric of sim/tuner/tuner.h; `curve` is the loop in the complex plane. Of a plant from a recording
    `verdict` says what Ms is with the others that the recording allows; else it is None.
    """

    def __init__(self, state: Dict[str, Any], actuator: Actuator, fit: Optional[Fit] = None) -> None:
        self.state, self._actuator = state, actuator
        run = _scene.run(state)
        if run["n"] < 0:
            raise ValueError(" ".join(advice_of(state, run, None)["refused"]))
        self._run = run
        self.margins = margins_of(state, run["results"])
        self.curve = self.margins.pop("curve")
        self.metrics = run["metrics"]
        self.advice: List[str] = advice_of(state, run, self.margins)["warnings"]
        self.verdict: Optional[str] = None
        self._warning: Optional[str] = None
        if fit is not None:
            each = ms_of_each(state, run["results"], fit._allowed(), actuator.full or actuator.most)
            own = self.margins["ms"]
            self.verdict, self._warning = verdict_of(math.inf if own is None else own, each)
            self.advice += [self._warning] * (self._warning is not None)
        series = run["series"]
        per_count = actuator.unit_per_count
        self.t = _array([i / state["RATE"] for i in range(run["n"])])
        unit = _scene.unit_per_count(state)
        self.setpoint, self.measurement = (_array([state["SENSOR_LOW"] + one * unit for one in series[name]])
                                           for name in ("SETPOINT", "MEASUREMENT"))
        self.true, self.twin = _array(series["VALUE_TRUE"]), _array(series["VALUE_TWIN"])
        self.output = _array([actuator.units(one) for one in series["OUTPUT"]])
        self.p, self.i, self.d = (_array([one * per_count / scale for one in series[name]])
                                  for name, scale in (("P", 256), ("I", 65536), ("D", 256)))
        self.flags, self.limited = _array(series["FLAGS"]), _array(series["LIMITED"])

    @property
    def gains(self) -> Tuple[float, ...]:
        """kp, ki and kd in units of the actuator and the sensor."""
        factor = self._actuator.unit_per_count / _scene.unit_per_count(self.state)
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

    def header(self, name: str = "") -> str:
        """The header for the firmware, as the page writes it: the integers, what they are from, and
        LOOP_RATE and LOOP_COUNTS(x) for the rest of the program. A firmware with several loops gives
        each a `name` of letters, digits and _, which is then a part of all that the header defines:
        LOOP_BED_RATE."""
        said = [self.verdict] if self.verdict else []
        said += [f"Warning: {self._warning}"] if self._warning else []
        link = _scene.fragment({**self.state, "loop": name})
        return header_of(self.state, self._run["results"], self.margins, link, name, said, "the Python package fixpid")

    def link(self, page: str = "") -> str:
        """A link that opens this loop in the tuner page, whose address is `page`."""
        return f"{page}#{_scene.fragment(self.state)}"

    def plot(self, axes: Any = None) -> Any:
        """The measurement and the output, by matplotlib: one axes for both, or a pair. Returns
        the axes of the measurement."""
        if axes is None:
            axes = axes_of(None)
        first, second = axes if hasattr(axes, "__len__") else (axes, axes.twinx())
        first.step(self.t, self.setpoint, where="post", color="0.6", label="setpoint")
        first.plot(self.t, self.measurement, color="tab:blue", label="measurement")
        second.step(self.t, self.output, where="post", color="tab:orange", linewidth=0.8, label="output")
        first.set_xlabel("seconds")
        first.set_ylabel(self.state["unit"] or "measurement")
        second.set_ylabel(self._actuator.unit or "output")
        first.set_title("kp {:.4g}, ki {:.4g}, kd {:.4g}; {}".format(*self.gains, self._ms()))
        first.legend()
        return first

    def _ms(self) -> str:
        return "unstable" if self.margins["ms"] is None else f"Ms {self.margins['ms']:.2f}"

    def __repr__(self) -> str:
        kp, ki, kd = self.gains
        found = self.metrics
        settled = "never" if found["settled"] is None else f"{found['settled']:.4g} s"
        return (f"<Loop kp={kp:.4g} ki={ki:.4g} kd={kd:.4g} rate={self.state['RATE']:g}: overshoot {100 * found['overshoot']:.1f} %, "
                f"settled {settled}, {self.verdict or self._ms()}>")


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


def _out_of_reach(state: Dict[str, Any]) -> List[str]:
    """What is said if no output holds the plant at the setpoint."""
    drives = [state[name] / max(state["OUTPUT_MAX"], -state["OUTPUT_MIN"]) for name in ("OUTPUT_MIN", "OUTPUT_MAX")]
    ends = [state["START"] + state["GAIN"] * drive for drive in drives]
    by_hand = any(event["what"] == "MANUAL" for event in state["events"])
    if by_hand or state["PLANT"] == _scene.PLANT["INTEGRATOR"] or min(ends) <= state["SETPOINT"] <= max(ends):
        return []
    return [f"The outputs hold this plant at {min(ends):.4g} to {max(ends):.4g}, and the setpoint is {state['SETPOINT']:.4g}. "
            "Is the plant's gain that of full output? If it is from a Fit, pass the Fit itself."]


def simulate(plant: Union[Plant, Fit], pid: Pid, duration: Optional[float] = None, setpoint: Optional[float] = None,
             events: Iterable[Tuple[Any, ...]] = (), noise: float = 0.0) -> Loop:
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
    fit = plant if isinstance(plant, Fit) else None
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
    loop = Loop(_scene.within_reason(_scene.possible(state)), actuator, fit)
    loop.advice += _out_of_reach(state)
    return loop


def _robustness(rule: str, given: Union[str, int, None], calm: Optional[float], fit: Fit) -> Tuple[int, float]:
    """That of a tuner's rule, and how calm SIMC's is."""
    if rule == "SIMC":
        if given is not None:
            raise ValueError(f"robustness = {given!r} is refused: SIMC's loop is made calmer by calm=2")
        calm = number("calm", fit.calm if calm is None else calm)
        if not 0.5 <= calm <= 8:
            raise ValueError(f"calm = {calm:g} is refused: 0.5 to 8 is legal")
        return _scene.WORD["SAFE"], calm
    if calm is not None:
        raise ValueError(f"calm = {calm!r} is refused: it is SIMC's; {rule} takes a robustness")
    robust = _scene.WORD.get(str(given or "safe").upper(), given)
    if robust not in range(8, 65):
        raise ValueError(f"robustness = {given!r} is refused: quick, safe, calm and 8..64 are legal")
    return robust, 1.0


def _scene_of(fit: Fit, rate: Optional[float], sensor: Optional[Sensor], actuator: Actuator) -> Dict[str, Any]:
    """The plant of a fit on this hardware, with a rate and a sensor that suit it if there is none."""
    state = fit.plant(actuator.full or actuator.most)._state()
    state.update((name, round4(state[name])) for name in ("GAIN", "T1", "T2", "DEAD", "START", "DAMPING"))
    if sensor is None:
        ends = fit.y if fit.kind == "integrating" else (state["START"], state["START"] + state["GAIN"])
        low, span = range_for(min(ends), max(ends))
    else:
        low, span = sensor.low, sensor.high - sensor.low
    return {**_scene.COMMON, **state, "RATE": rate_for(state, fit.t[-1]) if rate is None else number("rate", rate),
            "SENSOR_BITS": sensor.bits if sensor else 12, "SENSOR_LOW": low, "SENSOR_RANGE": span,
            "OUTPUT_MIN": actuator.lowest, "OUTPUT_MAX": actuator.highest, "unit": sensor.unit if sensor else ""}


def _tuned(state: Dict[str, Any], rule: str, robust: int, tuner: str) -> Dict[str, Any]:
    """What a tuner's experiment finds, as the scene's gains."""
    kind, states = TUNERS[tuner]
    state["EXPERIMENT"] = _scene.EXPERIMENT[kind]
    for state["DRIVE"] in DRIVES:
        tried = _scene.experiment(state, [(rule, robust)])
        status = states(int(tried["results"]["STATUS"]))
        if status is states.DONE or state["DRIVE"] == DRIVES[0] and status is not ReactionState.LIMIT:
            break
    else:
        raise ValueError("no gains: the heat-up goes too far or ends too early, with full output and down to an eighth of it: "
                         'take a faster rate, tuner="autotune" or rule="SIMC"')
    if status is states.RUNNING:
        steps, one_way = _scene.lib.TUNER_STEPS, state["OUTPUT_MIN"] * state["OUTPUT_MAX"] >= 0
        if tuner == "autotune" and one_way and state["PLANT"] == _scene.PLANT["INTEGRATOR"]:
            raise ValueError("no gains: the experiment does not end, because this integrating plant does not come down with the "
                             'output off: record for longer, or take tuner="reaction" or rule="SIMC"')
        raise ValueError(f"no gains: the experiment is not over after the {steps} steps that a run has, which are "
                         f"{steps / state['RATE']:g} s at rate = {state['RATE']:g}: take a lower rate")
    if status is not states.DONE:
        raise ValueError(f"no gains: {status.advice}")
    found = tried["rules"][0]
    if not found["has"]:
        reason = AutotuneCause(int(found["results"]["REASON"]))
        raise ValueError(f"no gains: {reason.advice if tuner == 'autotune' else OUT_OF_RANGE}")
    return _scene.gains_of_rule(state, found["results"])


def tune(fit: Fit, rule: str = "PI", rate: Optional[float] = None, sensor: Optional[Sensor] = None,
         actuator: Optional[Actuator] = None, robustness: Union[str, int, None] = None, tuner: str = "autotune",
         calm: Optional[float] = None) -> Loop:
    """The Loop with the gains of a rule for a Fit.

    `rule` is PI or PID, with a `robustness` of quick, safe (if none is said), calm or 8..64, as a
    tuner finds them in its experiment on the fitted plant: `tuner` is autotune, which swings it about
    the setpoint, or reaction, which heats it up from rest towards the setpoint. Or it is SIMC,
    Skogestad's, with a loop `calm` times as slow as by the rule; if that is not said, the fit's.
    `sensor`, `actuator` and `rate` are your hardware's; u of the fit is in the actuator's units, or
    with no actuator a part of full drive. Without a rate it is a tidy one, 16 to 40 steps in the dead
    time and the lags together, and the Loop shows it. The heat-up takes full output, or if that goes
    too far a half, a quarter or an eighth. ValueError, with what to do, where the rule has no gains.
    """
    if not isinstance(fit, Fit):
        raise TypeError(f"fit = {fit!r} is refused: a fixpid.Fit is wanted")
    if fit.refused is not None:
        raise ValueError(fit.refused)
    if rule not in ("PI", "PID", "SIMC"):
        raise ValueError(f"rule = {rule!r} is refused: PI, PID and SIMC are legal")
    robust, calm = _robustness(rule, robustness, calm, fit)
    if tuner not in TUNERS:
        raise ValueError(f"tuner = {tuner!r} is refused: {' and '.join(TUNERS)} are legal")
    if actuator is None and max(map(abs, fit.u)) > 1:
        raise ValueError(f"actuator is missing: u of the fit goes to {max(map(abs, fit.u)):g}, and without an actuator it is a part "
                         "of full drive, up to 1")
    given = Actuator(0, 1000, full=1.0) if actuator is None else actuator
    state = _scene_of(fit, rate, sensor, given)
    state.update(ROBUSTNESS=robust, rule="PI" if rule == "SIMC" else rule)
    state = _scene.within_reason(with_plant(state, calm))
    try:
        if rule != "SIMC":
            state.update(_tuned(state, rule, robust, tuner))
        loop = Loop(state, given, fit)
    except ValueError as why:
        if not fit._apart:
            raise
        raise ValueError(f"{str(why).rstrip('.')}. {fit._apart[0]}") from None
    if loop.metrics["settled"] is None:
        loop.advice.insert(0, f"Not settled within {state['events'][0]['at']:g} s at rate = {state['RATE']:g}: another rate or "
                           "rule may be quicker.")
    return loop
