# SPDX-License-Identifier: MIT
"""The tables that the package finds, to compare the tuner page with: sensors in JSON on the
standard input, and on the standard output what they come to."""
import json
import sys

import fixpid
from sensors import ntc, type_k


def table(sensor):
    kind, points = sensor.pop("kind"), sensor.pop("points")
    function, first, last = (ntc if kind == "ntc" else type_k)(**sensor)
    found = fixpid.table(function, first, last, points=points)
    return {"points": found.points, "error": found.error}


json.dump(list(map(table, json.load(sys.stdin))), sys.stdout)
