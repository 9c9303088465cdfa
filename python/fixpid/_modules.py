# SPDX-License-Identifier: MIT
"""What stands beside the controllers: the tuners, tables, guards, gains and records."""
import enum
import operator
import textwrap
from typing import Any, Callable, Dict, Iterable, Optional, Tuple, Union

from . import _headers, _nouns
from ._core import accept as _accept, each, ffi, fields_of as _fields, lib, new as _new


class Cause(enum.IntEnum):
    """An enum of C, whose members' `advice` is what the header says: what it is, and what to do."""

    advice: str


def _causes(name: str) -> Any:
    prefix = f"FIXPID_{name.split('_')[0].upper()}_"
    made = Cause("".join(map(str.capitalize, name.split("_"))), {
        one[len(prefix):]: value for value, one in sorted(ffi.typeof(f"enum fixpid_{name}").elements.items())}, module=__name__)
    for member in made:
        member.advice = _headers.FIELDS[f"fixpid_{name}"][prefix + member.name]
    return made


AutotuneState, AutotuneCause, ReactionState = map(_causes, ("autotune_state", "autotune_cause", "reaction_state"))


class Autotune(_nouns.Autotune):
    """Finds gains for Pid on the plant itself: fixpid_autotune.h.

    The rules are fixpid.AUTOTUNE_PI and AUTOTUNE_PID; for robustness_q4 there are three
    words, AUTOTUNE_QUICK, AUTOTUNE_SAFE and AUTOTUNE_CALM.
    """

    def status(self) -> Cause:
        """An AutotuneState, whose `advice` says what to do about it."""
        return AutotuneState(lib.fixpid_autotune_status(self.c))

    def progress(self) -> Dict[str, int]:
        """How far it is: phase, done, expected and period, as a dictionary."""
        stage = _new("autotune_stage", {})
        lib.fixpid_autotune_progress(self.c, stage)
        return _fields(stage[0])

    def model(self) -> Optional[Dict[str, Any]]:
        """The process that was found, as a dictionary, or None."""
        process = _new("autotune_process", {})
        return _fields(process[0]) if lib.fixpid_autotune_model(self.c, process) else None

    def result(self, rule: int, robustness_q4: int = lib.FIXPID_AUTOTUNE_SAFE, **config: Any) -> Optional[Dict[str, Any]]:
        """What Pid takes, by a rule: the fields of `config`, as the output's range, with the
        gains that were found. None if there are none: `reason` says why."""
        config = _new("pid_config", config)
        found = lib.fixpid_autotune_result(self.c, rule, robustness_q4, config)
        return _fields(config[0]) if found else None

    def reason(self, rule: int, robustness_q4: int = lib.FIXPID_AUTOTUNE_SAFE) -> Cause:
        """Why there is no result: an AutotuneCause, whose `advice` says what to do about it."""
        return AutotuneCause(lib.fixpid_autotune_reason(self.c, rule, robustness_q4))

    def pack(self) -> bytes:
        """A record of the experiment, as bytes. ValueError while it runs."""
        record = _new("autotune_record", {})
        if not lib.fixpid_autotune_pack(self.c, record):
            raise ValueError("there is no record before the experiment is over")
        return bytes(record.bytes)

    @classmethod
    def unpack(cls, record: Union[str, bytes]) -> "Autotune":
        """The experiment as it ended, maybe on a chip: from a record, as bytes or as
        hexadecimal text with any white space."""
        if isinstance(record, str):
            record = bytes.fromhex("".join(record.split()))
        if len(record) != lib.FIXPID_AUTOTUNE_RECORD_SIZE:
            raise ValueError(f"a record has {lib.FIXPID_AUTOTUNE_RECORD_SIZE} bytes, not {len(record)}")
        if record[0] != lib.FIXPID_AUTOTUNE_RECORD_VERSION:
            raise ValueError(f"version {record[0]} of a record, not {lib.FIXPID_AUTOTUNE_RECORD_VERSION}")
        tuner = cls.__new__(cls)
        tuner._said = (), {}
        tuner.c = _new("autotune", {})
        if not lib.fixpid_autotune_unpack(tuner.c, _new("autotune_record", {"bytes": list(record)})):
            raise ValueError("a byte of the record is wrong")
        return tuner


