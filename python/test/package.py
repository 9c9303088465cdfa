# SPDX-License-Identifier: MIT
"""What the package adds to the library: arrays, gains in real units, refusals.

    package.py INCLUDE README GUIDE    the headers, whose macros a C compiler folds, and the
                                       pages whose code must run

Prints `ok NAME` or `FAILED NAME` and why.
"""
import contextlib
import copy
import io
import math
import os
import random
import re
import subprocess
import sys
import tempfile
import types

import numpy

import fixpid
from board import Board, Clock
from fixpid import ffi, lib
from fixpid._core import WHOLE
from runner import message, refuses, run, same

INCLUDE, README, GUIDE = sys.argv[1:]
CONFIG = {"gains": fixpid.pid_gains(kp=2, ki=0.5, kd=1.5, rate=10, filter=2), "output_max": 255}


def compiled(lines, body):
    """What a program in C prints; None if it does not compile."""
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "program")
        text = "\n".join(["#include <stdio.h>", '#include "fixpid_pid.h"',
                          '#include "fixpid_slew.h"', *lines,
                          "int main(void)\n{", *body, "    return 0;\n}\n"])
        command = ["cc", "-std=c99", "-I", INCLUDE, "-x", "c", "-", "-o", program]
        done = subprocess.run(command, input=text, universal_newlines=True,
                              stderr=subprocess.DEVNULL)
        return subprocess.check_output([program], text=True) if done.returncode == 0 else None


ASKED = "fixpid_guard_from_model", "fixpid_table_at", "fixpid_table_valid"  # by guard_config and by the class Table


def every_function_has_a_method():
    nouns = {noun._noun: getattr(fixpid, noun.__name__) for noun in fixpid.Noun.__subclasses__()}
    modules = "record", "gains", "sat16", "table"
    others = sys.modules["fixpid._headers"].WITHOUT  # whose other end Python is
    lost = []
    for name in (name for name in dir(fixpid.lib) if name.startswith("fixpid_")):
        verbs = [name[len(f"fixpid_{noun}_"):] for noun in nouns
                 if name.startswith(f"fixpid_{noun}_") and
                 hasattr(nouns[noun], name[len(f"fixpid_{noun}_"):])]
        if not verbs and name not in ASKED and name.split("_")[1] not in others and not (name.split("_")[1] in modules and hasattr(fixpid, name[7:])):
            lost.append(name)
    assert len(dir(fixpid.lib)) > 100 and not lost, lost


TUNER = {"output_min": -100, "output_max": 100, "measurement_min": -32768, "measurement_max": 32767,
         "swing": 200, "timeout_steps": 500, "cycles": 2}
LEGAL = {"autotune": TUNER, "guard": {"output_min": 0, "output_max": 255, "reach_min": 0, "reach_max": 0, "band": 8, "patience": 90},
         "pid": {"gains": CONFIG["gains"], "output_min": -9, "output_max": 300, "integral_min": 0, "integral_max": 0, "setpoint_weight_q8": 99}}


def drawn(draw, kind):
    """A value of this type of C: small, or at an end."""
    if kind.kind == "struct":
        return {name: drawn(draw, field.type) for name, field in kind.fields}
    low, high = WHOLE.get(kind.cname, (0, 1))  # or a bool
    return draw.choice((low, high, *(draw.randint(0, min(high, 99)) for _ in range(6))))


