"""Feed a drive's protocol with spoilt bytes of its own base, in the middle of a drive.

The base is its firmware's twin. What is asked: nothing is raised; no echo is newer than what was
sent; and after the noise the base is heard again within two seconds.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, cast

from tools.attack.unsound import Unsound

if TYPE_CHECKING:
    from collections.abc import Sequence

KINDS = ("pons_mcu", "waveshare", "arduino", "turtlebot3")
TICK_S = 0.01
START_TICKS = 300
"""The slowest is left alone for 2.5 s."""
HEARD_TICKS = 200
INPUTS = 200
"""So many spoilt pieces are fed to one drive before it must be heard again, and another begins."""


@cache
def _robot(kind: str) -> Any:
    from pons.settings import CHECKOUT
    from wire import load_robot

    name = {"waveshare": "waveshare_ugv_rover", "turtlebot3": "turtlebot3_burger"}.get(kind, kind)
    return load_robot(CHECKOUT / "robots" / f"{name}.toml")


class DrivenLine:
    """Join a protocol and its base's firmware by two pieces of memory."""

    def __init__(self, kind: str) -> None:
        """Let the base start, and drive off."""
        from bridge.drive.serial_drive import SERIAL_PROTOCOLS
        from sim.twin import FIRMWARES
        from tests.wire.examples import EXAMPLES
        from wire import DriveState

        self._protocol = SERIAL_PROTOCOLS[kind](_robot(kind), "b1")
        self._firmware = FIRMWARES[kind](_robot(kind))
        self._body = cast("DriveState", EXAMPLES[DriveState])
        self._seq, self._now_s = 0, 100.0
        self.said: list[bytes] = []
        self._firmware.hear(self._protocol.begin(), self._now_s)
        for _ in range(START_TICKS):
            self.turn()

    def turn(self) -> int:
        """Pass a tick with a whole line; return how many states came of it."""
        data = self._say()
        self.said += [data] if data else []
        return self._hear(data)

    def spoil(self, data: bytes) -> int:
        """Pass a tick in which these bytes come in place of what the base said."""
        self._say()
        return self._hear(data)

    def recover(self) -> None:
        """Let the noise end.

        Raises:
            Unsound: the base is not heard again.
        """
        self._hear(b"\n")
        if not any(self.turn() for _ in range(HEARD_TICKS)):
            raise Unsound("deaf after noise")

    def _say(self) -> bytes:
        from wire import DriveCommand

        self._seq, self._now_s = self._seq + 1, self._now_s + TICK_S
        command = DriveCommand(
            boot="b1", seq=self._seq, left_radps=2.0, right_radps=-1.0, enable=True
        )
        self._firmware.hear(self._protocol.encode(command), self._now_s)
        self._firmware.motors(self._now_s)
        return self._firmware.say(self._body, self._now_s)

    def _hear(self, data: bytes) -> int:
        states = self._protocol.decode(data, self._now_s)
        for state in states:
            if state.echo_boot == "b1" and state.echo_seq > self._seq:
                raise Unsound(f"an echo of {state.echo_seq}, sent {self._seq}")
        return len(states)


class SpoiltLines:
    """Feed one kind's protocol with pieces, and let it recover now and then."""

    def __init__(self, kind: str) -> None:
        self._kind = kind
        self._line: DrivenLine | None = None
        self._left = 0

    def read(self, data: bytes) -> object:
        """Feed one piece; None where no state came of it.

        Raises:
            Unsound: what :class:`DrivenLine` says.
        """
        if self._line is None:
            self._line, self._left = DrivenLine(self._kind), INPUTS
        taken = self._line.spoil(data)
        self._left -= 1
        if self._left == 0:
            line, self._line = self._line, None
            line.recover()
        return taken or None


def lines_of(kind: str) -> Sequence[bytes]:
    """Return what a base of a kind says in three seconds, piece by piece."""
    return DrivenLine(kind).said[-100:]
