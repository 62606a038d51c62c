"""Keep what belongs to placing a robot anew: questions to the search, a person's word, a place.

Data alone; the localizer decides with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from wire import Pose2, PoseHint, between, compose

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SearchRequest:
    """Ask the search process where a scan was taken."""

    number: int
    points_m: Floats
    around: Pose2 | None = None
    """A pose that a person named; None searches the whole map."""
    radius_m: float = 0.0
    any_heading: bool = False
    outline: tuple[tuple[float, float], ...] = ()

    @classmethod
    def of_hint(cls, number: int, points_m: Floats, hint: PoseHint | None) -> SearchRequest:
        """Return the question where a person says that the robot is, or about the whole map."""
        if hint is None:
            return cls(number, points_m)
        return cls(number, points_m, hint.pose, hint.radius_m, hint.any_heading, hint.outline)


@dataclass(frozen=True, slots=True)
class PlacedBase:
    """Hold where ``base`` was in ``map``, and in the trail's frame at the same instant."""

    in_map: Pose2
    carried: Pose2

    def at(self, carried: Pose2) -> Pose2:
        """Return where ``base`` is in ``map`` when odometry has carried it on."""
        return compose(self.in_map, between(self.carried, carried))


@dataclass(frozen=True, slots=True)
class OpenSearch:
    """Hold a question that is not answered yet."""

    request: SearchRequest
    carried: Pose2
    """``base`` in the trail's frame when the scan was taken."""
    asked_s: float
    hint: PoseHint | None
