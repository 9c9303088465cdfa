# SPDX-License-Identifier: MIT
"""From a recording to a header: tuner.py RECORDINGS HEADERS [TEST]...

RECORDINGS is test/support/recordings/, and HEADERS is include/, to compile a header with.
"""
import copy
import csv
import datetime
import json
import math
import pickle
import random
import re
import subprocess
import sys
import tempfile

import numpy

import fixpid
from fixpid import _advice, _format, _header, _margins, _scene
from runner import message, run, same

RECORDINGS, HEADERS, *NAMES = sys.argv[1:]


def near(found, expected, what, part=1e-9):
    assert abs(found - expected) <= part * abs(expected), f"{what}: {found}, expected {expected}"


def lies(found, **ranges):
    """Its numbers are within these."""
    for name, (low, high) in ranges.items():
        assert low <= getattr(found, name) <= high, f"{name} = {getattr(found, name)} is not in {low}..{high}: {found}"


# ---- Recordings of plants that are known ----

OVEN = {"gain": 2.4, "lag": 140.0, "dead": 9.0}
SENSOR = fixpid.Sensor(low=0, high=300, bits=10, unit="C")
ACTUATOR = fixpid.Actuator(lowest=0, highest=255, full=100, unit="%")


def recording(rest=60.0, step=30.0, level=10.0, noise=0.3, seconds=900.0):
    """Lists of an uneven time, the drive in percent and the temperature of a lag with dead time."""
    draw, t = random.Random(3), [0.0]
    while t[-1] < seconds:
        t.append(round(t[-1] + draw.uniform(0.5, 2.5), 2))
    u = [level if time < rest else level + step for time in t]
    y = [20 + OVEN["gain"] * (level + step * (1 - math.exp(-max(0, time - rest - OVEN["dead"]) / OVEN["lag"])))
         + draw.uniform(-noise, noise) for time in t]
    return t, u, y


def is_the_oven(found, part=0.02):
    for name, value in OVEN.items():
        near(getattr(found, name), value, name, part * (8 if name == "dead" else 1))
    same((found.kind, found.refused, found.lag2, found.damping, found.start, found.calm), ("first", None, None, None, "settled", 1))
    assert found.r2 > 0.99 and found.part < 0.03 and abs(found.rest - 20) < 1.5, found


class Series:
    """What a Series of pandas does here: it can be gone through, and compared by its elements."""

    def __init__(self, values):
        self.values = values

    def __iter__(self):
        return iter(self.values)

    def __len__(self):
        return len(self.values)

    def __getitem__(self, at):
        raise KeyError(at)  # its labels need not begin at 0


def columns_of_all_kinds():
    t, u, y = recording()
    found = fixpid.fit(t, u, y)
    is_the_oven(found)
    same((found.notes, found.t[0], found.u, found.y), ([], 0, u, y))
    start = datetime.datetime(2026, 3, 29, 1, 59)
    dates = [start + datetime.timedelta(seconds=one) for one in t]
    stamps = numpy.datetime64("2026-03-29T01:59") + (numpy.array(t) * 1000).astype("timedelta64[ms]")
    for again in (fixpid.fit(numpy.array(t), numpy.array(u), numpy.array(y)), fixpid.fit(Series(t), Series(u), Series(y)),
                  fixpid.fit(dates, u, y), fixpid.fit(stamps, u, y), fixpid.fit([one + 1.7e9 for one in t], u, y),
                  fixpid.fit([1000 * one for one in t], u, y, unit="ms"), fixpid.fit([one / 60 for one in t], u, y, unit="min")):
        near(again.lag, found.lag, "lag", 1e-4)
    other = fixpid.fit(t, u, [1000 * one for one in y])  # in other units
    for name, factor in ("gain", 1000), ("lag", 1), ("dead", 1):
        near(getattr(other, name), factor * getattr(found, name), name, 1e-3)
        near(other.sd[name], factor * found.sd[name], f"sd of {name}", 0.05)
    broken = fixpid.fit(t + [901, 902, math.nan], u + [40, 40, 40], y + [math.nan, math.inf, 1])
    is_the_oven(broken)
    same(broken.notes, ["Lines that are no numbers left out: 3."])
    words = ["", "n/a", None]
    texts = [[*map(str, column), *words] for column in (t, u, y)]
    for again in (fixpid.fit(*texts), fixpid.fit(t + [901, 902, 903], u + [40] * 3, y + words), fixpid.fit([*dates, *words], u + [40] * 3, y + [1] * 3),
                  fixpid.fit([*stamps, *[numpy.datetime64("NaT")] * 3], u + [40] * 3, y + [1] * 3)):
        near(again.lag, found.lag, "lag", 1e-4)
        same(again.notes, broken.notes)
    is_the_oven(fixpid.fit(*recording(step=-8.0, noise=0.02)))  # falls
    for again in copy.deepcopy(found), pickle.loads(pickle.dumps(found)):
        same((repr(again), again.plant(), again.plants), (repr(found), found.plant(), found.plants))


