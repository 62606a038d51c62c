"""Say what a drive must be able to do: three methods and three facts about its metal."""

from __future__ import annotations

from typing import Literal, Protocol

from wire import DriveCommand, DriveState, Rejected

Braking = Literal["brake", "coast"]
"""What the wheels do without torque: short or brake, or roll on. Decides what CUT0 is worth."""


class Drive(Protocol):
    """Be the hands of the bridge. No method blocks."""

    kind: str
    virtual: bool
    """No metal moves: refused real-time rights are a banner, and the published key counts."""
    braking: Braking

    def read(self) -> tuple[DriveState | Rejected, ...]:
        """Return what arrived since the last call, oldest first, at most the 4 newest."""

    def write(self, command: DriveCommand | None) -> None:
        """Send one command; None sends nothing, which SELFTEST needs to see the time-out work."""

    def halt(self) -> None:
        """Zero both wheels and take the torque away. Never raises: all else may have failed."""
