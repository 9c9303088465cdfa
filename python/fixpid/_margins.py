# SPDX-License-Identifier: MIT
"""The sampled loop near its setpoint, in double precision: web/margins.js in Python. The plant
behind a hold and its dead time, and the controller with the integers that it has."""
import cmath
import math

from ._scene import CONTROLLER, PLANT, REVERSE

# ---- Small matrices, as lists of rows ----


def _times(a, b):
    return [[sum(x * b[k][j] for k, x in enumerate(row)) for j in range(len(b[0]))] for row in a]


def _scaled(a, factor):
    return [[x * factor for x in row] for row in a]


def _plus(a, b):
    return [[x + y for x, y in zip(*rows)] for rows in zip(a, b)]


def _identity(n):
    return [[float(i == j) for j in range(n)] for i in range(n)]


def _exponential(a):
    """e^a by Taylor's series of a part of it, squared again."""
    largest = max(sum(map(abs, row)) for row in a)
    halvings = max(0, math.ceil(math.log2(max(largest, 1e-30))) + 3)
    part, total = _scaled(a, 2.0**-halvings), _identity(len(a))
    for k in range(18, 0, -1):
        total = _plus(_identity(len(a)), _scaled(_times(part, total), 1 / k))
    for _ in range(halvings):
        total = _times(total, total)
    return total


# ---- The plant: a, b and c of x' = a x + b u, y = c x ----


def _process(s):
    a2, a1, a0 = s["T1"] * s["T2"], s["T1"] + s["T2"], 1
    if s["PLANT"] == PLANT["OSCILLATOR"]:
        a2, a1 = s["T1"] * s["T1"], 2 * s["DAMPING"] * s["T1"]
    elif s["PLANT"] == PLANT["INTEGRATOR"]:
        a2, a1, a0 = s["T2"], 1, 0
    if a2 > 0:
        return [[0, 1], [-a0 / a2, -a1 / a2]], [0, s["GAIN"] / a2], [1, 0]
    return [[-a0 / a1]], [s["GAIN"] / a1], [1]


def _oven(s):
    return [[-1 / s["T2"], 0], [s["GAIN"] / s["T1"], -1 / s["T1"]]], [1 / s["T2"], 0], [0, 1]


def _motor(s):
    """As plant_motor.c has it, without friction."""
    resistance, inductance, constant, viscous = 2.4, 0.4e-3, 0.05, 1e-5
    inertia = s["T1"] * 1e-6
    return ([[-resistance / inductance, -constant / inductance], [constant / inertia, -viscous / inertia]],
            [s["GAIN"] / inductance, 0], [0, 1])


def _pendulum(s):
    """As plant_pendulum.c has it, upright."""
    w, rod, lag = 1.2736 * 2 * math.pi * 60, s["T2"], s["T1"]
    return ([[0, 1, 0, 0, 0], [9.81 / rod, 0, 1 / (lag * rod), 0, 0], [0, 0, -1 / lag, 0, 0], [0, 0, 0, 0, 1],
             [w * w, 0, 0, -w * w, -w / 0.5774]],
            [0, -s["GAIN"] / (lag * rod), s["GAIN"] / lag, 0, 0], [0, 0, 0, math.degrees(1), 0])


def sampled_plant(s, dead_s):
    """x[n+1] = phi x[n] + now u[n - steps] + before u[n - steps - 1], in counts; the dead time is
    `steps` steps and a part of one."""
    a, b, c = {PLANT["OVEN"]: _oven, PLANT["MOTOR"]: _motor, PLANT["PENDULUM"]: _pendulum}.get(s["PLANT"], _process)(s)
    h, n = 1 / s["RATE"], len(a)
    steps = math.floor(dead_s / h + 1e-9)
    late = max(0, dead_s - steps * h)
    most, top = max(s["OUTPUT_MAX"], -s["OUTPUT_MIN"]), 2**s["SENSOR_BITS"] - 1

    def wide(seconds):  # with the input as a further state its integral comes along
        return _exponential(_scaled([*([*row, b[i]] for i, row in enumerate(a)), [0] * (n + 1)], seconds))

    def driven(m):
        return [[row[n]] for row in m[:n]]

    def moved(m):
        return [row[:n] for row in m[:n]]

    after = wide(h - late)
    return {"phi": moved(wide(h)), "now": [row[0] / most for row in driven(after)],
            "before": [row[0] / most for row in _times(moved(after), driven(wide(late)))],
            "out": [x * top / s["SENSOR_RANGE"] for x in c], "steps": steps}


# ---- Frequencies, as angles of a step ----


