"""Take goals that are given as steps, and judge each before anything moves.

The steps are the goal's whole plan: no brain is asked, and no sentence is read. They pass the same
check as a brain's. A point of the map is such a step, and one that can't be stood on, or can't be
reached, refuses the goal with its reason. ``RobotSurvey`` finds that out with the robot: its pose,
and a way to the point.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from maps.grid import FREE, UNKNOWN
from planner.bridge_client import Aged
from planner.bridge_client.bridge_status import standing
from planner.language.place_lists import rejection_outcome
from planner.language.plan_words import tell_steps
from planner.mission.agents import is_agents
from planner.mission.events import Planned, Submitted
from planner.mission.outcomes import plain_outcome
from planner.mission.reception import receive_points
from planner.mission.tasks import RouteService, Think
from planner.navigation import RouteFailure, RouteRequest
from planner.plan import GIVEN, Code, GoToPose, Language, Outcome, Step, StepPlan, check_plan
from planner.site import KnownPlaces, PlaceRefusal, Site
from planner.site.polygon import contains
from planner.skills.drive_to_place import SEES_FROM_M
from wire import OpRequest, Pose2, Status

if TYPE_CHECKING:
    from planner.mission.clocks import Clocks
    from planner.mission.effects import AskBrain
    from planner.mission.loop import Loop
    from planner.mission.request_keys import Repeats


_BY_THE_WAY = {
    "place_outside_map": Code.POINT_OUTSIDE_MAP,
    "place_in_obstacle": Code.POINT_IN_OBSTACLE,
    "place_unreachable": Code.POINT_UNREACHABLE,
}
"""What a search for the way says of a point; anything else says that none was made."""


class StepGoals:
    """Give goals by points of the map and by other steps, and plan them."""

    def __init__(
        self,
        loop: Loop,
        places: KnownPlaces,
        survey: RobotSurvey,
        repeats: Repeats,
        clocks: Clocks,
        otherwise: Think,
    ) -> None:
        """Take where goals go, what knows the map, and how all other goals are understood."""
        self._loop, self._places, self._survey = loop, places, survey
        self._repeats, self._clocks, self._otherwise = repeats, clocks, otherwise

    async def give(
        self,
        steps: tuple[Step, ...],
        *,
        language: Language = Language.EN,
        confirm: bool = False,
        replace: bool = False,
        idempotency_key: str | None = None,
        act: OpRequest | None = None,
        source: str = "api",
        by: str = "api",
    ) -> str:
        """Take the goal in and return its id, or that of the goal which this request made before.

        Raises:
            QueueFull, IdempotencyConflict, ReservedKey, JournalDown: as of a sentence.
            PersonMissing: an agent wants to end what runs.
        """
        await self._repeats.look_up(idempotency_key)
        goal_id = self._clocks.new_id()
        text = tell_steps(steps, self._places.vocabulary.name).of(language)
        given = Submitted(
            goal_id, text, language, confirm, replace, points=steps, source=source, by=by
        )
        heard = receive_points(self._loop.book, given, idempotency_key, self._repeats)
        if heard.refused is not None:
            raise heard.refused
        if heard.repeats is not None:
            return heard.repeats
        self._repeats.remember(heard.request)
        self._loop.keep_act(goal_id, None if is_agents(source) else act)
        self._loop.accepted.note(goal_id, self._clocks.monotonic())
        self._loop.event(given, heard.request)
        await self._repeats.ensure_written(self._loop, goal_id, heard.request)
        return goal_id

    async def think(self, ask: AskBrain) -> Planned:
        """Plan a goal that was given by steps; have any other understood."""
        mission = self._loop.book.missions.get(ask.id)
        if mission is None or not mission.points or mission.steps or mission.replies:
            return await self._otherwise(ask)
        plan, means = StepPlan(steps=mission.points), self._loop.book.means
        rejection = check_plan(plan, self._places.vocabulary, means.plannable | GIVEN, means.blind)
        if rejection is not None:
            return Planned(ask.id, None, rejection_outcome(rejection, self._places.vocabulary))
        points = tuple(step for step in mission.points if isinstance(step, GoToPose))
        refused = await self._find_refusal(points) if points else None
        return Planned(ask.id, plan if refused is None else None, refused)

    async def _find_refusal(self, points: tuple[GoToPose, ...]) -> Outcome | None:
        """Return why the first point that is not to be reached is not; None: all are."""
        site = self._places.site
        for point in points:
            if (code := judge_spot(site, point)) is not None:
                return _tell(code, point)
        at = points[0]
        try:
            here = self._survey.robot_pose(site.map_id, must_stand=False)
            for at in points:
                goal = Pose2(at.x_m, at.y_m, at.yaw_rad or 0.0)
                sees_from_m = SEES_FROM_M if at.look else 0.0
                await self._survey.check_way(here, goal, sees_from_m=sees_from_m)
                here = here if at.look else goal
        except PlaceRefusal as refused:
            code = _BY_THE_WAY.get(refused.code, Code.POINT_UNCHECKED)
            if at.look and code is Code.POINT_IN_OBSTACLE:
                code = Code.POINT_UNREACHABLE  # a wall may be looked at; nothing sees this one
            return _tell(code, at, refused)
        return None


def judge_spot(site: Site, point: GoToPose) -> Code | None:
    """Return why the robot can't stand at a point by map and fence; None: nothing is against it.

    Of a point that is only looked at, the map alone is asked.
    """
    x_m, y_m = point.x_m, point.y_m
    if point.map_id != site.map_id:
        return Code.POINT_OF_OTHER_MAP
    if not site.grid.contains(x_m, y_m):
        return Code.POINT_OUTSIDE_MAP
    if point.look:
        return None
    cell = site.grid.at(x_m, y_m)
    if cell == UNKNOWN:
        return Code.POINT_UNMAPPED
    if cell != FREE:
        return Code.POINT_IN_OBSTACLE
    if any(contains(outline, x_m, y_m) for outline in site.fence.record.keep_outs):
        return Code.POINT_IN_KEEP_OUT
    return None if site.fence.allows(x_m, y_m) else Code.POINT_OUTSIDE_FENCE


def _tell(code: Code, point: GoToPose, refused: PlaceRefusal | None = None) -> Outcome:
    facts = {"why": refused.why} if code is Code.POINT_UNCHECKED and refused is not None else {}
    named = "" if code is Code.POINT_OF_OTHER_MAP else f"({point.x_m:.2f}, {point.y_m:.2f})"
    point_named = {"point": named} if named else {}
    return plain_outcome(code, **point_named, **facts)


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
