"""Decide when a sight is worth telling a page anew. Pure but for the services it looks at."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from planner.api.interfaces import Services
    from planner.perception import LookSnapshot, Sight

SIGHT_S = 0.2
SAME_S = 0.5
"""So long a look that shows the same again is not told: boxes tremble, nothing has changed. A page
shows no boxes older than 1 s, so it must hear of them sooner."""
TREMBLE_PX = 4.0


class SightNews:
    """Remember the sight told last."""

    def __init__(self, services: Services) -> None:
        self._services = services
        self._told: Sight | None = None
        self._version = 0
        self._told_s = float("-inf")

    def due(self, now_s: float) -> bool:
        """Return whether to tell now; a yes counts as told."""
        eyes = self._services.eyes
        sight = eyes.sight
        if sight is self._told or not now_s - self._told_s >= SIGHT_S:
            return False
        told = self._told
        same = told is not None and eyes.version == self._version and _alike(told, sight)
        if same and not now_s - self._told_s >= SAME_S:
            return False
        self._told, self._version, self._told_s = sight, eyes.version, now_s
        return True


def _alike(before: Sight, now: Sight) -> bool:
    if before.blind != now.blind or (before.look is None) != (now.look is None):
        return False
    return before.look is None or now.look is None or _same_boxes(before.look, now.look)


def _same_boxes(before: LookSnapshot, now: LookSnapshot) -> bool:
    if before.here != now.here or len(before.detections) != len(now.detections):
        return False
    pairs = zip(before.detections, now.detections, strict=True)
    return all(
        a.label == b.label
        and a.color == b.color
        and all(abs(x - y) <= TREMBLE_PX for x, y in zip(a.box, b.box, strict=True))
        for a, b in pairs
    )