def a_time_that_says_nothing_is_refused():
    t, u, y = recording()
    two_runs = t[:200] + t[50:]
    dates = [datetime.datetime(2026, 3, 29) + datetime.timedelta(seconds=one) for one in t]
    for arguments, fields, start in (
            ((two_runs, u[:200] + u[50:], y[:200] + y[50:]), {},
             f"t goes back in line 200, from {t[199]:g} to {t[50]:g} s after the first line: fit the lines before it, [:200]"),
            ((t[::-1], u, y), {}, "t goes back in line 1,"), (([3] * 9, u[:9], y[:9]), {}, "The time goes back or stands still"),
            ((t, u, y), {"unit": "seconds"}, "unit = 'seconds' is refused: us, ms, s, min, h are legal"),
            ((dates, u, y), {"unit": "ms"}, "unit = 'ms' is refused: dates say it themselves"),
            ((["a", *map(str, dates)], u + [1], y + [1]), {}, "t has no number: its first element is 'a'")):
        said = message(ValueError, fixpid.fit, *arguments, **fields)
        assert said.startswith(start), said


def milliseconds_without_a_unit_are_said():
    _, u, y = recording()
    t = [1000 * line for line in range(len(y))]
    note = 'The lines are 1000 s apart: if t is in milliseconds, pass unit="ms".'
    found = fixpid.fit(t, u, y)
    same((found.notes, fixpid.fit(t, u, y, unit="ms").notes), ([note], []))
    for rule in "PI", "SIMC":
        said = message(ValueError, fixpid.tune, found, rule, 5, SENSOR, ACTUATOR)
        assert said.endswith(f"rate = 5: take a lower rate. {note}"), said


def a_number_is_a_step_at_the_first_time_or_where_it_is_said():
    t, u, y = recording()
    found = fixpid.fit(t, u, y)
    at = u.index(40)
    number = fixpid.fit(t[at:], 30, y[at:])
    near(number.lag, found.lag, "lag", 1e-2)
    near(fixpid.fit(t[at:], u[at:], y[at:], before=10).gain, found.gain, "gain", 1e-2)
    middle, start = (t[at - 1] + t[at]) / 2, datetime.datetime(2026, 3, 29, 1, 59)
    dates = [start + datetime.timedelta(seconds=one) for one in t]
    for said in fixpid.fit(t, 30, y, at=middle), fixpid.fit(dates, 30, y, at=start + datetime.timedelta(seconds=middle)):
        for name in "lag", "dead", "gain":
            near(getattr(said, name), getattr(found, name), name, 1e-4)
    said = message(ValueError, fixpid.fit, t, u, y, at=3)
    same(said, "at = 3 is refused: the outputs in u say when they change")


def what_is_left_out_or_taken_for_granted_is_said():
    t, u, y = recording()
    found = fixpid.fit(t, u, [-300 if i in (50, 200) else one for i, one in enumerate(y)])
    is_the_oven(found)
    same(found.notes, ["Single values far from their neighbours left out: 2."])
    held = next(one for one, time in zip(y, t) if time > 120)
    found = fixpid.fit(t, u, [held if 120 < time < 180 else one for one, time in zip(y, t)])
    is_the_oven(found)
    assert re.fullmatch(r"The sensor stood still from 12\d\.?\d* to 1[78]\d\.?\d* s, which is left out\.", found.notes[0]), found.notes
    late = u.index(40) - 3
    found = fixpid.fit(t[late:], u[late:], y[late:])
    is_the_oven(found)
    same(found.notes, ["That the plant stood still before the output moved is taken for granted: too few lines tell."])


KINDS = {"first": (fixpid.Plant(gain=2.4, lag=30, dead=5, start=20), ("lag",)),
         "second": (fixpid.Plant(gain=2.4, lag=30, lag2=14, dead=3, start=20), ("lag", "lag2")),
         "ringing": (fixpid.Plant(gain=0.5, lag=8, damping=0.2, dead=2, start=5, kind="oscillator"), ("lag", "damping")),
         "integrating": (fixpid.Plant(gain=0.01, lag2=12, dead=4, start=50, kind="integrator"), ("lag2",))}


