"""Show a plan before it moves: the legs that its steps would drive, by the route search of drives.

Nothing here moves, journals or asks a model. A step's legs are those of its own skill
(``planner.skills``), found on the costmap of now and from where the step before would end;
what hangs on a picture, a person or memory is told as open, and no way is made up for it.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

from planner.brain.interface import ThinkRequest
from planner.brain.offline_brain import OfflineBrain
from planner.language.catalogue import message, say
from planner.language.formatting import definite
from planner.language.sentence import parse
from planner.mission.leg_routes import SHORT_M
from planner.navigation import RouteFailure, RouteRequest
from planner.navigation.drive_time import leg_s, spin_s
from planner.plan import (
    JUDGED,
    RUNNABLE,
    Bilingual,
    Code,
    StepRecord,
    StepRole,
    StepState,
    children_of,
    plan_record,
)
from planner.plan.base import Frozen
from planner.skill_files.calls import SkillFailure, SkillScene, unfold
from planner.skills import DriveLeg, Fail, Scene, Way, act_of, begin_state, no_room
from wire import Pose2
from wire.geometry import wrap

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from planner.mission.state import MissionState
    from planner.mission.tasks import RouteService
    from planner.navigation import RouteResult, RouteSurvey
    from planner.plan import Language, PlanRecord
    from planner.site import KnownPlaces
    from wire import RobotDescription

REHEARSED = frozenset(
    {"go_to", "go_to_pose", "return_home", "come_back", "patrol", "stand_at", "turn", "move"}
)
"""Kinds of steps whose legs are known before they are driven."""
STANDS = frozenset({"wait", "say"})
ELSE = frozenset({StepRole.OTHERWISE, StepRole.ON_FAILURE})
MOST_LEGS = 60
_DONE = frozenset({StepState.SUCCEEDED, StepState.SKIPPED, StepState.FAILED})


class RehearsalError(Exception):
    """There is nothing to show; ``code`` is stable."""

    def __init__(self, code: str, detail: str, said: Bilingual | None = None) -> None:
        super().__init__(f"{code}: {detail}")
        self.code, self.detail, self.said = code, detail, said


class RehearsedStep(Frozen):
    """Show what one step of the plan would do."""

    index: int
    """In the plan's row of steps."""
    kind: str
    place: str | None = None
    name: Bilingual | None = None
    does: Literal["drives", "stands", "open", "shut"]
    """``open``: what it sees, hears or remembers decides. ``shut``: there is no way."""
    branch: bool = False
    """It may not come to this."""
    instead: bool = False
    """It comes only where the rest does not: its way is not in the plan's sums."""
    points: tuple[tuple[float, float], ...] = ()
    """Its way in ``map`` [m]."""
    length_m: float = 0.0
    seconds: float = 0.0
    narrowest_m: float | None = None
    """From thing to thing across the way; None: roomy everywhere."""
    narrowest_at: tuple[float, float] | None = None
    suspect_m: float = 0.0
    """Of the way leads through what may still stand there."""
    hoped: bool = False
    """The way is open only if something that was seen there has gone."""
    code: str | None = None
    message: Bilingual | None = None


class Rehearsal(Frozen):
    """Show a whole plan from where the robot stands."""

    map_id: str
    begins: Pose2
    steps: tuple[RehearsedStep, ...]
    length_m: float
    seconds: float
    """Of what is known; an open step takes longer."""
    narrowest_m: float | None
    is_whole: bool
    """All its steps are known, and all ways are open."""


@dataclass(slots=True)
class _PlanCourse:
    """Walk along a plan: where the robot would be, and what was found."""

    rows: Sequence[StepRecord]
    begins: Pose2
    found: list[RehearsedStep] = field(default_factory=list)
    legs: int = 0


@dataclass(slots=True)
class _Ways:
    """Add up the legs of one step."""

    points: list[tuple[float, float]] = field(default_factory=list)
    surveys: list[RouteSurvey] = field(default_factory=list)
    length_m: float = 0.0
    seconds: float = 0.0

    def add(self, way: RouteResult, took_s: float) -> None:
        """Add a way that takes so long."""
        self.points += ((round(point.x_m, 3), round(point.y_m, 3)) for point in way.points)
        self.length_m += way.length_m
        self.seconds += took_s
        if way.survey is not None:
            self.surveys.append(way.survey)

    def figures(self) -> dict[str, Any]:
        """Return what they come to, as the fields of a rehearsed step."""
        narrow = [(one.narrowest_m, one.narrowest_at) for one in self.surveys if one.narrowest_m]
        narrowest_m, at = min(narrow, default=(None, None))
        return {
            "points": tuple(self.points),
            "length_m": round(self.length_m, 2),
            "seconds": round(self.seconds, 1),
            "narrowest_m": None if narrowest_m is None else round(narrowest_m, 2),
            "narrowest_at": at,
            "suspect_m": round(sum(one.suspect_m for one in self.surveys), 2),
            "hoped": any(one.hoped for one in self.surveys),
        }


