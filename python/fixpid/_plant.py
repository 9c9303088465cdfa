# SPDX-License-Identifier: MIT
"""What is controlled, in real units."""
from dataclasses import dataclass
from typing import Any, Dict

from . import _scene
from ._units import number

KINDS = {"lags": "LAGS", "oscillator": "OSCILLATOR", "integrator": "INTEGRATOR", "oven": "OVEN"}
BOUNDS = {"gain": (-1e9, 1e9), "lag": (0, 1e9), "dead": (0, 1e9), "lag2": (0, 1e9), "start": (-1e9, 1e9),
          "damping": (1e-3, 100)}


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

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ValueError(f"kind = {self.kind!r} is refused: {', '.join(KINDS)} are legal")
        for name, (low, high) in BOUNDS.items():
            if not low <= number(name, getattr(self, name)) <= high:
                raise ValueError(f"{name} = {getattr(self, name)} is refused: {low:g} to {high:g} is legal")
        if (self.lag == 0 and self.kind != "integrator") or (self.lag2 == 0 and self.kind == "oven"):
            raise ValueError(f"lag = {self.lag}, lag2 = {self.lag2} is refused: {self.kind} needs it above 0")

    def _state(self) -> Dict[str, Any]:
        return {"PLANT": _scene.PLANT[KINDS[self.kind]], "GAIN": self.gain, "T1": self.lag, "T2": self.lag2,
                "DEAD": self.dead, "START": self.start, "DAMPING": self.damping, "unit": self.unit}
