# SPDX-License-Identifier: MIT
"""Sensors to make tables of: their function in counts, and its first and last x."""
import math


def ntc(bits, scale, r25=10, beta=3950, series=10, supply=True, low=0, high=150):
    """An NTC in kOhm, by its B: the series resistor is to the supply or to ground."""
    def celsius(count):
        ratio = (count + 0.5) / 2**bits
        resistance = series * (ratio / (1 - ratio) if supply else (1 - ratio) / ratio)
        return 1 / (1 / 298.15 + math.log(resistance / r25) / beta) - 273.15
    inside = [count for count in range(2**bits) if low <= celsius(count) <= high]
    return lambda count: celsius(count) * scale, inside[0], inside[-1]


# Type K in mV, NIST Monograph 175: above 0 with an exponential.
K_ABOVE = (-0.176004136860E-01, 0.389212049750E-01, 0.185587700320E-04, -0.994575928740E-07,
           0.318409457190E-09, -0.560728448890E-12, 0.560750590590E-15, -0.320207200030E-18,
           0.971511471520E-22, -0.121047212750E-25)
K_BELOW = (0, 0.394501280250E-01, 0.236223735980E-04, -0.328589067840E-06, -0.499048287770E-08,
           -0.675090591730E-10, -0.574103274280E-12, -0.310888728940E-14, -0.104516093650E-16,
           -0.198892668780E-19, -0.163226974860E-22)


def type_k_mv(celsius):
    value = 0
    for factor in reversed(K_ABOVE if celsius >= 0 else K_BELOW):
        value = value * celsius + factor
    bump = 0.1185976 * math.exp(-0.1183432E-3 * (celsius - 126.9686) ** 2)
    return value + (bump if celsius >= 0 else 0)


def type_k(low, high, microvolts=2, scale=10):
    """Degrees times scale over counts of so many microvolts, by Newton from one count to the next."""
    counts = 1000 / microvolts
    first, last = math.ceil(type_k_mv(low) * counts), math.floor(type_k_mv(high) * counts)
    values, celsius = {}, float(low)
    for count in range(first, last + 1):
        step = 1
        while abs(step) > 1e-6:
            slope = (type_k_mv(celsius + 1e-3) - type_k_mv(celsius - 1e-3)) / 2e-3
            step = (count / counts - type_k_mv(celsius)) / slope
            celsius += step
        values[count] = celsius * scale
    return values.__getitem__, first, last
