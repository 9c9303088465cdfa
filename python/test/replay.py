# SPDX-License-Identifier: MIT
"""Replays the recorded rows of test/support/vectors/ through the package: replay.py FOLDER.

Prints `ok NAME: N rows` or `FAILED NAME` with the rows that differ.
"""
import csv
import os
import sys

import fixpid
from plant import Plant

REPORTED = 5  # rows that differ; the rest is only counted
MASK = 0xFFFFFFFF
RULES = ("simc_pi", "amigo_pi", "amigo_pid", "tyreus_luyben_pi", "tyreus_luyben_pid",
         "ziegler_nichols_pi", "ziegler_nichols_pid", "rule_7")  # the last one is none
CONFIG = ("output_min", "output_max", "integral_min", "integral_max")
# The rows of fixpid_pid's definition know only these flags, and a weight of 0 was what a
# bool says now.
OLD_FLAGS = (fixpid.PID_AT_MAX | fixpid.PID_AT_MIN | fixpid.PID_FIRST | fixpid.PID_SEEDED
             | fixpid.PID_MANUAL)


def rows_of(path):
    with open(path, newline="", encoding="ascii") as file:
        return list(csv.DictReader(file))


def numbers(row):
    return {name: int(value) for name, value in row.items()}


def accepted(call, *arguments, **fields):
    try:
        call(*arguments, **fields)
    except ValueError:
        return 0
    return 1


def pid_gains(at):
    return {"kp_q8": at["kp_q8"], "ki_q24": at["ki_q24"], "kd_q8": at["kd_q8"],
            "derivative_filter": at["filter"]}


def pid_config(at):
    """A row's options are bits, and one with another bit stands for what is refused."""
    options = at["options"]
    return {"gains": pid_gains(at), "setpoint_weight_q8": 0xFFFF if options & 0x1F else at["weight_q8"],
            "reverse": bool(options & fixpid.RECORD_REVERSE),
            "derivative_on_error": bool(options & fixpid.RECORD_DERIVATIVE_ON_ERROR),
            "proportional_on_measurement": bool(options & fixpid.RECORD_PROPORTIONAL_ON_MEASUREMENT),
            **{name: at[name] for name in CONFIG}}


def pid_event(pid, event, value, value2, at):
    """What was called before a step; 1 if it was accepted."""
    verbs = (lambda: None, lambda: pid.init(**pid_config(at)), pid.reset,
             lambda: pid.set_gains(**pid_gains(at)), lambda: pid.set_limits(value, value2),
             lambda: pid.set_integral_limits(value, value2), lambda: pid.set_feedforward(value),
             lambda: pid.set_manual(value), pid.set_auto, lambda: pid.seed(value),
             lambda: pid.track(value, value2))
    return accepted(verbs[event])


def terms(pid):
    return [pid.proportional(), pid.integral(), pid.derivative()]


def pid_row(pid, at, _):
    event, value, value2 = at["event"], at["value"], 0
    if at["weight_q8"] == 0:
        at["options"] |= fixpid.RECORD_PROPORTIONAL_ON_MEASUREMENT
    if event == 4:
        value, value2 = at["output_min"], at["output_max"]
    elif event == 5:
        value, value2 = at["integral_min"], at["integral_max"]
    yield 1, pid_event(pid, event, value, value2, at)
    yield at["output"], pid.step(at["setpoint"], at["measurement"])
    yield [at[name] for name in ("p_q8", "i_q16", "d_q8")], terms(pid)
    yield at["status"], pid.flags() & OLD_FLAGS


def track_row(pid, at, _):
    yield at["accepted"], pid_event(pid, at["event"], at["value"], at["value2"], at)
    yield at["output"], pid.step(at["setpoint"], at["measurement"])
    pid_event(pid, at["event2"], at["value3"], 0, at)
    if at["tracked"]:
        pid.track(at["applied"], at["shift"])
    yield at["last_output"], pid.output()
    yield [at[name] for name in ("p_q8", "i_q16", "d_q8")], terms(pid)
    yield at["status"], pid.flags()


def an937_row(pid, at, fresh):
    if fresh:
        pid.init(kp_q4=at["kp"], ki_q4=at["ki"], kd_q4=at["kd"], accumulated_error_limit=4000,
                 derivative_period_ticks=4)
    if at["tick"]:
        pid.tick()
    yield at["pid_out"], pid.step(at["error"])
    yield at["a_error"], pid.accumulated_error()
    signs = [at[name] < 0 for name in ("error", "a_error", "d_error")]
    magnitudes = [at[name] for name in ("prop", "integ", "deriv")]
    yield [-term if sign else term for sign, term in zip(signs, magnitudes)], terms(pid)


def an964_row(pid, at, fresh):
    if fresh:
        pid.init(kp=at["kp"], ki=at["ki"], kd=at["kd"])
    yield at["out"], pid.step(at["error"])
    yield [at[name] for name in ("error", "integral", "derivative")], terms(pid)


