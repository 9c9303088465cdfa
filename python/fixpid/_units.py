# SPDX-License-Identifier: MIT
"""What a count is in real units: the sensor's, and the actuator's."""
import math
from dataclasses import dataclass
from typing import Any, Optional

from ._core import numpy


def number(name: str, value: Any) -> float:
    """A finite float; who passes another one is told which."""
    try:
        found = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} = {value!r} is refused: a number is wanted") from None
    if not math.isfinite(found):
        raise ValueError(f"{name} = {value} is refused: it is not finite")
    return found


def pair(name, value):
    """Two finite floats, the first below the second."""
    try:
        low, high = value
    except (TypeError, ValueError):
        raise TypeError(f"{name} = {value!r} is refused: a pair is wanted, lowest and highest") from None
    low, high = number(f"{name}[0]", low), number(f"{name}[1]", high)
    if low >= high:
        raise ValueError(f"{name} = ({low:g}, {high:g}) is refused: the first is not below the second")
    return low, high


def numbers(name, values, low=-math.inf, high=math.inf):
    """Finite floats from low to high, one or an array of them (a list, without numpy); who passes
    another one is told which."""
    if not hasattr(values, "__iter__"):
        found = number(name, values)
        if not low <= found <= high:
            raise ValueError(f"{name} = {found:g} is refused: {low:g} to {high:g} is legal here")
        return found
    if numpy is None:
        return [numbers(f"{name}[{at}]", value, low, high) for at, value in enumerate(values)]
    try:
        array = numpy.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise TypeError(f"{name} is refused: an array of numbers is wanted") from None
    for at in numpy.flatnonzero(~(numpy.isfinite(array) & (array >= low) & (array <= high)))[:1]:
        numbers(f"{name}[{at}]", array.flat[at], low, high)
    return array


def nearest(value, low, high):
    """The nearest whole number from low to high; for an array, an array."""
    if hasattr(value, "dtype"):
        return numpy.floor(numpy.clip(value, low, high) + 0.5).astype("int16")
    return math.floor(min(max(value, low), high) + 0.5)


@dataclass(frozen=True)
class Sensor:
    """A converter: count 0 is `low`, and its last count is `high`, in units of the measurement."""

    low: float = 0.0
    high: float = 100.0
    bits: int = 12
    unit: str = ""

    def __post_init__(self) -> None:
        pair("(low, high)", (self.low, self.high))
        if self.bits not in range(6, 16):
            raise ValueError(f"bits = {self.bits!r} is refused: 6..15 are wanted")

    @property
    def top(self) -> int:
        """The last count."""
        return 2**self.bits - 1

    @property
    def unit_per_count(self) -> float:
        """Units of a count."""
        return (self.high - self.low) / self.top

    def counts(self, value: Any) -> Any:
        """The nearest count; what is beyond the range is its end."""
        return nearest((value - self.low) / (self.high - self.low) * self.top, 0, self.top)

    def units(self, count: Any) -> Any:
        """What a count stands for."""
        return self.low + count * self.unit_per_count


@dataclass(frozen=True)
class Actuator:
    """Counts from `lowest` to `highest`; full drive, the one farther from 0, is `full` units,
    such as 100 for percent. Without `full`, a unit is a count."""

    lowest: int = 0
    highest: int = 1000
    full: Optional[float] = None
    unit: str = ""

    def __post_init__(self) -> None:
        for name in ("lowest", "highest"):
            value = getattr(self, name)
            if value not in range(-32768, 32768):
                raise ValueError(f"{name} = {value!r} is refused: a whole number of -32768..32767 is wanted")
        pair("(lowest, highest)", (self.lowest, self.highest))
        if self.full is not None and not number("full", self.full) > 0:
            raise ValueError(f"full = {self.full} is refused: it is not above 0")

    @property
    def most(self) -> int:
        """Counts of full drive."""
        return max(self.highest, -self.lowest)

    @property
    def unit_per_count(self) -> float:
        """Units of a count."""
        return 1.0 if self.full is None else self.full / self.most

    def counts(self, value: Any) -> Any:
        """The nearest count within the range."""
        return nearest(value / self.unit_per_count, self.lowest, self.highest)

    def units(self, count: Any) -> Any:
        """What a count stands for: the count itself where a unit is one."""
        return count if self.full is None else count * self.unit_per_count
