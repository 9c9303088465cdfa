# SPDX-License-Identifier: MIT
"""The margins of sim/identify/loop.c beside those of other code: margins.py RECORDED [TEST]...

RECORDED is test/support/margins.csv.
"""
import csv
import math
import random
import sys

import numpy
from scipy import integrate, linalg

from fixpid import _margins, _scene
from fixpid._library import ffi, lib
from runner import run, same

RECORDED, *NAMES = sys.argv[1:]


def near(found, expected, part, what):
    assert abs(found - expected) <= part * abs(expected), f"{what}: {found}, expected {expected}"


def margins_are_the_recorded():
    """The page's scenes, by the JavaScript that computed them before; empty where there is no margin."""
    names = {"gain": "gain_margin", "lower_gain": "lower_gain_margin", "phase_degrees": "phase_margin", "delay_s": "delay_margin"}
    with open(RECORDED, encoding="ascii") as file:
        rows = [{name: float(value) if value else None for name, value in row.items()} for row in csv.DictReader(file)]
    for i, row in enumerate(rows):
        state = {**_scene.COMMON, **{name: value for name, value in row.items() if name in _scene.COMMON}}
        found = _margins.margins_of(state, {name[len("RESULT_"):]: value for name, value in row.items() if name.startswith("RESULT_")})
        found = {"scale_s": _margins.scale_seconds(state), **found, **{name: found[of] for name, of in names.items()}}
        for name in ("stable", "scale_s", *(("ms", *names) if row["stable"] else ())):
            if found[name] is None or row[name] is None:
                assert found[name] is row[name], (i, name)
            else:
                near(found[name], row[name], 1e-9, f"scene {i}: {name}")
    assert len(rows) > 50, len(rows)


class Loop:
    """A plant of up to five states, seconds of dead time, a step and a controller, all by chance."""

    def __init__(self, draw):
        lags = [10 ** draw.uniform(-1, 1) for _ in range(draw.randint(1, 3))]
        states = len(lags)
        a = numpy.diag([-1 / lag for lag in lags]) + numpy.diag([1 / lag for lag in lags[1:]], -1)
        if draw.random() < 0.3:  # rings
            a = linalg.block_diag(a, [[0, 1], [-1 / lags[0]**2, -2 * draw.uniform(0.05, 0.9) / lags[0]]])
            a[states + 1, states - 1] = 1 / lags[0]**2
            states += 1
        c = numpy.eye(len(a))[states - 1]
        if draw.random() < 0.3 and len(a) < 5:  # and integrates
            a = linalg.block_diag(a, [[0]])
            a[-1, :-1] = c / sum(lags)
            c = numpy.eye(len(a))[-1]
        self.sign = draw.choice([1, -1])
        self.a, self.b, self.c = a, numpy.eye(len(a))[0] / lags[0], c * self.sign
        self.step = min(sum(lags) / draw.uniform(5, 40), 2 * min(lags))
        self.dead = draw.choice([0, draw.uniform(0, 15)]) * self.step
        self.scale = self.dead + sum(lags)
        self.three, self.keep = draw.random() < 0.3, 1 - 0.5**draw.randint(0, 4)
        kp = self.sign * 10**draw.uniform(-1.5, 0.3)
        self.gains = numpy.array([kp, kp / 10**draw.uniform(1, 2.5), kp * draw.choice([0, 1]) * draw.uniform(0, 3) * (1 if self.three else 1 - self.keep)])

    def sampled(self, dead):
        whole = math.floor(dead / self.step + 1e-9)
        late = max(dead - whole * self.step, 0)
        now, before = (integrate.quad_vec(lambda s: linalg.expm(self.a * s) @ self.b, *ends)[0]
                       for ends in ((0, self.step - late), (self.step - late, self.step)))
        return linalg.expm(self.a * self.step), now, before, whole

    def radius(self, factor=1.0, later=0.0):
        """The largest eigenvalue of what the loop does in a step, with a gain that is so many times it."""
        phi, now, before, whole = self.sampled(self.dead + later)
        n, (kp, ki, kd) = len(self.b), self.gains * factor

        def moved(z):
            x, line, (integral, held), past = z[:n], z[n:n + whole + 1], z[n + whole + 1:-3], z[-3:]
            y = self.c @ x
            integral += ki * y
            held = kd * (y - past[2]) if self.three else self.keep * held + kd * (y - past[0])
            u = numpy.append(-(kp * y + integral + held), line)
            return numpy.concatenate([phi @ x + now * u[whole] + before * u[whole + 1], u[:-1], [integral, held, y], past[:-1]])

        return max(abs(linalg.eigvals(numpy.column_stack([moved(one) for one in numpy.eye(n + whole + 6)]))))

    def curve(self):
        phi, now, before, whole = self.sampled(self.dead)
        z = numpy.exp(1j * numpy.geomspace(1e-5, math.pi, 6000))
        kp, ki, kd = self.gains
        states = numpy.linalg.solve(z[:, None, None] * numpy.eye(len(phi)) - phi, (now + before / z[:, None])[:, :, None])[:, :, 0]
        change = 1 - z**-3 if self.three else (1 - 1 / z) / (1 - self.keep / z)
        return states @ self.c / z**whole * (kp + ki / (1 - 1 / z) + kd * change)

    def margins(self, factor=1.0):
        plant, by, found = (ffi.new(f"struct loop_{name} *") for name in ("plant", "controller", "margins"))
        plant.states, plant.dead, plant.scale = len(self.b), self.dead, self.scale
        plant.a = [[*row, *[0] * (5 - len(row))] for row in self.a.tolist()]
        plant.b, plant.c = self.b.tolist(), self.c.tolist()
        by.kp, by.ki, by.kd = self.gains * factor
        by.derivative, by.keep, by.period = lib.LOOP_THREE if self.three else lib.LOOP_FILTERED, self.keep, 1
        lib.loop_margins(plant, by, self.step, found)
        return found


