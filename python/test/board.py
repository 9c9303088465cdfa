# SPDX-License-Identifier: MIT
"""A board in C, the library's fixpid_link with a controller and a plant, behind a port in memory:
it steps when it is read from."""
import random

import fixpid
from fixpid import ffi, lib

CONFIG = {"gains": {"kp_q8": 512, "ki_q24": 70000, "kd_q8": 64, "derivative_filter": 2},
          "output_min": -255, "output_max": 255, "setpoint_weight_q8": 256}
BOARD = {"period_us": 1000, "manual_steps": 50, "setpoint_min": -500, "setpoint_max": 900,
         "output_min": -300, "output_max": 300, "name": b"oven"}
ALL = 0x0F


def unstuffed(framed):
    """COBS backwards, without the 0 at the end."""
    found, left = bytearray(), framed[0]
    for byte in framed[1:]:
        left -= 1
        found.append(byte if left else 0)
        left = left or byte
    return bytes(found)


class Clock:
    """Seconds that the steps of a board make, and whoever sleeps."""

    now = 0.0

    def monotonic(self):
        return self.now

    def sleep(self, seconds):
        self.now += seconds


class Board:
    """`damage` is one byte in so many that is lost, turned, doubled or another, in both directions;
    `deaf` is how many commands are not heard; of `silent` ones
    nothing comes."""

    def __init__(self, allowed=ALL, damage=0, noise=10, lag=16, seed=1, clock=None, **board):
        self.config, self.pid, self.link, self.board = (
            ffi.new(f"struct fixpid_{name} *") for name in ("pid_config", "pid", "link", "link_board"))
        self.board[0] = {**BOARD, **board}
        self.start({**CONFIG}, 0)
        lib.fixpid_link_allow(self.link, allowed)
        self.damage, self.noise, self.lag, self.draw = damage, noise, lag, random.Random(seed)
        self.level_q8 = self.measurement = 0
        self.tracks, self.silent, self.deaf = False, False, 0
        self.out, self.clock = bytearray(), clock
        self.asked, self.heard, self.steps = set(), [], 0
        self.before_step = lambda board: None

    def start(self, config, setpoint):
        self.config[0] = config
        assert lib.fixpid_pid_init(self.pid, self.config)
        lib.fixpid_link_init(self.link, setpoint)

    # ---- the wire ----

    def carried(self, data):
        """What becomes of bytes on the wire."""
        if not self.damage:
            return data
        came, draw = bytearray(), self.draw
        for byte in data:
            kind = draw.randrange(4) if draw.randrange(self.damage) == 0 else None
            if kind is None:
                came.append(byte)
            elif kind == 1:
                came.append(byte ^ 1 << draw.randrange(8))
            elif kind == 2:
                came += bytes([byte, byte])
            elif kind == 3:
                came.append(draw.randrange(256))
        return came

    def write(self, data):
        assert data[:1] == b"\0" and data[-1:] == b"\0" and data.count(0) == 2, data
        self.asked.add(unstuffed(data[1:-1]))
        if self.deaf:
            self.deaf -= 1
        else:
            self.out += self.carried(self.receive(self.carried(data)))
        return len(data)

    def receive(self, data):
        """Takes bytes; what is answered."""
        answers = bytearray()
        for byte in data:
            if lib.fixpid_link_receive(self.link, byte):
                self.heard.append(bytes(self.link.bytes)[1:])
                answers += self.frame(lib.fixpid_link_answer(self.link, self.board, self.pid, self.config))
        return answers

    def wrong(self):
        """Whole commands that are not those that were sent, bit for bit."""
        return [heard for heard in self.heard if not any(map(heard.startswith, self.asked))]

    def frame(self, count):
        return bytes(self.link.frame[0:count])

    def read(self, _):
        self.loop()
        data, self.out = b"" if self.silent else bytes(self.out), bytearray()
        return data

    # ---- the loop ----

    def step(self, setpoint, measurement):
        """Its output, and the bytes of its frame."""
        output = lib.fixpid_pid_step(self.pid, setpoint, measurement)
        arguments = self.link, self.pid, setpoint, measurement, output
        if not self.tracks:
            return output, self.frame(lib.fixpid_link_step(*arguments))
        lib.fixpid_pid_track(self.pid, output // 2, 3)
        return output, self.frame(lib.fixpid_link_step_tracked(*arguments, output // 2, 3))

    def loop(self):
        """A step with its plant."""
        self.before_step(self)
        output, frame = self.step(lib.fixpid_link_setpoint(self.link), self.measurement)
        self.out += self.carried(frame)
        self.steps += 1
        if self.clock is not None:
            self.clock.now += self.board.period_us / 1e6
        self.level_q8 += (2 * 256 * output - self.level_q8) // self.lag
        self.measurement = (self.level_q8 >> 8) + self.draw.randrange(2 * self.noise + 1) - self.noise
