"""Repeat, delay or drop pictures when the camera is broken. Pure; told the time."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from wire import SimFault

if TYPE_CHECKING:
    from collections.abc import Collection

DELAY_S = 1.0


@dataclass(frozen=True, slots=True)
class PicturePair:
    """Hold both packed pictures of one instant."""

    stamp_s: float
    color: bytes
    depth: bytes


class Shutter:
    """Pass one camera's pictures, one call a period."""

    def __init__(self) -> None:
        self._stuck: PicturePair | None = None
        self._late: deque[tuple[float, PicturePair]] = deque()

    def through(
        self, shot: PicturePair, now_s: float, faults: Collection[SimFault]
    ) -> PicturePair | None:
        """Take both pictures; return those that leave the camera now, if any."""
        if SimFault.CAMERA_OFF in faults:
            return None
        if SimFault.CAMERA_STUCK in faults:
            self._stuck = self._stuck or shot
            shot = replace(self._stuck, stamp_s=shot.stamp_s)
        else:
            self._stuck = None
        if SimFault.CAMERA_DELAYED in faults:
            self._late.append((now_s + DELAY_S, shot))
            ready = self._late[0][0] <= now_s
            return self._late.popleft()[1] if ready else None
        self._late.clear()  # mended: what was held back is older than what comes
        return shot
