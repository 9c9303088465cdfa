# SPDX-License-Identifier: MIT
"""A plant of a recording. sim/identify finds it; here columns become lines for it, and what it
found becomes a Fit."""
import math
import threading
from datetime import timedelta
from typing import Any, Dict, List, Optional, Tuple

from ._format import digits
from ._library import ffi, lib
from ._plant import Plant
from ._units import number

MOST_MS, UNSTABLE = 2.2, 1e9  # as identify.h has them
APART = 100.0  # seconds between lines, from which the unit may be another
UNITS = {"us": 1e-6, "ms": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0}
# What each kind has besides gain and dead time, in the order of enum identify_kind.
KINDS = {"first": ("lag",), "second": ("lag", "lag2"), "integrating": ("lag2",), "ringing": ("lag", "damping")}
PLANTS = {"integrating": "integrator", "ringing": "oscillator"}  # others are lags
STARTS = ("settled", "cold", "moving", "drifting")  # enum identify_start
STARTED = {"cold": "The output is taken to have been off before the first line.",
           "moving": "The measurement was on its way when the recording began, which the fit allows for.",
           "drifting": "The measurement drifts, which the fit allows for."}

HINTS = {lib.IDENTIFY_DRIVE_STANDS: " Then say before=0.",
         lib.IDENTIFY_UNSURE_START: " If it stood still until the first line, say with which output: before=0 if it was off."}

_lock = threading.Lock()  # sim/identify has one memory