def answer(kind, plant, t):
    """What a step of 1 makes of a gain of 1, t seconds after its dead time."""
    a, b = plant.lag, plant.lag2
    if kind == "ringing":
        root = numpy.sqrt(complex(plant.damping**2 - 1))
        fast, slow = (root - plant.damping) / a, (-root - plant.damping) / a
        return (1 + (slow * numpy.exp(fast * t) - fast * numpy.exp(slow * t)) / (fast - slow)).real
    if kind == "integrating":
        return t - b * (1 - numpy.exp(-t / b))
    return 1 - (a * numpy.exp(-t / a) - b * numpy.exp(-t / (b or 1)) * (b > 0)) / (a - b)


def _fits_of_kinds():
    """A Fit of a recording of each kind, with its plant and the names of what it has."""
    t, u, _ = recording(seconds=400.0)
    draw = random.Random(9)
    for kind, (plant, names) in KINDS.items():
        rest = plant.start + (0 if kind == "integrating" else 10 * plant.gain)
        y = [rest + 30 * plant.gain * answer(kind, plant, max(0, s - 60 - plant.dead)) + draw.uniform(-0.02, 0.02) for s in t]
        yield kind, plant, names, fixpid.fit(t, u, y)


def each_kind_is_told_apart():
    for kind, plant, names, found in _fits_of_kinds():
        same((found.kind, found.refused, found.calm), (kind, None, 1))
        same(sorted(found.models), sorted(KINDS))
        assert found.models[kind] is found and repr(found).startswith(f"<Fit {kind} gain="), found
        again = found.plant()
        same((again.kind, found.plant(100).gain), (plant.kind, again.gain * 100))
        for name in ("gain", *names):
            near(getattr(again, name), getattr(plant, name), name, 0.06)
        assert abs(again.dead - plant.dead) < 1 and abs(again.start - plant.start) < 0.2, again
        same([name for name in ("lag", "lag2", "damping") if getattr(found, name) is not None], list(names))
        same(any("A lag far longer" in note for note in found.notes), kind == "integrating")
        same(sorted(found.sd), sorted(("gain", "dead", *names)))
        for name, deviation in found.sd.items():
            assert 0 < deviation and abs(getattr(found, name) - getattr(plant, name)) < 4 * deviation + 0.02, (name, found, found.sd)
        assert len(found.plants) == 32 and plant.kind in {one.kind for one in found.plants}, (kind, found.plants)
        curve = numpy.interp(found.t, *found.curve)
        assert max(abs(curve[5:-5] - found.y[5:-5])) < 0.1 * (max(found.y) - min(found.y)), kind


def each_kind_is_tuned_and_simulated():
    sensor = fixpid.Sensor(0, 200, 12)
    for kind, _, _, found in _fits_of_kinds():
        loop = fixpid.tune(found, "SIMC", 2, sensor, ACTUATOR)
        assert loop.margins["stable"] and loop.margins["ms"] < 2 and loop.metrics["overshoot"] < 0.5, (kind, loop)
        page, plant = {"ringing": ("spring", "oscillates"), "integrating": ("axis", "integrator")}.get(kind, ("flow", "lag"))
        assert loop.link().startswith(f"#p={page}&gain="), loop.link()
        assert plant in loop.header().split("\n")[2] and "#define LOOP_COUNTS(x) " in loop.header(), loop.header()
        again = fixpid.simulate(found, loop.pid, setpoint=loop.state["SETPOINT"])
        near(again.margins["ms"], loop.margins["ms"], "ms", 2e-2)
        assert again.verdict.split("; ")[1].endswith("for nine of ten plants that the recording allows"), again
        bare = fixpid.tune(found, "SIMC", actuator=ACTUATOR)
        assert bare.margins["stable"] and bare.state["SENSOR_LOW"] <= min(found.y) and bare.state["RATE"] in (0.5, 1, 2), (kind, bare, bare.state)


# ---- Recordings that people have ----


def column(name, *wanted):
    """Columns of a recording, by their numbers; lines that are no numbers are left out."""
    with open(f"{RECORDINGS}/{name}.csv", encoding="utf-8") as file:
        lines = [line for line in csv.reader(file) if re.match(r"[-\d.]", line[0])]
    return [[float(line[at]) for line in lines] for at in wanted]


def two_steps_are_one_plant():
    found = fixpid.fit(*column("two_steps", 0, 1, 2))
    lies(found, gain=(0.594, 0.606), lag=(147, 153), lag2=(18, 22), dead=(2, 4.5), r2=(0.999, 1))
    loop = fixpid.tune(found, "PI", actuator=ACTUATOR)
    true = fixpid.simulate(fixpid.Plant(gain=60, lag=150, lag2=20, dead=3, start=21), loop.pid)
    assert true.margins["ms"] < 1.9, true