def verbs_are_those_of_c():
    """Of each noun with fields and arguments by chance: what is accepted, what is returned, and all bytes of it."""
    draw, accepted, called = random.Random(9), {}, set()
    for base in fixpid.Noun.__subclasses__():
        def function(verb, noun=base._noun):
            return getattr(lib, f"fixpid_{noun}_{verb}")

        verbs = [verb for verb in vars(base) if hasattr(lib, f"fixpid_{base._noun}_{verb}") and verb != "check"
                 and all(kind.kind == "primitive" for kind in ffi.typeof(function(verb)).args[1:])]
        for _ in range(300):
            kinds = ffi.typeof(function("init")).args[1:]
            fields = drawn(draw, kinds[0].item) if base._config else {}
            fields.update(LEGAL.get(base._noun, {}) if draw.random() < 0.5 else {})
            numbers = [] if base._config else [drawn(draw, kind) for kind in kinds]
            c = ffi.new(f"struct fixpid_{base._noun} *")
            good = function("init")(c, *(numbers or [ffi.new(f"struct fixpid_{base._config} *", fields)])) is not False
            try:
                one = getattr(fixpid, base.__name__)(*numbers, **fields)
            except ValueError:
                one = None
            same((fields, one is not None), (fields, good))
            for verb in draw.choices(verbs, k=12) if good else ():
                arguments = [drawn(draw, kind) for kind in ffi.typeof(function(verb)).args[1:]]
                try:
                    found = getattr(one, verb)(*arguments)
                except ValueError:
                    found = False
                expected = function(verb)(c, *arguments)
                same((verb, True if found is None and expected is True else found, bytes(ffi.buffer(one.c))), (verb, expected, bytes(ffi.buffer(c))))
                called.add((base, verb))
            accepted[base] = accepted.get(base, 0) + good
        assert accepted[base] > 20 and {verb for of, verb in called if of is base} == set(verbs), (base, accepted)


def gains_in_thousandths():
    gains = fixpid.gains_from_milli(2000, 500, 1500, 10000, 2)
    same((gains, fixpid.gains_to_milli(gains, 10000)), (fixpid.pid_gains(2, 0.5, 1.5, 10, 2), {"kp": 2000, "ki": 500, "kd": 1500}))
    assert refuses(ValueError, fixpid.gains_from_milli, 200000, 0, 0, 1000) and refuses(ValueError, fixpid.gains_to_milli, gains, 0)


def steps_are_those_of_step():
    one, many = fixpid.Pid(**CONFIG), fixpid.Pid(**CONFIG)
    measurements = numpy.random.default_rng(1).integers(-32768, 32768, (40, 50))
    outputs = many.steps(numpy.int16(300), measurements)
    assert outputs.dtype == numpy.int16 and outputs.shape == (40, 50)
    same(outputs.ravel().tolist(), [one.step(300, int(y)) for y in measurements.ravel()])
    same(fixpid.Tpo(full=10, window=4).steps(numpy.full(8, 5)).dtype, bool)
    same(fixpid.An937(accumulated_error_limit=1, derivative_period_ticks=1).steps(
        [1, 2]).dtype, numpy.int32)


def what_does_not_fit_is_refused():
    same((fixpid.sat16(60000), fixpid.sat16(-60000), fixpid.sat16(5)), (32767, -32768, 5))
    pid = fixpid.Pid(**CONFIG)
    assert refuses(TypeError, pid.step, 1.0, 0)
    assert refuses(TypeError, pid.step, numpy.float32(1), 0)
    assert refuses(TypeError, pid.steps, numpy.zeros(3), 0)
    assert refuses(OverflowError, pid.step, 32768, 0)
    assert refuses(OverflowError, pid.steps, 0, numpy.array([-32769]))
    assert refuses(TypeError, fixpid.Pid, output_maximum=1)
    assert refuses(ValueError, fixpid.Pid)
    assert refuses(ValueError, pid.set_limits, 5, 5)
    assert refuses(ValueError, pid.set_gains, kp_q8=fixpid.PID_KP_MAX + 1)


def what_is_refused_is_named():
    assert fixpid.Pid.check(output_max=1) is None
    same(fixpid.Pid.check(output_max=1, setpoint_weight_q8=257), "setpoint_weight_q8")
    same(fixpid.Pid.check(gains={"kd_q8": 32256}), "kd_q8")
    assert fixpid.Pid.check(output_max=0) == "output_max"


# 255 counts of output raise 10 bits by 700, with a lag of 1200 steps, a delay of 60 and a
# noise of half a count.
HEATER = {"gain_q8": round(700 / 255 * 256), "lag_q4": 1200 * 16, "dead_q4": 60 * 16,
          "slope_q24": round(700 / 255 / 1200 * 2**24), "noise_q4": 8}


