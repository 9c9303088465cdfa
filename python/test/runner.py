# SPDX-License-Identifier: MIT
"""What the tests of the package share: each is a function, and `run` prints `ok NAME` or
`FAILED NAME` and why."""
import inspect
import sys
import traceback


def same(found, expected):
    """They are equal, or both are said."""
    if not found == expected:
        raise AssertionError(f"{found!r}, expected {expected!r}")


def message(what, call, *arguments, **fields):
    """What the error says that this call must raise."""
    try:
        found = call(*arguments, **fields)
    except what as error:
        return str(error)
    raise AssertionError(f"accepted: {found!r}")


def refuses(what, call, *arguments, **fields):
    try:
        call(*arguments, **fields)
    except what:
        return True
    return False


def run(names=()):
    """All functions of the program that take nothing, but those with an underscore in front; or
    those that are named. Ends with the exit status."""
    tests = {one.__name__: one for one in vars(sys.modules["__main__"]).values()
             if inspect.isfunction(one) and one.__module__ == "__main__" and one.__name__[0] != "_" and not inspect.signature(one).parameters}
    unknown = set(names) - set(tests)
    if unknown:
        sys.exit(f"no such test: {', '.join(sorted(unknown))}")
    failed = 0
    for name in names or tests:
        try:
            tests[name]()
            print(f"ok {name}")
        except Exception as why:  # pylint: disable=broad-except
            failed = 1
            where = [at for at in traceback.extract_tb(why.__traceback__) if at.name != "same"][-1]
            print(f"FAILED {name}: {why}, in line {where.lineno}: {where.line}")
    sys.exit(failed)