def a_hot_end_is_usable_long_before_it_stands_still():
    """For a loop as quick as its dead time; the lag, which it does not tell, is not in the gains."""
    y, = column("hotend", 0)
    for lines in 15, 21, len(y):
        found = fixpid.fit([2 * line for line in range(lines)], 1, y[:lines])
        same((found.refused, found.calm), (None, 2 if lines == 15 else 1))
        delay, slope = found.dead + found.lag2 / 2, found.gain / (found.lag + found.lag2 / 2 if found.lag else 1)
        assert lines == 15 or (12 < 8 * delay < 15 and 0.12 < 1 / (2 * delay * slope) < 0.16), (lines, found)
        assert fixpid.tune(found, "SIMC", rate=2).margins["ms"] < 1.7, found


def a_hot_plate_is_usable_by_its_slope_and_delay():
    """An integrator of 0.00098 a second, with 4.3 s of dead time and a lag of 4.7 s, is as near as two lags."""
    found = fixpid.fit(*column("hotplate", 0, 1, 2))
    same((found.refused, found.models["integrating"].refused), (None, None))
    t, y = map(numpy.array, found.curve)
    slopes = numpy.diff(y) / numpy.diff(t)
    at = slopes.argmax()
    near(slopes[at] / max(found.u), 0.00098, "slope", 0.08)
    near((t[at] + t[at + 1] - (y[at] + y[at + 1] - 2 * found.rest) / slopes[at]) / 2 - found.t[found.u.index(max(found.u))], 9, "delay", 0.15)


def a_closed_loop_says_what_it_was_before():
    t, u, y = column("closed_loop", 0, 3, 2)
    lies(fixpid.fit(t, u, y, before=0), gain=(1.96, 2.04), lag=(145, 152), lag2=(18, 22), dead=(4, 6))
    said = message(ValueError, fixpid.fit, t, u, y)
    assert said.startswith("The measurement moved before the output did") and said.endswith("before=0 if it was off."), said
    t, setpoint, y, u = column("closed_loop_SP1", 0, 1, 2, 3)
    lies(fixpid.fit(t, u, y), gain=(1.96, 2.04), lag=(145, 155), lag2=(18, 22), dead=(4, 7))
    message(ValueError, fixpid.fit, t, setpoint, y)  # which drives nothing


def an_oven_that_is_logged_too_slowly_is_refused():
    said = message(ValueError, fixpid.fit, *column("reflow2", 0, 3, 2))
    same(said, "The answer is over between two lines: record faster.")


# ---- Refusals ----


def what_is_refused_says_what_to_do():
    t, u, y = recording()
    draw = random.Random(5)
    cut = u.index(40)
    for arguments, start in (
            ((t, u, y[1:]), f"t, u and y have {len(t)}, {len(t)} and {len(t) - 1} elements"), (([], [], []), "t, u and y are empty"),
            ((t[:5], u[:5], y[:5]), "Fewer than 8 lines"), ((t, u, [math.nan] * len(t)), "Fewer than 8 lines"),
            ((t, [5] * len(t), y), "The output never changes: was it off before the first line? Then say before=0."),
            ((t, u, [7] * len(t)), "The measurement does not follow the output"),
            ((t, u, [draw.uniform(0, 1) for _ in t]), "No model fits"),
            ((t, u, [20 if time < 60 else 60 for time in t]), "The answer is over between two lines"),
            ((t[:cut + 3], u[:cut + 3], y[:cut + 3]), "")):
        said = message(ValueError, fixpid.fit, *arguments)
        assert said.startswith(start), said
    for values in [1e308 * (-1)**i for i in range(len(t))], [1e-300 * i for i in range(len(t))]:
        message(ValueError, fixpid.fit, t, u, values)
    for call, start in ((lambda: fixpid.fit(t, "x", y), "t, u and y have"), (lambda: fixpid.fit(t, u, y, before=math.nan), "before = nan")):
        assert message(ValueError, call).startswith(start)


def what_is_refused_can_be_looked_at():
    t, u, _ = recording()
    draw = random.Random(5)
    y = [draw.uniform(0, 1) for _ in t]
    said = message(ValueError, fixpid.fit, t, u, y)
    noise = fixpid.fit(t, u, y, refuse=False)
    assert said.startswith(noise.refused) and noise.models[noise.kind] is noise, (said, noise)
    assert noise.r2 < 0.5 and repr(noise).endswith(f": {noise.refused}>"), noise
    same(message(ValueError, fixpid.tune, noise), noise.refused)
    same(message(TypeError, fixpid.tune, 5), "fit = 5 is refused: a fixpid.Fit is wanted")
    message(ValueError, fixpid.fit, t, u, [7] * len(t), refuse=False)  # there is nothing to look at


