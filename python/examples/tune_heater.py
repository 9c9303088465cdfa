# SPDX-License-Identifier: MIT
# %% [markdown]
# Tunes a heater that scipy simulates and draws what the controller makes of it. Run it as a
# program, `python tune_heater.py heater.png`, or cell by cell in a notebook.

# %%
import sys

import matplotlib

matplotlib.use("Agg" if "ipykernel" not in sys.modules else matplotlib.get_backend())
import matplotlib.pyplot as plt
import numpy as np
from scipy import signal

import fixpid

# %% [markdown]
# The plant: two lags of 30 s and 6 s and a dead time of 2 s. Full power, 1000 counts, makes
# 160 degrees; the sensor has 12 bits for 200 degrees and some noise.

# %%
RATE = 2.0  # steps per second
FULL_POWER = 1000
COUNTS_PER_DEGREE = 4095 / 200


class Heater:
    """A transfer function in steps of 1 / RATE seconds, and a converter behind it."""

    def __init__(self):
        lags = np.polymul([30.0, 1.0], [6.0, 1.0])
        space = signal.tf2ss([160.0 / FULL_POWER], lags)
        self.a, self.b, self.c, _, _ = signal.cont2discrete(space, 1 / RATE)
        self.x = np.zeros((2, 1))
        self.line = [0] * int(2.0 * RATE)  # outputs on their way
        self.lost = 0  # power that goes out of the window
        self.noise = np.random.default_rng(7)

    def measure(self):
        degrees = 20.0 + float((self.c @ self.x)[0, 0])
        return int(np.rint(degrees * COUNTS_PER_DEGREE + self.noise.normal(0, 0.7)))

    def move(self, output):
        self.line.append(output)
        self.x = self.a @ self.x + self.b * (self.line.pop(0) - self.lost)


# %% [markdown]
# From cold, the heat-up takes the controller's place until it knows the plant. It ends before
# what it stores brings the heater to the setpoint.

# %%
heater = Heater()
setpoint = round(90 * COUNTS_PER_DEGREE)
tuner = fixpid.Reaction(output_drive=FULL_POWER, measurement_stop=setpoint)
heat_up = []
while tuner.status() == fixpid.REACTION_RUNNING:
    measurement = heater.measure()
    output = tuner.step(measurement)
    heat_up.append((measurement, output))
    heater.move(output)
if tuner.status() != fixpid.REACTION_DONE:
    sys.exit(f"the heat-up failed: {tuner.status().name}. {tuner.status().advice}")

model = tuner.model()
slope = model["slope_q24"] / 2**24 * FULL_POWER / COUNTS_PER_DEGREE * RATE
print(f"heat-up: {len(heat_up) / RATE:.0f} s")
print(f"found: {slope:.1f} degrees a second at full power, delay {model['dead_q4'] / 16 / RATE:.1f} s")

# %% [markdown]
# The controller with the gains of a rule goes on where the heat-up ended; then the setpoint
# steps, and a window is opened.

# %%
RULES = {"PI": fixpid.REACTION_PI, "PID": fixpid.REACTION_PID}
SECONDS = 600
time = np.arange(int(SECONDS * RATE)) / RATE
setpoints = np.where(time < 200, setpoint, round(110 * COUNTS_PER_DEGREE))


def closed_loop(rule):
    """Setpoints in, measurements and outputs back."""
    gains = tuner.result(rule)
    if gains is None:
        sys.exit("a gain is out of its range")
    config = {"gains": gains, "output_max": FULL_POWER, "setpoint_weight_q8": 128}
    pid = fixpid.Pid(**config)
    plant = Heater()
    plant.x, plant.line = heater.x.copy(), list(heater.line)
    measurements, outputs = np.empty((2, time.size), dtype=int)
    for i, wanted in enumerate(setpoints):
        plant.lost = 0 if time[i] < 400 else 100
        measurements[i] = plant.measure()
        outputs[i] = pid.step(int(wanted), measurements[i])
        plant.move(outputs[i])
    # The same measurements once more, as arrays: the same outputs, bit for bit.
    assert np.array_equal(fixpid.Pid(**config).steps(setpoints, measurements), outputs)
    return gains, measurements, outputs


runs = {}
for name, rule in RULES.items():
    runs[name] = closed_loop(rule)
    gains, measurements, _ = runs[name]
    over = (measurements.max() - setpoints.max()) / COUNTS_PER_DEGREE
    rest = np.abs(measurements[-100:] - setpoints[-100:]).max() / COUNTS_PER_DEGREE
    print(f"{name}: kp {gains['kp_q8'] / 256:.2f}, ki {gains['ki_q24'] / 2**24 * RATE:.4f} / s, "
          f"kd {gains['kd_q8'] * 2**gains['derivative_filter'] / 256 / RATE:.1f} s; "
          f"overshoot {over:.1f}, at the end within {rest:.1f} degrees")

# %%
figure, ((left, right), (below_left, below_right)) = plt.subplots(
    2, 2, sharex="col", figsize=(11, 5.5), gridspec_kw={"height_ratios": [2, 1]},
    constrained_layout=True)
before = np.arange(len(heat_up)) / RATE
measured, driven = np.array(heat_up).T
left.set_title("the heat-up")
left.plot(before, measured / COUNTS_PER_DEGREE, color="tab:blue")
left.axhline(setpoint / COUNTS_PER_DEGREE, color="0.6", zorder=0)
left.set_ylabel("degrees")
below_left.step(before, driven, where="post", color="tab:blue")
below_left.set_ylabel("power of 1000")
right.set_title("what its gains do")
right.step(time, setpoints / COUNTS_PER_DEGREE, where="post", color="0.6", label="setpoint")
right.axvspan(400, SECONDS, color="0.93", zorder=0, label="window open")
for colour, (name, (_, measurements, outputs)) in zip(("tab:orange", "tab:green"), runs.items()):
    right.plot(time, measurements / COUNTS_PER_DEGREE, color=colour, label=name)
    below_right.step(time, outputs, where="post", color=colour)
right.legend()
for axes in (below_left, below_right):
    axes.set_ylim(-50, FULL_POWER + 50)
    axes.set_xlabel("seconds")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "heater.png", dpi=100)
