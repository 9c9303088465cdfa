# SPDX-License-Identifier: MIT
"""The plant of the recorded experiments, in integers: test/model/autotune/autotune_plant.c."""
MASK = 0xFFFFFFFF
INTEGRAL_MAX = 1 << 47


def clamp(value, low, high):
    return max(low, min(high, value))


class Plant:
    """A delay, lags and perhaps an integrator, then noise and a converter."""

    def __init__(self, at, falling):
        self.at, self.falling = at, falling
        self.line = [at["start"]] * at["delay"]  # outputs on their way
        self.levels_q16 = [at["start"] * 65536] * (at["lags"] + 1)
        self.integral_q32 = 0
        self.random = at["seed"]
        self.steps = 0

    def _noise(self):
        span = 2 * self.at["noise"] + 1
        self.random = (self.random * 1664525 + 1013904223) & MASK
        return (((self.random >> 16) * span) >> 16) - self.at["noise"]

    def measure(self):
        """Once a step: it draws the noise."""
        at = self.at
        level_q32 = (self.integral_q32 if at["integrating"]
                     else self.levels_q16[-1] * at["gain_q16"])
        measurement = clamp(at["base"] + (level_q32 >> 32) + self._noise(), 0, at["full_scale"])
        return at["full_scale"] - measurement if self.falling else measurement

    def move(self, output):
        """The rest of the step, with its output."""
        at, levels = self.at, self.levels_q16
        self.steps += 1
        self.line.append(output + at["load"] + (at["step_by"] if self.steps > at["step_at"] else 0))
        levels[0] = self.line.pop(0) * 65536
        for i in range(1, len(levels)):
            levels[i] += ((levels[i - 1] - levels[i]) * at["pole_q16"]) >> 16
        if at["integrating"]:
            moved = self.integral_q32 + levels[-1] * at["gain_q16"]
            self.integral_q32 = clamp(moved, -INTEGRAL_MAX, INTEGRAL_MAX)
