"""Drive a base on a serial line; what the base's bytes mean is its protocol's affair.

A protocol is pure: it turns a command into bytes and bytes into states, and knows neither port nor
clock. Adding a base is one file with such a class and a line in ``SERIAL_PROTOCOLS``
(docs/drives.md shows one).
"""

from __future__ import annotations

import logging
import sys
import time
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from bridge.drive.arduino import ArduinoProtocol
from bridge.drive.base_trouble import CountingBase, TroubledBase
from bridge.drive.pons_mcu import PonsMcuProtocol
from bridge.drive.turtlebot3 import Turtlebot3Protocol
from bridge.drive.waveshare import WaveshareProtocol
from devices import LastingPort, PortTrouble
from wire import ConfigError, DriveCommand

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from bridge.drive.base import Braking
    from bridge.drive.base_gyro import BaseGyro
    from wire import DecodeFailure, DriveState, Imu, RobotDescription

log = logging.getLogger("bridge.drive")

_KEPT = 4
"""More than four readings at once are a stall's; the newest say all that counts."""
_MOST_READS = 4
"""At 4096 bytes a read, more than a line brings in a tick: a babbling one can't hold the tick."""
UNREAD_BYTES = 600
"""Ten states of ours, three of the longest reports."""
SPOILT_EVERY_S = 10.0
"""Between two words in the log on what can't be read."""
_HALT_SENDS = 5
_HALT_GAP_S = 0.01


class SerialProtocol(Protocol):
    """Translate between the wire's messages and one base's bytes."""

    kind: str
    baud: int
    """What the base speaks unless robot.toml says otherwise."""
    braking: Braking

    @property
    def gyro(self) -> BaseGyro | None:
        """Return what the base's own gyro says; None where it has none."""

    def begin(self) -> bytes:
        """Forget the unfinished; return what the base must be told whenever its port opens."""

    def encode(self, command: DriveCommand) -> bytes:
        """Return the bytes of one command; none where the base is not to hear each of them."""

    def question(self, seq: int) -> bytes:
        """Return what asks for a state and is no command: no dead-man is fed by it."""

    def decode(self, data: bytes, now_s: float) -> list[DriveState]:
        """Return the states that bytes read at ``now_s`` complete, oldest first."""


class LineTrouble(Protocol):
    """Say why a line is away."""

    code: str
    detail: str


class ByteLine(Protocol):
    """Be a line that may vanish and come back; a LastingPort is one."""

    opened: int
    """How often it was opened."""

    @property
    def trouble(self) -> LineTrouble | None:
        """Return why it is away; None while it is open."""

    def read(self) -> bytes:
        """Return the bytes that came."""

    def write(self, data: bytes) -> bool:
        """Send a message whole or not at all; return which."""

    def close(self) -> None:
        """Give it back."""


SERIAL_PROTOCOLS: Mapping[str, Callable[[RobotDescription, str], SerialProtocol]] = {
    "pons_mcu": lambda robot, boot: PonsMcuProtocol(robot.drive, boot),
    "waveshare": WaveshareProtocol,
    "arduino": ArduinoProtocol,
    "turtlebot3": Turtlebot3Protocol,
}
"""By ``kind`` of robot.toml. Each is given the robot and this run's name."""


