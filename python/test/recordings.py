# SPDX-License-Identifier: MIT
"""What sim/identify makes of recordings of plants that are known:

    recordings.py rows FOLDER     those of FOLDER/expected.csv, and what was found of each
    recordings.py table FILE      19 kinds with 100 random plants each: FILE has the table of
                                  what came of them, and the whole is within MOST
    recordings.py table --update FILE

Ms is that of SIMC's PI for the plant that was found, with the plant that made the recording, by
numpy over frequencies. SHARE of the plants in a table take seconds, and are not its numbers."""
import csv
import math
import os
import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np
from fixpid._library import ffi, lib
from scipy.linalg import expm

PLANTS = int(os.environ.get("SHARE", "100"))
MOST = {"refused": 0.015, "above 2.2": 0.005, "unstable": 0.0}  # of all; of those that are accepted
STEPS = "step", "quantised", "drift", "outliers", "stuck", "missing", "jitter", "door"
SEVERAL = "unrest", "two", "pulse", "three"
HEAT_UPS = "heat30", "heat60", "heat100"  # cut after that part of the lag, in percent
LOOPS = "closed", "warmup", "thermostat", "ssr"
KINDS = STEPS + SEVERAL + HEAT_UPS + LOOPS
REASONS = [name[9:].lower() for name in (
    "IDENTIFY_USABLE", "IDENTIFY_FEW_LINES", "IDENTIFY_TIME", "IDENTIFY_DRIVE_STANDS", "IDENTIFY_NO_RESPONSE", "IDENTIFY_NO_MODEL",
    "IDENTIFY_SLOW_LINES", "IDENTIFY_UNSURE_GAIN", "IDENTIFY_UNSURE_LAG", "IDENTIFY_UNSURE_DEAD", "IDENTIFY_UNSURE_START")]


# ---- Plants ----


class Plant:
    """Lags in a chain, or an oscillator of one, behind a dead time; then an integral if it integrates."""

    def __init__(self, gain, lags, dead, integrates=False, damping=None):
        self.gain, self.lags, self.dead, self.integrates, self.damping = gain, lags, dead, integrates, damping

    def at(self, s):
        if self.damping is not None:
            return self.gain / (1 + 2 * self.damping * self.lags[0] * s + (self.lags[0] * s)**2)
        return self.gain / np.prod([1 + lag * s for lag in self.lags], axis=0) / (s if self.integrates else 1)

    def states(self):
        """a and b of x' = a x + b u: the measurement is the last of x times the gain."""
        rates = [1 / lag for lag in self.lags]
        if self.damping is not None:
            return np.array([[-2 * self.damping, -1], [1, 0]]) * rates[0], np.array([rates[0], 0])
        a = np.diag([-rate for rate in rates]) + np.diag(rates[1:], -1)
        if self.integrates:
            a = np.pad(a, ((0, 1), (0, 1)))
            a[-1, -2] = 1
        return a, np.array([rates[0]] + [0] * (len(a) - 1))

    def ms(self, gains, step):
        """Of the loop in time that goes on, with half a step of dead time for the hold; infinite if unstable."""
        kp, ki, kd = gains
        slow = sum(self.lags) + self.dead + step + abs(kp / ki)
        s = 1j * np.geomspace(0.01 / slow, 3.1 / step, 1500)
        controller = kp + ki / s + kd * s / (1 + kd / kp * s / 10)
        away = 1 + controller * self.at(s) * np.exp(-s * (self.dead + step / 2))
        turned = np.angle(away[1:] / away[:-1]).sum() - (1 + self.integrates) * math.pi / 2  # by Nyquist 0
        return math.inf if abs(turned) > 0.8 else 1 / abs(away).min()


class Running:
    """A plant that steps, at rest with a drive. The dead time is whole steps and a part of one."""

    def __init__(self, plant, step, drive):
        whole, late = divmod(plant.dead, step)
        a, b = plant.states()
        self.gain, self.held = plant.gain, drive if plant.integrates else 0.0
        self.parts = [expm(np.block([[a, b[:, None]], [np.zeros((1, len(a) + 1))]]) * t) for t in (late, step - late)]
        self.drives = [drive] * (int(whole) + 2)
        self.x = np.zeros(len(a)) if plant.integrates else np.linalg.solve(a, -b * drive)

    def measurement(self):
        return self.gain * self.x[-1]

    def step(self, drive):
        self.drives.append(drive)
        for part, now in zip(self.parts, self.drives):
            self.x = part[:-1, :-1] @ self.x + part[:-1, -1] * (now - self.held)
        del self.drives[0]


