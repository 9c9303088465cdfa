# SPDX-License-Identifier: MIT
"""The header for the firmware as the tuner page writes it, web/header.js in Python: the integers
that have run, the plant and the margins, and the scale of the measurement."""
import re

from ._core import __version__
from ._format import digits, number, short
from ._library import lib
from ._scene import DERIVATIVE_ON_ERROR, PLANT, PROPORTIONAL_ON_MEASUREMENT, REVERSE

NAME = re.compile(r"[A-Za-z0-9_]{0,31}")
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
    *lines, last = [f"#define {name}", *(f"    {line}" for line in lines)]
    width = max(map(len, lines)) + 1
    return [*(line.ljust(width) + "\\" for line in lines), last]


def _initialiser(name, fields):
    """Of [value, name of the field, what it means]."""
    rows = [(f"{value},", field + (f": {meaning}" if meaning else "")) for value, field, meaning in fields]
    width = max(len(value) for value, _ in rows)
    rows[-1] = rows[-1][0][:-1], rows[-1][1]
    return _macro(name, ["{", *(f"    {value.ljust(width)} /* {text} */" for value, text in rows), "}"])


def _pid(s, r, loop):
    def option(bit):
        return "true" if int(r["OPTIONS"]) & bit else "false"

    return [
        "// The same, folded in double precision:",
        f"// FIXPID_PID_GAINS({', '.join(map(number, (s['KP'], s['KI'], s['KD'], s['RATE'], r['FILTER'])))})",
        *_initialiser(f"{loop}_GAINS", [
            (f"{number(r['KP'])}u", "kp_q8", short(r["KP"] / 256)),
            (f"{number(r['KI'])}u", "ki_q24", f"{short(r['KI'] * s['RATE'] / 2**24)} per second"),
            (f"{number(r['KD'])}u", "kd_q8", f"{short(r['KD'] * 2**r['FILTER'] / 256 / s['RATE'])} s"),
            (f"{number(r['FILTER'])}u", "derivative_filter", "")]),
        "",
        f"// static const struct fixpid_pid_config config = {loop}_CONFIG;",
        f"// It needs -DFIXPID_PID_FEATURES=0x{features_of(s, r):02X} or more.",
        *_initialiser(f"{loop}_CONFIG", [
            (f"{loop}_GAINS", "gains", ""),
            *((number(s[name.upper()]), name, "") for name in ("output_min", "output_max", "integral_min", "integral_max")),
            (f"{number(r['WEIGHT'])}u", "setpoint_weight_q8", ""),
            (option(REVERSE), "reverse", ""), (option(DERIVATIVE_ON_ERROR), "derivative_on_error", ""),
            (option(PROPORTIONAL_ON_MEASUREMENT), "proportional_on_measurement", "")])]


def _plain(text):
    """What a header may say: nothing that ends a comment or is not ASCII."""
    return re.sub(r"[\\*?]", "", re.sub(r"[^\x20-\x7E]", "", text))


def _plant(s, unit):
    gain, lag, lag2 = short(s["GAIN"]), short(s["T1"]), short(s["T2"])
    dead = f"dead time {short(s['DEAD'])} s"
    if s["PLANT"] == PLANT["INTEGRATOR"]:
        return f"integrator, {gain} {unit}/s at full drive, lag {lag2} s, {dead}"
    if s["PLANT"] == PLANT["OSCILLATOR"]:
        return (f"{gain} {unit} at full drive, oscillates with {short(1 / s['T1'])} rad/s, "
                f"damping {short(s['DAMPING'])}, {dead}")
    return f"{gain} {unit} at full drive, lag {lag} s{f' and {lag2} s' if s['T2'] > 0 else ''}, {dead}"


def _margins(margins):
    known = (("Ms", margins["ms"], ""), ("phase", margins["phase_margin"], " degrees"), ("gain", margins["gain_margin"], ""),
             ("dead time", margins["delay_margin"], " s"))
    said = [f"{name} {_plain(digits(value).replace('−', '-'))}{unit}" for name, value, unit in known if value is not None]
    return ", ".join(said) if margins["stable"] else "unstable"


def _scale(s, unit, loop):
    """The counts of a constant in units, and the rate, for the rest of the firmware."""
    low, high = (f"({number(value)})" for value in (s["SENSOR_LOW"], s["SENSOR_LOW"] + s["SENSOR_RANGE"]))
    return [
        f"#define {loop}_RATE {number(s['RATE'])} // steps per second",
        f"// A constant setpoint of so many {unit} in counts; beyond the sensor it does not compile.",
        *_macro(f"{loop}_COUNTS(x)", [
            "FIXPID_CAST(int16_t,",
            f"    FIXPID_FOLDED((FIXPID_REAL(x) - {low}) / {number(s['SENSOR_RANGE'])} * {2**int(s['SENSOR_BITS']) - 1}) +",
            f"        FIXPID_CHECKED(0, (FIXPID_REAL(x) >= {low}) &&",
            f"                              (FIXPID_REAL(x) <= {high})))"]),
        ""]


def _digest(lines):
    """FNV-1a of the lines, by which two headers of one name are known to differ."""
    found = 0x811C9DC5
    for byte in "\n".join(lines).encode("ascii"):
        found = (found ^ byte) * 0x01000193 % 2**32
    return f"0x{found:08X}u"


def _guarded(name, loop, lines):
    """Between a guard that two copies of the same header pass, and no others."""
    guard, digest = f"{loop}_GAINS_H", _digest(lines)
    differ = f"for the loop {name} differ: give each loop a name of its own" if name else (
        "without a name differ: give each loop a name")
    return [f"#ifndef {guard}", f"#define {guard} {digest}", *lines, f"#elif {guard} != {digest}",
            f'#error "two headers of gains {differ}"', "#endif", ""]


def header_of(s, results, margins, link, name="", said=(), by="the tuner page of fixpid"):
    """A header with the integers that have run, as an initialiser that every compiler takes, and with
    what it is from: the plant, the margins and what else is said of them, and the link of the page
    that has it. `name` is that of the loop, or none, and `by` what writes it."""
    if not NAME.fullmatch(name):
        raise ValueError(f"name = {name!r} is refused: at most 31 letters, digits and _ are legal")
    unit, loop = _plain(s["unit"]) or "units", f"LOOP_{name.upper()}" if name else "LOOP"
    return "\n".join([
        f"""// Gains of {f'the loop "{name}"' if name else 'a loop'}, by {by} {__version__}""",
        f"// {short(s['RATE'])} step{'s' * (s['RATE'] != 1)} per second; sensor: {number(s['SENSOR_BITS'])} bits, {short(s['SENSOR_RANGE'])} {unit}",
        f"// Plant: {_plant(s, unit)}", f"// Margins: {_margins(margins)}", *(f"// {_plain(text)}" for text in said),
        f"// The page has it with #{_plain(link)}",
        *_guarded(name, loop, ['#include "fixpid_pid.h"', "", *_scale(s, unit, loop), *_pid(s, results, loop), ""])])