def verdict_of(own: float, each: List[float]) -> Tuple[str, Optional[str]]:
    """What is said of a loop with this Ms whose Ms with each plant that the recording allows are
    these, in order, and infinite where it is unstable; and the warning, or None."""
    most, above = each[9 * len(each) // 10], sum(one > MOST_MS for one in each)
    said = (f"{digits(each[0])} to {digits(most)} for nine of ten plants" if math.isfinite(most)
            else "unstable for more than one of ten plants")
    text = f"{f'Ms {digits(own)}' if math.isfinite(own) else 'unstable'}; {said} that the recording allows"
    return text, None if most <= MOST_MS else (
        f"{above} of {len(each)} plants that the recording allows have Ms above {MOST_MS} with these gains: "
        "take calmer ones, or record again.")


def _plant_of(c: Any, full: float, start: float) -> Plant:
    kind = list(KINDS)[c.kind]
    numbers = {name: getattr(c, name) for name in KINDS[kind]}
    return Plant(gain=c.gain * full, dead=c.dead, start=start, kind=PLANTS.get(kind, "lags"), **numbers)


def _verdict_of_simc(plant: Any, calm: float, plants: Any) -> str:
    gains, step = ffi.new("double[3]"), (plant.lag + plant.lag2 + plant.dead) / 40
    lib.identify_simc(ffi.addressof(plant), step, calm, gains)

    def ms(one: Any) -> float:
        found: float = lib.identify_ms(ffi.addressof(one), step, gains)
        return found if found < UNSTABLE else math.inf

    return verdict_of(ms(plant), sorted(map(ms, plants)))[0]


def sentence(reason: int) -> str:
    """Why a recording is refused, and what to do; nothing if it is not."""
    said: str = ffi.string(lib.verdict_sentence(reason)).decode()
    return said


class Fit:
    """A plant of a recording: `kind` is first (one lag), second (two), integrating or ringing. It
    has gain, of a unit of the output; lag, lag2 and damping, of which those that its kind has not
    are None; and dead, the dead time. The period of a ringing one is 2 pi lag. `rest` is the
    measurement without an output; of an integrating one, that of the first line. `sd` has the
    standard deviation of each of these numbers, and `plants` are those that the recording allows.

    `verdict` is the Ms of a loop with SIMC's gains, and its range over these plants. `calm` is how
    much slower than by the rule such a loop has to be: 1, 2 or 4, and 0 where none is safe.
    `refused` says why the fit is not to be used, or is None. `error` is what the model leaves
    on average, in units, `part` the same as a part of what the output moved, and `r2` is 1 where it
    explains all. `start` is how the plant was before the output moved: settled, cold, moving or
    drifting. `models` has all four kinds, and `notes` says what was left out and taken for granted.
    t (seconds after the first line), u and y are the recording, and `curve` is what the model makes
    of it: seconds and measurements.
    """

    kind: str
    gain: float
    lag: Optional[float]
    lag2: Optional[float]
    damping: Optional[float]
    dead: float
    rest: float
    start: str
    calm: float
    error: float
    part: float
    r2: float
    refused: Optional[str]
    verdict: str
    sd: Dict[str, float]
    models: Dict[str, "Fit"]
    notes: List[str]
    t: List[float]
    u: List[float]
    y: List[float]
    curve: Tuple[List[float], List[float]]

    def __init__(self, c: Any, c_plants: Any, curve: Tuple[List[float], List[float]], **shared: Any) -> None:
        self.curve, self._c_plants, self._c_plant = curve, bytes(ffi.buffer(c_plants)), bytes(ffi.buffer(ffi.addressof(c.plant)))
        self.models, self.t, self.u, self.y, self._apart = (shared[name] for name in ("models", "t", "u", "y", "apart"))
        self.kind, self.start = list(KINDS)[c.plant.kind], STARTS[c.start]
        self.gain, self.dead = c.plant.gain, c.plant.dead
        self.lag, self.lag2, self.damping = (getattr(c.plant, name) if name in KINDS[self.kind] else None
                                             for name in ("lag", "lag2", "damping"))
        self.rest, self.calm, self.error, self.part, self.r2 = (
            getattr(c, name) for name in ("rest", "calm", "error", "part", "r2"))
        self.refused = sentence(c.reason) or None
        # C has those of the gain and of a first number that is not lag2 as parts.
        self.sd = {"gain": c.sd_gain * abs(self.gain), "dead": c.sd_dead, **{
            name: c.sd_lag * (self.lag or 1) if i == 0 else c.sd_lag2 for i, name in enumerate(KINDS[self.kind])}}
        self.verdict = _verdict_of_simc(c.plant, self.calm or 4.0, c_plants)
        self.notes = [*self._apart, *shared["notes"], *self._notes()]
        # How it stood before the output moved: all plants begin there.
        self._driven = 0.0 if self.start == "cold" else shared["driven"]
        self._stood = self.rest + (0 if self.kind == "integrating" else self.gain * self._driven)

    def _notes(self) -> List[str]:
        notes = [STARTED[self.start]] if self.start in STARTED else []
        if self.calm > 1:
            notes.append(f"SIMC's loop is {self.calm:g} times as slow as by its rule: the recording does not tell that a "
                         "quicker one is safe.")
        if self.kind == "integrating":
            notes.append("A lag far longer than the recording would look the same, and gets the same gains.")
        return notes

    def plant(self, full: float = 1.0) -> Plant:
        """The Plant for `simulate`, which also takes the Fit itself. `full` is full output in units of
        u, such as 100 for percent: the Plant's gain is for that."""
        return _plant_of(ffi.from_buffer("struct identify_plant *", self._c_plant), full, self.rest)

    @property
    def plants(self) -> Tuple[Plant, ...]:
        """Plants of which the recording allows each as much as the next, for an output of 1 at most."""
        return tuple(_plant_of(one, 1.0, self._stood - (0 if one.kind == lib.IDENTIFY_INTEGRATING else one.gain * self._driven))
                     for one in self._allowed())

    def _allowed(self) -> List[Any]:
        """The same as C has them, by their pointers."""
        first = ffi.from_buffer("struct identify_plant[]", self._c_plants)
        return [first + i for i in range(len(first))]

    def plot(self, axes: Any = None) -> Any:
        """The recording and the model, by matplotlib. Returns its axes."""
        axes = axes_of(axes)
        axes.plot(self.t, self.y, ".", color="0.6", label="recorded")
        axes.plot(*self.curve, color="tab:blue", label=self._numbers(" s"))
        axes.set_xlabel("seconds")
        axes.set_title(f"{self.kind}: {self.refused or self.verdict}", wrap=True)
        axes.legend()
        return axes

    def _numbers(self, second: str = "") -> str:
        units = {"gain": "", "lag": second, "lag2": second, "damping": "", "dead": second}
        known = [(name, getattr(self, name), unit) for name, unit in units.items()]
        return " ".join(f"{name}={value:.4g}{unit}" for name, value, unit in known if value is not None)

    def __repr__(self) -> str:
        return f"<Fit {self.kind} {self._numbers()} rest={self.rest:.4g}: {self.refused or self.verdict}>"


def axes_of(axes: Any) -> Any:
    """These, or new ones."""
    if axes is None:
        try:
            from matplotlib import pyplot
        except ImportError:
            raise ImportError("plot() needs matplotlib: pip install fixpid[plot]") from None
        axes = pyplot.subplots(constrained_layout=True)[1]
    return axes


# ---- Columns ----


def _value(one: Any) -> float:
    """A number, also as text; what is none is nan."""
    try:
        return float(one)
    except (TypeError, ValueError):
        return math.nan


def _is_missing(one: Any) -> bool:
    """It is no time: None, a text, or what is not even equal to itself, as NaT."""
    try:
        return one is None or isinstance(one, str) or not one == one  # pylint: disable=comparison-with-itself
    except TypeError:  # pandas.NA
        return True


def _seconds(t: List[Any], unit: Optional[str]) -> Tuple[List[float], Optional[str]]:
    """Times in seconds after the first one: numbers, or what a difference of dates is. And the
    unit, which dates have."""
    first = next((one for one in t if not _is_missing(one)), 0.0)
    dates = hasattr(first - first, "total_seconds")
    stamps = type(first).__name__ == "datetime64"
    if unit is not None and (dates or stamps or unit not in UNITS):
        raise ValueError(f"unit = {unit!r} is refused: " + (
            "dates say it themselves" if dates or stamps else f"{', '.join(UNITS)} are legal"))
    if dates or stamps:
        second = type(first - first)(1, "s") if stamps else timedelta(seconds=1)
        return [math.nan if _is_missing(one) else float((one - first) / second) for one in t], "s"
    numbers = [_value(one) for one in t]
    first = next(filter(math.isfinite, numbers), 0.0)
    return [(one - first) * UNITS[unit or "s"] for one in numbers], unit


def _far_apart(t: List[float], unit: Optional[str]) -> List[str]:
    """What is said of seconds that may be milliseconds."""
    apart = sorted(after - before for before, after in zip(t, t[1:]))
    often = apart[len(apart) // 2] if apart else 0.0
    return [f'The lines are {often:.4g} s apart: if t is in milliseconds, pass unit="ms".'] * (unit is None and often >= APART)


def _rising(rows: List[Tuple[int, float, float, float]]) -> None:
    for (_, before, *_), (line, after, *_) in zip(rows, rows[1:]):
        if after < before:
            raise ValueError(f"t goes back in line {line}, from {before:g} to {after:g} s after the first line: "
                             f"fit the lines before it, [:{line}], or those from it on, [{line}:]")


def _lines(t: Any, u: Any, y: Any, at: Any, unit: Optional[str]) -> Tuple[List[List[float]], List[str], List[str]]:
    """Columns of seconds after the first line, output and measurement, without lines that are no
    numbers; notes; and what is said of lines far apart. A number as the output is a step of so
    much at the time `at`."""
    t, y, one_step = list(t), list(y), not hasattr(u, "__iter__")
    u = [number("u", u)] * len(t) if one_step else list(u)
    if not len(t) == len(u) == len(y):
        raise ValueError(f"t, u and y have {len(t)}, {len(u)} and {len(y)} elements")
    if not t:
        raise ValueError("t, u and y are empty")
    if at is not None and not one_step:
        raise ValueError(f"at = {at!r} is refused: the outputs in u say when they change")
    seconds, unit = _seconds(t if at is None else [*t, at], unit)
    if at is not None:
        moment = seconds.pop()
        u = [value if s >= moment else 0.0 for s, value in zip(seconds, u)]
    rows = [(line, s, _value(a), _value(b)) for line, (s, a, b) in enumerate(zip(seconds, u, y))]
    for name, column, numbers in zip("tuy", (t, u, y), list(zip(*rows))[1:]):
        if not isinstance(column[0], float) and not any(map(math.isfinite, numbers)):
            raise ValueError(f"{name} has no number: its first element is {column[0]!r}")
    good = [row for row in rows if all(map(math.isfinite, row))]
    _rising(good)
    notes = [f"Lines that are no numbers left out: {len(t) - len(good)}."] * (len(good) < len(t))
    begin = good[0][1] if good else 0.0
    columns = [[row[1] - begin for row in good], [row[2] for row in good], [row[3] for row in good]]
    return columns, notes, _far_apart(columns[0], unit)


def _said_of(result: Any) -> List[str]:
    notes = []
    if result.outliers:
        notes.append(f"Single values far from their neighbours left out: {result.outliers}.")
    if result.stuck_to > result.stuck_from:
        notes.append(f"The sensor stood still from {result.stuck_from:.4g} to {result.stuck_to:.4g} s, which is left out.")
    if result.assumed:
        notes.append("That the plant stood still before the output moved is taken for granted: too few lines tell.")
    return notes


def fit(t: Any, u: Any, y: Any, before: Optional[float] = None, unit: Optional[str] = None, at: Any = None,
        refuse: bool = True) -> Fit:
    """The plant of a recording, a Fit: of times, what the actuator got, and the measurement, as
    lists, arrays or pandas Series. It may have several steps, begin or end on the move, or come
    from a closed loop.

    The times may be uneven: seconds, dates, or numbers of a `unit` of us, ms, s, min or h. `before`
    says that the plant stood still with this output until the first line; without it, that is
    found out as far as the lines tell. A single number as u is a step of so much from `before`, or
    from no output, at the first time or at the time `at`. Single values far from their neighbours
    are left out. A ValueError says why there is no plant that can be used; with refuse=False the
    best one comes all the same, with the reason in `refused`, to look at it.
    """
    (t, drive, y), notes, apart = _lines(t, u, y, at, unit)
    if before is None and at is None and not hasattr(u, "__iter__"):
        before = 0.0
    columns = [ffi.new("double[]", column) for column in (t, drive, y)]
    recording = ffi.new("struct identify_recording *", {
        "lines": len(t), "t": columns[0], "u": columns[1], "y": columns[2],
        "before": 0.0 if before is None else number("before", before), "before_known": before is not None})
    result = ffi.new("struct identify_result *")
    times, values = ffi.new("double[]", lib.IDENTIFY_LINES), ffi.new("double[]", lib.IDENTIFY_LINES)
    models: Dict[str, Fit] = {}
    curves = []
    with _lock:
        lib.identify(recording, result)
        # Where there is nothing to fit, all is 0.
        fitted = result.models[1].plant.kind == 1
        for model in result.models if fitted else ():
            n = lib.identify_curve(ffi.addressof(model), times, values)
            curves.append((ffi.unpack(times, n), ffi.unpack(values, n)))
    refused = sentence(result.reason)
    if before is None:
        refused += HINTS.get(result.reason, "")
    if refused and (refuse or not fitted):
        raise ValueError(refused)
    for kind, model, curve in zip(KINDS, result.models, curves):
        models[kind] = Fit(model, result.plants, curve, models=models, t=t, u=drive, y=y, apart=apart, notes=[*notes, *_said_of(result)],
                           driven=drive[0] if before is None else before)
    return models[list(KINDS)[result.chosen]]