def guard_is_chosen_by_the_librarys_rule():
    config = fixpid.guard_config(HEATER, 0, 255, measurement_min=1, measurement_max=1022)
    same(config, {"band": 8, "patience": 395, "noisy": False, "output_min": 0,
                  "output_max": 255, "measurement_min": 1, "measurement_max": 1022})
    flags = fixpid.Guard(**config).steps(500, numpy.full(395, 100), 255)
    assert flags.dtype == numpy.uint8 and flags[:-1].max() == 0 and flags[-1] == fixpid.GUARD_NOT_RISING
    noisy = {**HEATER, "noise_q4": 17}
    for model, more, band, patience in (({**HEATER, "bands": 50}, {}, 8, 806), (noisy, {}, 13, 566),
                                        (noisy, {"patience": 5, "noisy": True}, 13, 5), (noisy, {"band": 20}, 20, 806)):
        found = fixpid.guard_config(model, 0, 255, **more)
        same((found["band"], found["patience"]), (band, patience))
    for model, high, more in (({**HEATER, "slope_q24": 0}, 255, {}), (HEATER, 0, {}), (HEATER, 255, {"reach_min": 1, "reach_max": 9})):
        assert refuses(ValueError, fixpid.guard_config, model, 0, high, **more)


def table_has_the_lines_of_its_points():
    table = fixpid.Table([(0, 0), (2, -1), (3, 50)])
    same([table.at(x) for x in (-9, 0, 1, 2, 3, 9)], [0, 0, 0, -1, 50, 50])
    same(table.at(numpy.array([[1, 2], [3, 4]])).tolist(), [[0, -1], [50, 50]])
    same(table.points, ((0, 0), (2, -1), (3, 50)))
    assert refuses(ValueError, fixpid.Table, [])
    assert refuses(ValueError, fixpid.Table, [(0, 0)])
    assert refuses(ValueError, fixpid.Table, [(0, 0), (0, 1)])
    assert refuses(OverflowError, fixpid.Table, [(0, 0), (40000, 1)])
    assert refuses(OverflowError, fixpid.Table, [(x, x) for x in range(256)])
    assert refuses(OverflowError, table.at, 32768)
    assert refuses(TypeError, table.at, 0.5)


def ntc(bits, scale):
    """Degrees times `scale` over counts, of 10 kOhm by B 3950 with 10 kOhm to the supply; and the first and last count of 0 to 150."""
    def celsius(count):
        ratio = (count + 0.5) / 2**bits
        return 1 / (1 / 298.15 + math.log(ratio / (1 - ratio)) / 3950) - 273.15
    inside = [count for count in range(2**bits) if 0 <= celsius(count) <= 150]
    return lambda count: celsius(count) * scale, inside[0], inside[-1]


# What is reached with 8, 16 and 24 points at most, in counts.
SENSORS = ((ntc(10, 100), (57.15, 14.65, 6.28)), (ntc(10, 10), (6.01, 1.84, 1.09)),
           (ntc(12, 100), (56.24, 14.28, 6.56)), (ntc(12, 10), (6.02, 1.821, 1.08)))


def value(points, x):
    """The definition, in Python's own integers."""
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if x <= x1:
            return y0 + (2 * (y1 - y0) * (x - x0) + x1 - x0) // (2 * (x1 - x0))
    raise AssertionError(x)


def tables_follow_sensors():
    for (function, first, last), most in SENSORS:
        for points, error in zip((8, 16, 24), most):
            found = fixpid.table(function, first, last, points=points)
            worst = max(abs(value(found.points, x) - function(x)) for x in range(first, last + 1))
            assert found.error == worst <= error, (first, last, points, found.error, worst)
            assert len(found.points) <= points and found.points[0][0] == first
            assert found.points[-1][0] == last and found.at(last) == found.points[-1][1]
    for function, first, last in SENSORS[0][0], SENSORS[2][0]:
        found = fixpid.table(function, first, last, error=10)  # 0.1 degrees
        assert found.error <= 10 and len(found.points) <= 20, (found.error, len(found.points))


