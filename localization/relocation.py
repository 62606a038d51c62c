"""Place a robot anew: questions to the search, a person's word, and which of its answers count."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING

from localization.correlative_search import WINDOW_M, WINDOW_RAD
from localization.global_search import is_sure
from localization.quality import ENOUGH_SCORE
from localization.scan_fit import BETTER
from wire import Pose2, PoseHint, between, compose

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from localization.global_search import Candidate

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

    def is_near(self, pose: tuple[float, float, float], carried: Pose2) -> bool:
        """Return whether a pose in ``map`` lies in the window around where odometry has come to."""
        off = between(self.at(carried), Pose2(*pose))
        return hypot(off.x_m, off.y_m) <= WINDOW_M and abs(off.yaw_rad) <= WINDOW_RAD


@dataclass(frozen=True, slots=True)
class OpenSearch:
    """Hold a question that is not answered yet."""

    request: SearchRequest
    carried: Pose2
    """``base`` in the trail's frame when the scan was taken."""
    asked_s: float
    hint: PoseHint | None


def known_place(
    placed: PlacedBase, candidates: tuple[Candidate, ...], carried: Pose2
) -> Candidate | None:
    """Return the place where the robot was lost a few turns of its wheels ago, if it fits.

    No lead over places that look alike is asked for then, but none of them may fit better.
    """
    least = ENOUGH_SCORE
    for one in candidates:
        least = max(least, one.score - BETTER)
        if one.score >= least and placed.is_near(one.pose, carried):
            return one
    return None


def is_elsewhere(
    placed: PlacedBase, candidates: tuple[Candidate, ...], carried: Pose2, least: float
) -> bool:
    """Return whether the map surely shows a tracked robot at another place, as if carried there.

    Args:
        placed: where it was tracked to.
        candidates: of the whole map, best first.
        carried: ``base`` in the trail's frame when the search's scan was taken.
        least: score that the other place must exceed.
    """
    if not is_sure(candidates):
        return False
    return candidates[0].score > least and not placed.is_near(candidates[0].pose, carried)