class Reaction(_nouns.Reaction):
    """Finds gains for Pid from the first minutes of a heat-up: fixpid_reaction.h.

    The rules are fixpid.REACTION_PI and REACTION_PID; for robustness_q4 there are three
    words, REACTION_QUICK, REACTION_SAFE and REACTION_CALM.
    """

    def status(self) -> Cause:
        """A ReactionState, whose `advice` says what to do about it."""
        return ReactionState(lib.fixpid_reaction_status(self.c))

    def model(self) -> Optional[Dict[str, Any]]:
        """The process that was found, as a dictionary, or None."""
        process = _new("reaction_process", {})
        return _fields(process[0]) if lib.fixpid_reaction_model(self.c, process) else None

    def result(self, rule: int, robustness_q4: int = lib.FIXPID_REACTION_SAFE) -> Optional[Dict[str, int]]:
        """The gains that Pid takes, by a rule. None if there are none: it has not measured, or
        one of them is out of its range. They want a setpoint_weight_q8 of 128."""
        gains = _new("pid_gains", {})
        return _fields(gains[0]) if lib.fixpid_reaction_result(self.c, rule, robustness_q4, gains) else None


class Table:
    """A curve from points: fixpid_table.h. `points` are pairs (x, y) of integers, whose x rise."""

    error: Optional[float] = None  # where `table` has found the points: the worst one, in counts

    def __init__(self, points: Iterable[Tuple[int, int]]) -> None:
        self.points = tuple((operator.index(x), operator.index(y)) for x, y in points)
        self._points = ffi.new("struct fixpid_table_point[]", self.points)
        self._table = _new("table", {"points": self._points, "count": len(self.points)})
        _accept(lib.fixpid_table_valid(self._table),
                f"points = {self.points}, fewer than 2 or whose x do not rise,")

    def __repr__(self) -> str:
        return f"Table({list(self.points)})"

    def __reduce__(self):
        return Table, (self.points,), {"error": self.error}

    def at(self, x: Any) -> Any:
        """The curve at x; of an array or a list, an array."""
        if hasattr(x, "__iter__"):
            return each("fixpid_table_at", self._table, (x,))
        return lib.fixpid_table_at(self._table, operator.index(x))

    def c(self, name: str) -> str:
        """The table in C: the array, and what fixpid_table_at takes."""
        points = textwrap.wrap(", ".join(f"{{{x},_{y}}}" for x, y in self.points), 76)
        error = "" if self.error is None else f", within {self.error:.4g} counts"
        return "\n".join([
            f"// {len(self.points)} points for {self.points[0][0]} to {self.points[-1][0]}{error}.",
            f"// On an AVR write PROGMEM after {name}_points[], and call fixpid_table_at_P.",
            f"static const struct fixpid_table_point {name}_points[] = {{",
            *(f"    {line.replace('_', ' ')}" for line in points), "};",
            f"static const struct fixpid_table {name} = FIXPID_TABLE({name}_points);", ""])


def table(function: Callable[[int], float], first: int, last: int, points: Optional[int] = None,
          error: Optional[float] = None) -> Table:
    """The Table that follows a function best: 16 points, so many, or as few as an error allows.

    `function(x)` is the value in counts, as a float, for all whole x from first to last. The
    result's `error` is the largest distance from it over all of them. The points need not lie on
    the function. ValueError where no table of 255 points does it, or a value is not of 16 bits.
    """
    first, last = operator.index(first), operator.index(last)
    _accept(-32768 <= first < last <= 32767, f"first = {first}, last = {last}")
    _accept(points is None or error is None, f"points = {points} together with error = {error}")
    fit = ffi.new("struct fit *", {"first": first, "last": last})
    fit.f[0:last - first + 1] = [float(function(x)) for x in range(first, last + 1)]
    _accept(lib.fit_within(fit, error) if error is not None
            else lib.fit_least(fit, 16 if points is None else operator.index(points)),
            f"points = {points}, error = {error}: a table of 2 to 255 points for this function")
    found = Table((point.x, point.y) for point in fit.points[0:fit.count])
    found.error = fit.error
    return found


