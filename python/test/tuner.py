# SPDX-License-Identifier: MIT
"""The tuner page's mathematics in Python: tuner.py TABLE HEADERS [TEST]...

TABLE has what the page computes, test/web/tuner/shared.json; HEADERS is include/, to compile a
header with. Then what is Python's own: recordings, hardware, refusals, plots.
"""
import csv
import datetime
import importlib
import json
import math
import random
import re
import subprocess
import sys
import tempfile

import numpy

import fixpid
from fixpid import _scene
from runner import message, run, same

TABLE, HEADERS, *NAMES = sys.argv[1:]
with open(TABLE, encoding="utf-8") as file:
    ROWS = json.load(file)
NEAR = 1e-9  # of a number: sums and exp() are rounded apart

_advice, _fit, _format, _header, _margins, _metrics = (importlib.import_module(f"fixpid._{name}") for name in (
    "advice", "fit", "format", "header", "margins", "metrics"))


def near(found, expected, what, part=NEAR):
    """Both are the same but for rounding, in depth; of `expected` nothing may be missing."""
    if isinstance(expected, dict):
        for name, value in expected.items():
            near(found[name], value, f"{what}.{name}", part)
    elif isinstance(expected, list):
        same((what, len(found)), (what, len(expected)))
        for i, (one, other) in enumerate(zip(found, expected)):
            near(one, other, f"{what}[{i}]", part)
    elif isinstance(expected, float) and isinstance(found, (int, float)):
        assert abs(found - expected) <= part * max(1, abs(expected)), f"{what}: {found}, the page has {expected}"
    else:
        same((what, found), (what, expected))


def near_tells_numbers_apart():
    for found, expected in ((1.0, 1 + 3e-9), ({"a": [1.0]}, {"a": [1.1]}), ({}, {"a": 1.0}), ([1.0], []), (None, 1.0),
                            (True, False), (math.nan, 1.0), ("a", "b"), ({"a": 1.0}, {"a": None})):
        try:
            near(found, expected, "it")
        except (AssertionError, KeyError):
            continue
        raise AssertionError(f"{found} is near {expected}")
    near({"a": [1 + 5e-10], "b": 2}, {"a": [1.0]}, "it")


def scenes_are_the_pages():
    """Runs bit for bit; figures, advice and header of each."""
    for i, row in enumerate(ROWS["scenes"]):
        state, what = row["state"], f"scene {i}"
        found = _scene.run(state)
        same((what, found["n"]), (what, row["n"]))
        near(found["results"], row["results"], what)
        margins = _margins.margins_of(state, found["results"]) if found["n"] > 0 else None
        same(_advice.advice_of(state, found, margins), row["advice"])
        if margins is None:
            continue
        near({name: float(sum(series)) for name, series in found["series"].items()},
             {name: float(total) for name, total in row["sums"].items()}, f"{what}: sum")
        near(_metrics.metrics_of(state, found), row["metrics"], what)
        same(_header.header_of(state, found["results"], margins, row["fragment"]), row["header"])


def margins_are_the_recorded():
    """The scenes of margins.csv with the margins that other code computed, empty where there is none."""
    names = {"gain": "gainMargin", "lower_gain": "lowerGainMargin", "phase_degrees": "phaseMargin", "delay_s": "delayMargin"}
    with open(f"{HEADERS}/../test/support/margins.csv", encoding="ascii") as file:
        rows = [{name: float(value) if value else None for name, value in row.items()} for row in csv.DictReader(file)]
    for i, row in enumerate(rows):
        state = {**_scene.COMMON, **{name: value for name, value in row.items() if name in _scene.COMMON}}
        found = _margins.margins_of(state, {name[len("RESULT_"):]: value for name, value in row.items() if name.startswith("RESULT_")})
        found = {"scale_s": _margins.scale_seconds(state), **found, **{name: found[of] for name, of in names.items()}}
        for name in "stable", "ms", "scale_s", *names:
            near(found[name], row[name], f"scene {i}: {name}")
    assert len(rows) > 50, len(rows)


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
              "percent": _format.percent(value), "whole": _format.whole(value)}, row)


def the_table_is_whole():
    """A list that nothing here reads must not stand in it."""
    same(sorted(ROWS), ["links", "numbers", "rules", "scenes"])
    assert sum(map(len, ROWS.values())) >= 50
    assert any(row["n"] < 0 for row in ROWS["scenes"])


# ---- Recordings ----

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


def is_the_oven(found, percent=2.0):
    for name, value in OVEN.items():
        assert abs(getattr(found, name) - value) < percent / 100 * value * (8 if name == "dead" else 1), (name, found)
    same((found.kind, found.worth, found.refused, found.lag2, found.damping), ("first", "fits well", None, None, None))
    assert found.r2 > 0.99 and found.part < 0.01 and abs(found.rest - 20) < 1.5, found


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