def _solved(phi, w, b):
    """(z - phi)^-1 b by elimination."""
    n, z = len(phi), cmath.exp(1j * w)
    rows = [[*(z - x if i == j else complex(-x) for j, x in enumerate(row)), b[i]] for i, row in enumerate(phi)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: (abs(rows[i][k]), -i))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [*rows[i][:k], *(x - factor * y for x, y in zip(rows[i][k:], rows[k][k:]))]
    for k in range(n - 1, -1, -1):
        rows[k][n] = (rows[k][n] - sum(rows[k][j] * rows[j][n] for j in range(k + 1, n))) / rows[k][k]
    return [row[n] for row in rows]


def _plant_at(plant, w):
    back = cmath.exp(-1j * w)
    x = _solved(plant["phi"], w, [now + before * back for now, before in zip(plant["now"], plant["before"])])
    return sum(out * one for out, one in zip(plant["out"], x)) * cmath.exp(-1j * w * plant["steps"])


def error_per_count(s):
    """What AN937's loop multiplies the error with: its motor has 4000 counts where the sensor has 1023."""
    return 4 if s["PLANT"] == PLANT["MOTOR"] else 1


def controller_of(s, results):
    """In output counts per measurement count: kp, ki per step, kd per step, and the shape of the
    derivative."""
    sign = -1 if int(s["OPTIONS"]) & REVERSE else 1
    if s["CONTROLLER"] == CONTROLLER["AN937"]:
        q4 = error_per_count(s) / 16
        return {"kp": results["KP"] * q4, "ki": results["KI"] * q4, "kd": results["KD"] * q4,
                "kind": "periodic", "period": int(results["FILTER"]), "sign": sign}
    if s["CONTROLLER"] == CONTROLLER["AN964"]:
        whole = results["KP"] / 1024
        return {"kp": whole, "ki": whole * results["KI"] / 4096, "kd": whole * results["KD"] / 32,
                "kind": "three", "sign": -1 if s["PLANT"] == PLANT["PENDULUM"] else sign}
    return {"kp": results["KP"] / 256, "ki": results["KI"] / 2**24, "kd": results["KD"] / 256, "kind": "filtered",
            "keep": 1 - 2**-results["FILTER"], "sign": sign}


def _derivative_at(controller, w):
    if controller["kind"] == "three":
        return 1 - cmath.exp(-3j * w)
    if controller["kind"] == "periodic":  # on average: held for its period
        period = controller["period"]
        return sum(cmath.exp(-1j * w * i) for i in range(period)) / period * (1 - cmath.exp(-1j * w * period))
    return (1 - cmath.exp(-1j * w)) / (1 - controller["keep"] * cmath.exp(-1j * w))


def _controller_at(controller, w):
    integral = controller["ki"] / (1 - cmath.exp(-1j * w))
    return controller["sign"] * (controller["kp"] + integral + controller["kd"] * _derivative_at(controller, w))


# ---- In time ----


def linear_response(plant, controller, n):
    """The closed loop without limits and rounding: the measurement of each step after a count on
    the first one and an output count before it."""
    phi, now, before, out = plant["phi"], plant["now"], plant["before"], plant["out"]
    x = list(now)
    outputs, seen = [0.0] * (n + plant["steps"] + 2), [0.0] * n
    kp, ki, kd, sign, kind = (controller[name] for name in ("kp", "ki", "kd", "sign", "kind"))
    integral = derivative = sample = change = 0.0
    order = range(len(x))
    for i in range(n):
        y = float(i == 0)
        for k in order:
            y += out[k] * x[k]
        if not math.isfinite(y):
            return seen[:i] + [math.inf] * (n - i)
        seen[i] = y
        integral += ki * y
        if kind == "three":
            derivative = kd * (y - (seen[i - 3] if i >= 3 else 0))
        elif kind == "periodic":
            if i % controller["period"] == 0:
                sample, change = y, y - sample
            derivative = kd * change
        else:
            derivative = controller["keep"] * derivative + kd * (y - (seen[i - 1] if i else 0))
        outputs[i + plant["steps"] + 1] = -sign * (kp * y + integral + derivative)
        u, u1 = outputs[i + 1], outputs[i]
        x = [sum(p * one for p, one in zip(phi[k], x)) + now[k] * u + before[k] * u1 for k in order]
    return seen