def slew_row(slew, at, _):
    rates = at["rise_q16"], at["fall_q16"]
    (lambda: None, lambda: slew.init(*rates), slew.reset, lambda: slew.set_rates(*rates),
     lambda: slew.seed(at["seed"]))[at["event"]]()
    yield at["output"], slew.step(at["target"])
    yield at["value_q16"], slew.value()


def tpo_row(tpo, at, _):
    config = {name: at[name] for name in ("full", "window", "minimum_on", "minimum_off")}
    init = accepted(tpo.init, **config) if at["event"] == 1 else 1
    if at["event"] == 2:
        tpo.reset()
    yield at["accepted"], init
    yield at["on"], int(tpo.step(at["duty"]))


def gains_row(_, at, __):
    try:
        gains = fixpid.gains_from_milli(at["kp_milli"], at["ki_milli"], at["kd_milli"],
                                        at["rate_milli"], at["filter"])
    except ValueError:
        yield at["accepted"], 0
        return
    yield at["accepted"], 1
    yield [at[name] for name in ("kp_q8", "ki_q24", "kd_q8")], list(gains.values())[:3]
    try:
        back = fixpid.gains_to_milli(gains, at["rate_milli"])
    except ValueError:
        yield at["back_accepted"], 0
        return
    yield [at[name] for name in ("back_accepted", "kp_back", "ki_back", "kd_back")], [
        1, *back.values()]


def fnv(digest, value):
    for byte in (value & 255, (value >> 8) & 255):
        digest = ((digest ^ byte) * 16777619) & MASK
    return digest


def rule_text(tuner, rule, robustness):
    """Gains as the file has them."""
    result = tuner.result(rule, robustness)
    if result is None:
        return "-"
    weight = result["setpoint_weight_q8"]
    if result["proportional_on_measurement"] != (weight == 0):
        return "wrong options"
    return " ".join(map(str, (*result["gains"].values(), weight)))


def autotune_row(tuner, row, _):
    text = ("digest", *RULES)
    at = numbers({name: value for name, value in row.items() if value and name not in text})
    setpoint, options = at["setpoint"], at["options"]
    falling = options & fixpid.AUTOTUNE_REVERSE
    config = ("output_min", "output_max", "output_rest", "measurement_min", "measurement_max",
              "swing", "timeout_steps", "cycles", "options")
    accepted(tuner.init, **{name: at[name] for name in config})
    plant = Plant(at, falling)
    setpoint = at["full_scale"] - setpoint if falling else setpoint
    digest, steps = 2166136261, 0
    while steps == 0 or tuner.status() == fixpid.AUTOTUNE_RUNNING:
        output = tuner.step(setpoint, plant.measure())
        digest = fnv(digest, output)
        plant.move(output)
        steps += 1
    yield [at["status"], at["steps"], row["digest"]], [tuner.status(), steps, f"{digest:08x}"]
    model = tuner.model() or {}
    yield row["gain_q8"] != "", bool(model)
    yield {name: at.get(name) for name in model}, model
    for rule, name in enumerate(RULES):
        yield row[name], rule_text(tuner, rule, at["robustness_q4"])


# File, rows, object, what compares a row.
FILES = (
    ("an937_firmware", 2000, lambda: fixpid.An937(accumulated_error_limit=1,
                                                  derivative_period_ticks=1), an937_row),
    ("an964_firmware", 2000, fixpid.An964, an964_row),
    ("pid_definition", 2000, lambda: fixpid.Pid(output_max=1), pid_row),
    ("track", 1000, lambda: fixpid.Pid(output_max=1), track_row),
    ("slew", 1000, fixpid.Slew, slew_row),
    ("tpo", 1000, lambda: fixpid.Tpo(full=1, window=1), tpo_row),
    ("gains", 1000, lambda: None, gains_row),
    ("autotune", 300, lambda: fixpid.Autotune(output_max=1, measurement_max=1, timeout_steps=2,
                                              cycles=1), autotune_row),
)


def replay(path, count, thing, row_of):
    """How many rows differ; says the first ones."""
    rows, run, different = rows_of(path), None, 0
    if len(rows) != count:
        raise ValueError(f"{path} has {len(rows)} rows, not {count}")
    for number, row in enumerate(rows, 1):
        at = row if row_of is autotune_row else numbers(row)
        # The first column is the run where rows go on from the one before.
        first = next(iter(row.values()))
        wrong = [pair for pair in row_of(thing, at, first != run) if pair[0] != pair[1]]
        run = first
        different += 1 if wrong else 0
        if wrong and different <= REPORTED:
            print(f"row {number}: recorded {wrong[0][0]}, computed {wrong[0][1]}")
    return different


def main(folder):
    failed = 0
    for name, count, make, row_of in FILES:
        different = replay(os.path.join(folder, name + ".csv"), count, make(), row_of)
        failed += 1 if different else 0
        print(f"FAILED {name}: {different} differ" if different else f"ok {name}: {count} rows")
    unknown = {name[:-len(".csv")] for name in os.listdir(folder)} - {row[0] for row in FILES}
    for name in sorted(unknown):
        print(f"FAILED {name}: nothing replays it")
    return 1 if failed or unknown else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
