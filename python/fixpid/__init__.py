# SPDX-License-Identifier: MIT
"""fixpid in Python: the C library itself, each step bit for bit.

    pid = fixpid.Pid(kp=2, ki=0.5, rate=10, output_limits=(0, 255), setpoint=700)
    output = pid(measurement)                    # once per sample period
    outputs = pid.run(setpoints, measurements)   # of arrays or lists

Each noun whose header has an `init` is a class with its verbs: Pid, An937, An964_8bit,
Autotune and so on. What `init` takes in C makes an object here; fields that are left
out are 0. The verbs take the library's integers: `help(fixpid.Pid.step)` has what the
header says. The headers' constants stand here without FIXPID_: fixpid.PID_AT_MAX.
Link is no such noun: it is the other end of a board that runs fixpid_link.
Structures come back as dictionaries, and are given as keywords.

Who passes what is no whole number gets a TypeError, what does not fit an OverflowError, and
what C refuses by returning false a ValueError; each names the value.
"""
from . import _nouns
from ._core import __version__
from ._fit import Fit, fit
from ._library import ffi, lib
from ._link import Difference, Link, Step
from ._loop import Loop, simulate, tune
from ._modules import (Autotune, AutotuneCause, AutotuneState, Reaction, ReactionState, Table, gains_from_milli,
                       gains_to_milli, guard_config, record_pack, record_unpack, sat16, slew_rate, table)
from ._nouns import *  # noqa: F403, the constants, and the classes that C alone makes
from ._pid import Pid, pid_gains
from ._plant import Plant
from ._units import Actuator, Sensor

__all__ = ["__version__", "Actuator", "Autotune", "AutotuneCause", "AutotuneState", "Difference", "Fit", "Link", "Loop", "Pid",
           "Plant", "Reaction", "ReactionState", "Sensor", "Step", "Table", "ffi", "fit", "gains_from_milli", "gains_to_milli",
           "guard_config", "lib", "pid_gains", "record_pack", "record_unpack", "sat16", "simulate", "slew_rate", "table", "tune"]
__all__ += _nouns.__all__