def lags_that_are_no_part_of_a_step_are_simulated():
    pid = fixpid.Pid(kp=1, ki=0.1, rate=1, output_limits=(0, 1000), sensor=fixpid.Sensor(0, 100))
    for fields in {"lag": 10, "lag2": 1e-4}, {"lag": 1e-4}, {"kind": "integrator", "lag2": 1e-4}, {"kind": "oscillator", "lag": 1e-3}:
        loop = fixpid.simulate(fixpid.Plant(gain=50, **fields), pid, setpoint=20, duration=60)
        assert numpy.isfinite(loop.true).all(), (fields, loop)


# ---- Gains ----

def tuning_is_on_the_hardware_that_is_given():
    found = fixpid.fit(*recording())
    for rule, tuner, least, most in (("PI", "autotune", 1.2, 1.8), ("PID", "autotune", 1.1, 1.9), ("SIMC", "autotune", 1.3, 1.8),
                                     ("PI", "reaction", 1.2, 1.8), ("PID", "reaction", 1.1, 1.9)):
        loop = fixpid.tune(found, rule, rate=10, sensor=SENSOR, actuator=ACTUATOR, tuner=tuner)
        same(loop.state["WEIGHT"], 0.5 if tuner == "reaction" else loop.state["WEIGHT"])
        same([loop.state[name] for name in ("SENSOR_BITS", "SENSOR_RANGE", "OUTPUT_MAX", "RATE", "unit")], [10, 300, 255, 10, "C"])
        assert loop.margins["stable"] and least < loop.margins["ms"] < most, (rule, loop)
        assert loop.metrics["overshoot"] < 0.1 and loop.metrics["settled"] is not None, loop
        kp, ki, _ = loop.gains
        assert 0.5 / OVEN["gain"] < kp < 12 and 0.2 < kp / ki / OVEN["lag"] < 2, (rule, loop.gains)
    quick, safe, calm = (fixpid.tune(found, "PI", 10, SENSOR, ACTUATOR, word).gains[0] for word in ("quick", "safe", "calm"))
    assert quick > safe > calm
    for same_as_safe in 16, None:
        same(fixpid.tune(found, "PI", 10, SENSOR, ACTUATOR, same_as_safe).gains[0], safe)
    assert fixpid.tune(found, "SIMC", 10, SENSOR, ACTUATOR, calm=2).gains[0] < fixpid.tune(found, "SIMC", 10, SENSOR, ACTUATOR).gains[0]
    # By the formula: half a step of hold, and a closed loop as quick as the dead time.
    loop, per_count = fixpid.tune(found, "SIMC", 0.5, SENSOR, ACTUATOR), (300 / 1023) / (100 / 255)
    state = loop.state
    dead = state["DEAD"] + 1
    wanted = dead + max(dead, state["T1"] / 10)
    near(state["KP"], state["T1"] / (state["GAIN"] / 255 * 1023 / 300) / wanted, "kp", 1e-3)
    near(state["KP"] / state["KI"], min(state["T1"], 4 * wanted), "ti", 1e-3)
    near(state["KP"] / per_count, loop.gains[0], "kp in units")
    down = fixpid.fit(recording()[0], recording()[1], [-one for one in recording()[2]])
    loop = fixpid.tune(down, "PI", rate=2, actuator=ACTUATOR)
    assert loop.state["OPTIONS"] == _scene.REVERSE and loop.margins["stable"] and loop.pid._said[1]["reverse"], loop


def a_heat_up_that_goes_too_far_has_less_output():
    heater = fixpid.Plant(gain=110, lag=85, dead=12, start=20)
    hand = fixpid.Pid(kp=1, rate=1, sensor=fixpid.Sensor(0, 150), actuator=ACTUATOR)
    log = fixpid.simulate(heater, hand, duration=600, noise=1, events=[(0, "manual", 0), (20, "manual", 153)])
    assert not any("hold this plant" in one for one in log.advice), log.advice
    found = fixpid.fit(log.t, log.output, log.measurement)
    for rate in 0.2, 0.5, 1, 2, 5, 10:
        for rule in "PI", "PID":
            loop = fixpid.tune(found, rule, rate, fixpid.Sensor(0, 150), ACTUATOR, tuner="reaction")
            assert 1.2 < loop.margins["ms"] < 1.8 and "&drive=50&" in loop.link(), loop
            slow = [f"Not settled within {loop.state['events'][0]['at']:g} s at rate = {rate:g}: another rate or rule may be quicker."]
            same(loop.advice[:1] if loop.metrics["settled"] is None else slow, slow)
            assert f" rate={rate:g}: " in repr(loop) and f"\n// {rate:g} step{'s' * (rate != 1)} per" in loop.header(), loop
            same(loop.header().split("\n")[0], f"// Gains of a loop, by the Python package fixpid {fixpid.__version__}")
    said, = fixpid.simulate(found.plant(), loop.pid).advice
    assert re.match(r"The outputs hold this plant at [\d.]+ to 21\.\d+, and the setpoint is [\d.]+\. Is the plant's gain", said), said
    same(fixpid.simulate(found, loop.pid).advice, [])