def recordings_of_all_kinds():
    t, u, y = recording()
    found = fixpid.fit(t, u, y)
    is_the_oven(found)
    same((found.step, found.before, found.notes), (30, 10, []))
    start = datetime.datetime(2026, 3, 29, 1, 59)
    dates = [start + datetime.timedelta(seconds=one) for one in t]
    stamps = numpy.datetime64("2026-03-29T01:59") + (numpy.array(t) * 1000).astype("timedelta64[ms]")
    for again in (fixpid.fit(numpy.array(t), numpy.array(u), numpy.array(y)), fixpid.fit(Series(t), Series(u), Series(y)),
                  fixpid.fit(dates, u, y), fixpid.fit(stamps, u, y), fixpid.fit(t[::-1], u[::-1], y[::-1]),
                  fixpid.fit([one + 1.7e9 for one in t], u, y)):
        near(again.lag, found.lag, "lag", 1e-4)
    broken = fixpid.fit(t + [901, 902, math.nan], u + [40, 40, 40], y + [math.nan, math.inf, 1])
    is_the_oven(broken)
    same(broken.notes, ["Lines that are no numbers left out: 3."])
    is_the_oven(fixpid.fit(*recording(step=-8.0, noise=0.02)))  # falls


def a_number_is_a_step_at_the_first_time_or_where_it_is_said():
    t, u, y = recording()
    found = fixpid.fit(t, u, y)
    at = u.index(40)
    number = fixpid.fit(t[at:], 30, y[at:])
    same((number.rest, number.before, number.step, number.notes), (number.start, 0, 30, []))
    near(number.lag, found.lag, "lag", 1e-2)
    middle, start = (t[at - 1] + t[at]) / 2, datetime.datetime(2026, 3, 29, 1, 59)
    dates = [start + datetime.timedelta(seconds=one) for one in t]
    for said in fixpid.fit(t, 30, y, at=middle), fixpid.fit(dates, 30, y, at=start + datetime.timedelta(seconds=middle)):
        for name in "lag", "dead", "start":
            near(getattr(said, name), getattr(found, name), name, 1e-4)
    unsaid = fixpid.fit(t, 30, y)
    assert abs(unsaid.dead - middle - OVEN["dead"]) < 3 and "say at=TIME" in unsaid.notes[0], (unsaid, unsaid.notes)


def what_is_left_out_is_said():
    t, u, y = recording()
    moves = next(i for i, one in enumerate(t) if one > 700)
    wires = 50, 200
    found = fixpid.fit(t, u[:moves] + [70] * len(t[moves:]), [-300 if i in wires else one for i, one in enumerate(y)])
    is_the_oven(found)
    same(found.notes, [f"Left out as outliers: -300 at {t[50]:g} s, -300 at {t[200]:g} s.",
                       f"Used up to {t[moves - 1]:g} s, after which u moves again."])
    step_at = t[moves - 1] - found.t[-1]
    for (time, value), i in zip(found.outliers, wires):
        near(time, t[i] - step_at, "time of an outlier")
        same(value, -300)
    same(len(found.t), moves - len(wires))


KINDS = {"first": (fixpid.Plant(gain=2.4, lag=30, dead=5, start=20), ("lag",)),
         "second": (fixpid.Plant(gain=2.4, lag=30, lag2=14, dead=3, start=20), ("lag", "lag2")),
         "ringing": (fixpid.Plant(gain=0.5, lag=8, damping=0.2, dead=2, start=5, kind="oscillator"), ("lag", "damping")),
         "integrating": (fixpid.Plant(gain=0.01, lag2=12, dead=4, start=50, kind="integrator"), ("lag2",))}


def fits_of_kinds():
    """A Fit of a recording of each kind, with its plant and the names of what it has."""
    t, u, _ = recording(seconds=400.0)
    draw = random.Random(9)
    for kind, (plant, names) in KINDS.items():
        numbers = {"T1": plant.lag, "T2": plant.lag2, "damping": plant.damping, "dead": plant.dead}
        rest = plant.start + (0 if kind == "integrating" else 10 * plant.gain)
        y = [rest + 30 * plant.gain * _fit.shape_at(kind, numbers, s - 60) + draw.uniform(-0.02, 0.02) for s in t]
        yield kind, plant, names, fixpid.fit(t, u, y)


