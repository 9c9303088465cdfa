# SPDX-License-Identifier: MIT
"""Models of a recorded step: web/models.js in Python. A lag, two lags, an integrator and an
oscillator, each with dead time. They are fitted by least squares that far values move little,
and one is chosen, or all are refused with the reason."""
import math
from contextlib import nullcontext
from types import SimpleNamespace

from ._columns import median, thinned
from ._core import numpy
from ._format import digits, percent

FEW_POINTS = 300  # points that a search looks at first
FITS_WELL = 0.015  # residual as a part of the rise
FITS_BADLY = 0.04
SETTLED = 0.8  # the part of the rise that must be seen
SWINGS = 0.85  # what is damped more overshoots by less than 1 %

PLAIN = SimpleNamespace(exp=math.exp, cos=math.cos, sin=math.sin, minimum=min)  # numpy's, of a number

# ---- Shapes: what a step of 1 makes of a plant with gain 1, t seconds after its dead time ----
# Each is of a number and PLAIN, or of an array and numpy.


def _first(of, t, n):
    return 1 - of.exp(-t / n["T1"])


def _second(of, t, n):
    a, b = n["T1"], min(n["T2"], 0.999 * n["T1"])  # equal ones by ones that nearly are
    if b < 1e-6 * a:
        return 1 - of.exp(-t / a)
    return 1 - (a * of.exp(-t / a) - b * of.exp(-t / b)) / (a - b)


def _integrating(of, t, n):
    return t - n["T2"] * (1 - of.exp(-t / n["T2"])) if n["T2"] > 0 else t


def _ringing(of, t, n):
    fall, turn = n["damping"] / n["T1"], math.sqrt(1 - n["damping"] * n["damping"]) / n["T1"]
    return 1 - of.exp(-fall * t) * (of.cos(turn * t) + fall / turn * of.sin(turn * t))


def _ramp(of, t, n):
    return of.minimum(1, t / n["T1"])  # one that ends: it is only refused


SHAPES = {"first": _first, "second": _second, "integrating": _integrating, "ringing": _ringing, "ramp": _ramp}


def shape_at(kind, numbers, t):
    """The part of the rise that is done at t."""
    return 0.0 if t <= numbers["dead"] else SHAPES[kind](PLAIN, t - numbers["dead"], numbers)


def model_at(model, t):
    """The measurement that a model has t seconds after the step."""
    return model["start"] + model["rise"] * shape_at(model["kind"], model, t)


def _limited(x, low, high):
    return min(high, max(low, x))


def _exp(x):
    return math.exp(_limited(x, -600, 600))


def _numbers(kind, x):
    """The plant's numbers of what a search moves, any real numbers."""
    found = {"T2" if kind == "integrating" else "T1": _exp(x[0]), "dead": abs(x[1])}
    if kind == "second":
        found["T2"] = found["T1"] / (1 + _exp(_limited(x[2], -30, 30)))
    elif kind == "ringing":
        found["damping"] = 0.97 / (1 + _exp(_limited(x[2], -30, 30)))
    return found


# ---- Least squares ----


class _Points:
    """Lines with their weights: arrays where there is numpy, and lists where there is none."""

    def __init__(self, times, values):
        make = list if numpy is None else numpy.array
        self.times, self.values = make(times), make(values)
        self._weigh_by(self._ones())

    def _ones(self):
        return [1.0] * len(self.times) if numpy is None else numpy.ones(len(self.times))

    def _weigh_by(self, weights):
        """What of a line through the points does not depend on a shape."""
        self.weights = weights
        self.total = float(sum(weights) if numpy is None else weights.sum())
        self.mean, self.away = self._centred(self.values)
        self.spread = self._product(self.away, self.away)

    def shape(self, kind, numbers):
        if numpy is None:
            return [shape_at(kind, numbers, t) for t in self.times]
        return SHAPES[kind](numpy, numpy.maximum(self.times - numbers["dead"], 0), numbers)

    def projected(self, kind, numbers):
        """The start and the rise that fit these numbers best, and what is left: a weighted line
        through the points (shape, value)."""
        mx, dx = self._centred(self.shape(kind, numbers))
        xx, xy = self._product(dx, dx), self._product(dx, self.away)
        rise = xy / xx if xx > 0 else 0.0
        left = self.spread - rise * xy
        left = 0.0 if left < 0 else left
        return {"kind": kind, **numbers, "rise": rise, "start": self.mean - rise * mx,
                "error": math.sqrt(left / self.total), "r2": 1 - left / self.spread if self.spread > 0 else 0.0}

    def _centred(self, column):
        """Its weighted mean, and what it is away from it."""
        if numpy is None:
            mean = sum(w * one for w, one in zip(self.weights, column)) / self.total
            return mean, [one - mean for one in column]
        mean = float(self.weights @ column) / self.total
        return mean, column - mean

    def _product(self, a, b):
        if numpy is None:
            return sum(w * one * other for w, one, other in zip(self.weights, a, b))
        return float((self.weights * a) @ b)

    def weigh(self, model):
        """Huber's weights: what is far from the model counts by its distance, not by its square."""
        start, rise = model["start"], model["rise"]
        at = self.shape(model["kind"], model)
        left = ([abs(value - start - rise * one) for value, one in zip(self.values, at)] if numpy is None
                else abs(self.values - start - rise * at))
        far = 2.5 * 1.4826 * median(left)
        if not far > 0:
            self._weigh_by(self._ones())
        elif numpy is None:
            self._weigh_by([far / one if one > far else 1.0 for one in left])
        else:
            self._weigh_by(far / numpy.maximum(left, far))


