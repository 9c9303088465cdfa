# SPDX-License-Identifier: MIT
"""The general-purpose controller, in counts as C has it and in real units."""
import math
from typing import Any, Dict, Optional, Tuple

from . import _nouns
from ._core import accept, each, ffi, lib, new
from ._nouns import PID_FILTER_MAX, PID_KD_MAX, PID_KI_MAX, PID_KP_MAX, PID_MANUAL
from ._units import Actuator, Sensor, nearest, number, numbers, pair

REAL = ("kp", "ki", "kd", "rate (steps per second)", "output_limits", "setpoint", "sensor", "actuator", "filter",
        "setpoint_weight", "integral_limits")
CONFIG = ("gains", "output_min", "output_max", "integral_min", "integral_max", "setpoint_weight_q8")


def _folded(name, value, scaled, least, most):
    """A gain as its integer, rounded half up, or a ValueError that says between which."""
    if not (value == 0 or least <= scaled < most + 0.5):
        reverse = ": for an output that falls to raise the measurement, set reverse" if value < 0 else ""
        factor = value / scaled if scaled else 1.0
        raise ValueError(f"{name} = {value:g} is refused{reverse}: 0 and "
                         f"{least * factor:.6g} to {most * factor:.6g} are legal here")
    return int(scaled + 0.5)


def pid_gains(kp: float, ki: float = 0.0, kd: float = 0.0, rate: float = 1.0, filter: int = 0) -> Dict[str, int]:
    """What the macro FIXPID_PID_GAINS makes of gains in real units: the field `gains`."""
    kp, ki, kd, rate = (number(*one) for one in (("kp", kp), ("ki", ki), ("kd", kd), ("rate", rate)))
    if not rate > 0:
        raise ValueError(f"rate = {rate:g} is refused: it is not above 0")
    if filter not in range(PID_FILTER_MAX + 1):
        raise ValueError(f"filter = {filter!r} is refused: 0..{PID_FILTER_MAX} are legal")
    return {"kp_q8": _folded("kp", kp, kp * 256.0, 0.5, PID_KP_MAX),
            "ki_q24": _folded("ki", ki, ki * 16777216.0 / rate, 8.0, PID_KI_MAX),
            "kd_q8": _folded("kd", kd, kd * 256.0 * rate / (1 << filter), 0.5, PID_KD_MAX),
            "derivative_filter": int(filter)}


