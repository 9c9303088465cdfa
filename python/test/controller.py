# SPDX-License-Identifier: MIT
"""Pid in real units, what help() and type checkers see, and copies: controller.py."""
import ast
import copy
import inspect
import itertools
import math
import os
import pickle
import sys

import numpy
from scipy.signal import lfilter

import fixpid
from runner import message, refuses, run, same

SENSOR = fixpid.Sensor(low=-20, high=389.5, bits=12)
ACTUATOR = fixpid.Actuator(lowest=0, highest=1000, full=100)


def oven(**more):
    return fixpid.Pid(**{"kp": 1.7, "ki": 0.05, "kd": 3, "rate": 10, "filter": 2, "sensor": SENSOR,
                         "actuator": ACTUATOR, "setpoint": 180, **more})


def a_call_is_a_step():
    """In counts, against the verbs of C with the macro's gains."""
    pid = fixpid.Pid(kp=2, ki=0.5, kd=1.5, rate=10, filter=2, output_limits=(-5, 255), setpoint=700)
    c = fixpid.Pid(gains=fixpid.pid_gains(2, 0.5, 1.5, 10, 2), output_min=-5, output_max=255)
    for measurement in 600, 690, 695, 640.4, 639.5, 720, 1e9, -1e9:
        same(pid(measurement), c.step(700, max(-32768, min(32767, math.floor(measurement + 0.5)))))
    same(pid(40, setpoint=10.5), c.step(11, 40))
    same(pid.setpoint, 10.5)
    same(pid.components, (c.proportional() / 256, c.integral() / 65536, c.derivative() / 256))


def units_are_those_of_sensor_and_actuator():
    """A count is 0.1 degrees and 0.1 %, so the gains stay; the signals are moved."""
    pid = oven()
    c = fixpid.Pid(gains=fixpid.pid_gains(1.7, 0.05, 3, 10, 2), output_max=1000)
    for degrees in 150.0, 160.04, 172.0, -100.0, 1000.0, 181.0:
        counts = max(0, min(4095, math.floor((degrees + 20) / 409.5 * 4095 + 0.5)))
        same(pid(degrees), c.step(2000, counts) / 10)
    fine = fixpid.Sensor(0, 100, bits=10)
    half = fixpid.Pid(kp=2, rate=1, sensor=fine, actuator=fixpid.Actuator(-500, 250, full=2))
    same(half._said[1]["gains"]["kp_q8"], math.floor(2 * (100 / 1023) / (2 / 500) * 256 + 0.5))
    same(half.output_limits, (-2, 1))
    same((fine.counts(50), fine.units(1023)), (512, 100))
    for weight, q8, on_measurement in ((1, 256, False), (0.25, 64, False), (0, 0, True)):
        config = oven(setpoint_weight=weight)._said[1]
        same((config["setpoint_weight_q8"], config["proportional_on_measurement"]), (q8, on_measurement))


def the_transfer_function_is_that_of_controller_md():
    """Sampled by backward Euler: s is (1 - 1/z) / Ts, as in Matlab's pid(). All gains are exact."""
    kp, ki, kd, b, rate = 2.5, 0.25, 8.0, 0.5, 8
    random = numpy.random.default_rng(937)
    r, y = 2 * random.integers(-25, 26, 2000), random.integers(-100, 101, 2000)
    y[0] = 0  # the integral starts from 0
    s = numpy.array([1, -1]) * rate
    for n, on_error in itertools.product(range(8), (False, True)):
        tf = (2**n - 1) / rate
        seen = y - r if on_error else y
        exact = (kp * (b * r - y) + lfilter([ki, 0], s, r - y)
                 - lfilter(kd * s, tf * s + [1, 0], seen - seen[0]))
        pid = fixpid.Pid(kp=kp, ki=ki, kd=kd, rate=rate, filter=n, setpoint_weight=b, derivative_on_error=on_error,
                         output_limits=(-32768, 32767))
        worst = max(abs(pid.run(r, y) - exact))
        assert worst <= 0.5 + 2**n / 256, f"filter {n}: {worst:g} counts"