def _lowest(f, start, sides, turns):
    """Nelder and Mead's simplex from a place, with the first sides of it."""
    def at(x):
        return f(x), x

    def value(corner):
        return corner[0]

    n = len(start)
    corners = [at(start), *(at([one + (side if k == i else 0) for k, one in enumerate(start)]) for i, side in enumerate(sides[:n]))]
    for _ in range(turns):
        corners.sort(key=value)
        best, worst = corners[0], corners[-1]
        if worst[0] - best[0] <= 1e-10 * abs(best[0]):
            break
        middle = [sum(one[1][k] for one in corners[:-1]) / n for k in range(n)]

        def along(far):
            return at([one + far * (one - worst[1][k]) for k, one in enumerate(middle)])  # pylint: disable=cell-var-from-loop

        mirrored = along(1)
        if mirrored[0] < best[0]:
            tried = min(mirrored, along(2), key=value)
        elif mirrored[0] < corners[-2][0]:
            tried = mirrored
        else:
            tried = along(0.5 if mirrored[0] < worst[0] else -0.5)
            tried = tried if tried[0] < min(mirrored[0], worst[0]) else None
        if tried is not None:
            corners[-1] = tried
        else:
            corners = [best, *(at([(x + one) / 2 for x, one in zip(corner[1], best[1])]) for corner in corners[1:])]
    return min(corners, key=value)[1]


# Where searches begin: lags as parts of the time after the step, dead times, and the third number.
DEADS = (0, 0.02, 0.06, 0.15, 0.4)
GRID = {
    "first": ((0.003, 0.01, 0.03, 0.08, 0.2, 0.5, 2), (0,)),
    "second": ((0.003, 0.01, 0.03, 0.08, 0.2, 0.5, 2), (0.1, 2.5)),
    "integrating": ((0.003, 0.03, 0.1, 0.3), (0,)),
    "ringing": ([0.002 * 1.25**i for i in range(26)], (-0.5, 1, 3)),
    "ramp": ((0.02, 0.05, 0.1, 0.2, 0.4, 0.7), (0,)),
}


def _fitted(kind, times, values, span):
    """A kind's best fit: by a grid and a search over few points, once more with the weights of
    what is left, and a last time over all."""
    few, everything = _Points(*thinned(times, values, FEW_POINTS)), _Points(times, values)
    size = 3 if kind in ("second", "ringing") else 2

    def error_of(points):
        return lambda x: points.projected(kind, _numbers(kind, x))["error"]

    lags, thirds = GRID[kind]
    places = [[math.log(lag * span), dead * span, third][:size] for lag in lags for dead in DEADS for third in thirds]
    error = error_of(few)
    found = [_lowest(error, start, [0.3, 0.03 * span, 0.5], 150) for start in sorted(places, key=error)[:3]]
    x = min(found, key=error)
    for points in (few, few, everything, everything):
        for _ in range(6):  # the start and the rise move with the weights
            points.weigh(points.projected(kind, _numbers(kind, x)))
        x = _lowest(error_of(points), x, [0.02, 0.003 * span, 0.05], 60)
    return everything.projected(kind, _numbers(kind, x))


def _noise_of(values):
    """The noise of neighbours, or what a step of the converter makes of it."""
    bends = [abs(c - 2 * b + a) for a, b, c in zip(values, values[1:], values[2:])]
    steps = [abs(b - a) for a, b in zip(values, values[1:]) if b != a] or [0]
    return max(1.4826 * median(bends) / math.sqrt(6), min(min(steps), median(steps)) / math.sqrt(12))


# ---- Which one, or none ----


def _seen_rise(model, span):
    """How far it came while it was recorded, in its unit."""
    return abs(model["rise"] * shape_at(model["kind"], model, span))


def _part(model, span):
    """What is left, as a part of the rise."""
    seen = _seen_rise(model, span)
    return model["error"] / seen if seen > 0 else math.inf


def _is_too_long(model, span):
    return model["kind"] in ("first", "second") and model["T1"] > 1.2 * (span - model["dead"])