def log_uniform(random, low, high):
    return math.exp(random.uniform(math.log(low), math.log(high)))


def random_plant(random, kind):
    """The plant and its lag."""
    lag, gain = log_uniform(random, 20, 600), log_uniform(random, 0.3, 3)
    if kind in ("step", "quantised", "missing", "jitter", "unrest", "two", "pulse", "three", "closed") and random.uniform() < 0.12:
        return Plant(gain / lag, [lag * random.uniform(0.05, 0.3)], lag * random.uniform(0.02, 0.2), integrates=True), lag
    if kind in ("step", "jitter", "two", "pulse", "three") and random.uniform() < 0.12:
        return Plant(gain, [lag], lag * random.uniform(0.02, 0.3), damping=random.uniform(0.08, 0.6)), lag
    heats = kind in HEAT_UPS + ("warmup", "thermostat")
    second, dead = (lag * log_uniform(random, *part) for part in (((0.01, 0.12), (0.005, 0.08)) if heats else ((0.03, 0.5), (0.02, 0.6))))
    order = random.choice([1, 2, 3], p=[0, 0.7, 0.3] if heats else [0.25, 0.5, 0.25])
    return Plant(gain, [lag, second, 0.3 * second][:order], dead), lag


# ---- What drives them: the drive before, and each line's by its number and measurement ----


def profile_of(random, kind, per):
    """Of so many lines a lag: drives in percent."""
    low, high = random.uniform(20, 60), random.uniform(60, 100)
    rest, tail = [0.0] * max(8, int(random.uniform(0.1, 0.5) * per)), int(random.uniform(3, 6) * per)

    def held(drive, least, most):
        return [drive] * int(random.uniform(least, most) * per)

    if kind in HEAT_UPS:
        return [0.0] * 6 + [100.0] * int(int(kind[4:]) / 100 * per)
    if kind == "unrest":
        return [0.0] * 3 + [low] * max(6, int(random.uniform(0.2, 5) * per)) + [high] * tail
    if kind == "two":
        return rest + held(low, 0.3, 4) + [high if random.uniform() < 0.6 else low * random.uniform(0, 0.6)] * tail
    if kind == "pulse":
        return [low / 2] * len(rest) + held(high, 0.3, 1.5) + [low / 2] * tail
    if kind == "three":
        return rest + held(high, 0.3, 2) + held(low / 2, 0.3, 2) + [high * 0.8] * tail
    return [random.choice([0.0, low])] * len(rest) + [high] * tail


def pi(random, kind, plant, lag, per, step, scale):
    """SIMC's or calmer or quicker ones, with anti-windup: a setpoint step, or a warm-up from cold."""
    closed = kind == "closed"
    dead = plant.dead + step / 2 + sum(plant.lags[0 if plant.integrates else 1:]) / 2
    wanted = dead + (dead if plant.integrates else max(dead, plant.lags[0] / 10))
    first = 1.0 if plant.integrates else plant.lags[0]
    kp = first / (plant.gain * wanted) * random.uniform(0.3, 1.2)
    ki = kp / (4 * wanted if plant.integrates else min(first, 4 * wanted))
    before = random.uniform(20, 40) if closed else 0.0
    start = plant.gain * before if closed and not plant.integrates else 0.0
    jump = max(8, int(0.3 * per)) if closed else 0
    size = (random.uniform(0.1, 0.3) if closed else random.uniform(0.3, 0.7)) * scale
    total = before

    def drive(line, measurement):
        nonlocal total
        error = start + (size if line >= jump else 0.0) - measurement
        wish = kp * error + total + ki * step * error
        if 0 <= wish <= 100 or (wish > 100) == (error < 0):
            total += ki * step * error
        return round(min(100.0, max(0.0, wish)), 1)

    return before, drive


def thermostat(random, scale):
    setpoint, band, on = random.uniform(0.3, 0.7) * scale, random.uniform(0.005, 0.02) * scale, True

    def drive(_, measurement):
        nonlocal on
        on = measurement < setpoint + (band if on else -band)
        return 100.0 * on

    return 0.0, drive


