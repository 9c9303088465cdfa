# SPDX-License-Identifier: MIT
"""What type checkers say of the pages' programs: typed.py PYRIGHT PAGE..."""
import os
import re
import subprocess
import sys
import tempfile

from runner import run

PYRIGHT, *PAGES = sys.argv[1:]
CHECKERS = ["mypy", "--strict", "--python-executable", sys.executable], [PYRIGHT, "--pythonpath", sys.executable]


def complaints(program):
    """What each checker says of a program that it refuses, or nothing. pyserial has no types."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for name, text in ("program.py", program), ("serial.pyi", "def Serial(port: str, baudrate: int) -> object: ...\n"):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        for command in CHECKERS:
            done = subprocess.run([*command, "program.py"], cwd=folder, stdout=subprocess.PIPE, universal_newlines=True, check=False)
            found.append(done.stdout if done.returncode else "")
    return found


def programs_of_pages_have_their_types():
    for path in PAGES:
        with open(path, encoding="utf-8") as page:
            found = complaints("\n".join(re.findall("```python\n(.*?)```", page.read(), re.DOTALL)))
        assert found == ["", ""], f"{path}: {' '.join(found)}"


def wrong_ones_are_noticed():
    for line in 'fixpid.Pid(kp="2")', "fixpid.Pod()", "fixpid.fit([1], 2, [3]).lag + 1", "fixpid.Slew(1, 2).step('3')":
        assert all(complaints(f"import fixpid\n{line}\n")), line


run()