def each_kind_is_told_apart():
    for kind, plant, names, found in fits_of_kinds():
        same((found.kind, found.refused, found.worth), (kind, None, "fits well"))
        same(sorted(found.models), sorted(KINDS))
        assert found.models[kind] is found and repr(found).startswith(f"<Fit {kind} gain=") and "fits well" in repr(found), found
        again = found.plant()
        same((again.kind, found.plant(100).gain), (plant.kind, again.gain * 100))
        for name in ("gain", *names):
            assert abs(getattr(again, name) - getattr(plant, name)) < 0.06 * getattr(plant, name), (name, again)
        assert abs(again.dead - plant.dead) < 1 and abs(again.start - plant.start) < 0.2, again
        same([name for name in ("lag", "lag2", "damping") if getattr(found, name) is not None], list(names))
        same(any("A lag far longer" in note for note in found.notes), kind == "integrating")
        near(found.at(0), found.start, "before the dead time")


def each_kind_is_tuned_and_simulated():
    sensor = fixpid.Sensor(0, 200, 12)
    for kind, _, _, found in fits_of_kinds():
        loop = fixpid.tune(found, "SIMC", 2, sensor, ACTUATOR)
        assert loop.margins["stable"] and loop.margins["ms"] < 2 and loop.metrics["overshoot"] < 0.5, (kind, loop)
        page, plant = {"ringing": ("spring", "oscillates"), "integrating": ("axis", "integrator")}.get(kind, ("flow", "lag"))
        assert loop.link().startswith(f"#p={page}&gain="), loop.link()
        assert plant in loop.header().split("\n")[2] and "#define LOOP_COUNTS(x) " in loop.header(), loop.header()
        again = fixpid.simulate(found, loop.pid, setpoint=loop.state["SETPOINT"])
        near(again.margins["ms"], loop.margins["ms"], "ms", 1e-2)
        bare = fixpid.tune(found, "SIMC", actuator=ACTUATOR)
        assert bare.margins["stable"] and bare.state["SENSOR_LOW"] <= min(found.y) and bare.state["RATE"] in (0.5, 1, 2), (kind, bare, bare.state)


def what_is_no_step_is_refused():
    t, u, y = recording()
    for arguments, start in (
            ((t, u, y[1:]), f"t, u and y have {len(t)}, {len(t)} and {len(t) - 1} elements"), ((t[:5], u[:5], y[:5]), "t has 5"),
            ((t, u, [math.nan] * len(t)), "t, u and y have 0 lines of numbers"), (([3] * 9, u[:9], y[:9]), "t is refused: the time stands still"),
            ((t, [5] * len(t), y), "u = 5 is refused: it has no step"), ((t, 0, y), "u = 0 is refused"),
            ((t, t, y), "u is refused: it has no step between two values that stand still"),
            ((t, u, [7] * len(t)), "There is no step here"), ((t, 30, y, t[-3]), "Only 2 lines are after the step at 89"),
            ((t[:120], u[:120], y[:120]), "It has not settled"), ((t, u, [1e308 * (-1)**i for i in range(len(t))]), "There is no step here")):
        said = message(ValueError, fixpid.fit, *arguments)
        assert said.startswith(start), said


def what_is_refused_can_be_looked_at():
    t, u, _ = recording()
    draw = random.Random(5)
    y = [draw.uniform(0, 1) for _ in t]
    said = message(ValueError, fixpid.fit, t, u, y)
    noise = fixpid.fit(t, u, y, refuse=False)
    same((noise.refused, noise.models[noise.kind]), (said, noise))
    assert noise.r2 < 0.5 and repr(noise).endswith(f": {said}>"), noise
    same(message(ValueError, fixpid.tune, noise), said)
    said = message(TypeError, fixpid.tune, 5)
    assert said == "fit = 5 is refused: a fixpid.Fit is wanted", said


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
    same(fixpid.tune(found, "PI", 10, SENSOR, ACTUATOR, 16).gains[0], safe)
    # By the formula: half a step of hold, and a closed loop as quick as the dead time.
    loop, per_count = fixpid.tune(found, "SIMC", 0.5, SENSOR, ACTUATOR), (300 / 1023) / (100 / 255)
    state = loop.state
    dead = state["DEAD"] + 1
    wanted = dead + max(dead, state["T1"] / 10)
    near(state["KP"], state["T1"] / (state["GAIN"] / 255 * 1023 / 300) / wanted, "kp", 1e-3)
    near(state["KP"] / state["KI"], min(state["T1"], 4 * wanted), "ti", 1e-3)
    near(state["KP"] / per_count, loop.gains[0], "kp in units")
    down = fixpid.fit(recording()[0], recording()[1], [-one for one in recording()[2]])
    loop = fixpid.tune(down, "PI", rate=2)
    assert loop.state["OPTIONS"] == _scene.REVERSE and loop.margins["stable"] and loop.pid._said[1]["reverse"], loop


def without_hardware_it_is_the_pages():
    loop = fixpid.tune(fixpid.fit(recording()[0], [one / 100 for one in recording()[1]], recording()[2]), "SIMC")
    same([loop.state[name] for name in ("SENSOR_BITS", "SENSOR_LOW", "SENSOR_RANGE", "OUTPUT_MAX", "RATE")], [12, 0, 500, 1000, 0.2])
    same(len(loop.advice), 0)


