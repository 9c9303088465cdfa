# SPDX-License-Identifier: MIT
"""Replays the recorded rows of test/support/vectors/ through the package's verbs: replay.py FOLDER
[NAME]... Those of tuners, tables and the link are for unit tests in C: what the package adds to
them is in package.py and link.py.

Prints `ok NAME: N rows` or `FAILED NAME` with the rows that differ.
"""
import csv
import os
import sys

import fixpid

REPORTED = 5  # rows that differ; the rest is only counted
CONFIG = ("output_min", "output_max", "integral_min", "integral_max")
# The rows of fixpid_pid's definition know only these flags, and a weight of 0 was what a
# bool says now.
OLD_FLAGS = (fixpid.PID_AT_MAX | fixpid.PID_AT_MIN | fixpid.PID_FIRST | fixpid.PID_SEEDED
             | fixpid.PID_MANUAL)


def rows_of(path):
    with open(path, newline="", encoding="ascii") as file:
        return list(csv.DictReader(file))


def numbers(row):
    """What of a row is a number, as one."""
    return {name: int(value) if value.lstrip("-").isdigit() else value for name, value in row.items()}


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


def step_error_row(pid, at, _):
    yield at["accepted"], pid_event(pid, at["event"], at["value"], at["value2"], at)
    yield at["output"], (pid.step_error if at["by_error"] else pid.step)(at["first"], at["second"])
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


GUARD = ("output_min", "output_max", "measurement_min", "measurement_max", "reach_min",
         "reach_max", "band")


def guard_row(guard, at, _):
    """As of fixpid_pid, an option that there is not stands for what is refused."""
    options = at["options"]
    config = {name: at[name] for name in GUARD}
    config.update(patience=0 if options & 0x3F else at["patience"],
                  reverse=bool(options & 0x80), noisy=bool(options & 0x40))
    init = accepted(guard.init, **config) if at["event"] == 1 else 1
    (lambda: None, lambda: None, guard.reset, guard.acknowledge)[at["event"]]()
    yield at["accepted"], init
    yield at["flags_before"], guard.flags()
    for _ in range(at["repeat"]):
        flags = guard.step(at["setpoint"], at["measurement"], at["output"])
    yield at["flags"], flags


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


# File, rows, object, what compares a row.
FILES = (
    ("an937_firmware", 2000, lambda: fixpid.An937(accumulated_error_limit=1,
                                                  derivative_period_ticks=1), an937_row),
    ("an964_firmware", 2000, fixpid.An964, an964_row),
    ("pid_definition", 2000, lambda: fixpid.Pid(output_max=1), pid_row),
    ("track", 1000, lambda: fixpid.Pid(output_max=1), track_row),
    ("rest", 600, lambda: fixpid.Pid(output_max=1), track_row),
    ("step_error", 500, lambda: fixpid.Pid(output_max=1), step_error_row),
    ("slew", 1000, fixpid.Slew, slew_row),
    ("tpo", 1000, lambda: fixpid.Tpo(full=1, window=1), tpo_row),
    ("guard", 1000, lambda: fixpid.Guard(output_max=1, band=1, patience=2), guard_row),
    ("gains", 1000, lambda: None, gains_row),
)


def replay(path, count, thing, row_of):
    """How many rows differ; says the first ones."""
    rows, run, different = rows_of(path), None, 0
    if len(rows) != count:
        raise ValueError(f"{path} has {len(rows)} rows, not {count}")
    for number, row in enumerate(rows, 1):
        at = numbers(row)
        # The first column is the run where rows go on from the one before.
        first = next(iter(row.values()))
        wrong = [pair for pair in row_of(thing, at, first != run) if pair[0] != pair[1]]
        run = first
        different += 1 if wrong else 0
        if wrong and different <= REPORTED:
            print(f"row {number}: recorded {wrong[0][0]}, computed {wrong[0][1]}")
    return different


def main(folder, *names):
    failed = 0
    chosen = [row for row in FILES if not names or row[0] in names]
    if len(chosen) < len(set(names)):
        raise ValueError(f"one of these is not replayed: {', '.join(names)}")
    for name, count, make, row_of in chosen:
        different = replay(os.path.join(folder, name + ".csv"), count, make(), row_of)
        failed = 1 if different else failed
        print(f"FAILED {name}: {different} differ" if different else f"ok {name}: {count} rows")
    return failed


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
