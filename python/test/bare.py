# SPDX-License-Identifier: MIT
"""What a wheel has to do alone, where there is cffi and no numpy: bare.py WHEEL."""
import ast
import copy
import os
import sys
import sysconfig
import zipfile

import fixpid
from board import Board
from runner import refuses, run, same

WHEEL = sys.argv[1]


def comes_from_the_wheel():
    assert os.path.dirname(fixpid.__file__).startswith(sysconfig.get_paths()["platlib"]), fixpid.__file__
    assert "numpy" not in sys.modules and refuses(ImportError, __import__, "numpy")
    assert fixpid.__version__ in WHEEL and "-abi3-" in WHEEL, WHEEL
    with zipfile.ZipFile(WHEEL) as wheel:
        names = set(wheel.namelist())
        metadata = wheel.read(next(name for name in names if name.endswith("/METADATA"))).decode()
    for name in names:
        if name.endswith(".py"):
            with zipfile.ZipFile(WHEEL) as wheel:
                ast.parse(wheel.read(name), name, feature_version=(3, 8))
    assert {"fixpid/_nouns.pyi", "fixpid/_headers.py", "fixpid/py.typed"} <= names, names
    assert [name for name in names if name.endswith(".so")] == ["fixpid/_library.abi3.so"], names
    for line in "Requires-Dist: cffi", "Requires-Python: >=3.8", "Description-Content-Type: text/markdown":
        assert f"\n{line}\n" in metadata, metadata


def lists_do_for_arrays():
    pid = fixpid.Pid(kp=2, ki=0.5, rate=10, output_limits=(0, 255))
    one = copy.deepcopy(pid)
    same(pid.run(700, [650, 660.2, 701]), [one(650, 700), one(660.2, 700), one(701, 700)])
    same(pid.run([1, 2], 0), [one(0, 1), one(0, 2)])
    assert refuses(ValueError, pid.run, [1, 2], [1, 2, 3]) and refuses(ValueError, pid.run, 1, 2)
    same(fixpid.Tpo(full=10, window=4).steps([5] * 8), fixpid.Tpo(full=10, window=4).steps((5,) * 8))
    assert refuses(TypeError, pid.steps, [1.5], 0)
    same(fixpid.table(lambda x: x * x, 0, 9, points=10).at(3), 9)


def a_recording_becomes_a_header():
    t = [0.5 * i for i in range(400)]
    u = [int(s > 20) for s in t]
    found = fixpid.fit(t, u, [50 + 30 * (1 - 2 ** (-max(0, s - 24) / 20)) for s in t])
    loop = fixpid.tune(found, "PI", rate=5)
    assert isinstance(loop.output, list) and loop.margins["stable"] and "LOOP_GAINS" in loop.header()
    same(loop.pid.run(loop.setpoint, loop.measurement), loop.output)
    assert refuses(ImportError, found.plot)


def a_live_link_has_lists():
    with fixpid.Link(Board()) as link:
        link.setpoint(90)
        steps = link.read(50)
    same(link.log["output"][:50], [step.output for step in steps])
    assert isinstance(link.recording()[0], list) and link.equal and link.log["p"][0] == steps[0].p


run()