def without_hardware_it_is_the_pages():
    loop = fixpid.tune(fixpid.fit(recording()[0], [one / 100 for one in recording()[1]], recording()[2]), "SIMC")
    same([loop.state[name] for name in ("SENSOR_BITS", "SENSOR_LOW", "SENSOR_RANGE", "OUTPUT_MAX", "RATE")], [12, 0, 500, 1000, 0.2])
    same(len(loop.advice), 0)


def what_has_no_gains_says_what_to_do():
    found = fixpid.fit(*recording())
    for fields, start in (({"rule": "ZN"}, "rule = 'ZN' is refused: PI, PID"), ({"robustness": 7}, "robustness = 7 is refused"),
                          ({"rule": "SIMC", "robustness": "calm"}, "robustness = 'calm' is refused: SIMC's loop is made calmer by calm=2"),
                          ({"calm": 2}, "calm = 2 is refused: it is SIMC's"), ({"rule": "SIMC", "calm": 0}, "calm = 0 is refused: 0.5 to 8"),
                          ({"tuner": "relay"}, "tuner = 'relay' is refused: autotune and reaction"), ({"rate": 0.01, "tuner": "reaction"}, "no gains: the heat-up goes"),
                          ({"rate": 0.01}, "no gains: "), ({"rate": math.nan}, "rate = nan is refused"),
                          ({"rate": 1000}, "no gains: the experiment is not over after the 20000 steps that a run has, which are 20 s"),
                          ({"actuator": None}, "actuator is missing: u of the fit goes to ")):
        said = message(ValueError, fixpid.tune, found, **{"actuator": ACTUATOR, **fields})
        assert said.startswith(start), said
    *_, (_, _, _, integrating) = _fits_of_kinds()
    said = message(ValueError, fixpid.tune, integrating, "PI", 1, actuator=ACTUATOR)
    assert said.endswith('output off: record for longer, or take tuner="reaction" or rule="SIMC"'), said
    for fields in {"tuner": "reaction"}, {"rule": "SIMC"}:
        assert fixpid.tune(integrating, rate=1, actuator=ACTUATOR, **fields).margins["stable"], fields


def a_simulated_loop_is_that_controllers():
    """Each step of the simulated loop once more, by a Pid that gets its measurements."""
    plant = fixpid.Plant(gain=240, lag=140, dead=9, start=20)
    pid = fixpid.Pid(kp=2.5, ki=0.03, kd=4, filter=3, rate=2, sensor=SENSOR, actuator=ACTUATOR, setpoint=120,
                     setpoint_weight=0.5, integral_limits=(-50, 300), output_limits=(2, 95))
    loop = fixpid.simulate(plant, pid, duration=900, events=[(450, "setpoint", 150), (700, "load", -0.1)], noise=1.5)
    same((len(loop.t), loop.t[-1], loop.output.dtype), (1800, 899.5, numpy.float64))
    for one in pid, loop.pid:
        same(one.run(loop.setpoint, loop.measurement).tolist(), loop.output.tolist())
    same(tuple(loop.pid.components), (loop.p[0] * 0, 5 / 255 * 100, 0))  # at rest
    assert loop.output.min() >= 2 and loop.output.max() <= 95 and loop.limited.any() and not loop.limited.all()
    assert abs(loop.true[-1] - 150) < 3 and loop.metrics["load"] > 2
    assert loop.flags[0] & fixpid.PID_AT_MAX
    same(fixpid.simulate(plant, pid, setpoint=50).setpoint[0], SENSOR.units(SENSOR.counts(50)))
    again = fixpid.simulate(fixpid.fit(*recording()), pid, duration=10)
    found = fixpid.fit(*recording())
    same([again.state[name] for name in ("GAIN", "T1", "DEAD", "START")], [found.gain * 100, found.lag, found.dead, found.rest])
    counts = fixpid.simulate(plant, fixpid.Pid(gains=fixpid.pid_gains(2, 0.1, 0, 10), output_max=255, rate=10, setpoint=100))
    assert abs(counts.measurement[-1] - 100) < 3 and counts.output.dtype.kind == "i"


