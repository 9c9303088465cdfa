# SPDX-License-Identifier: MIT
"""A live link against a board in C, over good wires and bad ones: link.py."""
import itertools
import os
import random
import socket
import sys
import tempfile
import threading
import time
import types

import numpy

import fixpid
from board import ALL, BOARD, CONFIG, Board, Clock
from fixpid import lib
from runner import message, refuses, run, same

LINK = sys.modules["fixpid._link"]
CLOCK = LINK.time = Clock()  # the board's: each run is the same
KEY_FRAMES = 256  # steps from one to the next
STEPS = 20000


def pair(every=1, **board):
    board = Board(clock=CLOCK, **board)
    return board, fixpid.Link(board, every=every)


def read_on(link, count):
    """What waits, and so many steps behind it, which are returned."""
    link.read(len(link._steps))
    return link.read(count)


def config_of(board):
    return LINK.fields_of(board.config[0])


def the_board_says_who_it_is():
    board, link = pair(allowed=fixpid.LINK_SETPOINT | fixpid.LINK_LIMITS)
    same((link.name, link.version, link.period, link.manual_steps), ("oven", fixpid.__version__, 0.001, 50))
    same((link.allowed, link.features), ({"setpoint", "limits"}, fixpid.PID_ALL))
    same(fixpid.Link(Board(clock=CLOCK, allowed=0, name=b"ten" * 3 + b"!")).name, "tententen!")
    assert link.record() == config_of(board) and fixpid.Pid(**link.record())
    same((link.equal, link.compared, link.not_compared), (False, 0, 0))
    lib.fixpid_link_allow(board.link, ALL)
    link.hello()
    same(len(link.allowed), 4)
    same(message(ValueError, link._take_hello, bytes([3, 1, 2]) + bytes(21)),
         f"the board has version 2 of the link, and fixpid {fixpid.__version__} version 1")


def steps_have_the_terms_of_the_board():
    board, link = pair()
    terms = {}

    def note(at):
        terms[at.steps - 1] = (lib.fixpid_pid_proportional(at.pid) / 256, lib.fixpid_pid_integral(at.pid) / 65536,
                               lib.fixpid_pid_derivative(at.pid) / 256)

    link.setpoint(300)
    board.before_step = note
    steps = link.read(2000)
    same([(step.p, step.i, step.d) for step in steps[:-1]], [terms[step.number] for step in steps[:-1]])
    same([step.number for step in steps], list(range(steps[0].number, steps[0].number + 2000)))
    same({step.setpoint for step in steps}, {300})
    same([step.equal for step in steps], [None] + [True] * 1999)
    assert len({step.output for step in steps}) > 50 and abs(steps[-1].measurement - 300) < 60, steps[-1]


def order(link, draw):
    """A command, which may be refused."""
    value = draw.randrange(-600, 1000)
    gains = {"kp_q8": draw.randrange(40000), "ki_q24": draw.randrange(3000000), "kd_q8": draw.randrange(600)}
    call, arguments = draw.choice((
        (link.setpoint, {"value": value}), (link.manual, {"value": value}), (link.auto, {}), (link.seed, {"value": value}),
        (link.write, {"gains": gains}), (link.write, {"output_max": draw.randrange(250, 310)}), (link.record, {})))
    try:
        call(**arguments)
    except ValueError:
        return 1
    return 0