class SerialDrive:
    """Move a base through one serial port. Nothing here waits for the port."""

    virtual = False

    def __init__(
        self,
        protocol: SerialProtocol,
        port: ByteLine,
        boot: str,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.kind = protocol.kind
        self.braking = protocol.braking
        self._protocol = protocol
        self._port = port
        self._opened = 0
        self._boot = boot
        self._clock = clock
        self._seq = self._asked = 0
        self._waits = True
        """No state came since the port was opened."""
        self.unread = b""
        """What came meanwhile, the newest of it: for who wonders why none did."""
        self._spoilt_said, self._spoilt_said_s = 0, -SPOILT_EVERY_S

    @property
    def trouble(self) -> LineTrouble | None:
        """Return why the port is away; None while it is open."""
        return self._port.trouble

    @property
    def base_trouble(self) -> str | None:
        """Return what is wrong with a base that speaks, a code of base_trouble.py; or None."""
        return self._protocol.trouble if isinstance(self._protocol, TroubledBase) else None

    @property
    def spoilt(self) -> int:
        """Return how much could not be read since the start: lines, or bytes between frames."""
        return self._protocol.spoilt if isinstance(self._protocol, CountingBase) else 0

    @property
    def times_opened(self) -> int:
        """Return how often the port was opened."""
        return self._port.opened

    def read(self) -> tuple[DriveState | DecodeFailure, ...]:
        """Return the states since the last call, oldest first, at most the 4 newest."""
        self._begin_if_opened()
        found: list[DriveState] = []
        for _ in range(_MOST_READS):
            data = self._port.read()
            if not data:
                break
            found += self._protocol.decode(data, self._clock())
            if self._waits:
                self._waits, self.unread = not found, (self.unread + data)[-UNREAD_BYTES:]
                self._spoilt_said = self.spoilt  # before the first state it is noise
        self._say_spoilt()
        return tuple(found[-_KEPT:])

    @property
    def gyro(self) -> BaseGyro | None:
        """Return what the base's own gyro says; None where it has none."""
        return self._protocol.gyro

    def take_imu(self) -> Imu | None:
        """Return what the base's own gyro said in the states last read, once."""
        gyro = self._protocol.gyro
        return None if gyro is None else gyro.take()

    def write(self, command: DriveCommand | None) -> None:
        """Send one command; None sends nothing."""
        if command is None:
            return
        self._seq = command.seq
        self._begin_if_opened()
        data = self._protocol.encode(command)
        if data:
            self._port.write(data)

    def ask(self) -> None:
        """Ask for a state without commanding anything, where the base speaks only when asked."""
        self._asked += 1
        self._begin_if_opened()
        data = self._protocol.question(self._asked)
        if data:
            self._port.write(data)

    def halt(self) -> None:
        """Zero both wheels and take the torque away. Never raises."""
        for _ in range(_HALT_SENDS):
            self._seq += 1
            try:
                self.write(
                    DriveCommand(
                        boot=self._boot,
                        seq=self._seq,
                        left_radps=0.0,
                        right_radps=0.0,
                        enable=False,
                    )
                )
            except Exception as error:  # noqa: BLE001  # the last resort must not fail upwards
                print(f"halt_not_sent: {error!r}", file=sys.stderr, flush=True)  # noqa: T201
            time.sleep(_HALT_GAP_S)

    def close(self) -> None:
        """Give the port back."""
        self._port.close()

    def _say_spoilt(self) -> None:
        """Say in the log, now and then, how much of the line is spoilt."""
        more = self.spoilt - self._spoilt_said
        now_s = self._clock()
        if more <= 0 or now_s - self._spoilt_said_s < SPOILT_EVERY_S:
            return
        self._spoilt_said, self._spoilt_said_s = self.spoilt, now_s
        log.warning(
            "base_spoilt: %d more lines or bytes could not be read, %d since the start: shorten "
            "the cable, keep it off the motors' wires, look at its plug",
            more,
            self.spoilt,
        )

    def _begin_if_opened(self) -> None:
        """Greet the base after each opening: it may be another, or have begun anew."""
        opened = self._port.opened
        if self._opened != opened:
            greeting = self._protocol.begin()
            self._waits, self.unread = True, b""
            if not greeting or self._port.write(greeting):
                self._opened = opened


def open_serial_drive(
    robot: RobotDescription, boot: str, line: Path | None = None, *, for_trial: bool = False
) -> SerialDrive:
    """Open the port that robot.toml names, or ``line`` in its place, and speak its protocol.

    A robot whose trial is missing, or was of another wiring, gets no line at which metal may be:
    only one with a program at its far end, as a twin's is.

    Args:
        robot: its description.
        boot: this run's name.
        line: in place of robot.toml's port.
        for_trial: the wheels are off the ground, and who asks is the trial itself.

    Raises:
        ConfigError: ``robot_untried``, or the port can't be used and waiting would not mend it; its
            code is the port's.
    """
    config = robot.drive
    protocol = SERIAL_PROTOCOLS[config.kind](robot, boot)
    path = line or Path(config.port or "")
    try:
        guard = None if for_trial or robot.valid_trial else partial(_refuse_metal, robot)
        port = LastingPort(path, config.baud or protocol.baud, guard=guard)
    except PortTrouble as trouble:
        raise ConfigError(trouble.code, f"drive.port {trouble.detail}") from None
    return SerialDrive(protocol, port, boot)


def _refuse_metal(robot: RobotDescription, path: Path) -> None:
    """Refuse a line that is there and is no pseudo-terminal, whose far end is always a program."""
    if not path.exists() or path.resolve().is_relative_to("/dev/pts"):
        return
    known = "none" if robot.trial is None else f"one of {robot.trial.date}, of another wiring"
    raise PortTrouble(
        "robot_untried",
        path,
        f"before metal moves, robot.toml must hold a trial of it; it holds {known}",
    )