def plants_and_events_that_are_none_are_refused():
    pid = fixpid.Pid(kp=1, rate=10, output_limits=(0, 100))
    plant = fixpid.Plant(gain=5)
    for call, fields, start in (
            (fixpid.Plant, {"gain": math.nan}, "gain = nan"), (fixpid.Plant, {"gain": 1, "lag": 0}, "lag = 0"),
            (fixpid.Plant, {"gain": 1, "dead": -1}, "dead = -1 is refused: 0 to 1e+09"), (fixpid.Plant, {"gain": 1, "kind": "x"}, "kind = 'x'"),
            (fixpid.simulate, {"plant": plant, "pid": pid, "events": [(1, "bang", 2)]}, "event (1, 'bang', 2) is refused"),
            (fixpid.simulate, {"plant": plant, "pid": pid, "events": [(-1, "load", 2)]}, "time of load = -1 is refused: 0 to 9.9 is legal"),
            (fixpid.simulate, {"plant": plant, "pid": fixpid.Pid(output_max=9)}, "pid is refused: it needs a rate")):
        said = message(ValueError, call, **fields)
        assert said.startswith(start), said
    for kind, more in (("lags", {"lag2": 0.2}), ("integrator", {"lag2": 0.1}), ("oscillator", {"damping": 0.7}), ("oven", {"lag2": 0.2})):
        loop = fixpid.simulate(fixpid.Plant(gain=100, kind=kind, **more), pid, setpoint=30, duration=5)
        assert loop.true[-1] > 5 and loop.margins["ms"] > 1, (kind, loop)


def a_loop_says_what_the_recording_does_not_tell():
    """Ms with the plants that the recording allows: by hand, and in the loop of a fit, its header and its advice."""
    y, = column("hotend", 0)
    found = fixpid.fit([2 * line for line in range(15)], 1, y[:15])
    same(found.notes[0], "SIMC's loop is 2 times as slow as by its rule: the recording does not tell that a quicker one is safe.")
    sensor, actuator = fixpid.Sensor(0, 400, 12), fixpid.Actuator(0, 1000, full=1)
    for calm, warned in (2, False), (0.5, True):
        loop = fixpid.tune(found, "SIMC", 5, sensor, actuator, calm=calm)
        each = sorted(fixpid.simulate(plant, loop.pid, duration=1).margins["ms"] or math.inf for plant in found.plants)
        said = re.fullmatch(r"Ms ([\d.]+); ([\d.]+) to ([\d.]+) for nine of ten plants that the recording allows", loop.verdict)
        for word, expected in zip(said.groups(), (loop.margins["ms"], each[0], each[28])):
            near(float(word), expected, loop.verdict, 0.15)
        warning = (r"\d+ of 32 plants that the recording allows have Ms above 2\.2 with these gains: take calmer ones, or "
                   r"record again\.")
        same((bool(re.fullmatch(warning, (loop.advice or [""])[-1])), each[28] > 2.2), (warned, warned))
        lines = loop.header().split("\n")
        same((lines[4], lines[5].startswith("// Warning: ")), (f"// {loop.verdict}", warned))
        assert loop.verdict in repr(loop)
    known = fixpid.simulate(found.plant(), loop.pid)
    same((known.verdict, known.header().split("\n")[4][:21]), (None, "// The page has it wi"))


def an_unstable_loop_has_no_margins():
    quick = fixpid.Pid(kp=60, ki=2, rate=2, sensor=SENSOR, actuator=ACTUATOR)
    loop = fixpid.simulate(fixpid.fit(*recording()), quick, setpoint=100)
    same((loop.margins["ms"], loop.margins["stable"]), (None, False))
    assert loop.verdict == "unstable; unstable for more than one of ten plants that the recording allows", loop.verdict
    assert repr(loop).endswith(f"{loop.verdict}>") and "// Margins: unstable\n" in loop.header()
    loop.plot()
    good = fixpid.tune(fixpid.fit(*recording()), actuator=ACTUATOR, rate=2)
    assert len(str(good.margins)) < 400 and len(good.curve) == 480, good.margins
    near(1 / min(abs(1 + one) for one in good.curve), good.margins["ms"], "ms by the curve", 0.01)