def ssr(random, per):
    """A window of whole lines, on for a part of it, which steps."""
    window, low, high = int(random.uniform(4, 12)), random.uniform(0.1, 0.3), random.uniform(0.5, 0.9)
    return 0.0, lambda line, _: 100.0 * (line % window < round(window * (low if line < 2 * per else high)))


def driven(random, kind, plant, lag, per, step, scale):
    """How many lines, the drive before, and what gives the next."""
    if kind in LOOPS:
        return int(random.uniform(4, 7) * per), *(thermostat(random, scale) if kind == "thermostat" else ssr(random, per) if kind == "ssr"
                                                  else pi(random, kind, plant, lag, per, step, scale))
    profile = profile_of(random, kind, per)
    return len(profile), profile[0], lambda line, _: profile[line]


# ---- Recordings ----


def spoilt(random, kind, per, scale, t, u, y):
    """What loggers and sensors do to it."""
    n, keep = len(t), np.full(len(t), True)
    step = int((u != u[0]).argmax())
    if kind == "unrest":
        keep[:3 + int(random.uniform(0, 0.8) * (int((u == u[-1]).argmax()) - 3))] = False
    if kind not in ("closed", "warmup", "thermostat") and random.uniform() < 0.5:  # it logs what was before
        u = np.r_[u[0], u[:-1]]
    if kind == "outliers":
        for i in random.choice(n, max(2, n // 50), replace=False):
            y[i] = random.choice([0.0, y[i] + 0.5 * scale, -0.3 * scale, 473.0])
    if kind == "stuck":
        at = step + int(random.uniform(0.3, 1) * per)
        y[at:at + int(random.uniform(0.2, 0.5) * per)] = y[at]
    if kind == "missing":
        keep = random.uniform(size=n) > 0.2
        gap = step + int(random.uniform(0.3, 2) * per)
        keep[gap:gap + int(0.5 * per)] = False
    if kind == "jitter":
        t = np.round(t + random.uniform(-0.1, 0.1, n) * (t[1] - t[0]), 3)
        keep = random.uniform(size=n) > 0.3
    keep[0] = keep[0] or kind != "unrest"
    return t[keep], u[keep], y[keep]


def recorded(kind, number):
    """The plant, and columns of a recording."""
    random = np.random.default_rng([KINDS.index(kind), number])
    plant, lag = random_plant(random, kind)
    per = random.uniform(80, 250) if kind in HEAT_UPS + ("warmup", "thermostat", "ssr") else random.uniform(20, 120)
    step = float(f"{lag / per:.1g}")
    scale = 100 * plant.gain * (lag if plant.integrates else 1)
    rounding, noise = float(f"{scale / 2000:.1g}"), random.uniform(0.0005, 0.004)
    if kind == "quantised":  # in steps of a quarter, of a range of 15 to 80
        factor = random.uniform(15, 80) / scale
        plant.gain, scale, rounding, noise = plant.gain * factor, scale * factor, 0.25, 0.3 * noise
    n, before, drive = driven(random, kind, plant, lag, per, step, scale)
    drift = random.uniform(0.05, 0.15) * scale / n if kind == "drift" else 0.0
    running, ambient, rows = Running(plant, step, before), random.uniform(0, 30), []
    for line in range(n):
        y = running.measurement() + ambient + drift * line + random.normal(0, noise * scale)
        y = round(y / rounding) * rounding
        u = drive(line, y - ambient)
        rows.append((line * step, u, y))
        door = kind == "door" and 0.55 * n < line < 0.55 * n + 0.3 * per
        running.step(u - (15.0 if door else 0.0))
    return plant, spoilt(random, kind, per, scale, *np.array(rows).T)


# ---- What comes of them ----


def identified(columns, before=None):
    """The result, and the plant that was chosen."""
    kept = [ffi.new("double[]", list(column)) for column in columns]
    result = ffi.new("struct identify_result *")
    lib.identify(ffi.new("struct identify_recording *", (len(columns[0]), *kept, before or 0.0, before is not None)), result)
    return result, result.models[result.chosen]


def true_ms(plant, model):
    step, gains = (sum(plant.lags) + plant.dead) / 40, ffi.new("double[3]")
    lib.identify_simc(ffi.addressof(model, "plant"), step, model.calm, gains)
    return plant.ms(list(gains), step)


def outcome(of):
    """Of a kind and a number: Ms, or None if it was refused; and whether the gains are calmer."""
    plant, columns = recorded(*of)
    result, model = identified(columns)
    return (None if result.reason else true_ms(plant, model)), model.calm > 1


def row_of(name, outcomes):
    ms = sorted(one for one, _ in outcomes if one is not None)
    figures = [f"{ms[min(len(ms) - 1, int(part * len(ms)))]:.2f}" for part in (0.5, 0.9, 0.97, 1)]
    return [name, len(outcomes), len(outcomes) - len(ms), sum(one is not None and calm for one, calm in outcomes), *figures,
            sum(one > 2.2 for one in ms), sum(map(math.isinf, ms))]


def table(path, update):
    names = [(kind, number) for kind in KINDS for number in range(PLANTS)]
    with ProcessPoolExecutor() as pool:
        found = list(pool.map(outcome, names, chunksize=5))
    rows = [row_of(kind, found[i * PLANTS:(i + 1) * PLANTS]) for i, kind in enumerate(KINDS)] + [row_of("all", found)]
    text = "kind,recordings,refused,calmer,Ms 50 %,90 %,97 %,largest,above 2.2,unstable\n" + "".join(
        ",".join(map(str, row)) + "\n" for row in rows)
    print(text, end="")
    _, every, refused, *_, above, unstable = rows[-1]
    for name, part in ("refused", refused / every), ("above 2.2", above / (every - refused)), ("unstable", unstable / (every - refused)):
        print(f"{'ok' if part <= MOST[name] else 'FAILED'} {name}: {part:.1%} of {MOST[name]:.1%} at most")
    if update:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    with open(path, encoding="utf-8") as file:
        print("ok" if file.read() == text else "FAILED", f"{path} is the table")


# ---- Rows ----


def wrong(row, result, model):
    """What is not as expected.csv says: a verdict is usable, refused, a reason, or safe, which is any;
    a range has its two ends, or none."""
    plant, reason = model.plant, REASONS[result.reason]
    if row["verdict"] not in ("safe", reason, reason if reason == "usable" else "refused"):
        return f"it is {reason}, not {row['verdict']}"
    left_out = "outliers" if result.outliers else "stuck" if result.stuck_to else ""
    if left_out != row["left_out"]:
        return f"it leaves out {left_out or 'nothing'}, not {row['left_out'] or 'nothing'}"
    lags = plant.lag + plant.lag2 / 2 if plant.lag else 1.0  # of an integrator, and without a model
    values = {"gain": plant.gain, "slope": plant.gain / lags, "delay": plant.dead + plant.lag2 / 2}
    for name, value in values.items() if reason == "usable" else ():
        low, high = row[f"{name}_low"], row[f"{name}_high"]
        if low and not float(low) <= value <= float(high):
            return f"{name} {value:.4g} is not within {low} to {high}"
    true = Plant(float(row["gain"]), [float(row[name]) for name in ("lag", "lag2", "lag3") if float(row[name])], float(row["dead"]),
                 row["integrates"] == "1")
    ms = true_ms(true, model) if reason == "usable" else 0.0
    return None if ms < 2.3 else f"Ms is {ms:.2f}"


def rows(folder):
    with open(os.path.join(folder, "expected.csv"), encoding="ascii") as file:
        expected = list(csv.DictReader(file))
    for row in expected:
        columns = np.loadtxt(os.path.join(folder, row["file"]), delimiter=",", skiprows=1, unpack=True)
        result, model = identified(columns, float(row["before"]) if row["before"] else None)
        why, p = wrong(row, result, model), model.plant
        numbers = " ".join(repr(one) for one in (p.gain, p.lag, p.lag2, p.damping, p.dead, model.calm))
        print(f"{'FAILED' if why else 'ok'} {row['file']}: {REASONS[result.reason]} {p.kind} {numbers}", f"; {why}" if why else "", sep="")


if __name__ == "__main__":
    if sys.argv[1] == "rows":
        rows(sys.argv[2])
    else:
        table(sys.argv[-1], "--update" in sys.argv)
