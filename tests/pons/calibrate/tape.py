"""Keep what a hand heard and said in one drive, so that it can be heard again without driving.

What distances are compared with does not steer the robot: the same drive may be read by truth, by
lidar and by a person. A hand that says another thing than the first did is an error here.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, cast

from pons.calibrate.session import CalibrationRig
from wire import Record, Velocity
from wire.keys import Key
from wire.session import Session


@dataclass
class Tape:
    """Hold one drive, from the first moment on."""

    times_s: list[float] = field(default_factory=list)
    heard: dict[str, list[Any]] = field(default_factory=dict)
    """By key: what each look brought, in order."""
    said: list[Velocity] = field(default_factory=list)

    def rig(
        self,
        operator: Session,
        judge: Session,
        clock: Callable[[], float],
        wait: Callable[[], None],
    ) -> CalibrationRig:
        """Return a rig that drives while all is kept."""

        def waits() -> None:
            wait()
            self.times_s.append(clock())

        self.times_s.append(clock())
        kept = [cast("Session", _Keeping(self, port)) for port in (operator, judge)]
        return CalibrationRig(kept[0], kept[1], clock, waits)

    def again(self) -> CalibrationRig:
        """Return a rig that meets the same once more."""
        port = cast("Session", _Playing(self))
        at = iter(self.times_s)
        now_s = [next(at)]

        def wait() -> None:
            now_s[0] = next(at)

        return CalibrationRig(port, port, lambda: now_s[0], wait)


@dataclass(frozen=True)
class _Keeping:
    """Be a session whose messages are kept."""

    tape: Tape
    port: Session

    def publisher(self, key: Key[Velocity]) -> _Mouth:
        return _Mouth(self.tape, self.port.publisher(key).put)

    def subscriber(self, key: Key[Record]) -> _Ear:
        ear = self.port.subscriber(key)
        kept = self.tape.heard.setdefault(key.path, [])
        return _Ear(_keeping(ear.newest, kept), _keeping(ear.drain, kept))


@dataclass(frozen=True)
class _Mouth:
    tape: Tape
    send: Callable[[Velocity], None]

    def put(self, message: Velocity) -> None:
        self.tape.said.append(message)
        self.send(message)


@dataclass(frozen=True)
class _Ear:
    newest: Callable[[], Any]
    drain: Callable[[], Any]


def _keeping(look: Callable[[], Any], kept: list[Any]) -> Callable[[], Any]:
    def looks() -> Any:
        kept.append(look())
        return kept[-1]

    return looks


class _Playing:
    """Be a session that says what was heard."""

    def __init__(self, tape: Tape) -> None:
        self._tape = tape
        self._said = iter(tape.said)

    def publisher(self, _: Key[Velocity]) -> _Playing:
        return self

    def put(self, message: Velocity) -> None:
        """Compare what is said now with what was said.

        Raises:
            ValueError: it differs: what was heard is no answer to it.
        """
        if message != next(self._said):
            raise ValueError(f"another hand would have been needed: {message}")

    def subscriber(self, key: Key[Record]) -> _Ear:
        look = iter(self._tape.heard[key.path]).__next__
        return _Ear(look, look)