class Pid(_nouns.Pid):
    """The general-purpose controller of fixpid_pid.h, in real units:

        pid = fixpid.Pid(kp=2, ki=0.5, rate=10, output_limits=(0, 255), setpoint=700)
        output = pid(measurement)  # once per sample period, `rate` times a second

    With a `sensor` and an `actuator` the gains, the setpoint, the measurement and the output
    are in their units; else they are counts. Further keywords, in these units: setpoint_weight
    (0 to 1), filter (of the derivative, 0..7), integral_limits, reverse, derivative_on_error. Without a setpoint it is 0, or the sensor's end
    that is nearest to 0.

    Without kp it takes the fields of C instead: `gains`, as pid_gains makes them, output_min,
    output_max and so on, and a `rate` if `tunings` are asked for. The verbs of C, step, track
    and the others, always take counts.
    """

    def __init__(self, *, kp: Optional[float] = None, ki: float = 0.0, kd: float = 0.0, rate: Optional[float] = None,
                 output_limits: Optional[Tuple[float, float]] = None, setpoint: Optional[float] = None,
                 sensor: Optional[Sensor] = None, actuator: Optional[Actuator] = None, filter: int = 0, setpoint_weight: float = 1.0,
                 integral_limits: Optional[Tuple[float, float]] = None, **config: Any) -> None:
        known = dict(ffi.typeof("struct fixpid_pid_config").fields)
        for name in config:
            if name not in known:
                raise TypeError(f"there is no {name!r}; there are {', '.join(REAL)}; or in counts {', '.join(known)}")
        for name, kind, given in (("sensor", Sensor, sensor), ("actuator", Actuator, actuator)):
            if given is not None and not isinstance(given, kind):
                raise TypeError(f"{name} = {given!r} is refused: a fixpid.{kind.__name__} is wanted")
        self.sensor, self.actuator = sensor, actuator
        self.rate = None if rate is None else number("rate", rate)
        self.setpoint_weight, self.filter = setpoint_weight, filter
        self.setpoint = min(max(0.0, self._reach[0]), self._reach[1]) if setpoint is None else setpoint
        self._tunings = None
        if kp is not None:
            config = self._real(kp, ki, kd, output_limits, integral_limits, config)
        elif "gains" not in config and (ki or kd):
            raise TypeError("kp is missing")
        super().__init__(**config)

    def _real(self, kp, ki, kd, output_limits, integral_limits, config):
        """The fields of C that these real units come to."""
        mixed = sorted(set(config) & set(CONFIG))
        if mixed:
            raise TypeError(f"{mixed[0]} is refused together with kp: it is a field of C")
        if self.rate is None:
            raise TypeError("rate is missing: steps per second")
        if output_limits is None and self.actuator is None:
            raise TypeError("output_limits are missing: the lowest and the highest output")
        self._tunings = tuple(number(*one) for one in (("kp", kp), ("ki", ki), ("kd", kd)))
        weight = number("setpoint_weight", self.setpoint_weight)
        on_measurement = weight == 0
        weight_q8 = math.floor(weight * 256 + 0.5)
        if not (on_measurement or 1 <= weight_q8 <= 256):
            raise ValueError(f"setpoint_weight = {weight:g} is refused: 0 to 1 is legal")
        low, high = self._ends("output_limits", output_limits) if output_limits is not None else \
            (self.actuator.lowest, self.actuator.highest)
        config = {"gains": self._gains(), "output_min": low, "output_max": high,
                  "setpoint_weight_q8": 0 if on_measurement else weight_q8,
                  "proportional_on_measurement": on_measurement, **config}
        if integral_limits is not None:
            config["integral_min"], config["integral_max"] = self._ends("integral_limits", integral_limits)
        return config

    # ---- counts and units ----

    @property
    def counts_per_unit(self) -> float:
        """What a gain in real units is multiplied by: output counts per measurement count."""
        per_sensor = 1.0 if self.sensor is None else self.sensor.unit_per_count
        return per_sensor / (1.0 if self.actuator is None else self.actuator.unit_per_count)

    def _gains(self):
        """The integers of the tunings. What is refused is named with its value in real units."""
        factor = self.counts_per_unit
        try:
            return pid_gains(*(value * factor for value in self._tunings), self.rate, self.filter)
        except ValueError as why:
            if factor == 1:
                raise
            given = ", ".join(f"{name} = {value:g}" for name, value in zip(("kp", "ki", "kd"), self._tunings))
            raise ValueError(f"{given} in real units; in output counts per measurement count {why}") from None

    def _ends(self, name, limits):
        per_count = 1.0 if self.actuator is None else self.actuator.unit_per_count
        low, high = (math.floor(value / per_count + 0.5) for value in pair(name, limits))
        if low < -32768 or high > 32767:
            raise ValueError(f"{name} = {tuple(limits)} is refused: {low}..{high} counts are beyond 16 bits")
        return low, high

    def _counts(self, value):
        """A number of the measurement, or an array or list of them, in counts."""
        if isinstance(value, list):
            return list(map(self._counts, value))
        return nearest(value, -32768, 32767) if self.sensor is None else self.sensor.counts(value)

    def _driven(self, counts):
        return counts if self.actuator is None else self.actuator.units(counts)

    # ---- in real units ----

    @property
    def setpoint(self) -> float:
        """What the next call is to reach; what the sensor never shows is refused."""
        return self._setpoint

    @setpoint.setter
    def setpoint(self, setpoint: float) -> None:
        self._setpoint = numbers("setpoint", number("setpoint", setpoint), *self._reach)
        self._wanted = self._counts(self._setpoint)

    @property
    def _reach(self):
        return (-32768.0, 32767.0) if self.sensor is None else (self.sensor.low, self.sensor.high)

    def __call__(self, measurement: float, setpoint: Optional[float] = None) -> float:
        """One step, once per sample period: the output for this measurement."""
        if setpoint is not None and setpoint != self._setpoint:
            self.setpoint = setpoint
        return self._driven(self.step(self._wanted, self._counts(number("measurement", measurement))))

    def run(self, setpoints: Any, measurements: Any) -> Any:
        """A call for each element of arrays or lists: the outputs, as an array if there is
        numpy. The last setpoint stays."""
        wanted, measured = numbers("setpoints", setpoints, *self._reach), numbers("measurements", measurements)
        outputs = each("fixpid_pid_step", self.c, (self._counts(wanted), self._counts(measured)))
        while hasattr(wanted, "__iter__") and len(wanted):
            wanted = wanted[-1]
        if not hasattr(wanted, "__iter__"):
            self.setpoint = float(wanted)
        return list(map(self._driven, outputs)) if isinstance(outputs, list) else self._driven(outputs)

    @property
    def tunings(self) -> Tuple[float, float, float]:
        """kp, ki and kd in real units; they may be set, and then hold from the next step on."""
        if self._tunings is None:
            if self.rate is None:
                raise ValueError("the tunings need a rate: Pid(..., rate=steps per second)")
            gains = {**dict.fromkeys(("kp_q8", "ki_q24", "kd_q8", "derivative_filter"), 0),
                     **self._said[1].get("gains", {})}
            factor = self.counts_per_unit
            self._tunings = (gains["kp_q8"] / 256 / factor, gains["ki_q24"] / 2**24 * self.rate / factor,
                             gains["kd_q8"] / 256 / self.rate * 2**gains["derivative_filter"] / factor)
        return self._tunings

    @tunings.setter
    def tunings(self, tunings: Tuple[float, float, float]) -> None:
        try:
            kp, ki, kd = tunings
        except (TypeError, ValueError):
            raise TypeError(f"tunings = {tunings!r} is refused: kp, ki and kd are wanted") from None
        if self.rate is None:
            raise ValueError("the tunings need a rate: Pid(..., rate=steps per second)")
        before, self._tunings = self._tunings, tuple(number(*one) for one in (("kp", kp), ("ki", ki), ("kd", kd)))
        now = self._tunings
        try:
            self.set_gains(**self._gains())
        except ValueError:
            self._tunings = before
            raise
        self._tunings = now

    def set_gains(self, **gains: int) -> None:
        """New gains for the next step, as pid_gains makes them. What is not named stays."""
        gains = {**self._said[1].get("gains", {}), **gains}
        accept(lib.fixpid_pid_set_gains(self.c, new("pid_gains", gains)),
               ", ".join(f"{name} = {value}" for name, value in gains.items()))
        self._said = ((), {**self._said[1], "gains": gains})
        self._tunings = None

    def state(self) -> bytes:
        """All that the next step depends on besides the configuration, as bytes."""
        state = ffi.new("uint8_t[]", lib.FIXPID_PID_STATE_SIZE)
        lib.fixpid_pid_state(self.c, state)
        return bytes(state)

    def restore(self, state: bytes) -> None:
        """Goes on from what `state` returned, of a controller with the same configuration."""
        if len(state) != lib.FIXPID_PID_STATE_SIZE:
            raise ValueError(f"a state has {lib.FIXPID_PID_STATE_SIZE} bytes, not {len(state)}")
        accept(lib.fixpid_pid_restore(self.c, ffi.new("uint8_t[]", list(state))), "the state")

    @property
    def output_limits(self) -> Tuple[float, float]:
        """The lowest and the highest output; they may be set."""
        return self._driven(self.c.output_min), self._driven(self.c.output_max)

    @output_limits.setter
    def output_limits(self, limits: Tuple[float, float]) -> None:
        low, high = self._ends("output_limits", limits)
        self.set_limits(low, high)
        self._said = ((), {**self._said[1], "output_min": low, "output_max": high})

    @property
    def components(self) -> Tuple[float, float, float]:
        """The proportional, integral and derivative terms of the last step, as outputs."""
        per_count = 1.0 if self.actuator is None else self.actuator.unit_per_count
        return (self.proportional() / 256 * per_count, self.integral() / 65536 * per_count,
                self.derivative() / 256 * per_count)

    @property
    def auto_mode(self) -> bool:
        """False while the output is held by hand. Setting it makes no bump."""
        return not self.flags() & PID_MANUAL

    @auto_mode.setter
    def auto_mode(self, enabled: bool) -> None:
        self.set_auto_mode(enabled)

    def set_auto_mode(self, enabled: bool, last_output: Optional[float] = None) -> None:
        """Automatic, from `last_output` on if it is given; or by hand, at `last_output`, or
        at what the last step returned."""
        if last_output is not None:
            per_count = 1.0 if self.actuator is None else self.actuator.unit_per_count
            held = math.floor(min(max(number("last_output", last_output) / per_count, -32768), 32767) + 0.5)
        if not enabled:
            self.set_manual(self.output() if last_output is None else held)
            return
        if last_output is not None:
            self.seed(held)
        self.set_auto()

    def __repr__(self) -> str:
        if self._tunings is None:
            return super().__repr__()
        kp, ki, kd = self._tunings
        config = {"kp": kp, "ki": ki, "kd": kd, "rate": self.rate, "output_limits": self.output_limits,
                  "setpoint": self.setpoint}
        config.update({name: getattr(self, name) for name, usual in (
            ("sensor", None), ("actuator", None), ("filter", 0), ("setpoint_weight", 1.0))
            if getattr(self, name) != usual})
        config.update({name: True for name in ("reverse", "derivative_on_error") if self._said[1].get(name)})
        low, high = (self._said[1].get(name, 0) for name in ("integral_min", "integral_max"))
        if (low, high) != (0, 0):
            config["integral_limits"] = self._driven(low), self._driven(high)
        return f"Pid({', '.join(f'{name}={value!r}' for name, value in config.items())})"
