# SPDX-License-Identifier: MIT
"""The PC's end of fixpid_link: the steps of a board, with the terms that its twin has, and
commands. The twin is C, sim/link/link_twin.c; its frames and counts are read here."""
import select
import time
from collections import deque
from typing import Any, Deque, Dict, FrozenSet, Iterator, List, NamedTuple, Optional, Tuple

from ._core import __version__, fields_of, new, numpy, problem, whole
from ._library import ffi, lib
from ._modules import record_pack
from ._pid import Pid
from ._units import Actuator, Sensor

PERMISSIONS = {"setpoint": lib.FIXPID_LINK_SETPOINT, "gains": lib.FIXPID_LINK_GAINS,
               "limits": lib.FIXPID_LINK_LIMITS, "manual": lib.FIXPID_LINK_MANUAL}
NUMBERS = 0x4000  # of steps, in their frames
CHUNK = 4096
PAUSE = 0.001  # seconds, where nothing has come
PATIENCE = 0.1  # seconds until a command is sent again
KEPT = 100_000


class Step(NamedTuple):
    """A step of the board, in counts. p, i and d are the twin's terms, as outputs, and None where
    there is no twin; `equal` is whether the twin's step was the same, and None where that was not
    compared. The setpoint is None where a frame may be missing that had another one."""

    number: int
    setpoint: Optional[int]
    measurement: int
    output: int
    flags: int
    p: Optional[float]
    i: Optional[float]
    d: Optional[float]
    equal: Optional[bool]


class Difference(NamedTuple):
    """A step that the twin made otherwise: what differs of output and flags, and in a key frame of
    integral, derivative and feedforward, each as the board has it and as the twin has it."""

    number: int
    board: Dict[str, float]
    twin: Dict[str, float]

    def __str__(self) -> str:
        said = (f"{name} {value:.12g}, the twin's {self.twin[name]:.12g}" for name, value in self.board.items())
        return f"step {self.number}: the board's {'; '.join(said)}"


def _state_of(state: bytes) -> Dict[str, float]:
    """The state that a key frame has, in output counts."""
    def at(first: int, end: int, signed: bool = True) -> int:
        return int.from_bytes(state[first:end], "little", signed=signed)

    return {"output": at(0, 2), "flags": state[2], "integral": at(3, 7) / 65536 + state[7] / 2**24,
            "derivative": at(8, 12) / 256, "feedforward": at(12, 14)}


