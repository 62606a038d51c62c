"""Look with the robot whether a point can become a place: its pose, and a way to the point."""

from __future__ import annotations

from typing import Protocol

from planner.bridge_client import Aged
from planner.mission.bridge_status import standing
from planner.mission.tasks import RouteService
from planner.navigation import RouteFailure, RouteRequest
from planner.site import PlaceRefusal
from wire import Pose2, Status

MAX_STATUS_AGE_S = 0.5
MOST_MOVED_M = 0.05
"""A route that ends farther from the point than this says that nobody can stand on it."""
_CODES = {
    "no_route": "place_unreachable",
    "start_blocked": "place_unreachable",
    "goal_blocked": "place_in_obstacle",
    "goal_occupied": "place_in_obstacle",
    "goal_outside_map": "place_outside_map",
}


class StatusSource(Protocol):
    """Hold the newest status and its age, as the link does."""

    @property
    def status(self) -> Aged[Status] | None: ...


class RobotSurvey:
    """Answer by the bridge's newest status and the search for routes (``PlaceSurvey``)."""

    def __init__(self, link: StatusSource, router: RouteService) -> None:
        """Take the source of statuses, and the finder of ways."""
        self._link, self._router = link, router

    def robot_pose(self, map_id: str, *, must_stand: bool) -> Pose2:
        """Return the robot in ``map``, as a status says that is no older than half a second.

        Raises:
            PlaceRefusal: ``pose_unknown``, ``map_mismatch`` or ``robot_moving``.
        """
        aged = self._link.status
        status = aged.value if aged is not None and aged.age_s <= MAX_STATUS_AGE_S else None
        here = status.base_in_map if status is not None else None
        if status is None or here is None:
            raise PlaceRefusal("pose_unknown")
        if status.map_id != map_id:
            raise PlaceRefusal("map_mismatch", f"{status.map_id}, expected {map_id}")
        if must_stand and not standing(status):
            raise PlaceRefusal("robot_moving")
        return here

    async def check_way(self, start: Pose2, goal: Pose2, *, sees_from_m: float = 0.0) -> float:
        """Return the length [m] of the way to a point, which is not moved beside an obstacle.

        Args:
            start: where the way begins.
            goal: where it ends.
            sees_from_m: where not 0, it is to end where the point is seen, and no nearer to it.

        Raises:
            PlaceRefusal: ``place_unreachable``, ``place_in_obstacle``, ``place_outside_map`` or
                ``route_unavailable``.
        """
        try:
            sees = (goal.x_m, goal.y_m) if sees_from_m else None
            result = await self._router.route(
                RouteRequest(start, goal, sees=sees, sees_from_m=sees_from_m)
            )
        except RouteFailure as failure:
            code = _CODES.get(failure.code, "route_unavailable")
            raise PlaceRefusal(code, failure.code) from None
        if not (sees_from_m or result.moved_goal_m <= MOST_MOVED_M):
            detail = f"free floor is {result.moved_goal_m:.2f} m away"
            raise PlaceRefusal("place_in_obstacle", detail)
        return result.length_m
