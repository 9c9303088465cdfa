# SPDX-License-Identifier: MIT
"""The notebook, cell by cell in one namespace, as Jupyter runs it: notebook.py NOTEBOOK.

A cell must run, no output may be kept in the file, and what it comes to must hold.
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")

import fixpid
from runner import run, same

with open(sys.argv[1], encoding="utf-8") as file:
    BOOK = json.load(file)
NAMES = {}


def is_a_notebook():
    same((BOOK["nbformat"], BOOK["metadata"]["kernelspec"]["name"]), (4, "python3"))
    cells = BOOK["cells"]
    same(len({cell["id"] for cell in cells}), len(cells))
    for cell in cells:
        wanted = {"cell_type", "id", "metadata", "source"}
        if cell["cell_type"] == "code":
            wanted |= {"execution_count", "outputs"}
            same((cell["id"], cell["outputs"], cell["execution_count"]), (cell["id"], [], None))
        same((cell["id"], set(cell)), (cell["id"], wanted))


def cells_run():
    for cell in BOOK["cells"]:
        if cell["cell_type"] == "code":
            try:
                exec(compile("".join(cell["source"]), cell["id"], "exec"), NAMES)  # pylint: disable=exec-used
            except Exception as why:
                raise AssertionError(f"cell {cell['id']}: {type(why).__name__}: {why}") from why


def what_it_comes_to_holds():
    found, loops, tried = NAMES["fit"], NAMES["loops"], NAMES["tried"]
    assert (found.kind, found.calm) == ("second", 1) and abs(found.gain - 2.4) < 0.1, found
    assert 136 < found.lag < 144 and 8 < found.lag2 < 16 and 2 < found.dead < 7, found
    same(list(loops), ["PI", "PID", "SIMC"])
    for rule, loop in tried.items():
        assert loop.margins["stable"] and loop.margins["ms"] < 2 and loop.metrics["settled"], (rule, loop)
        assert abs(loop.true[-1] - 150) < 2, (rule, loop.true[-1])
    assert NAMES["held"] == 60 < NAMES["free"], (NAMES["held"], NAMES["free"])
    assert NAMES["header"].startswith(f"// Gains of the loop \"oven\", by the Python package fixpid {fixpid.__version__}\n")
    assert NAMES["link"].startswith("build/tuner/index.html#p=flow&gain=")


run()