def all_steps_are_equal_on_a_good_wire():
    board, link = pair()
    draw, refused = random.Random(1), 0
    for _ in range(STEPS // 100):
        refused += order(link, draw)
        link.read(100)
    # Not compared are the first step, and those around a hand that let go.
    assert link.equal and link.compared > STEPS * 0.98, link
    same((board.steps - 1 - link.compared - link.not_compared < 120, board.wrong(), link.spoilt), (True, [], 0))
    assert len({heard[0] for heard in board.heard}) == 8 and 10 < refused < 100, refused
    assert link.read(KEY_FRAMES)[-1].equal and link.record() == config_of(board)
    log = link.log
    same((log["number"].dtype, log["equal"].dtype, len(log["p"])), (numpy.int64, bool, link.compared + link.not_compared))


def nothing_is_wrong_on_a_bad_wire():
    """One byte of a hundred is lost, turned, doubled or another, in both directions."""
    board, link = pair(damage=100)
    draw, late = random.Random(2), 0
    for _ in range(STEPS // 100):
        try:
            order(link, draw)
            link.read(100)
        except TimeoutError:
            late += 1
    assert board.steps > STEPS and link.spoilt > STEPS / 20, (board.steps, link.spoilt)
    same((board.wrong(), link.difference), ([], None))
    assert link.compared > STEPS / 10 and link.not_compared > STEPS / 10 and late < 20, (link, late)
    board.damage = 0
    read_on(link, KEY_FRAMES)
    before = link.not_compared
    assert all(step.equal for step in link.read(1000)) and link.not_compared == before and link.equal, link
    same(link.record(), config_of(board))


def a_bit_of_the_board_is_noticed():
    board, link = pair()
    link.read(100)
    board.pid.integral_fraction ^= 1
    link.read(KEY_FRAMES)
    found = link.difference
    assert not link.equal and found.number == link._kept[0].number + KEY_FRAMES, found
    same((list(found.board), abs(found.board["integral"] - found.twin["integral"])), (["integral"], 2**-24))
    assert str(found).startswith(f"step {found.number}: the board's integral "), str(found)
    board, link = pair()
    at = link.read(100)[-1].number
    board.pid.integral += 5 << 16
    wrong = link.read(1)[0]
    same((wrong.number, wrong.equal, link.difference.number), (at + 1, False, at + 1))
    same(link.difference.board, {"output": wrong.output})
    same(link.difference.twin, {"output": wrong.output - 5})
    assert f"output {wrong.output}, the twin's {wrong.output - 5}" in repr(link), repr(link)
    same(link.compared, 100)
    link.read(2 * KEY_FRAMES)
    assert link.log["equal"][-100:].all() and not link.equal


def what_is_refused_is_said():
    _, link = pair(allowed=0)
    for call, arguments, start in (
            (link.setpoint, (5,), "setpoint = 5 is not allowed: it needs setpoint, and the board allows nothing"),
            (link.manual, (5,), "manual = 5 is not allowed: it needs manual"), (link.auto, (), "auto is not allowed"),
            (link.seed, (5,), "seed = 5 is not allowed"), (link.write, ({"gains": {}},), "write is not allowed: it needs gains")):
        assert message(PermissionError, call, *arguments).startswith(start), start
    board, link = pair(allowed=ALL)
    lib.fixpid_link_allow(board.link, fixpid.LINK_MANUAL)
    assert message(PermissionError, link.setpoint, 5).endswith("and the board allows manual")
    _, link = pair(allowed=ALL - fixpid.LINK_LIMITS, manual_steps=0)
    assert "limits" in message(PermissionError, link.write, output_max=9)
    for call, fields, start in (
            (link.setpoint, {"value": 901}, "setpoint = 901 is refused: it is beyond the board's"),
            (link.manual, {"value": 1}, "manual = 1 is refused: the board's manual_steps is 0"),
            (link.write, {"setpoint_weight_q8": 9}, "write is refused: setpoint_weight_q8 = 9 needs an init on the board"),
            (link.write, {"gains": {"kd_q8": 32256}}, "write is refused: kd_q8 = 32256"),
            (link.write, {"output_min": -301}, "write is refused: output limits beyond"),
            (link.write, {"record": bytes(23)}, "write is refused: it is no record"),
            (link.write, {"record": bytes(22)}, "a record has 23 bytes, not 22")):
        said = message(ValueError, call, **fields)
        assert said.startswith(start), said
    assert refuses(TypeError, link.setpoint, 1.5) and refuses(OverflowError, link.seed, 40000)
    assert refuses(TypeError, link.write, outputs=1) and refuses(OverflowError, link.write, gains={"kp_q8": -1})
    assert all(step.equal is not False for step in link.read(300)) and link.difference is None


def gains_are_written():
    board, link = pair()
    gains = fixpid.pid_gains(kp=1.5, ki=2, rate=1000)
    link.write(gains=gains)
    same(link.record(), {**config_of(board), "gains": gains})
    link.write({**link.record(), "output_max": 200})
    same((board.config.output_max, board.config.gains.kp_q8), (200, 384))
    link.write(fixpid.record_pack(**{**CONFIG, "output_min": -9}))
    same(link.record(), {**config_of(board), "gains": CONFIG["gains"], "output_min": -9})
    link.write(fixpid.Pid(kp=3, ki=1, rate=1000, output_limits=(-300, 300)))
    same((board.config.gains.kp_q8, board.config.output_min, board.pid.output_min), (768, -9, -9))
    link.read(100)
    link.write(output_min=-8)
    assert all(step.equal for step in link.read(300)) and link.record()["output_min"] == -8


def a_silent_board_is_said():
    board = Board(clock=CLOCK)
    board.silent = True
    said = message(TimeoutError, fixpid.Link, board, timeout=0.5)
    assert said.startswith("the board did not answer to hello within 0.5 s: nothing came; the wire, the baud rate"), said
    board, link = pair()
    link.read(10)
    board.silent = True
    since = CLOCK.now
    assert message(TimeoutError, link.read, 10).startswith("the board did not answer to record within 2 s")
    assert 2 < CLOCK.now - since < 5, CLOCK.now - since
    board.deaf, board.silent = 10**6, False
    assert ": its steps come, so it is the wire to the board" in message(TimeoutError, link.record)
    with link:
        pass  # it does not mind
    for came, said in ((b"boot\r\nfree: 1024 bytes\r\n", "text came, 'boot\\r\\nfree: 1024 bytes\\r\\n"),
                       (b"\x00\xf8\x80\xfe\x00", " f8 80 fe f8 80 fe ")):
        wire = types.SimpleNamespace(write=len, read=lambda _, of=itertools.cycle((b"", came)): next(of))
        assert said in message(TimeoutError, fixpid.Link, wire, timeout=0.5), came
    board, link = pair(period_us=1000000)
    board.silent, said = True, []
    board.write = said.append
    assert "within 5 s" in message(TimeoutError, link.auto)
    same((len(said), len(set(said))), (3, 1))  # each two steps


def a_command_is_repeated_and_done_once():
    board, link = pair()
    link.read(10)
    board.deaf = 3
    link.seed(77)
    same([heard[0] for heard in board.heard if heard[0] == lib.LINK_SET_SEED], [lib.LINK_SET_SEED])
    link.read(300)
    answer, lost = Board.receive, []

    def unheard(self, data):
        lost.append(answer(self, data))
        return lost[-1] if len(lost) > 2 else b""

    for call, fields in ((link.manual, {"value": 9}), (link.write, {"gains": {"kp_q8": 9}}), (link.record, {})):
        lost.clear()
        board.receive = unheard.__get__(board)
        call(**fields)
        same((len(lost), lost[0]), (3, lost[2]))
        read_on(link, KEY_FRAMES)
    assert link.equal and link.read(1)[0].equal
    # The record is said twice, the second time when the next command is under way.
    board.receive = lambda data: 2 * answer(board, data)
    for value in 20, 30, 40:
        link.record()
        link.manual(value)
        same(link.read(5)[-1].output, value)
    assert link.equal and link.read(1)[0].equal
    # Nobody knows whether it was done.
    board.receive = lambda data: answer(board, data) and b""
    assert refuses(TimeoutError, link.write, gains={"kp_q8": 100})
    del board.receive
    read_on(link, KEY_FRAMES)
    assert link.equal and link.read(1)[0].equal and link.record() == config_of(board)
    same(board.config.gains.kp_q8, 100)


def what_the_program_changes_is_taken_over():
    board, link = pair()
    link.setpoint(200)
    for kp in 100, 900, 300:
        link.read(500)
        board.config.gains.kp_q8 = kp
        assert lib.fixpid_pid_set_gains(board.pid, LINK.new("pid_gains", LINK.fields_of(board.config.gains)))
        lib.fixpid_pid_reset(board.pid)
        lib.fixpid_link_changed(board.link)
    link.read(500)
    same(link.record()["gains"]["kp_q8"], 300)
    assert link.equal and link.compared > 1950, link


def a_reset_is_seen_and_said():
    """Whether the numbers fall, or rise because the board was silent for longer than it had run."""
    for before in 3000, 50:
        board, link = pair()
        link.read(before)
        link.setpoint(200)
        lib.fixpid_link_allow(board.link, 0)
        board.start(CONFIG, 0)
        last, since = link._number, board.steps
        link.read(300)
        same((link.resets, len(link.notes), link.allowed), (1, 1, frozenset()))
        assert link.notes[0].startswith(f"The board was reset behind step {last}: "), link.notes
        assert repr(link).endswith("no step differs, 1 resets>"), repr(link)
        assert link.equal and link.read(1)[0].equal and link.not_compared < 20, link
        t, u, _ = link.recording()
        same((t[0], len(t) == len(u), round(t[-1] * 1000)), (0, True, len(t) - 1))
        assert len(t) <= board.steps - since, (len(t), board.steps - since)
    # Where frames go on to come, the number of a key frame tells it.
    board.start(CONFIG, 0)
    lib.fixpid_link_allow(board.link, ALL)
    link.stream(1)
    same((link.read(1)[0].number < 5, link.resets, len(link.recording()[0])), (True, 2, 1))
    # A wire that was cut for long is no reset.
    board, link = pair()
    link.read(50)
    board.silent = True
    since = CLOCK.now
    board.before_step = lambda at: setattr(at, "silent", CLOCK.now - since < 2.5)
    link.read(KEY_FRAMES)
    assert link.resets == 0 and link.notes == [] and link.read(1)[0].equal, link
    assert link.recording()[0][-1] > 1 and link.not_compared > 1000, link


def tracked_steps_are_equal():
    board, link = pair()
    board.tracks = True
    assert link.read(2000)[-1].equal and link.equal and link.compared == 1999, link
    board.pid.integral += 9 << 16
    link.read(3)
    assert link.difference.board.keys() == {"output"}, link.difference
    board, link = pair()
    board.tracks = True
    link.read(KEY_FRAMES)
    board.pid.derivative ^= 1
    key = link.read(1)[0]
    same((list(link.difference.board), link.difference.number, key.equal), (["derivative"], key.number, False))


def a_thinned_stream_has_no_twin():
    board, link = pair(every=3)
    link.setpoint(250)
    steps = link.read(600)
    same({b.number - a.number for a, b in zip(steps, steps[1:])}, {3})
    same({step.equal for step in steps}, {None})
    same({step.setpoint for step in steps}, {250})
    assert not link.equal and link.difference is None and link.not_compared == 1 + 3 * 599, link
    link.stream(1)
    link.read(600)
    assert link.equal and link.read(1)[0].equal
    link.stream(0)
    count = len(link.read(10))
    same((count < 10, link.read(10)), (True, []))
    same(board.link.stream_interval, 0)
    lost = Board(clock=CLOCK)
    link = fixpid.Link(lost)
    link.read(10)
    lost.step(33, 0)  # a frame that nobody gets: the setpoint may be another one
    same([step.setpoint for step in link.read(2)], [0, 0])  # it says it, as it is another one than before
    lost.step(0, 0)
    same([step.setpoint for step in link.read(2)], [None, 0])  # until a key frame, which is asked for


def text_spoils_one_frame():
    board, link = pair()
    link.read(10)
    board.out += b"free: 1024 bytes\r\n"
    link.read(KEY_FRAMES + 10)
    assert link.spoilt == 1 and link.equal and link.read(1)[0].equal, link


def a_file_is_read_again():
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "run.bin")
        board = Board(clock=CLOCK, noise=0, manual_steps=5000)
        with open(path, "wb") as file, fixpid.Link(board, save=file) as link:
            link.manual(0)
            link.read(100)
            link.manual(200)
            link.read(300)
            link.auto()
            link.write(gains={"kp_q8": 300})
            link.read(300)
            link.record()
            link.read(KEY_FRAMES)
        same((board.link.stream_interval, link.equal), (0, True))
        with open(path, "rb") as file:
            played = fixpid.Link(file)
            steps = list(played)
            assert message(ValueError, played.setpoint, 5).startswith("setpoint = 5 is refused: a recording takes no commands")
    # The recording has one or two steps more, as the stream ends.
    count = len(link.log["number"])
    for name in "number", "setpoint", "measurement", "output", "flags":
        same(played.log[name][:count].tolist(), link.log[name].tolist())
    assert played.difference is None and steps[-1].equal and played.compared > 250, played
    same((played.name, played.period, played.record()["gains"]["kp_q8"]), ("oven", 0.001, 300))
    t, u, y = link.recording()
    assert abs(t[0]) + abs(t[count - 1] - (link.log["number"][-1] - link.log["number"][0]) / 1000) < 1e-9, t
    until = u[:390].tolist().index(200) + 300
    found = fixpid.fit(t[:until], u[:until], y[:until])
    assert abs(found.gain - 2) < 0.1 and 0.014 < found.lag < 0.018, found
    t, u, y = link.recording(sensor=fixpid.Sensor(0, 409.5), actuator=fixpid.Actuator(0, 255, full=100))
    same((u.max(), y.max()), (100, max(link.log["measurement"]) / 10))
    assert message(ValueError, fixpid.Link(open(os.devnull, "rb")).recording).startswith("the period is not known")


class Waiting:
    """A port like pyserial's."""

    def __init__(self, board):
        self.board, self.write = board, board.write

    @property
    def in_waiting(self):
        if not self.board.out:
            self.board.loop()
        return len(self.board.out)

    def read(self, count):
        data, self.board.out = bytes(self.board.out[:count]), self.board.out[count:]
        same(len(data), count)
        return data


def ports_of_several_kinds():
    assert fixpid.Link(Waiting(Board(clock=CLOCK))).read(300)[-1].equal
    LINK.time = time
    here, there = socket.socketpair()
    board, wire = Board(), there.makefile("rwb", buffering=0)
    there.settimeout(5)
    over = threading.Event()

    def serve():
        there.setblocking(False)
        while not over.is_set():
            got = wire.read(64)
            if got:
                wire.write(board.receive(got))
            board.out.clear()
            board.loop()
            wire.write(board.out)
            time.sleep(0.0005)

    thread = threading.Thread(target=serve)
    thread.start()
    try:
        with here, here.makefile("rwb", buffering=0) as port:
            link = fixpid.Link(port, timeout=1)
            link.setpoint(99)
            assert link.read(200)[-1].equal and link.equal and link.read(1)[0].setpoint == 99
            over.set()
            thread.join()
            assert message(TimeoutError, link.read, 1000).startswith("the board did not answer to record")
    finally:
        over.set()
        thread.join()
        there.close()
        LINK.time = CLOCK


run()
