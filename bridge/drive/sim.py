"""Drive the simulated robot over its two keys of the wire.

A command goes out as the core made it, the motors' dead zone fed forward there already.
"""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING

from wire import DecodeFailure, DriveCommand, DriveState, decode
from wire.keys import DRIVE_COMMAND, DRIVE_STATE

if TYPE_CHECKING:
    from bridge.drive.base import Braking
    from wire import Imu
    from wire.session import Session

_PARSED = 4
"""More than four ticks of readings at once are a stall's; the newest say all that counts."""
_HALT_SENDS = 5
_HALT_GAP_S = 0.01
"""A command sent once may be dropped on its way; five over 40 ms are not, or the robot is deaf and
its own dead-man acts."""


class SimDrive:
    """Speak to the simulator's drive; the same keys a remote base would use."""

    kind = "sim"
    virtual = True
    braking: Braking = "brake"

    def __init__(self, session: Session, boot: str) -> None:
        self._commands = session.publisher(DRIVE_COMMAND)
        self._states = session.subscriber(DRIVE_STATE)
        self._boot = boot
        self._seq = 0

    def read(self) -> tuple[DriveState | DecodeFailure, ...]:
        payloads = self._states.drain_bytes()
        return tuple([decode(DRIVE_STATE, payload) for payload in payloads[-_PARSED:]])

    def take_imu(self) -> Imu | None:
        return None  # it comes by a key of its own

    def write(self, command: DriveCommand | None) -> None:
        if command is None:
            return
        self._seq = command.seq
        self._commands.put(command)

    def halt(self) -> None:
        for _ in range(_HALT_SENDS):
            self._seq += 1
            self._send_zero()
            time.sleep(_HALT_GAP_S)

    def _send_zero(self) -> None:
        try:
            self._commands.put(
                DriveCommand(
                    boot=self._boot, seq=self._seq, left_radps=0.0, right_radps=0.0, enable=False
                )
            )
        except Exception as error:  # noqa: BLE001  # the last resort must not fail upwards
            print(f"halt_not_sent: {error!r}", file=sys.stderr, flush=True)  # noqa: T201