def tables_of_few_points():
    line = fixpid.table(lambda x: 3 * x - 7, -100, 100)
    assert line.points[0] == (-100, -307) and line.points[-1] == (100, 293) and line.error == 0
    same(len(fixpid.table(lambda x: 3 * x - 7, -100, 100, error=0).points), 2)
    jump = fixpid.table(lambda x: 500 if x > 3 else -500, -32768, 32767, error=0)
    same(jump.points, ((-32768, -500), (3, -500), (4, 500), (32767, 500)))
    whole = fixpid.table(lambda x: x, -32768, 32767, points=2)
    assert whole.points == ((-32768, -32768), (32767, 32767)) and whole.error == 0
    same(len(fixpid.table(lambda x: x * x, 0, 100).points), 16)  # if nothing else is said
    ends = fixpid.table(lambda x: 32767.4, 0, 1, points=2)
    assert ends.points == ((0, 32767), (1, 32767)) and abs(ends.error - 0.4) < 1e-9
    for wrong in ({"points": 1}, {"points": 256}, {"error": -1}, {"error": math.nan},
                  {"points": 2, "error": 2}):
        assert refuses(ValueError, fixpid.table, float, 0, 9, **wrong), wrong
    for function in (lambda x: 40000, lambda x: math.nan, lambda x: -32769):
        assert refuses(ValueError, fixpid.table, function, 0, 9)
    assert refuses(ValueError, fixpid.table, float, 5, 5)
    assert refuses(ValueError, fixpid.table, float, 0, 32768)
    assert refuses(ValueError, fixpid.table, lambda x: 0.5, 0, 9, error=0.4)
    assert refuses(ValueError, fixpid.table, lambda x: 900 * (x % 2), 0, 400, error=1)


def tables_in_c():
    found = fixpid.table(*SENSORS[0][0])
    text, last = found.c("ntc"), SENSORS[0][0][2]
    assert max(map(len, text.splitlines())) <= 80, text
    body = [f"for (int x = 0; x <= {last}; x++) {{",
            'printf("%d\\n", fixpid_table_at(&ntc, (int16_t)x)); }']
    printed = compiled([f'#include "{INCLUDE}/../src/table/fixpid_table.c"', text], body)
    same(printed.split(), [str(found.at(x)) for x in range(last + 1)])


def records_come_back():
    record = fixpid.record_pack(**CONFIG)
    config = fixpid.record_unpack(record)
    assert config["gains"] == CONFIG["gains"] and config["output_max"] == 255
    assert refuses(ValueError, fixpid.record_unpack, bytes([record[0] ^ 1]) + record[1:])
    assert refuses(ValueError, fixpid.record_unpack, record[:-1])


def states_come_back():
    pid, other = fixpid.Pid(**CONFIG), fixpid.Pid(**CONFIG)
    pid.steps(50, range(40))
    state = pid.state()
    other.restore(state)
    assert other.state() == state
    same(other.steps(50, range(60)).tolist(), pid.steps(50, range(60)).tolist())
    assert refuses(ValueError, other.restore, state[:-1])
    assert refuses(ValueError, other.restore, state[:2] + b"\x80" + state[3:])
    assert other.state() == pid.state()