def _is_stable(plant, controller, n):
    """The loop is stable if what is left of a push goes on getting less."""
    seen = linear_response(plant, controller, n)
    early = max(map(abs, seen[n // 4:math.ceil(n / 2)]))
    late = max(map(abs, seen[3 * n // 4:]))
    return math.isfinite(late) and (late < early * 0.999 or late < 1e-9)


# ---- Margins ----

POINTS = 480


def _crossing(at, low, high, sign):
    for _ in range(50):
        middle = math.sqrt(low * high)
        if (at(middle) > 0) == sign:
            low = middle
        else:
            high = middle
    return math.sqrt(low * high)


def _peak(at, low, high):
    for _ in range(60):
        a, b = low * (high / low)**0.382, low * (high / low)**0.618
        if at(a) < at(b):
            low = a
        else:
            high = b
    return math.sqrt(low * high)


def _least(a, b):
    return b if a is None else min(a, b)


def _most(a, b):
    return b if a is None else max(a, b)


def _along(loop, grid, curve, rate):
    """Where the curve crosses the axis and the unit circle: the margins of both, or None."""
    upper = lower = phase = delay = None
    for wa, wb, a, b in zip(grid, grid[1:], curve, curve[1:]):
        if (a.imag > 0) != (b.imag > 0) and (a.real < 0 or b.real < 0):
            at = loop(_crossing(lambda w: loop(w).imag, wa, wb, a.imag > 0))
            margin = 1 / abs(at)
            if at.real < 0 and margin >= 1:
                upper = _least(upper, margin)
            elif at.real < 0:
                lower = _most(lower, margin)
        if (abs(a) > 1) != (abs(b) > 1):
            w = _crossing(lambda w: abs(loop(w)) - 1, wa, wb, abs(a) > 1)
            at = loop(w)
            away = abs(math.atan2(at.imag, -at.real))  # from -180 degrees
            phase = _least(phase, math.degrees(away))
            # More dead time turns the curve back: from above the axis all the way round.
            delay = _least(delay, (away if at.imag < 0 else 2 * math.pi - away) / w / rate)
    return upper, lower, phase, delay


def margins_of(s, results):
    """ms, gainMargin, lowerGainMargin, phaseMargin (degrees), delayMargin (seconds of further dead
    time), stable, and curve, the loop's points. A margin that there is none of is None."""
    plant, controller = sampled_plant(s, results["DEAD_S"]), controller_of(s, results)

    def loop(w):
        return _controller_at(controller, w) * _plant_at(plant, w)

    def sensitivity(w):
        return 1 / abs(1 + loop(w))

    lowest = min(0.01, 0.02 / scale_steps(s))
    grid = [lowest * (math.pi / lowest)**((i + 1) / POINTS) for i in range(POINTS)]
    curve = [loop(w) for w in grid]
    best = max(range(POINTS), key=lambda i: (1 / abs(1 + curve[i]), -i))
    upper, lower, phase, delay = _along(loop, grid, curve, s["RATE"])
    # The end of the band: a real number there is a crossing, too.
    end = loop(math.pi)
    if end.real < 0 and 1 / abs(end) >= 1:
        upper = _least(upper, 1 / abs(end))
    # So is its start, where the loop has an end there.
    start, before = loop(lowest / 10), loop(lowest / 100)
    if before.real < 0 and abs(before.imag) < 0.1 * abs(before.real) and abs(start.real / before.real - 1) < 0.05:
        margin = 1 / abs(before)
        upper, lower = (_least(upper, margin), lower) if margin >= 1 else (upper, _most(lower, margin))
    return {"ms": sensitivity(_peak(sensitivity, grid[max(0, best - 1)], grid[min(POINTS - 1, best + 1)])),
            "gainMargin": upper, "lowerGainMargin": lower, "phaseMargin": phase, "delayMargin": delay,
            "stable": _is_stable(plant, controller, response_steps(s, results)), "curve": curve}


def response_steps(s, results):
    """How long to look at a loop's answer to a push, in steps."""
    controller, scale = controller_of(s, results), scale_steps(s)
    reset = controller["kp"] / controller["ki"] if controller["ki"] > 0 else 0
    return math.floor(min(30000, max(1500, 60 * max(scale, min(reset, 20 * scale)))) + 0.5)


def scale_steps(s):
    """The time that matters to the controller, in steps: dead time and lags."""
    return scale_seconds(s) * s["RATE"]


def scale_seconds(s):
    if s["PLANT"] == PLANT["MOTOR"]:
        return 2.4 * s["T1"] * 1e-6 / 0.0025
    if s["PLANT"] == PLANT["PENDULUM"]:
        return math.sqrt(s["T2"] / 9.81)
    if s["PLANT"] == PLANT["INTEGRATOR"]:
        return 2 * (s["DEAD"] + s["T2"]) + 4 / s["RATE"]
    if s["PLANT"] == PLANT["OSCILLATOR"]:
        return s["T1"] / max(s["DAMPING"], 0.05) + s["DEAD"]
    return s["T1"] + s["T2"] + s["DEAD"]