def _chosen_of(models, span, noise, n):
    """The one that explains most; another number has to earn its place."""
    scale = max(min(_seen_rise(one, span), 1e300) for one in models)
    floor = 0.3 * noise * (0.3 * noise) + 1e-4 * scale * (1e-4 * scale)

    def score(model):
        square = model["error"] * model["error"] + floor
        return (min(n, 200) * (-math.inf if square <= 0 else math.log(square))
                + (12 if model["kind"] in ("second", "ringing") else 0))

    straight = next(one for one in models if one["kind"] == "integrating")
    # A lag that is far too long for the recording has to be seen; an oscillator that hardly swings is
    # two lags.
    return min((one for one in models if not (_is_too_long(one, span) and score(straight) < score(one) + 8)
                and not (one["kind"] == "ringing" and one["damping"] > SWINGS)), key=score)


def _lasts_too_long(model, span):
    """The sentence of a model that is not over when the recording is, or None."""
    kind, after = model["kind"], span - model["dead"]
    settled = shape_at(kind, model, span)
    if _is_too_long(model, span):
        lag = f"The lag of about {digits(model['T1'], 2)} s" if model["T1"] < 5 * after else "The lag"
        return (f"{lag} is beyond the recording, which has {digits(after)} s after the dead time: record until the "
                "measurement stands still.")
    if kind in ("first", "second") and settled < SETTLED:
        return (f"It has not settled: {percent(settled, 0)} of its rise is recorded. Record at least "
                f"{digits(3 * model['T1'])} s after the step.")
    if kind == "ringing" and model["damping"] > SWINGS:
        return "It does not swing: see two lags."
    if kind == "ringing" and model["damping"] < 0.02:
        return "It swings on and on: that is no answer to a step."
    if kind == "ringing" and after < 6 * model["T1"]:
        return f"It has not settled: less than one swing is recorded. Record at least {digits(15 * model['T1'])} s."
    if kind == "integrating" and after < 3 * model["T2"]:
        return f"It has not come to a steady slope. Record at least {digits(6 * model['T2'])} s after the step."
    return None


def _refusal_of(model, ramp, span, noise, every, times):
    """Why a model is not to be used, or None."""
    kind, seen, part = model["kind"], _seen_rise(model, span), _part(model, span)
    if not seen > 0 or model["r2"] < 0.5 or seen < 3 * min(noise, model["error"]):
        return "There is no step here: the measurement moves no further than its noise."
    if (kind != "integrating" and ramp["error"] < 0.6 * model["error"] and model["error"] > 1.5 * noise
            and ramp["T1"] < 0.9 * (span - ramp["dead"]) and ramp["T1"] > 4 * every):
        return (f"The measurement is a ramp that ends after {digits(ramp['dead'] + ramp['T1'])} s: it ran into an end of its "
                "range, or the drive did. Record a smaller step.")
    if part > FITS_BADLY and (model["error"] > 3 * noise or part > 0.25):
        return f"Nothing fits: the best is {percent(part)} of the rise away. Was there one step only, and no load?"
    lasting = _lasts_too_long(model, span)
    if lasting is not None:
        return lasting
    main = (model["dead"] + (span - model["dead"]) / 4 if kind == "integrating"
            else model["T1"] + (model["T2"] if kind == "second" else 0))
    if main < 0.7 * every or sum(t > model["dead"] for t in times) < 6:
        return f"It is over within {digits(main)} s, and lines are {digits(every)} s apart: record faster."
    return None


def _word_of(model, span, noise):
    """The worth of a fit in words. What noise does not explain is told apart."""
    part = _part(model, span)
    if part <= FITS_WELL and (model["error"] <= 2 * noise or part <= FITS_WELL / 3):
        return "fits well"
    return "fits roughly" if part <= FITS_BADLY else "fits in much noise"


def fit_models(times, values, step_at, every):
    """All models of a recording whose lines are `every` seconds apart: {"models", each with
    "refused": the reason or None, "part" and "word"; "chosen": the kind; "span"; "noise"}, or
    {"refused"} where nothing can be fitted."""
    times = [t - step_at for t in times]
    span, after = times[-1], sum(t > 0 for t in times)
    if after < 8:
        return {"refused": f"Only {after} lines are after the step at {digits(step_at)} s; at least 8 are needed."}
    noise = _noise_of(values)
    with nullcontext() if numpy is None else numpy.errstate(all="ignore"):
        found = {kind: _fitted(kind, times, values, span) for kind in GRID}
    ramp = found.pop("ramp")
    models = []
    for model in found.values():
        # What is far shorter than the time between lines is none.
        none = {name: 0.0 for name in ("dead", "T2") if model.get(name, every) < every / 100}
        model = {**model, **none}
        models.append({**model, "refused": _refusal_of(model, ramp, span, noise, every, times),
                       "part": _part(model, span), "word": _word_of(model, span, noise)})
    return {"models": models, "chosen": _chosen_of(models, span, noise, after)["kind"], "span": span, "noise": noise}