def sat16(value: int) -> int:
    """A number of 32 bits, limited to -32768..32767: a setpoint or a measurement."""
    return lib.fixpid_sat16(operator.index(value))


def slew_rate(counts_per_second: float, steps_per_second: float) -> int:
    """What the macro FIXPID_SLEW_RATE makes of it."""
    _accept(steps_per_second > 0, f"steps_per_second = {steps_per_second}")
    rate = counts_per_second * 65536.0 / steps_per_second
    _accept(counts_per_second == 0 or 0.5 <= rate < 4294967295.5, f"counts_per_second = {counts_per_second}")
    return int(rate + 0.5)


def guard_config(model: Dict[str, Any], output_min: int, output_max: int, **config: int) -> Dict[str, int]:
    """What Guard takes for a plant, by fixpid_guard_from_model.

    `model` is a dictionary as Autotune.model gives it, maybe with `bands`, and `config` is all
    other fields: measurement_min, measurement_max, reach_min, reach_max, reverse, and band,
    patience or noisy in place of the rule's. ValueError where the rule has no answer: the plant is too
    slow for a patience of 16 bits, or there is no such guard.
    """
    known = {name: model[name] for name, _ in ffi.typeof("struct fixpid_guard_model").fields if name in model}
    found = _new("guard_config", {"output_min": output_min, "output_max": output_max})
    _accept(lib.fixpid_guard_from_model(found, _new("guard_model", {**known, "band": config.get("band", 0)})),
            f"a guard of {known} and an output of {output_min} to {output_max}")
    chosen = {"band": found.band, "patience": found.patience, "noisy": found.noisy,
              "output_min": output_min, "output_max": output_max, **config}
    _accept(lib.fixpid_guard_init(_new("guard", {}), _new("guard_config", chosen)),
            ", ".join(f"{name} = {value}" for name, value in chosen.items()))
    return chosen


def gains_from_milli(kp: int, ki: int, kd: int, rate_milli: int, filter: int = 0) -> Dict[str, int]:
    """Gains from thousandths, as fixpid_gains.h has them."""
    gains, milli = _new("pid_gains", {}), _new("gains_milli", {"kp": kp, "ki": ki, "kd": kd})
    _accept(lib.fixpid_gains_from_milli(gains, milli, rate_milli, filter),
            f"kp = {kp}, ki = {ki}, kd = {kd}, rate_milli = {rate_milli} or filter = {filter}")
    return _fields(gains[0])


def gains_to_milli(gains: Dict[str, int], rate_milli: int) -> Dict[str, int]:
    """The way back."""
    milli = _new("gains_milli", {})
    _accept(lib.fixpid_gains_to_milli(milli, _new("pid_gains", gains), rate_milli),
            f"{gains} at rate_milli = {rate_milli}")
    return _fields(milli[0])


def record_pack(**config: Any) -> bytes:
    """A configuration of Pid as bytes: fixpid_record.h."""
    record = _new("record", {})
    lib.fixpid_record_pack(record, _new("pid_config", config))
    return bytes(record.bytes)


def record_unpack(record: bytes) -> Dict[str, Any]:
    """The configuration of a record; ValueError for another version or a wrong check."""
    config = _new("pid_config", {})
    if len(record) != lib.FIXPID_RECORD_SIZE:
        raise ValueError(f"a record has {lib.FIXPID_RECORD_SIZE} bytes, not {len(record)}")
    _accept(lib.fixpid_record_unpack(_new("record", {"bytes": list(record)}), config), "the record")
    return _fields(config[0])
