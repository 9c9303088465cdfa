# SPDX-License-Identifier: MIT
"""The plant of the recorded experiments, in integers: test/model/autotune/autotune_plant.c."""
MASK = 0xFFFFFFFF
LAGS_MAX = 8
POLE_MAX = 65536
INTEGRATED_MAX = 1 << 40
INTEGRAL_MAX = 1 << 47


def clamp(value, low, high):
    return max(low, min(high, value))


class Plant:
    """Backlash, a delay, a mass on a spring, lags and perhaps an integrator, then noise and a
    converter."""

    def __init__(self, at, falling):
        self.at, self.falling = at, falling
        self.line = [at["start"]] * at["delay"]  # outputs on their way
        self.levels_q16 = [at["start"] * 65536] * (LAGS_MAX + 1)
        self.position_q16 = at["start"] * 65536
        self.speed_q16 = 0
        self.integral_q32 = 0
        self.random = at["seed"]
        self.slack = at["output_rest"]
        self.steps = 0

    def _noise(self):
        span = 2 * self.at["noise"] + 1
        self.random = (self.random * 1664525 + 1013904223) & MASK
        return (((self.random >> 16) * span) >> 16) - self.at["noise"]

    def _given_on(self, lag, level):
        """Its level, and if it is one of those with a lead a part of the difference."""
        own = self.levels_q16[lag]
        if lag <= self.at["lags"] - self.at["leads"]:
            return own
        return own + ((level - own) * self.at["lead_q16"] >> 16)

    def measure(self):
        """Once a step: it draws the noise."""
        at = self.at
        if at["integrating"]:
            level_q32 = self.integral_q32
        else:
            level = self.levels_q16[0]
            for lag in range(1, at["lags"] + 1):
                level = self._given_on(lag, level)
            level_q32 = level * at["gain_q16"]
        measurement = clamp(at["base"] + (level_q32 >> 32) + self._noise(), 0, at["full_scale"])
        return at["full_scale"] - measurement if self.falling else measurement

    def _pushed(self, output):
        at = self.at
        self.slack = clamp(self.slack, output - at["backlash"], output + at["backlash"])
        drifted = min(self.steps, at["drift_steps"]) * at["drift_q16"] >> 16
        return (self.slack + at["load"] + (at["step_by"] if self.steps > at["step_at"] else 0)
                + drifted)

    def _swung(self, level):
        at = self.at
        self.speed_q16 += (((level - self.position_q16) * at["spring_q16"] >> 16)
                           - (self.speed_q16 * at["damp_q16"] >> 16))
        self.position_q16 += self.speed_q16
        return self.position_q16

    def _lagged(self, level):
        at, levels = self.at, self.levels_q16
        pole = at["pole_q16"]
        for lag in range(1, at["lags"] + 1):
            falls = lag == 1 and at["fall_q16"] and level < levels[lag]
            levels[lag] += (level - levels[lag]) * (at["fall_q16"] if falls else pole) >> 16
            level = self._given_on(lag, level)
            pole = clamp(pole * at["ratio_q8"] >> 8, 1, POLE_MAX)
        return level

    def move(self, output):
        """The rest of the step, with its output."""
        at = self.at
        self.steps += 1
        self.line.append(self._pushed(output))
        level = self.line.pop(0) * 65536
        if at["spring_q16"]:
            level = self._swung(level)
        self.levels_q16[0] = level
        level = self._lagged(level)
        if at["integrating"]:
            moved = (self.integral_q32
                     + clamp(level, -INTEGRATED_MAX, INTEGRATED_MAX) * at["gain_q16"]
                     + (self.integral_q32 >> 16) * at["growth_q16"])
            self.integral_q32 = clamp(moved, -INTEGRAL_MAX, INTEGRAL_MAX)