def _experiment():
    """On an integrator with a dead time of 5 steps, and the progress after each step."""
    tuner = fixpid.Autotune(**TUNER)
    assert refuses(ValueError, tuner.pack)
    level, line, progress = 0, [0] * 5, []
    while tuner.status() == fixpid.AUTOTUNE_RUNNING:
        line.append(tuner.step(0, level // 8))
        level += line.pop(0)
        progress.append(tuner.progress())
    return tuner, progress


def autotune_finds_gains():
    tuner, progress = _experiment()
    assert tuner.status() is fixpid.AutotuneState.DONE == fixpid.AUTOTUNE_DONE
    same([at["phase"] for at in (progress[0], progress[-1])], [0, 6])
    assert all(at["done"] < at["expected"] == 13 for at in progress[:-1]), progress
    assert progress[-1]["done"] == 13 and progress[-1]["period"] > 20
    # 1 / 8 count per count and step
    model = tuner.model()
    assert abs(model["slope_q24"] / 2**24 - 1 / 8) < 0.02, model
    assert model["gain_q8"] == fixpid.AUTOTUNE_INTEGRATING and 5 * 16 < model["dead_q4"], model
    for rule in fixpid.AUTOTUNE_PI, fixpid.AUTOTUNE_PID:
        quick, safe, calm = (tuner.result(rule, word, output_max=7)["gains"]["kp_q8"] for word in
                             (fixpid.AUTOTUNE_QUICK, fixpid.AUTOTUNE_SAFE, fixpid.AUTOTUNE_CALM))
        assert quick > safe > calm > 0
        assert fixpid.Pid(**tuner.result(rule, output_max=7)) and tuner.reason(rule) == 0


def autotune_says_what_to_do():
    tuner, _ = _experiment()
    assert tuner.result(2) is None and tuner.reason(2) is fixpid.AutotuneCause.NOT_LEGAL
    assert tuner.reason(fixpid.AUTOTUNE_PI, 65) is fixpid.AutotuneCause.NOT_LEGAL
    tuner.reset()
    assert tuner.model() is None and tuner.reason(0) is fixpid.AutotuneCause.NOT_DONE
    same(tuner.status().advice, "Keep stepping.")
    for causes, prefix, count in ((fixpid.AutotuneState, "AUTOTUNE", 9), (fixpid.AutotuneCause, "AUTOTUNE", 8),
                                  (fixpid.ReactionState, "REACTION", 9)):
        same((len(causes), len({cause.advice for cause in causes} - {""})), (count, count))
        assert all(getattr(fixpid, f"{prefix}_{cause.name}") == cause for cause in causes)


def experiments_come_back():
    tuner, progress = _experiment()
    record = tuner.pack()
    same(len(record), fixpid.AUTOTUNE_RECORD_SIZE)
    text = "".join(f"{byte:02X}" + "  \n"[at % 4:at % 4 + 1] for at, byte in enumerate(record))
    for packed in record, bytearray(record), text, f"\t{record.hex()}\n":
        again = fixpid.Autotune.unpack(packed)
        assert again.status() == tuner.status() and again.model() == tuner.model()
        assert again.progress() == progress[-1] and again.pack() == record
        assert all(again.result(rule, word, output_max=9) == tuner.result(rule, word, output_max=9)
                   for rule in range(3) for word in range(7, 66))
    unpack = fixpid.Autotune.unpack
    for wrong in (record[:-1], record + b"\0", bytes([2]) + record[1:], record.hex()[1:],
                  record.hex()[:-1] + "g", "", bytes([record[0], record[1] ^ 1]) + record[2:]):
        assert refuses(ValueError, unpack, wrong), wrong


class Kettle:
    """A lag of 80 steps and a dead time of 5: 1000 counts of output are 3000 of the measurement."""

    def __init__(self):
        self.level, self.line = 0.0, [0] * 5

    def move(self, output):
        self.line.append(output)
        self.level += (3 * self.line.pop(0) - self.level) / 80
        return round(self.level)


def heat_up_hands_over():
    tuner, kettle, measurement = fixpid.Reaction(output_drive=1000, measurement_stop=1500), Kettle(), 0
    assert tuner.model() is None and tuner.result(fixpid.REACTION_PI) is None
    while tuner.status() is fixpid.ReactionState.RUNNING:
        measurement = kettle.move(tuner.step(measurement))
    assert tuner.status() is fixpid.ReactionState.DONE and tuner.progress() == 100 and measurement < 1500
    # 3 counts per count in 80 steps
    assert abs(tuner.model()["slope_q24"] / 2**24 - 3 / 80) < 0.005, tuner.model()
    same(tuner.result(2), None)
    for rule in fixpid.REACTION_PI, fixpid.REACTION_PID:
        quick, safe, calm = (tuner.result(rule, word)["kp_q8"] for word in
                             (fixpid.REACTION_QUICK, fixpid.REACTION_SAFE, fixpid.REACTION_CALM))
        assert quick > safe > calm > 0 and tuner.result(rule)["kp_q8"] == safe
        pid, one = fixpid.Pid(gains=tuner.result(rule), output_max=1000, setpoint_weight_q8=128), copy.deepcopy(kettle)
        way, now = [], measurement
        for _ in range(400):
            now = one.move(pid.step(1500, now))
            way.append(now)
        assert max(way) < 1515 and abs(way[-1] - 1500) <= 1, (max(way), way[-1])


def gains_are_those_of_the_macro():
    draw = random.Random(1)
    wanted = [(round(2 ** draw.uniform(-8, 6.9), 4), round(2 ** draw.uniform(-8, 5), 5),
               round(2 ** draw.uniform(0, 2.5), 4), draw.choice((0.5, 1, 3, 10, 20)),
               draw.randrange(8)) for _ in range(500)]
    table = "".join(f"    FIXPID_PID_GAINS({', '.join(map(str, gains))}),\n" for gains in wanted)
    table = "static const struct fixpid_pid_gains table[] = {\n" + table + "};"
    body = [f"for (int i = 0; i < {len(wanted)}; i++) {{",
            'printf("%u %lu %u %u\\n", table[i].kp_q8, (unsigned long)table[i].ki_q24,',
            "table[i].kd_q8, table[i].derivative_filter); }"]
    folded = compiled([table], body).splitlines()
    ours = [" ".join(map(str, fixpid.pid_gains(*gains).values())) for gains in wanted]
    different = [row for row in zip(wanted, folded, ours) if row[1] != row[2]]
    assert len(folded) == len(wanted) and not different, different[:5]


def gains_are_refused_as_by_the_macro():
    """At both ends of each range, on both sides."""
    for gains in ((0.0019, 0, 0, 1, 0), (0.00196, 0, 0, 1, 0), (127.998, 0, 0, 1, 0),
                  (127.9979, 0, 0, 1, 0), (1, 4.7e-7, 0, 1, 0), (1, 4.8e-7, 0, 1, 0),
                  (1, 127.997, 0, 1, 0), (1, 127.996, 0, 1, 0), (1, 0, 0.0019, 1, 0),
                  (1, 0, 0.002, 1, 0), (1, 0, 126, 1, 0), (1, 0, 125.99, 1, 0),
                  (1, 0, 1, 1, 8), (-1, 0, 0, 1, 0), (1, 0, 0, 0, 0)):
        text = ", ".join(map(str, gains))
        legal = compiled([f"struct fixpid_pid_gains g = FIXPID_PID_GAINS({text});"], []) is not None
        assert refuses(ValueError, fixpid.pid_gains, *gains) != legal, gains


def rates_are_those_of_the_macro():
    for rate in ((20, 10), (0.001, 1), (0, 3), (65535, 1), (1e-5, 1), (65536, 1), (1, 0), (-1, 1)):
        text = ", ".join(map(str, rate))
        folded = compiled([f"uint32_t rate = FIXPID_SLEW_RATE({text});"],
                          ['printf("%lu", (unsigned long)rate);'])
        if folded is None:
            assert refuses(ValueError, fixpid.slew_rate, *rate), rate
        else:
            same(fixpid.slew_rate(*rate), int(folded))


def figures_are_those_of_the_run():
    """By numpy, of the series: from 20 degrees to 120, to 90 at 200 s, and a load at 400 s."""
    oven = fixpid.Plant(gain=200, lag=30, dead=2, start=20)
    pid = fixpid.Pid(kp=3, ki=0.4, rate=5, setpoint=120, sensor=fixpid.Sensor(0, 300),
                     actuator=fixpid.Actuator(highest=255, full=100))
    loop = fixpid.simulate(oven, pid, duration=600, events=[(200, "setpoint", 90), (400, "load", -0.2)])
    error = abs(loop.true - loop.setpoint)
    first = loop.true[:1000]
    found = loop.metrics
    assert abs(found["iae"] - error.sum() / 5) < 1e-9 * found["iae"] and abs(found["mean_error"] - error.mean()) < 1e-9
    assert abs(found["overshoot"] - (first.max() - loop.setpoint[0]) / 100) < 1e-3 and found["overshoot"] > 0.02, found
    same((found["settled"], found["rise"]), (loop.t[numpy.flatnonzero(abs(first - loop.setpoint[0]) > 2)[-1] + 1],
                                             loop.t[numpy.flatnonzero(first >= 20 + 0.9 * (loop.setpoint[0] - 20))[0]]))
    same((found["load"], found["limited"]), (error[2000:].max(), loop.limited.mean()))
    apart = (loop.true - loop.twin) / (300 / 4095)
    for name, value in (("moved", abs(numpy.diff(loop.output)).sum() / (100 / 255) / 3000), ("twin_most", abs(apart).max()),
                        ("twin_rms", (apart**2).mean()**0.5)):
        assert abs(found[name] - value) < 1e-9 * value, (name, found[name], value)
    assert 0 < found["limited"] < 0.5 and found["load"] > 2, found
    same(set(found), {name for name in found if name == name.lower()})


def what_a_run_would_cut_is_refused():
    plant, events = fixpid.Plant(gain=100, lag=30, dead=3), [(20, "limits", 0, 9), (40, "auto")]
    pid = fixpid.Pid(kp=1, ki=0.1, rate=5, setpoint=50, sensor=fixpid.Sensor(0, 150), actuator=fixpid.Actuator(highest=255, full=100))
    same(len(fixpid.simulate(plant, pid, 4000, setpoint=150, events=[*events, (3999.8, "manual", 9)]).t), 20000)
    for fields, said in (
            ({"duration": 4001}, "duration = 4001 is refused: 0.8 to 4000 is legal here"),
            ({"duration": 0.7}, "duration = 0.7 is refused"), ({"setpoint": 1e6}, "setpoint = 1e+06 is refused: 0 to 150 is legal"),
            ({"duration": 50, "events": [(50, "auto")]}, "time of auto = 50 is refused: 0 to 49.8"),
            ({"events": [(1, "setpoint", -1)]}, "setpoint = -1 is refused"), ({"events": [(1, "setpoint")]}, "event (1, 'setpoint') is refused"),
            ({"events": [(1, "auto", 1)]}, "event (1, 'auto', 1) is refused"), ({"events": [(1, "manual", 40000)]}, "manual = 40000 is refused"),
            ({"events": [(1, "limits", 9, 9)]}, "limits = (9, 9) is refused"),
            ({"plant": fixpid.Plant(gain=100, lag=0.1, dead=3000), "duration": 3900}, "dead = 3000 is refused: with these lags a run has at most 13 s of it at rate = 5: take a lower rate")):
        found = message(ValueError, fixpid.simulate, **{"plant": plant, "pid": pid, **fields})
        assert found.startswith(said), found


def names_of(path):
    """What the blocks of a page leave, one after the other."""
    with open(path, encoding="utf-8") as page:
        blocks = re.findall("```python\n(.*?)```", page.read(), re.DOTALL)
    names = {}
    for block in blocks:
        with contextlib.redirect_stdout(io.StringIO()):
            exec(block, names)
    return names


def code_of_the_page_runs():
    names = names_of(README)
    same((names["output"], names["outputs"].dtype, names["pid"].flags()), (255, numpy.int16, fixpid.PID_AT_MAX))
    assert 0 < names["percent"] < 100, names["percent"]
    assert names["loop"].margins["stable"] and names["loop"].metrics["overshoot"] < 0.2, names["loop"]
    assert names["chip"].status() == fixpid.AUTOTUNE_DONE and names["config"]["output_max"] == 1000


def code_of_the_guide_runs():
    """With a board where it opens a serial port."""
    clock = sys.modules["fixpid._link"].time = Clock()
    board = Board(noise=1, lag=60, manual_steps=5000, clock=clock)
    sys.modules["serial"] = types.SimpleNamespace(Serial=lambda *_: board)
    names = names_of(GUIDE)
    assert abs(names["fit"].gain - 2.4) < 0.05 and abs(names["fit"].lag - 140) < 5 and names["fit"].start == "cold", names["fit"]
    assert names["bad"].refused, names["bad"]
    assert names["loop"].advice == [] and 1.2 < names["door"].margins["ms"] < 1.8, names["door"]
    assert names["kp"] > 0 and names["ki"] > 0 and names["kd"] == 0
    assert names["live"].calm == 1 and names["link"].equal and names["link"].compared > 800, names["link"]
    same((board.config.gains.kp_q8, board.link.stream_interval), (names["tuned"].pid._said[1]["gains"]["kp_q8"], 0))
    assert abs(names["step"].measurement - 300) < 10 and names["step"].setpoint == 300, names["step"]
    assert "LOOP_OVEN_CONFIG" in names["header"] and names["url"].startswith("build/tuner/index.html#p=flow&")


run()
