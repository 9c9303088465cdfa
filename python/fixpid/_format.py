# SPDX-License-Identifier: MIT
"""Numbers as the tuner page writes them: web/format.js, and what JavaScript itself does."""
import math
from decimal import ROUND_HALF_UP, Decimal


def number(value):
    """A number as JavaScript's String() has it."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return str(value)
    if isinstance(value, int) and abs(value) < 10**21:
        return str(value)
    text = repr(float(value))
    if "n" in text:  # neither finite nor a number
        return {"inf": "Infinity", "-inf": "-Infinity"}.get(text, "NaN")
    if value == 0 or 1e-6 <= abs(value) < 1e21:
        return format(Decimal(text).normalize() + 0, "f")
    return text.replace("e-0", "e-")


def precise(value, figures):
    """Number(value.toPrecision(figures)): rounded to so many figures, halves away from 0."""
    if value == 0 or not math.isfinite(value):
        return value
    exact = Decimal(value)
    return float(exact.quantize(Decimal(1).scaleb(exact.adjusted() - figures + 1), ROUND_HALF_UP))


def fixed(value, places):
    """value.toFixed(places)."""
    if abs(value) >= 1e21:
        return number(value)
    return str(Decimal(value).quantize(Decimal(1).scaleb(-places), ROUND_HALF_UP))


def short(value):
    """Without digits that say nothing: 0.30000000000000004 is 0.3."""
    return number(precise(value, 6))


def digits(value, figures=3):
    """To so many figures, with the signs of print."""
    if value is None or math.isnan(value):
        return "–"
    if not math.isfinite(value):
        return "∞"
    size = abs(value)
    if size == 0:
        return "0"
    if size >= 1e6 or size < 1e-4:
        mantissa, _, exponent = f"{precise(value, figures):.{figures - 1}e}".partition("e")
        return f"{mantissa} e{int(exponent):+d}".replace("-", "−")
    places = max(0, figures - 1 - math.floor(math.log10(size)))
    return fixed(value, min(places, 6)).replace("-", "−")


def percent(part, places=1):
    return f"{fixed(100 * part, places)} %".replace("-", "−")


def shortest(value, fold):
    """The shortest decimal that `fold` makes the same integer of."""
    wanted = fold(value)
    for figures in range(1, 17):
        tried = precise(value, figures)
        if fold(tried) == wanted:
            return tried
    return value
