"""Own what a robot can do by what it has: eyes or none, and somebody who knows what they see.

Which steps may be planned follows from it, and which lack is told where one may not.
"""

from __future__ import annotations

from planner.plan.base import Frozen
from planner.plan.outcome_codes import Code
from planner.plan.steps import NEEDS_CAMERA, RUNNABLE

NEEDS_DETECTOR = frozenset({"find", "count", "follow", "go_to_object"})
POINTS = frozenset({"go_to_point"})
"""Runnable with any camera, but of use only to who sees the picture that it points at."""


class Means(Frozen):
    """Say what a robot has beyond wheels and a voice."""

    camera: bool = False
    detector: bool = False  # recognises what the camera shows
    model: bool = False  # a vision model may be asked about a picture

    @property
    def runnable(self) -> frozenset[str]:
        """Return the kinds of steps that this robot can do."""
        if not self.camera:
            return RUNNABLE
        look = {"look"} if self.detector or self.model else set()
        return RUNNABLE | POINTS | look | (NEEDS_DETECTOR if self.detector else frozenset())

    @property
    def offered(self) -> frozenset[str]:
        """Return the kinds that a brain may plan with: it sees no picture to point at."""
        return self.runnable - POINTS

    @property
    def blind(self) -> Code:
        """Return what is said of a step that needs eyes and can't be done."""
        return Code.NO_DETECTOR if self.camera else Code.NO_CAMERA

    def lacks(self, kind: str) -> Code | None:
        """Return what is missing for a kind of step, or None where nothing is."""
        if kind in self.runnable:
            return None
        return self.blind if kind in NEEDS_CAMERA else Code.NO_CAPABILITY


BARE = Means()
"""A robot that only drives and talks."""
