# SPDX-License-Identifier: MIT
"""What the package chooses, to compare the tuner page with: lists of guards and of tables in
JSON on the standard input, and on the standard output what they come to, or null."""
import json
import sys

import fixpid
from sensors import ntc, type_k


def guard(config):
    try:
        return fixpid.guard_config(**config)
    except ValueError:
        return None


def table(sensor):
    kind, points = sensor.pop("kind"), sensor.pop("points")
    function, first, last = (ntc if kind == "ntc" else type_k)(**sensor)
    found = fixpid.table(function, first, last, points=points)
    return {"points": found.points, "error": found.error}


asked = json.load(sys.stdin)
json.dump({"guards": list(map(guard, asked["guards"])), "tables": list(map(table, asked["tables"]))}, sys.stdout)