def what_has_no_gains_says_what_to_do():
    found = fixpid.fit(*recording())
    for fields, start in (({"rule": "ZN"}, "rule = 'ZN' is refused: PI, PID"), ({"robustness": 7}, "robustness = 7 is refused"),
                          ({"tuner": "relay"}, "tuner = 'relay' is refused: autotune and reaction"), ({"rate": 0.01, "tuner": "reaction"}, "no gains: The reading"),
                          ({"rate": 0.01}, "no gains: "), ({"rate": math.nan}, "rate = nan is refused")):
        said = message(ValueError, fixpid.tune, found, **fields)
        assert said.startswith(start), said


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
            (fixpid.Plant, {"gain": 1, "dead": -1}, "dead = -1 is refused: 0 to 100000"), (fixpid.Plant, {"gain": 1, "kind": "x"}, "kind = 'x'"),
            (fixpid.simulate, {"plant": plant, "pid": pid, "events": [(1, "bang", 2)]}, "event (1, 'bang', 2) is refused"),
            (fixpid.simulate, {"plant": plant, "pid": pid, "events": [(-1, "load", 2)]}, "time of load = -1 is refused: 0 to 9.9 is legal"),
            (fixpid.simulate, {"plant": plant, "pid": fixpid.Pid(output_max=9)}, "pid is refused: it needs a rate")):
        said = message(ValueError, call, **fields)
        assert said.startswith(start), said
    for kind, more in (("lags", {"lag2": 0.2}), ("integrator", {"lag2": 0.1}), ("oscillator", {"damping": 0.7}), ("oven", {"lag2": 0.2})):
        loop = fixpid.simulate(fixpid.Plant(gain=100, kind=kind, **more), pid, setpoint=30, duration=5)
        assert loop.true[-1] > 5 and loop.margins["ms"] > 1, (kind, loop)


def the_header_compiles_to_these_gains():
    loop = fixpid.tune(fixpid.fit(*recording()), "PID", 10, SENSOR, ACTUATOR)
    text = loop.header()
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/loop_gains.h", "w", encoding="ascii") as file:
            file.write(text)
        program = ['#include "loop_gains.h"', "#include <stdio.h>", "int main(void) {",
                   "static const struct fixpid_pid_config config = LOOP_CONFIG;",
                   'printf("%u %lu %u", config.gains.kp_q8, (unsigned long)config.gains.ki_q24, config.gains.kd_q8); return 0; }']
        subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-I", HEADERS, "-I", folder, "-x", "c", "-",
                        "-o", f"{folder}/program"], input="\n".join(program), universal_newlines=True, check=True)
        printed = subprocess.check_output([f"{folder}/program"], universal_newlines=True)
    gains = loop.pid._said[1]["gains"]
    same(printed, f"{gains['kp_q8']} {gains['ki_q24']} {gains['kd_q8']}")
    link = loop.link("tuner/index.html")
    assert re.fullmatch(r"tuner/index\.html#p=flow&gain=.*&rule=PID&events=setpoint_[\d.]+_[\d.]+_0~load_.*", link), link


def plots_have_what_they_show():
    import matplotlib
    matplotlib.use("Agg")
    found = fixpid.fit(*recording())
    axes = found.plot()
    same([len(line.get_xdata()) for line in axes.lines], [len(found.t)] * 2)
    loop = fixpid.tune(found, "PI", 10, SENSOR, ACTUATOR)
    same([line.get_label() for line in loop.plot().lines], ["setpoint", "measurement"])
    pair = matplotlib.pyplot.subplots(2)[1]
    assert loop.plot(pair) is pair[0]
    same(pair[1].lines[0].get_ydata().tolist(), loop.output.tolist())


run((near_tells_numbers_apart, scenes_are_the_pages, rules_are_the_pages, margins_are_the_recorded, links_are_the_pages,
     numbers_are_written_as_on_the_page, the_table_is_whole, recordings_of_all_kinds,
     a_number_is_a_step_at_the_first_time_or_where_it_is_said, what_is_left_out_is_said, each_kind_is_told_apart,
     each_kind_is_tuned_and_simulated, what_is_no_step_is_refused, what_is_refused_can_be_looked_at,
     lags_that_are_no_part_of_a_step_are_simulated, tuning_is_on_the_hardware_that_is_given,
     without_hardware_it_is_the_pages, what_has_no_gains_says_what_to_do, a_simulated_loop_is_that_controllers,
     plants_and_events_that_are_none_are_refused, the_header_compiles_to_these_gains, plots_have_what_they_show), NAMES)
