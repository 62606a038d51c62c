"""Hold an operator's wish for another fence until it is written, or why it could not be."""

from __future__ import annotations

from wire import Pose2
from wire.value import value


@value
class FenceAsked:
    """Remember a request whose proof held while nothing had torque."""

    id: str
    source: str
    text: str
    """All that is to be fence.json: what the proof binds."""
    robot_in_map: Pose2
    """Where the robot stood: a fence that leaves it outside is refused."""
    written: bool = False
    """It stands on the disk and counts from the bridge's next start."""


@value
class FenceArrived:
    """Give an operator's request for another fence, and whether its proof binds this very text."""

    id: str
    source: str
    nonce: str | None
    authentic: bool
    text: str
    """Empty where the proof does not fit: nobody looks at it."""


@value
class FenceDone:
    """Tell what became of a request: ``ok`` with both hashes, or why the fence can't be."""

    id: str
    code: str
    detail: str
