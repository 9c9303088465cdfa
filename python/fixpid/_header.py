# SPDX-License-Identifier: MIT
"""The header for the firmware: the integers as the tuner page writes them, web/header.js in Python."""
import re

from ._core import __version__
from ._format import number, short
from ._library import lib
from ._scene import CONTROLLER, DERIVATIVE_ON_ERROR, PROPORTIONAL_ON_MEASUREMENT, REVERSE

KI_FINE = 0x7FFF7F  # the largest without FIXPID_PID_HAS_COARSE_KI


def features_of(s, results):
    """FIXPID_PID_FEATURES of this configuration and of what its scene calls."""
    called = {event["what"] for event in s["events"]}
    options = int(results["OPTIONS"])
    needs = {"FILTER": results["FILTER"] > 0, "WEIGHT": results["WEIGHT"] < 256, "REVERSE": options & REVERSE,
             "DERIVATIVE_ON_ERROR": options & DERIVATIVE_ON_ERROR, "FEEDFORWARD": "FEEDFORWARD" in called,
             "MANUAL": called & {"MANUAL", "AUTO"}, "COARSE_KI": results["KI"] > KI_FINE}
    return sum(getattr(lib, f"FIXPID_PID_HAS_{name}") for name, needed in needs.items() if needed)


def _macro(name, lines):
    """A macro of lines, their backslashes under each other."""
    lines = [f"#define {name}", "    {", *(f"        {line}" for line in lines)]
    width = max(map(len, lines)) + 1
    return [*(line.ljust(width) + "\\" for line in lines), "    }"]


def _initialiser(name, fields):
    """Of [value, name of the field, what it means]."""
    rows = [(f"{value},", field + (f": {meaning}" if meaning else "")) for value, field, meaning in fields]
    width = max(len(value) for value, _ in rows)
    rows[-1] = rows[-1][0][:-1], rows[-1][1]
    return _macro(name, [f"{value.ljust(width)} /* {text} */" for value, text in rows])


def _pid(s, r):
    def option(bit):
        return "true" if int(r["OPTIONS"]) & bit else "false"

    return [
        "// The same, folded in double precision:",
        f"// FIXPID_PID_GAINS({', '.join(map(number, (s['KP'], s['KI'], s['KD'], s['RATE'], r['FILTER'])))})",
        *_initialiser("LOOP_GAINS", [
            (f"{number(r['KP'])}u", "kp_q8", short(r["KP"] / 256)),
            (f"{number(r['KI'])}u", "ki_q24", f"{short(r['KI'] * s['RATE'] / 2**24)} per second"),
            (f"{number(r['KD'])}u", "kd_q8", f"{short(r['KD'] * 2**r['FILTER'] / 256 / s['RATE'])} s"),
            (f"{number(r['FILTER'])}u", "derivative_filter", "")]),
        "",
        "// static const struct fixpid_pid_config config = LOOP_CONFIG;",
        f"// It needs -DFIXPID_PID_FEATURES=0x{features_of(s, r):02X} or more.",
        *_initialiser("LOOP_CONFIG", [
            ("LOOP_GAINS", "gains", ""),
            *((number(s[name.upper()]), name, "") for name in ("output_min", "output_max", "integral_min", "integral_max")),
            (f"{number(r['WEIGHT'])}u", "setpoint_weight_q8", ""),
            (option(REVERSE), "reverse", ""), (option(DERIVATIVE_ON_ERROR), "derivative_on_error", ""),
            (option(PROPORTIONAL_ON_MEASUREMENT), "proportional_on_measurement", "")])]


def _an937(s, r):
    return ["// static const struct fixpid_an937_config config = LOOP_CONFIG;",
            *_initialiser("LOOP_CONFIG", [
                (f"{number(r['KP'])}u", "kp_q4", short(r["KP"] / 16)),
                (f"{number(r['KI'])}u", "ki_q4", f"{short(r['KI'] / 16)} per tick"),
                (f"{number(r['KD'])}u", "kd_q4", short(r["KD"] / 16)),
                (f"{number(s['INTEGRAL_MAX'])}u", "accumulated_error_limit", ""),
                (f"{number(r['FILTER'])}u", "derivative_period_ticks", "")])]


def _an964(_, r):
    return ["// static const struct fixpid_an964_gains gains = LOOP_CONFIG;",
            *_initialiser("LOOP_CONFIG", [(f"{number(r['KP'])}u", "kp", short(r["KP"] / 1024)),
                                          (f"{number(r['KI'])}u", "ki", ""), (f"{number(r['KD'])}u", "kd", "")])]


def header_of(s, results):
    """A header with the integers that have run, as an initialiser that every compiler takes."""
    noun, lines = {CONTROLLER["PID"]: ("fixpid_pid", _pid), CONTROLLER["AN937"]: ("fixpid_an937", _an937),
                   CONTROLLER["AN964"]: ("fixpid_an964", _an964)}[s["CONTROLLER"]]
    unit = re.sub(r"[\\*?]", "", re.sub(r"[^\x20-\x7E]", "", s["unit"])) or "units"
    return "\n".join([
        f"// Gains of a loop, by the tuner page of fixpid {__version__}",
        f"// {short(s['RATE'])} steps per second; sensor: {number(s['SENSOR_BITS'])} bits, {short(s['SENSOR_RANGE'])} {unit}",
        "#ifndef LOOP_GAINS_H", "#define LOOP_GAINS_H", f'#include "{noun}.h"', "", *lines(s, results), "", "#endif", ""])