class Link:
    """A board that runs fixpid_link, over any file object: pyserial's Serial, the `makefile("rwb",
    buffering=0)` of a socket, or whatever has `read` and `write` of bytes.

        with fixpid.Link(serial.Serial("/dev/ttyUSB0", 115200)) as link:
            print(link.name, link.allowed, link.record())
            for step in link:
                print(step.number, step.measurement, step.output, step.i)

    Each step of the board is one of the same C here, the twin, whose output and flags must be equal;
    key frames must have its whole state. `difference` is the first step that was not, `compared` and
    `not_compared` count. `resets` says how often the board began anew, which `notes` tells.

    A file that can only be read is a recording, as `save`, a file to write to, gets one: it has steps
    until it ends, and takes no commands. `every` streams each so many steps only, which have no twin.
    A command is sent again until it is answered, for at least `timeout` seconds and five steps, and
    then is a TimeoutError. What the board does not allow is a PermissionError, and what it refuses a
    ValueError. `keep` is how many of the last steps `log` has.
    """

    name: Optional[str] = None
    version: Optional[str] = None
    allowed: FrozenSet[str] = frozenset()
    period: Optional[float] = None
    manual_steps: Optional[int] = None
    features: Optional[int] = None
    compared: int
    not_compared: int
    difference: Optional[Difference]
    resets: int
    notes: List[str]

    def __init__(self, port: Any, *, every: int = 1, timeout: float = 2.0, save: Any = None, keep: int = KEPT):
        self._port, self._save = port, save
        self._live = hasattr(port, "write") and (not hasattr(port, "writable") or port.writable())
        self._every = whole("every", every, "uint8_t")
        self._timeout = timeout
        self._twin = ffi.new("struct link_twin *")
        lib.link_twin_init(self._twin)
        self._twin.wants_record = True
        self._twin.asks = self._live
        self._before = ffi.new("struct fixpid_pid *")
        self._bytes = bytearray()
        self._odd = b""  # the last that came since a command was sent, and was no frame
        self._steps: Deque[Step] = deque(maxlen=keep)  # nobody has read them
        self._kept: Deque[Step] = deque(maxlen=keep)
        self._number: Optional[int] = None  # of the last step
        self._run = 0  # steps since the board began
        self._setpoint: Optional[int] = None
        self._heard = time.monotonic()
        self._streams = self._key_due = False
        self.compared = self.not_compared = self.resets = 0
        self.difference, self.notes = None, []
        if self._live:
            self.hello()

    def __enter__(self) -> "Link":
        return self

    def __exit__(self, kind: Any, *_: Any) -> None:
        self.close()

    def close(self) -> None:
        """Ends the stream, if the board still answers. The port stays open."""
        if self._streams:
            try:
                self.stream(0)
            except (OSError, ValueError):
                self._streams = False

    def __repr__(self) -> str:
        said = "no step differs" if self.difference is None else str(self.difference)
        anew = f", {self.resets} resets" if self.resets else ""
        return f"<Link {self.name}: {self.compared} steps compared, {self.not_compared} not, {said}{anew}>"

    # ---- bytes ----

    def _read(self, wait: float = PAUSE) -> bytes:
        """What has come; nothing, after a while, if nothing has."""
        waiting = getattr(self._port, "in_waiting", None)
        if waiting is not None:  # pyserial would wait for all that is asked for
            came = self._port.read(waiting) if waiting else b""
        else:
            came = self._port.read1(CHUNK) if hasattr(self._port, "read1") else self._ready(wait) and self._port.read(CHUNK)
        if not came and self._live:
            time.sleep(wait)
        return came or b""

    def _ready(self, wait: float) -> bool:
        if not self._live:
            return True
        try:
            return bool(select.select([self._port], [], [], wait)[0])
        except (OSError, TypeError, ValueError):
            return True  # it is no file of the system

    def _pump(self) -> bool:
        """Takes what has come; False if that is nothing."""
        came = self._read()
        if not came:
            return False
        self._heard = time.monotonic()
        if self._save is not None:
            self._save.write(came)
        *frames, rest = came.split(b"\0")
        for frame in frames:
            self._bytes += frame
            self._take(bytes(self._bytes[:lib.LINK_FRAMES_MAX]))
            self._bytes.clear()
        self._bytes += rest
        del self._bytes[lib.LINK_FRAMES_MAX:]
        return True

    # ---- frames ----

    def _take(self, framed: bytes) -> None:
        """A frame without its 0, for the twin and for what is told."""
        twin = self._twin
        if not framed:
            return
        self._before[0] = twin.pid
        different, tracked = twin.different, twin.tracked
        for byte in framed:
            lib.link_twin_receive(twin, byte)
        if not lib.link_twin_receive(twin, 0):
            self._odd = (self._odd + framed)[-2 * lib.LINK_FRAMES_MAX:]
            return
        payload = bytes(twin.frame[0:twin.frame_bytes])
        if payload[0] & lib.LINK_STEP or payload[0] == lib.LINK_KEY:
            self._take_step(payload, False if twin.different != different else True if twin.compared else None, tracked)
        elif payload[0] == lib.LINK_HELLO:
            self._take_hello(payload)

    def _take_hello(self, payload: bytes) -> None:
        self.version = ".".join(map(str, payload[3:6]))
        self.features = payload[6]
        self.allowed = frozenset(name for name, bit in PERMISSIONS.items() if payload[7] & bit)
        self.period = int.from_bytes(payload[8:12], "little") / 1e6
        self.manual_steps = int.from_bytes(payload[12:14], "little")
        self.name = payload[14:].rstrip(b"\0").decode("ascii", "replace")
        if payload[2] != lib.FIXPID_LINK_VERSION:
            raise ValueError(f"the board has version {payload[2]} of the link, and fixpid {__version__} "
                             f"version {lib.FIXPID_LINK_VERSION}")

    def _take_step(self, payload: bytes, equal: Optional[bool], tracked: bool) -> None:
        twin, key = self._twin, payload[0] == lib.LINK_KEY
        setpoint_at = 7 if key or len(payload) in (9, 12) else None
        number_at, measured_at, size = (3, 9, 4) if key else (1, 3, 2)
        number = int.from_bytes(payload[number_at:number_at + size], "little")
        measurement, output = (int.from_bytes(payload[at:at + 2], "little", signed=True)
                               for at in (measured_at, measured_at + 2))
        flags = payload[13] if key else payload[0] & ~lib.LINK_STEP
        jump = self._jump(number, key)
        self._key_due = False
        if setpoint_at is not None:
            self._setpoint = int.from_bytes(payload[setpoint_at:setpoint_at + 2], "little", signed=True)
        elif jump != self._every:
            self._setpoint = None
        if equal is None:
            self.not_compared += jump
        else:
            self.compared += 1
            self.not_compared += jump - 1
        if equal is False and self.difference is None:
            self.difference = self._differs(payload, measurement, output, flags, tracked)
        terms: Tuple[Optional[float], ...] = (None, None, None)
        if twin.running:
            terms = (lib.fixpid_pid_proportional(ffi.addressof(twin.pid)) / 256,
                     lib.fixpid_pid_integral(ffi.addressof(twin.pid)) / 65536,
                     lib.fixpid_pid_derivative(ffi.addressof(twin.pid)) / 256)
        step = Step(self._number or 0, self._setpoint, measurement, output, flags, *terms, equal)
        self._steps.append(step)
        self._kept.append(step)
        self._run += 1

    def _jump(self, number: int, key: bool) -> int:
        """By how many steps the board has gone on; notes their number."""
        if key and self._number is not None and (number - self._number) % 2**32 >= 2**31:
            self._anew()
        last, self._number = self._number, number
        if last is None:
            return 1
        jump = (number - last) % (2**32 if key else NUMBERS)
        self._number = (last + jump) % 2**32
        return jump or 1

    def _anew(self) -> None:
        """The board was reset: its steps count from 0, and it controls as its program has it."""
        self.notes.append(f"The board was reset behind step {self._number}: its setpoint and its gains are those of its "
                          "program again.")
        self.resets += 1
        self._number, self._run = None, 0

    def _differs(self, payload: bytes, measurement: int, output: int, flags: int, tracked: bool) -> Difference:
        """The step once more, for both answers."""
        board: Dict[str, float] = {"output": output, "flags": flags}
        own = lib.fixpid_pid_step(self._before, self._twin.setpoint, measurement)
        twin: Dict[str, float] = {"output": own, "flags": lib.fixpid_pid_flags(self._before)}
        if payload[0] == lib.LINK_KEY:
            state = ffi.new("uint8_t[]", lib.FIXPID_PID_STATE_SIZE)
            lib.fixpid_pid_state(self._before, state)
            twin = {**_state_of(bytes(state)), **twin}
            board = {**_state_of(payload[11:25]), **board}
            if tracked:
                del twin["integral"]  # what was applied is not in a key frame
        names = [name for name in twin if twin[name] != board[name]]
        return Difference(self._number or 0, {name: board[name] for name in names}, {name: twin[name] for name in names})

    def _doubt(self) -> None:
        """The controller may be another one than the twin's: the record is asked for again."""
        self._twin.known = self._twin.running = False
        self._twin.wants_record = True

    # ---- steps ----

    @property
    def spoilt(self) -> int:
        """How often what stood between two zeros was no frame."""
        return int(self._twin.spoilt)

    @property
    def equal(self) -> bool:
        """True if steps were compared, and none differed."""
        return self.compared > 0 and self.difference is None

    def __iter__(self) -> Iterator[Step]:
        return self

    def __next__(self) -> Step:
        """The next step. The stream begins with the first one, and ends with `stream(0)`."""
        self._mend()
        while not self._steps:
            if self._live and self._every == 0:
                raise StopIteration
            if not self._pump():
                if not self._live:
                    raise StopIteration
                if time.monotonic() - self._heard > self._silence():
                    self._wake()
            self._mend()
        return self._steps.popleft()

    def _wake(self) -> None:
        """Asks a silent board. One that answers and streams nothing was reset."""
        self._ask("record", lib.LINK_ASK_RECORD)
        end = time.monotonic() + max(PATIENCE, 2 * (self.period or 0) * self._every)
        while not self._steps:
            if time.monotonic() > end:
                self._anew()
                self.hello()
                self._begin()
                return
            self._pump()

    def _mend(self) -> None:
        """Asks for what the twin needs: the record, and a key frame, with which a stream begins."""
        twin = self._twin
        if not self._live or self._every == 0:
            return
        if not self._streams or (twin.wants_record and self._every == 1):
            self._begin()
        elif self._every == 1 and twin.known and not twin.running and not self._key_due:
            self.stream(1)

    def read(self, count: int) -> List[Step]:
        """The next so many steps; fewer if the stream ends."""
        return [step for _, step in zip(range(count), self)]

    def _silence(self) -> float:
        return max(self._timeout, 5 * (self.period or 0) * self._every)

    def _begin(self) -> None:
        self._twin.wants_record = False
        self._ask("record", lib.LINK_ASK_RECORD)
        self.stream(self._every)

    # ---- commands ----

    def _ask(self, what: str, command: int, value: bytes = b"") -> int:
        """Sends a command until it is answered: the result."""
        if not self._live:
            raise ValueError(f"{what} is refused: a recording takes no commands")
        twin, period = self._twin, self.period or 0
        self._odd, frames = b"", twin.frames
        lib.link_twin_send(twin, command, value, len(value))
        # A 0 ends what the board may have of another command.
        framed = b"\0" + bytes(ffi.buffer(twin.command, twin.command_bytes))
        end = time.monotonic() + max(self._timeout, 5 * period)
        try:
            while time.monotonic() < end:
                self._port.write(framed)
                if hasattr(self._port, "flush"):
                    self._port.flush()
                again = time.monotonic() + max(PATIENCE, 2 * period)
                while time.monotonic() < min(again, end):
                    self._pump()
                    if twin.command_bytes == 0:
                        return int(twin.result)
        finally:
            if twin.command_bytes != 0:  # whether it was done is not known
                twin.command_bytes = 0
                self._doubt()
        raise TimeoutError(f"the board did not answer to {what} within {max(self._timeout, 5 * period):g} s: "
                           f"{self._came(twin.frames != frames)}")

    def _came(self, frames: bool) -> str:
        """What came in the place of an answer, and what that tells."""
        loop, odd = "a loop without fixpid_link_receive and fixpid_link_answer", self._odd + self._bytes
        if frames:
            return f"its steps come, so it is the wire to the board, or {loop}"
        if not odd:
            return f"nothing came; the wire, the baud rate, or {loop}"
        text = odd.decode("latin-1")
        if all(one.isspace() or " " <= one <= "~" for one in text):
            return f"text came, {text[:40]!r}; another program runs there, or prints on this port"
        return f"{odd[:10].hex(' ')} came, which is no frame; the baud rate, or another program runs there"

    def _command(self, what: str, command: int, value: bytes, needs: str, why: str) -> None:
        result = self._ask(what, command, value)
        if result == lib.LINK_NOT_ALLOWED:
            self.hello()  # what is allowed may have changed
            allowed = ", ".join(sorted(self.allowed)) or "nothing"
            raise PermissionError(f"{what} is not allowed: it needs {needs}, and the board allows {allowed}")
        if result == lib.LINK_REFUSED:
            raise ValueError(f"{what} is refused: {why}")

    def _value(self, name: str, value: int, command: int, needs: str, why: str) -> None:
        number = whole(name, value, "int16_t")
        self._command(f"{name} = {number}", command, number.to_bytes(2, "little", signed=True), needs, why)

    def hello(self) -> None:
        """Asks the board who it is: name, version of its library, period in seconds, manual_steps,
        features as FIXPID_PID_FEATURES, and allowed, a set of "setpoint", "gains", "limits" and
        "manual"."""
        self._ask("hello", lib.LINK_ASK_HELLO)

    def record(self) -> Dict[str, Any]:
        """What the controller of the board runs with, as Pid takes it: `gains`, output_min and so on.
        Of a recording, what it has said up to here."""
        if self._live:
            self._ask("record", lib.LINK_ASK_RECORD)
        if not self._twin.known:
            raise ValueError("the record is not known" if self._live else "the recording has said no record yet")
        return dict(fields_of(self._twin.config))

    def stream(self, every: int) -> None:
        """A frame for each so many steps, from the next one on; 0 ends it. Only 1 has a twin."""
        self._every = whole("every", every, "uint8_t")
        self._command(f"stream({every})", lib.LINK_SET_STREAM, bytes([self._every]), "nothing", "the board has no stream")
        self._streams = self._key_due = self._every != 0
        self._heard = time.monotonic()

    def setpoint(self, value: int) -> None:
        """Another setpoint, in counts."""
        self._value("setpoint", value, lib.LINK_SET_SETPOINT, "setpoint", "it is beyond the board's setpoint_min..setpoint_max")

    def manual(self, value: int) -> None:
        """The output by hand, in counts. Say it again within `manual_steps` steps, else the board
        controls by itself again."""
        self._value("manual", value, lib.LINK_SET_MANUAL, "manual", self._no_hand())

    def auto(self) -> None:
        """The end of an output by hand."""
        self._command("auto", lib.LINK_SET_AUTO, b"", "manual", self._no_hand())

    def seed(self, value: int) -> None:
        """The output from which the controller goes on, in counts: fixpid_pid_seed."""
        self._value("seed", value, lib.LINK_SET_SEED, "manual", self._no_hand())

    def _no_hand(self) -> str:
        return ("the board's manual_steps is 0" if self.manual_steps == 0 else
                "its firmware is built without FIXPID_PID_HAS_MANUAL")

    def write(self, record: Any = None, **fields: Any) -> None:
        """Other gains or limits: `gains`, as pid_gains makes them, and output_min, output_max,
        integral_min, integral_max; what is not said stays. Or a whole record, as bytes or as `record`
        returns it; or a Pid, whose gains in counts are taken."""
        if isinstance(record, (bytes, bytearray)):
            if len(record) != lib.FIXPID_RECORD_SIZE:
                raise ValueError(f"a record has {lib.FIXPID_RECORD_SIZE} bytes, not {len(record)}")
            wanted: Optional[Dict[str, Any]] = None
            packed = bytes(record)
        else:
            known = fields_of(self._twin.config) if self._twin.running else self.record()
            if isinstance(record, Pid):
                record = {"gains": record._said[1].get("gains", {})}
            wanted = {**known, **(record or {}), **fields}
            new("pid_config", wanted)  # refuses names and numbers that there are not
            wanted["gains"] = {**dict.fromkeys(known["gains"], 0), **wanted["gains"]}
            packed = record_pack(**wanted)
        self._command("write", lib.LINK_WRITE, packed, "gains, and for other limits limits", self._no_write(wanted))

    def _no_write(self, wanted: Optional[Dict[str, Any]]) -> str:
        if wanted is None:
            return "it is no record, or has what a running controller does not take"
        known = fields_of(self._twin.config)
        for name in "setpoint_weight_q8", "reverse", "derivative_on_error", "proportional_on_measurement":
            if self._twin.known and wanted[name] != known[name]:
                return f"{name} = {wanted[name]} needs an init on the board, which has {known[name]}"
        field = problem("pid", new("pid_config", wanted))
        if field:
            return f"{field} = {({**wanted, **wanted['gains']})[field]}"
        return "output limits beyond the board's, or gains that its features do not have"

    # ---- what has come ----

    @property
    def log(self) -> Dict[str, Any]:
        """The last steps (`keep` of them) as arrays of their fields, or as lists without numpy. The
        setpoint and the terms are nan where they are None in a Step; `equal` is then False."""
        columns = zip(*self._kept) if self._kept else [()] * len(Step._fields)
        log: Dict[str, Any] = {}
        for name, column in zip(Step._fields, columns):
            if name in ("setpoint", "p", "i", "d"):
                values: List[Any] = [float("nan") if value is None else float(value) for value in column]
            else:
                values = list(map(bool, column)) if name == "equal" else list(column)
            log[name] = values if numpy is None else numpy.array(values, {"equal": bool, "number": "int64"}.get(
                name, float if name in ("setpoint", "p", "i", "d") else int))
        return log

    @property
    def rate(self) -> float:
        """Steps per second, which the board says in its hello."""
        if not self.period:
            raise ValueError("the period is not known: the recording has no hello")
        return 1 / self.period

    def recording(self, sensor: Optional[Sensor] = None, actuator: Optional[Actuator] = None) -> Tuple[Any, Any, Any]:
        """Seconds, output and measurement of `log`, for `fit(*link.recording())`: counts, or with a
        sensor and an actuator their units. It begins behind the board's last reset."""
        rate = self.rate
        steps = list(self._kept)[max(0, len(self._kept) - self._run):]
        t = [(step.number - steps[0].number) % 2**32 / rate for step in steps]
        u = [step.output if actuator is None else actuator.units(step.output) for step in steps]
        y = [step.measurement if sensor is None else sensor.units(step.measurement) for step in steps]
        return (t, u, y) if numpy is None else (numpy.array(t), numpy.array(u), numpy.array(y))
