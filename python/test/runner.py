# SPDX-License-Identifier: MIT
"""What the tests of the package share: each is a function, and `run` prints `ok NAME` or
`FAILED NAME` and why."""
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


def run(tests, names=()):
    """All, or those that are named, and the exit status."""
    failed = 0
    unknown = set(names) - {test.__name__ for test in tests}
    if unknown:
        sys.exit(f"no such test: {', '.join(sorted(unknown))}")
    for test in (one for one in tests if not names or one.__name__ in names):
        try:
            test()
            print(f"ok {test.__name__}")
        except Exception as why:  # pylint: disable=broad-except
            failed = 1
            where = [at for at in traceback.extract_tb(why.__traceback__) if at.name != "same"][-1]
            print(f"FAILED {test.__name__}: {why}, in line {where.lineno}: {where.line}")
    sys.exit(failed)
