"""Remember where the robot was when pictures were taken that somebody still thinks about. Pure.

A model may think for a minute, and odometry's history is five seconds: a picture that is handed out
keeps the stance of its instant for as long as it may be asked about.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from planner.perception.interfaces import Picture
    from planner.perception.pose_buffer import Poses, Stance

KEPT = 128
SETTLED_S = 0.3
"""So long after a picture, odometry and localization of its instant have come, or never will."""

Shot = tuple[str, int]


class PendingPoses:
    """Hold the stances of pictures by boot and seq of their camera."""

    def __init__(self) -> None:
        self._stances: dict[Shot, Stance] = {}
        self._waiting: dict[Shot, float] = {}

    def note(self, picture: Picture) -> None:
        """Take note that somebody has this picture."""
        shot = _shot_of(picture)
        if shot not in self._stances:
            self._waiting[shot] = picture.taken_s

    def settle(self, poses: Poses, now_s: float) -> None:
        """Look up the stances that are known by now."""
        for shot, taken_s in tuple(self._waiting.items()):
            if now_s - taken_s >= SETTLED_S:
                del self._waiting[shot]
                self._keep(shot, poses.at(taken_s))

    def stance(self, picture: Picture, poses: Poses) -> Stance | None:
        """Return where the robot was when a picture was taken."""
        return self._stances.get(_shot_of(picture)) or poses.at(picture.taken_s)

    def _keep(self, shot: Shot, stance: Stance | None) -> None:
        if stance is not None:
            self._stances[shot] = stance
            if len(self._stances) > KEPT:
                del self._stances[next(iter(self._stances))]


def _shot_of(picture: Picture) -> Shot:
    return picture.color.header.boot_id, picture.color.header.seq