def arrays_run():
    pid, one = oven(), oven()
    measurements = numpy.linspace(150, 190, 30)
    setpoints = numpy.where(measurements < 170, 180.0, 175.0)
    outputs = pid.run(setpoints, measurements)
    same(outputs.tolist(), [one(y, r) for y, r in zip(measurements, setpoints)])
    same(pid.setpoint, 175)
    same(oven().run(numpy.full((2, 3), 180), measurements[:3]).shape, (2, 3))
    same((pid.run(170, []).size, pid.setpoint), (0, 170))
    counts = fixpid.Pid(kp=1, rate=1, output_limits=(0, 9))
    outputs = counts.run(5, [1, 2.6, 9, -1e9, 1e9])
    assert outputs.tolist() == [4, 2, 0, 9, 0] and outputs.dtype == numpy.int16 and counts.setpoint == 5
    # What is refused has moved nothing.
    before = counts.state()
    assert refuses(ValueError, counts.run, 5, [1, math.inf]) and counts.state() == before
    same(fixpid.Pid(kp=1, rate=1, sensor=fixpid.Sensor(20, 90), output_limits=(0, 9)).setpoint, 20)


def tunings_and_limits_are_set_live():
    pid, again = oven(), oven(kp=0.8, ki=0.01, kd=0)
    pid.tunings = 0.8, 0.01, 0
    same(pid.tunings, (0.8, 0.01, 0))
    same(pid._said[1]["gains"], again._said[1]["gains"])
    said = message(ValueError, setattr, pid, "tunings", (0.8, 0.01, 1e9))
    assert said.startswith("kd = 1e+09 is refused"), said
    same((pid.tunings, pid(150)), ((0.8, 0.01, 0), again(150)))
    pid.output_limits = 10, 60
    same(pid.output_limits, (10, 60))
    assert pid(-20) == 60 and pid(300) == 10
    raw = fixpid.Pid(gains=fixpid.pid_gains(2, 0.5, 1.5, 10, 2), output_max=255, rate=10)
    assert all(abs(one - other) < 1e-6 for one, other in zip(raw.tunings, (2, 0.5, 1.5))), raw.tunings
    tunings = raw.tunings
    raw.set_gains(kp_q8=1024)
    same(raw.tunings, (4, *tunings[1:]))  # what is not named stays
    assert message(TypeError, raw.set_gains, kp=2).startswith("there is no 'kp'")


def by_hand_and_back_without_a_bump():
    pid = oven(kd=0)
    before = pid(170)
    pid.auto_mode = False
    assert pid.auto_mode is False and pid(120) == before == pid(200)
    pid.auto_mode = True
    assert pid.auto_mode is True and pid(175) == before
    pid.set_auto_mode(False, 42.5)
    same((pid(0), pid(300)), (42.5, 42.5))
    pid.set_auto_mode(True, 33)
    same(pid(180), 33)