class Rehearser:
    """Rehearse plans on one robot's site. One at a time: drives come first at the route search."""

    def __init__(
        self,
        site: KnownPlaces,
        robot: RobotDescription,
        router: RouteService,
        book: Callable[[], MissionState],
        obstacles: Callable[[], tuple[tuple[float, float], ...]] = lambda: (),
    ) -> None:
        """Take what a drive has.

        Args:
            site: the places.
            robot: its description.
            router: finds ways, as it does for drives.
            book: tells where everything stands.
            obstacles: the lidar's points now in ``map`` [m]; a straight way minds them.
        """
        self._site, self._robot, self._router, self._book = site, robot, router, book
        self._obstacles = obstacles
        self._turn = asyncio.Lock()

    async def of_text(self, text: str, language: Language | None = None) -> Rehearsal:
        """Rehearse what the built-in reader makes of a sentence. No model is asked, no goal made.

        Raises:
            RehearsalError: it is no plan that moves, or the robot's place is not known.
        """
        return await self.of_plan(await self.plan_of(text, language))

    async def plan_of(self, text: str, language: Language | None = None) -> PlanRecord:
        """Return what the built-in reader makes of a sentence; raises as :meth:`of_text` does."""
        pose = self._pose()
        request = ThinkRequest(
            text=text,
            vocabulary=self._site.vocabulary,
            language=language,
            room=self._site.facts.room_at(pose.x_m, pose.y_m),
            runnable=RUNNABLE | self._site.vocabulary.calls,
        )
        scene = SkillScene(request.vocabulary, language or parse(text).language, request.room)
        try:
            plan = (await unfold((await OfflineBrain().think(request)).plan, scene)).plan
        except SkillFailure as failed:
            raise RehearsalError("rehearsal_no_plan", str(failed), failed.outcome.message) from None
        return plan_record(plan)

    async def of_plan(self, plan: PlanRecord | None) -> Rehearsal:
        """Rehearse a plan from here and now: of one under way, what is left of it.

        Raises:
            RehearsalError: it has no steps, or the robot's place is not known.
        """
        if plan is None or not plan.steps:
            said = plan.text if plan is not None else None
            raise RehearsalError("rehearsal_no_plan", "there is no plan to show", said)
        walk = _PlanCourse(plan.steps, self._pose())
        async with self._turn:
            await self._rehearse_all(walk)
        return self._sum_up(walk)

    def _pose(self) -> Pose2:
        status = self._book().status
        if status is None or status.base_in_map is None:
            raise RehearsalError("rehearsal_without_pose", "the robot does not know where it is")
        return status.base_in_map

    async def _rehearse_all(self, walk: _PlanCourse) -> None:
        pose = walk.begins
        for index, row in enumerate(walk.rows):
            if row.depth == 0:
                pose = await self._step(walk, index, pose, branch=False, instead=False)

    async def _step(
        self, walk: _PlanCourse, index: int, pose: Pose2, *, branch: bool, instead: bool
    ) -> Pose2:
        """Rehearse a step with all that it holds; return where the robot would be then."""
        row = walk.rows[index]
        held = children_of(walk.rows, index)
        if not held:
            return await self._leaf(walk, index, pose, branch=branch, instead=instead)
        end, other = pose, pose
        for child in held:
            role = walk.rows[child].role
            if role in JUDGED:
                await self._leaf(walk, child, end, branch=branch, instead=instead)
            elif role in ELSE:
                other = await self._step(walk, child, other, branch=True, instead=True)
            else:
                may = branch or row.kind == "if"
                end = await self._step(walk, child, end, branch=may, instead=instead)
        return end

    async def _leaf(
        self, walk: _PlanCourse, index: int, pose: Pose2, *, branch: bool, instead: bool
    ) -> Pose2:
        row = walk.rows[index]
        if row.state in _DONE:
            return pose
        target = self._site.facts.targets.get(row.place or "")
        shown = RehearsedStep(
            index=index, kind=row.kind, place=row.place, does="open", branch=branch,
            instead=instead, name=None if target is None else target.name,
        )  # fmt: skip
        if row.kind in STANDS:
            update: dict[str, Any] = {"does": "stands", "seconds": row.seconds or 0.0}
        elif row.kind in REHEARSED and not row.look:
            update, pose = await self._legs(walk, row, pose)
        else:
            update = {}
        walk.found.append(shown.model_copy(update=update))
        return pose

    async def _legs(
        self, walk: _PlanCourse, row: StepRecord, pose: Pose2
    ) -> tuple[dict[str, Any], Pose2]:
        """Return what the step's own legs come to, and where they end."""
        ways, done = _Ways(), 0.0
        scene = self._scene(row, walk.begins, pose)
        part = 0
        while isinstance(act := act_of(replace(scene, pose=pose, part=part, done=done)), DriveLeg):
            part, walk.legs = part + 1, walk.legs + 1
            if walk.legs > MOST_LEGS:
                raise RehearsalError("rehearsal_too_long", f"more than {MOST_LEGS} legs")
            try:
                end = await self._leg(ways, act, pose)
            except RouteFailure as failure:
                if act.otherwise is not None:
                    scene = scene.but(act.otherwise)
                    continue
                return _shut(self._no_way(act, failure)), pose
            if isinstance(end, Fail):
                return _shut(end), pose
            done += wrap(end.yaw_rad - pose.yaw_rad) if row.kind == "turn" else 0.0
            done = (row.distance_m or 0.0) if row.kind == "move" else done
            pose = end
            if act.then is not None:
                scene = scene.but(act.then)
        if isinstance(act, Fail):
            return _shut(act), pose
        return {"does": "drives", **ways.figures()}, pose

    async def _leg(self, ways: _Ways, act: DriveLeg, pose: Pose2) -> Pose2 | Fail:
        """Add one leg; return where it ends, or why it is not driven. Raises RouteFailure."""
        limits = self._robot.limits
        if act.way is Way.SPIN:
            ways.seconds += spin_s(wrap(act.goal.yaw_rad - pose.yaw_rad), limits)
            return Pose2(pose.x_m, pose.y_m, act.goal.yaw_rad)
        way = await self._route(act, pose)
        if act.way is Way.STRAIGHT and not way.moved_goal_m <= SHORT_M:
            return no_room(act.goal, pose, way.moved_goal_m)
        end_rad = act.goal.yaw_rad if act.heading else None
        took_s, heading = leg_s(way.points, pose.yaw_rad, end_rad, limits)
        ways.add(way, took_s)
        return Pose2(way.points[-1].x_m, way.points[-1].y_m, heading)

    def _no_way(self, act: DriveLeg, failure: RouteFailure) -> Fail:
        target = self._site.facts.targets.get(act.target or "")
        if target is None:
            return Fail(Code.NO_ROUTE, failure.code, say(f"route_failure.{failure.code}"))
        return Fail(
            Code.NO_ROUTE, failure.code, message(Code.NO_ROUTE, place=definite(target.name))
        )

    async def _route(self, act: DriveLeg, pose: Pose2) -> RouteResult:
        straight = act.way is Way.STRAIGHT
        seen = self._obstacles() if straight else ()
        request = RouteRequest(
            pose, act.goal, seen, straight=straight, sees=act.sees, sees_from_m=act.sees_from_m,
            survey=True,
        )  # fmt: skip
        return await self._router.route(request)

    def _scene(self, row: StepRecord, accepted: Pose2, began: Pose2) -> Scene[Any]:
        book = self._book()
        return Scene(
            step=row, facts=self._site.facts, state=begin_state(row.kind), pose=began,
            began=began, done=0.0, part=0, accepted=accepted, eyes=book.eyes, sight=book.sight,
        )  # fmt: skip

    def _sum_up(self, walk: _PlanCourse) -> Rehearsal:
        counted = [step for step in walk.found if not step.instead]
        narrow = [step.narrowest_m for step in counted if step.narrowest_m is not None]
        return Rehearsal(
            map_id=self._site.facts.map_id,
            begins=walk.begins,
            steps=tuple(walk.found),
            length_m=round(sum(step.length_m for step in counted), 2),
            seconds=round(sum(step.seconds for step in counted), 1),
            narrowest_m=min(narrow, default=None),
            is_whole=all(step.does not in ("open", "shut") for step in walk.found),
        )


def _shut(why: Fail) -> dict[str, Any]:
    """Return the fields of a step that would not be driven."""
    return {"does": "shut", "code": why.reason, "message": why.said or message(why.code)}
