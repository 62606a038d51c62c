"""Name the parties of a trial: base, clock and person, and the refusal that ends it.

The engine (:mod:`pons.robot.wheel_trial`, :mod:`pons.robot.lidar_trial`) speaks to these alone; a
terminal and a page are two persons to it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Protocol

if TYPE_CHECKING:
    from wire import DecodeFailure, DriveCommand, DriveState

Side = Literal["left", "right"]


class TrialRefusal(Exception):
    """The trial found what must be mended first. The code is stable; ``detail`` says what came."""

    def __init__(self, code: str, detail: str = "") -> None:
        super().__init__(f"{code}: {detail}")
        self.code, self.detail = code, detail


class TrialBase(Protocol):
    """Be a base as the bridge drives it."""

    def read(self) -> tuple[DriveState | DecodeFailure, ...]:
        """Return the states since the last call, oldest first."""

    def write(self, command: DriveCommand | None) -> None:
        """Send one command."""

    def ask(self) -> None:
        """Ask for a state, where the base speaks only when asked; no dead-man is fed by it."""

    def halt(self) -> None:
        """Zero both wheels and take the torque away. Never raises."""


class TrialPace(Protocol):
    """Give the time, and let it pass."""

    def now_s(self) -> float:
        """Return the time [s]."""

    def wait(self) -> None:
        """Wait for the next tick of 10 ms."""


class TrialPerson(Protocol):
    """Be the person beside the robot. Nobody waits for an answer: the base must be heard on."""

    def ask(self, code: str) -> None:
        """Ask for something to be done."""

    def has_answered(self) -> bool:
        """Tell whether it is done."""

    def tell(self, step: str, seen: str = "") -> None:
        """Tell that a step begins, and what the one before it saw."""

    def require_watch(self) -> None:
        """Go on only while the person watches and has not stopped.

        Raises:
            TrialRefusal: ``trial_stopped`` or ``trial_unwatched``.
        """


def opposite_side(side: Side) -> Side:
    """Return the other wheel's side."""
    return "right" if side == "left" else "left"