def compiled(files, program):
    """What a program prints that includes these headers."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            with open(f"{folder}/{name}", "w", encoding="ascii") as file:
                file.write(text)
        lines = [*(f'#include "{name}"' for name in files), *(f'#include "{name}"' for name in files), "#include <stdio.h>",
                 "int main(void) {", program, "return 0; }"]
        subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-I", HEADERS, "-I", folder, "-x", "c", "-", "-o", f"{folder}/program"],
                       input="\n".join(lines), universal_newlines=True, check=True, stderr=subprocess.PIPE)
        return subprocess.check_output([f"{folder}/program"], universal_newlines=True)


def the_header_compiles_to_these_gains():
    loop = fixpid.tune(fixpid.fit(*recording()), "PID", 10, SENSOR, ACTUATOR)
    printed = compiled({"loop_gains.h": loop.header()}, """static const struct fixpid_pid_config config = LOOP_CONFIG;
        printf("%u %lu %u", config.gains.kp_q8, (unsigned long)config.gains.ki_q24, config.gains.kd_q8);""")
    gains = loop.pid._said[1]["gains"]
    same(printed, f"{gains['kp_q8']} {gains['ki_q24']} {gains['kd_q8']}")
    link = loop.link("tuner/index.html")
    assert re.fullmatch(r"tuner/index\.html#p=flow&gain=.*&rule=PID&events=setpoint_[\d.]+_[\d.]+_0~load_.*", link), link


def two_loops_in_a_firmware_have_two_names():
    found = fixpid.fit(*recording())
    one, other = (fixpid.tune(found, "PI", rate, SENSOR, ACTUATOR) for rate in (5, 10))
    printed = compiled({"bed.h": one.header("bed"), "nozzle.h": other.header("nozzle"), "unnamed.h": one.header()}, """
        static const struct fixpid_pid_config configs[] = {LOOP_BED_CONFIG, LOOP_NOZZLE_CONFIG, LOOP_CONFIG};
        for (int i = 0; i < 3; i++) { printf("%lu ", (unsigned long)configs[i].gains.ki_q24); }
        printf("%d %d %d", LOOP_BED_RATE, LOOP_NOZZLE_RATE, LOOP_NOZZLE_COUNTS(150));""")
    ki = [str(loop.pid._said[1]["gains"]["ki_q24"]) for loop in (one, other, one)]
    same(printed.split(), [*ki, "5", "10", str(SENSOR.counts(150))])
    for name, said in (("bed", "for the loop bed differ"), ("", "without a name differ")):
        why = ""
        try:
            compiled({"one.h": one.header(name), "other.h": other.header(name)}, "")
        except subprocess.CalledProcessError as error:
            why = error.stderr
        assert f"two headers of gains {said}" in why, why
    for name in "hot bed", "d\u00fcse", "a" * 32:
        assert message(ValueError, one.header, name).startswith(f"name = {name!r} is refused"), name


# ---- What the page says of the same ----

with open(f"{HEADERS}/../test/web/tuner/shared.json", encoding="utf-8") as table:
    ROWS = json.load(table)


def scenes_are_the_pages():
    """Runs bit for bit, but that sums are rounded; advice and header to the letter: of a loop that both
    have, one digest that differed would be two loops to a compiler."""
    for row in ROWS["scenes"]:
        state = row["state"]
        found = _scene.run(state)
        same((found["n"], {name: found["results"][name] for name in row["results"]}), (row["n"], row["results"]))
        margins = _margins.margins_of(state, found["results"]) if found["n"] > 0 else None
        same(_advice.advice_of(state, found, margins)["warnings"], row["warnings"])
        if margins is not None:
            for name, series in found["series"].items():
                near(sum(series), row["sums"][name], name)
            same(_header.header_of(state, found["results"], margins, row["fragment"], state["loop"]), row["header"])
    same(sorted(ROWS), ["links", "numbers", "rules", "scenes"])
    assert any(row["n"] < 0 for row in ROWS["scenes"]) and min(map(len, ROWS.values())) > 4


def rules_are_the_pages():
    for row in ROWS["rules"]:
        state = row["state"]
        found = _scene.experiment(state, [(one["rule"], one["robustness"]) for one in row["rules"]])
        same((found["n"], found["results"]["STATUS"]), (row["n"], row["status"]))
        for one, expected in zip(found["rules"], row["rules"]):
            same((one["has"], one["results"]["REASON"]), (expected["has"], expected["reason"]))
            same(_scene.gains_of_rule(state, one["results"]) if one["has"] else None, expected["gains"])


def links_are_the_pages():
    for row in ROWS["links"]:
        same(_scene.fragment(row["state"]), row["fragment"])


def numbers_are_written_as_on_the_page():
    for row in ROWS["numbers"]:
        value = row["value"]
        same({"value": value, "text": _format.number(value), "short": _format.short(value), "digits": _format.digits(value),
              "percent": _format.percent(value)}, row)


def plots_have_what_they_show():
    import matplotlib
    matplotlib.use("Agg")
    found = fixpid.fit(*recording())
    axes = found.plot()
    same([len(line.get_xdata()) for line in axes.lines], [len(found.t), len(found.curve[0])])
    loop = fixpid.tune(found, "PI", 10, SENSOR, ACTUATOR)
    same([line.get_label() for line in loop.plot().lines], ["setpoint", "measurement"])
    pair = matplotlib.pyplot.subplots(2)[1]
    assert loop.plot(pair) is pair[0]
    same(pair[1].lines[0].get_ydata().tolist(), loop.output.tolist())


run(NAMES)