def what_is_refused_is_named():
    limits = {"rate": 10, "output_limits": (0, 255)}
    for kind, fields, start in (
            (TypeError, {"gains": (2, 1, 0), "output_max": 255}, "gains = (2, 1, 0) is refused: a dictionary"),
            (TypeError, {"kp": 2, "ki": 1}, "rate is missing"), (TypeError, {"ki": 1}, "kp is missing"),
            (TypeError, {"kp": 2, "rate": 1}, "output_limits are missing"),
            (TypeError, {"kp": (2, 1), **limits}, "kp = (2, 1) is refused"),
            (TypeError, {"kp": 2, "output_max": 9, **limits}, "output_max is refused together with kp"),
            (TypeError, {"outputmax": 255}, "there is no 'outputmax'; there are kp, ki, kd, rate (steps per second), output_limits"),
            (TypeError, {"Kp": 2, **limits}, "there is no 'Kp'; there are kp"),
            (TypeError, {"kp": 2, "sample_time": 0.1}, "there is no 'sample_time'; there are kp, ki, kd, rate"),
            (ValueError, {"kp": 2, **limits, "setpoint": 1e6}, "setpoint = 1e+06 is refused: -32768 to 32767 is legal"),
            (TypeError, {"gains": {"kp": 2}}, "there is no 'kp'; there are kp_q8"),
            (TypeError, {"kp": 2, **limits, "sensor": (0, 100)}, "sensor = (0, 100) is refused: a fixpid.Sensor"),
            (TypeError, {"kp": 2, **limits, "output_limits": 255}, "output_limits = 255 is refused: a pair"),
            (TypeError, {"output_max": 1.5}, "output_max = 1.5 is refused: a whole number"),
            (OverflowError, {"output_max": 40000}, "output_max = 40000 is refused: it does not fit -32768..32767"),
            (ValueError, {}, "output_max = 0 is refused: not above output_min"),
            (ValueError, {"output_max": 1, "integral_min": 1}, "integral_max = 0 is refused: below integral_min"),
            (ValueError, {"output_max": 1, "gains": {"kp_q8": 40000}},
             "kp_q8 = 40000 is refused: proportional gain x 256; 0..32767"),
            (ValueError, {"kp": 200, **limits}, "kp = 200 is refused: 0 and 0.00195312 to 127.996 are legal"),
            (ValueError, {"kp": -1, **limits}, "kp = -1 is refused: for an output that falls"),
            (ValueError, {"kp": 1, "ki": 1e-9, **limits}, "ki = 1e-09 is refused"),
            (ValueError, {"kp": math.nan, **limits}, "kp = nan is refused"),
            (ValueError, {"kp": 1, **limits, "rate": 0}, "rate = 0 is refused"),
            (ValueError, {"kp": 1, **limits, "filter": 8}, "filter = 8 is refused: 0..7"),
            (ValueError, {"kp": 1, **limits, "setpoint_weight": 1.5}, "setpoint_weight = 1.5 is refused"),
            (ValueError, {"kp": 1, **limits, "output_limits": (0, 40000)}, "output_limits = (0, 40000) is refused"),
            (ValueError, {"kp": 1, **limits, "output_limits": (9, 9)}, "output_limits = (9, 9) is refused")):
        said = message(kind, fixpid.Pid, **fields)
        assert said.startswith(start), f"{fields}: {said}"
    pid = fixpid.Pid(kp=2, **limits)
    for kind, call, arguments, start in (
            (OverflowError, pid.step, (1, 32768), "measurement = 32768 is refused"),
            (TypeError, pid.step, (1.0, 1), "setpoint = 1.0 is refused"),
            (ValueError, pid, (math.inf,), "measurement = inf is refused"),
            (ValueError, oven(), (20, 389.6), "setpoint = 389.6 is refused: -20 to 389.5 is legal here"),
            (ValueError, pid.run, ([1, -40000], 1), "setpoints[1] = -40000 is refused: -32768 to 32767 is legal"),
            (ValueError, pid.run, (1, [1, math.nan]), "measurements[1] = nan is refused"),
            (TypeError, pid.run, (1, ["a"]), "measurements is refused: an array of numbers"),
            (TypeError, pid.steps, (1,), "setpoint, measurement are wanted, not 1"),
            (TypeError, pid, ((1, 2),), "measurement = (1, 2) is refused"),
            (TypeError, pid, (1, (1, 2)), "setpoint = (1, 2) is refused"),
            (OverflowError, fixpid.Slew, (1, -1), "fall_q16 = -1 is refused"),
            (TypeError, fixpid.Guard, (5,), "Guard takes its fields by name: output_min"),
            (TypeError, fixpid.Pid, (2, 1, 0), ""), (ValueError, fixpid.Sensor, (5, 5), "(low, high) = (5, 5)"),
            (ValueError, fixpid.Sensor, (0, 1, 16), "bits = 16 is refused: 6..15"),
            (ValueError, fixpid.Actuator, (0, 40000), "highest = 40000 is refused"),
            (ValueError, fixpid.Actuator, (0, 9, -1.0), "full = -1.0 is refused")):
        said = message(kind, call, *arguments)
        assert start in said, said
    said = message(ValueError, fixpid.Tpo, full=0)
    assert said.startswith("full = 0 is refused: The duty that is on without a gap"), said