def margins_of_any_loop_are_those_of_its_eigenvalues():
    draw, seen = random.Random(20261129), []
    for i in range(60):
        loop = Loop(draw)
        found, radius = loop.margins(), loop.radius()
        if abs(radius - 1) < 2e-3:
            continue  # too near to be told apart in time
        assert found.stable == (radius < 1), (i, radius)
        seen.append(found.stable)
        if not found.stable:
            continue
        curve = loop.curve()
        near(found.ms, max(1 / abs(1 + curve)), 1e-3, f"loop {i}: Ms")
        if found.off_stable:
            near(found.off_ms, max(max(1 / abs(1 + gain * curve)) for gain in numpy.linspace(0.8, 1.2, 41)), 5e-3, f"loop {i}: Ms of a gain that is off")
        assert found.off_stable == (max(map(loop.radius, (0.8, 1.2))) < 1), i
        if found.gain < 0:
            assert loop.radius(20) < 1, i
        else:
            near_it = 0.98 * found.gain, 1.02 * found.gain
            same((i, [loop.radius(one) < 1 for one in near_it], [loop.margins(one).stable for one in near_it]), (i, *[[True, False]] * 2))
        assert found.lower_gain < 0 or loop.radius(0.98 * found.lower_gain) > 1, (i, found.lower_gain)
        if 0 < found.delay_s < 60 * loop.step:
            assert loop.radius(1, 0.98 * found.delay_s) < 1 < loop.radius(1, 1.02 * found.delay_s), (i, found.delay_s)
    assert 15 < sum(seen) < len(seen) - 3, seen


def plants_are_the_transfer_functions_of_their_kinds():
    """The plants of a recording in the sampled loop, and Ms of a loop with each in continuous time."""
    bottoms = {lib.IDENTIFY_FIRST: lambda s: 7 * s + 1, lib.IDENTIFY_SECOND: lambda s: (7 * s + 1) * (2 * s + 1),
               lib.IDENTIFY_INTEGRATING: lambda s: s * (2 * s + 1), lib.IDENTIFY_RINGING: lambda s: 49 * s**2 + 2 * 0.3 * 7 * s + 1}
    numbers = {lib.IDENTIFY_FIRST: {"lag": 7}, lib.IDENTIFY_SECOND: {"lag": 7, "lag2": 2}, lib.IDENTIFY_INTEGRATING: {"lag2": 2},
               lib.IDENTIFY_RINGING: {"lag": 7, "damping": 0.3}}
    s = 1j * numpy.geomspace(1e-3, 30, 20000)
    for kind, bottom in bottoms.items():
        plant = ffi.new("struct identify_plant *", {"kind": kind, "gain": 3, "dead": 1.5, **numbers[kind]})
        linear, gains = ffi.new("struct loop_plant *"), ffi.new("double[3]")
        lib.loop_plant_of(linear, plant, 0.5, 4)
        n = linear.states
        a, b, c = numpy.array([list(row)[:n] for row in linear.a])[:n], numpy.array(list(linear.b)[:n]), numpy.array(list(linear.c)[:n])
        for one in s[::4000]:
            near(c @ numpy.linalg.solve(one * numpy.eye(n) - a, b), 3 * 4 / 0.5 / bottom(one), 1e-9, f"kind {kind} at {one}")
        lib.identify_simc(plant, 0.25, 1, gains)
        kp, ki, kd = gains
        loop = (kp + ki / s + kd * s / (1 + kd / kp / 10 * s)) * 3 / bottom(s) * numpy.exp(-s * (1.5 + 0.25 / 2))
        near(lib.identify_ms(plant, 0.25, gains), max(1 / abs(1 + loop)), 0.01, f"kind {kind}: Ms")


run(NAMES)
