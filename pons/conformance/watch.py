"""Watch a bridge as the wire's judge and keep the record. Owns one session and one thread."""

from __future__ import annotations

import threading
import time
from contextlib import ExitStack
from dataclasses import replace
from typing import TYPE_CHECKING, Self, TypeVar

from pons.conformance.record import Command, DriveRecord, Truth, WheelSample, Word
from wire import (
    DecodeFailure,
    DriveCommand,
    DriveState,
    Mode,
    SimTruth,
    Status,
    decode,
)
from wire.base import Record as Base
from wire.keys import DRIVE_COMMAND, DRIVE_STATE, SIM_CONTROL, SIM_TRUTH, STATUS, Party
from wire.session import open_session

if TYPE_CHECKING:
    from pathlib import Path
    from types import TracebackType

    from wire import Pose2
    from wire.keys import Key

M = TypeVar("M", bound=Base)

POLL_S = 0.003
RING = 1024
"""A judge that shares the machine may be held up; nothing may be lost meanwhile."""
MOVES = frozenset({Mode.ACTIVE, Mode.TELEOP})


def _parse_all(payloads: list[bytes], key: Key[M]) -> list[M | DecodeFailure]:
    """Parse everything: a judge may not skip what the bridge would."""
    return [decode(key, payload) for payload in payloads]


class BridgeWatch:
    """Hear status, commands, wheels and truth until closed."""

    def __init__(self, home: Path, robot_id: str) -> None:
        self.record = DriveRecord()
        self._home, self._robot_id = home, robot_id
        self._status: Status | None = None
        self._ending = threading.Event()
        self._stack = ExitStack()

    def __enter__(self) -> Self:
        with ExitStack() as stack:
            session = stack.enter_context(open_session(Party.JUDGE, self._robot_id, self._home))
            self._words = session.subscriber(replace(STATUS, ring=RING))
            self._commands = session.subscriber(replace(DRIVE_COMMAND, ring=RING))
            self._wheels = session.subscriber(replace(DRIVE_STATE, ring=RING))
            self._truths = session.subscriber(replace(SIM_TRUTH, ring=RING))
            self._controls = session.publisher(SIM_CONTROL)
            thread = threading.Thread(target=self._run, daemon=True, name="watch")
            thread.start()
            stack.callback(thread.join)
            stack.callback(self._ending.set)
            self._stack = stack.pop_all()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stack.close()

    @property
    def status(self) -> Status | None:
        """Return the bridge's newest word."""
        return self._status

    def place(self, pose: Pose2, wish_id: str) -> None:
        """Put the simulated robot somewhere."""
        message = SIM_CONTROL.message(id=wish_id, place_robot=pose)
        self._controls.put(message)

    def _run(self) -> None:
        while not self._ending.wait(POLL_S):
            now_s = time.monotonic()
            self._hear_words(now_s)  # first: a command of the same tick has then come too
            self._hear_commands(now_s)
            self._hear_robot(now_s)
            self.record.learn()

    def _hear_words(self, now_s: float) -> None:
        for raw in _parse_all(self._words.drain_bytes(), STATUS):
            if isinstance(raw, Status):
                self._status = raw
                moves = raw.mode in MOVES
                ticks = raw.ticks
                self.record.words.append(
                    Word(now_s, raw.at_s, raw.boot, ticks.ticks, ticks.missed, raw.mode, moves)
                )

    def _hear_commands(self, now_s: float) -> None:
        for raw in _parse_all(self._commands.drain_bytes(), DRIVE_COMMAND):
            if isinstance(raw, DriveCommand):
                command = Command(now_s, raw.seq, raw.left_radps, raw.right_radps, raw.enable)
                self.record.commands.append(command)
            else:
                self.record.unreadable.append((now_s, raw.detail))

    def _hear_robot(self, now_s: float) -> None:
        for state in _parse_all(self._wheels.drain_bytes(), DRIVE_STATE):
            if isinstance(state, DriveState):
                turned = (state.left_rad, state.right_rad)
                self.record.wheels.append(
                    WheelSample(now_s, state.stamp_s, state.seq, *turned, state.enabled)
                )
        for truth in _parse_all(self._truths.drain_bytes(), SIM_TRUTH):
            if isinstance(truth, SimTruth):
                twist = truth.twist
                self.record.truths.append(
                    Truth(now_s, twist.v_mps, twist.w_radps, truth.contacts_total)
                )