def copies_go_on_by_themselves():
    for make, moved in ((oven, lambda one: one(172)), (lambda: fixpid.Slew(9, 9), lambda one: one.step(99)),
                        (lambda: fixpid.Pid(gains={"kp_q8": 256}, output_max=99), lambda one: one.step(50, 3)),
                        (lambda: fixpid.Tpo(full=10, window=4), lambda one: one.step(3))):
        first = make()
        moved(first)
        others = [copy.copy(first), copy.deepcopy(first), pickle.loads(pickle.dumps(first))]
        expected = [moved(first) for _ in range(20)]
        for other in others:
            same([moved(other) for _ in range(20)], expected)
            same(repr(other), repr(first))
    state = oven().__getstate__()
    assert refuses(ValueError, oven().__setstate__, {**state, "version": "0.0.0"})
    table = fixpid.table(lambda x: x * x / 9, 0, 99, points=5)
    again = pickle.loads(pickle.dumps(table))
    same((again.points, again.error, again.at(50)), (table.points, table.error, table.at(50)))


def repr_makes_it_again():
    names = {name: getattr(fixpid, name) for name in ("Pid", "Sensor", "Actuator", "Slew", "Guard", "Table")}
    for one in (oven(), oven(setpoint_weight=0.5, reverse=True, integral_limits=(0, 50)), oven(setpoint_weight=0),
                fixpid.Pid(kp=2, rate=1, output_limits=(-9, 9)), fixpid.Slew(3, 4),
                fixpid.Pid(gains={"kp_q8": 256}, output_max=99)):
        again = eval(repr(one), names)  # pylint: disable=eval-used
        same(repr(again), repr(one))
        same(bytes(fixpid.ffi.buffer(again.c)), bytes(fixpid.ffi.buffer(one.c)))


def _classes_of_the_stub():
    """{class: {method: argument names}} of `_nouns.pyi`, its constants, and what `*` takes."""
    with open(os.path.join(os.path.dirname(fixpid.__file__), "_nouns.pyi"), encoding="utf-8") as file:
        body = ast.parse(file.read()).body
    classes = {node.name: {part.name: part for part in node.body if isinstance(part, ast.FunctionDef)}
               for node in body if isinstance(node, ast.ClassDef)}
    exported = next(ast.literal_eval(node.value) for node in body if isinstance(node, ast.Assign))
    return classes, {node.target.id for node in body if isinstance(node, ast.AnnAssign)}, exported


def stubs_are_what_there_is():
    """Every class, verb and constant is in the stub with its arguments, and nothing else."""
    classes, constants, exported = _classes_of_the_stub()
    known = {name[len("FIXPID_"):] for name in dir(fixpid.lib) if name.startswith("FIXPID_")}
    same(sorted(known ^ constants), [])
    same(sorted(exported), sorted(sys.modules["fixpid._nouns"].__all__))
    same([name for name in exported if not hasattr(fixpid, name)], [])
    nouns = {noun.__name__: noun for noun in fixpid.Noun.__subclasses__()}
    same(set(classes) - {"Noun", "PidGains"}, set(nouns))
    seen = 0
    for name, noun in nouns.items():
        own = {verb: method for verb, method in vars(noun).items() if not verb.startswith("_") and callable(method)}
        assert set(own) - set(classes[name]) <= {"progress", "model", "result", "pack", "unpack", "state", "restore"}, (name, set(own))
        for verb, node in classes[name].items():
            assert hasattr(noun, verb), (name, verb)
            if verb in own and not node.args.kwonlyargs:
                expected = [argument.arg for argument in node.args.posonlyargs + node.args.args]
                same(list(inspect.signature(own[verb]).parameters), expected)
                seen += 1
    assert seen >= 55, seen


def help_is_the_headers():
    assert fixpid.Pid.step.__doc__.startswith("One step, once per sample period; returns output_min..output_max.")
    assert "D = clamp(D - floor(D / 2^n) + kd_q8 * d, -DMAX, DMAX)\n" in fixpid.Pid.step.__doc__
    assert "FIXPID_" not in fixpid.Guard.__doc__ and fixpid.Guard.__doc__.startswith("fixpid_guard: reports when")
    same(str(inspect.signature(fixpid.Pid.track)), "(self, applied, shift, /)")
    silent = [f"{noun.__name__}.{verb}" for noun in fixpid.Noun.__subclasses__() for verb, method in vars(noun).items()
              if callable(method) and not verb.startswith("_") and verb != "check" and not method.__doc__]
    same(silent, [])
    same([name for name in ("numpy", "operator", "math", "enum", "textwrap") if hasattr(fixpid, name)], [])


run()
