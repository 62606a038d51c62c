"""Drive reducer, follower and owner together, one event at a time. No clock, no IO, no tasks.

The event loop's runner and the lockstep harness both use this: they feed events, send ``messages``
at once and carry out ``effects``. Whoever answers an effect does so with another event.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import atan2, copysign, hypot

from planner.bridge_client import Course, Identity, OwnerState, on_course, on_status
from planner.bridge_client.nav2_pilot import Nav2Pilot, pilot_of
from planner.bridge_client.ownership import MotionRequest
from planner.mission.activity import Driving, RouteDoubt
from planner.mission.effects import AskRoute, Effect
from planner.mission.events import Event, Routed, Seen
from planner.mission.reducer import advance, motion_request
from planner.mission.route_doubts import meeting_share, standing_doubt
from planner.mission.state import MissionState
from planner.navigation import FloorReport, Horizon, LegPath, RoutePoint, cut
from planner.skills import Way
from wire import Nav2State, Record, RobotDescription, Status

SPIN_MPS = 0.05
"""The slowest speed that the bridge takes for a speed: a spin's one point is never driven to."""


@dataclass(frozen=True, slots=True)
class Output:
    """Hold the messages to send now and the effects to carry out."""

    messages: tuple[Record, ...] = ()
    effects: tuple[Effect, ...] = ()


@dataclass(frozen=True, slots=True)
class Leg:
    """Show the leg that is driven: its goal, its number and its whole path."""

    mission: str
    leg: int
    points: tuple[RoutePoint, ...]
    doubt: RouteDoubt | None = None
    """What was seen to close its way, and why it bends or goes on."""


@dataclass(frozen=True, slots=True)
class WayAhead:
    """Show the points of a leg's way from the robot on, in ``map`` [m]."""

    mission: str
    leg: int
    points: tuple[tuple[float, float], ...]


@dataclass(slots=True)
class Following:
    """Remember the path of the leg that is streamed."""

    mission: str
    leg: int
    path: LegPath
    progress_m: float = 0.0
    slowed: tuple[float, LegPath] | None = None
    """The share of the planned speeds that was driven last, and the path at those speeds."""


class Engine:
    """Be one robot's missions in one thread.

    Where robot.toml has Nav2 drive the legs, no route is searched and no waypoint sent.
    """

    def __init__(
        self, book: MissionState, identity: Identity, robot: RobotDescription | None = None
    ) -> None:
        pilot = pilot_of(robot, identity.planner_id) if robot is not None else None
        self.book = book if pilot is None else replace(book, nav2=True)
        self._pilot = pilot
        self._identity = identity if pilot is None else replace(identity, kind="external")
        self._owner = OwnerState()
        self._path: LegPath | None = None
        self._following: Following | None = None
        self._wish = MotionRequest()
        self._used = 0

    @property
    def leg(self) -> Leg | None:
        """Return the leg that is wanted now, for people to see; None while standing is wanted."""
        following = self._path_of(motion_request(self.book))
        if following is None:
            return None
        doubt = standing_doubt(self.book)
        return Leg(following.mission, following.leg, following.path.points, doubt)

    def _path_of(self, wanted: MotionRequest) -> Following | None:
        """Return the path that is followed, where it is that of the leg that is wanted."""
        now = self._following
        ours = now is not None and (now.mission, now.leg) == (wanted.mission, wanted.leg)
        return now if ours else None

    def way_ahead(self, reach_m: float) -> WayAhead | None:
        """Return the path from the robot on; None while it is to stand."""
        following = self._following
        if following is None or self.leg is None or self._pilot is not None:
            return None  # where Nav2 leads it on is not known
        path, done_m = following.path, following.progress_m
        ahead = zip(path.points, path.along_m, strict=True)
        points = tuple((p.x_m, p.y_m) for p, m in ahead if done_m <= m <= done_m + reach_m)
        return WayAhead(following.mission, following.leg, points)

    def status(self, status: Status, now_s: float) -> Output:
        """Judge one bridge status and answer it as the owner."""
        if self._pilot is not None:
            return self._status_by_nav2(self._pilot, status, now_s)
        horizon, before = self._cut(status), self._following
        off_path, left_m = False, None
        if horizon is not None and before is not None:
            off_path, left_m = horizon.off_path, before.path.length_m - horizon.progress_m
        effects = self._advance(Seen(status, off_path, left_m), now_s)
        self._used = status.seq
        course = self._course(horizon if self._following is before else self._cut(status))
        self._owner, messages = on_status(
            self._identity, self._owner, status, course, self._used, now_s
        )
        return Output(messages, effects)

    def _status_by_nav2(self, pilot: Nav2Pilot, status: Status, now_s: float) -> Output:
        """Judge one status with what Nav2 makes of the leg in the place of the bridge's word."""
        wanted = motion_request(self.book)
        judged = status.model_copy(update={"leg": pilot.report(status, wanted, now_s)})
        effects = self._advance(Seen(judged, False, pilot.left_m(status, wanted)), now_s)
        self._used = status.seq
        self._wish = wanted = motion_request(self.book)
        self._owner, messages = on_status(
            self._identity, self._owner, status, Course(wanted.grant), self._used, now_s
        )
        said = pilot.speak(status, wanted, self._speed_share(), now_s)
        return Output((*messages, *said), effects)

    def nav2(self, state: Nav2State, now_s: float) -> Output:
        """Hear Nav2; what it asks of the wheels goes to the bridge at once, where it may."""
        pilot, status = self._pilot, self.book.status
        if pilot is None or status is None:
            return Output()
        pilot.hear(state, now_s)
        share = self._speed_share()
        return Output(pilot.drive(status, motion_request(self.book), share, now_s))

    def _speed_share(self) -> float:
        """Return the share of the planned speeds that is driven: less near another robot."""
        mission = self.book.running_goal
        share = mission.speed_share if mission is not None else 1.0
        return min(share, meeting_share(self.book))

    def event(self, event: Event, now_s: float) -> Output:
        """Take any other event; if it changes what is wanted, say so to the bridge at once."""
        if isinstance(event, Seen):
            return self.status(event.status, now_s)
        effects = self._advance(event, now_s)
        return Output(self._speak(now_s), effects)

    def take_route(
        self,
        ask: AskRoute,
        points: tuple[RoutePoint, ...] | None,
        failure: str | None,
        now_s: float,
        floor: FloorReport | None = None,
        faces: tuple[float, float] | None = None,
    ) -> Output:
        """Take the answer to ``AskRoute``: the route's points, or the code of why there is none.

        ``floor`` comes with the answer to one who explores, ``faces`` where the end is to face
        something: its heading is then taken from where the way really ends.
        """
        effects = self._take_route(ask, points, failure, now_s, floor, faces)
        return Output(self._speak(now_s), effects)

    def _advance(self, event: Event, now_s: float) -> tuple[Effect, ...]:
        """Reduce one event; a spin that is asked for needs no router and is answered here."""
        self.book, effects = advance(self.book, event, now_s)
        carried: list[Effect] = []
        for effect in effects:
            if isinstance(effect, AskRoute) and self._pilot is not None:
                carried.extend(self._aim(self._pilot, effect, now_s))
            elif isinstance(effect, AskRoute) and effect.way is Way.SPIN:
                start = effect.request.start
                here = (RoutePoint(start.x_m, start.y_m, SPIN_MPS),)
                carried.extend(self._take_route(effect, here, None, now_s))
            else:
                carried.append(effect)
        return tuple(carried)

    def _aim(self, pilot: Nav2Pilot, ask: AskRoute, now_s: float) -> tuple[Effect, ...]:
        """Answer a leg's question for its route: Nav2 finds one itself, to a pose and no other."""
        if ask.way in (Way.EXPLORE, Way.ASIDE):
            return self._take_route(ask, None, "no_route", now_s)
        ends = start, goal = ask.request.start, ask.request.goal
        points = tuple(RoutePoint(end.x_m, end.y_m, SPIN_MPS) for end in ends)
        before = self._following
        effects = self._take_route(ask, points, None, now_s)
        taken = self._following
        if taken is not None and taken is not before:
            heading = ask.heading or ask.way is not Way.ROUTE
            leg = (taken.mission, taken.leg)
            pilot.aim(leg, start, goal, now_s, heading=heading)
        return effects

    def _take_route(
        self,
        ask: AskRoute,
        points: tuple[RoutePoint, ...] | None,
        failure: str | None,
        now_s: float,
        floor: FloorReport | None = None,
        faces: tuple[float, float] | None = None,
    ) -> tuple[Effect, ...]:
        goal, short_m, end_m, length_m = ask.request.goal, 0.0, None, 0.0
        if points is not None:
            points = _slow_down(points, ask.speed_mps)
            yaw_rad = goal.yaw_rad if faces is None else _bearing(points[-1], faces)
            self._path = LegPath.of(points, yaw_rad if ask.heading else None)
            end_m, length_m = (points[-1].x_m, points[-1].y_m), self._path.length_m
            short_m = hypot(goal.x_m - points[-1].x_m, goal.y_m - points[-1].y_m)
        code = failure if points is None else None
        event = Routed(ask.id, ask.ticket, code, short_m, end_m, length_m, floor)
        effects = self._advance(event, now_s)
        self._adopt()
        self._path = None
        return effects

    def _speak(self, now_s: float) -> tuple[Record, ...]:
        status, wanted = self.book.status, motion_request(self.book)
        if status is None or wanted == self._wish:
            return ()
        if self._pilot is not None:
            self._wish, course = wanted, Course(wanted.grant)
            self._owner, messages = on_course(self._identity, self._owner, status, course, now_s)
            said = self._pilot.speak(status, wanted, self._speed_share(), now_s)
            return (*messages, *said)
        course = self._course(self._cut(status))
        self._owner, messages = on_course(self._identity, self._owner, status, course, now_s)
        return messages

    def _adopt(self) -> None:
        """Make the path that just came the one of the new leg, if the reducer took it."""
        activity, running = self.book.activity, self.book.running
        leg = activity.leg if isinstance(activity, Driving) else None
        if running is None or leg is None or self._path is None:
            return
        now = self._following
        if now is None or (now.mission, now.leg) != (running, leg):
            self._following = Following(running, leg, self._path)

    def _cut(self, status: Status) -> Horizon | None:
        """Cut the horizon of the leg that is wanted, on the pose of this status."""
        following, pose = self._path_of(motion_request(self.book)), status.base_in_map
        if following is None or pose is None:
            return None
        horizon = cut(self._slow(following), pose, following.progress_m)
        following.progress_m = horizon.progress_m
        return horizon

    def _slow(self, following: Following) -> LegPath:
        """Return the path at the share of its speeds that is driven now."""
        share = self._speed_share()
        if share == 1.0:
            return following.path
        if following.slowed is None or following.slowed[0] != share:
            following.slowed = (share, following.path.scale_speed(share))
        return following.slowed[1]

    def _course(self, horizon: Horizon | None) -> Course:
        """Return the course for the bridge now; ``horizon`` was cut on the status answered."""
        self._wish = wanted = motion_request(self.book)
        ours = self._path_of(wanted) is not None
        if wanted.leg is None or not ours or horizon is None or not horizon.points:
            return Course(wanted.grant)
        return Course(wanted.grant, wanted.leg, horizon.points, horizon.final)


def _bearing(end: RoutePoint, faces: tuple[float, float]) -> float:
    """Return the heading at which a robot at the end of a way faces a point [rad]."""
    return atan2(faces[1] - end.y_m, faces[0] - end.x_m)


def _slow_down(points: tuple[RoutePoint, ...], speed_mps: float | None) -> tuple[RoutePoint, ...]:
    """Return a route that is driven no faster than that, in either direction."""
    if speed_mps is None:
        return points
    return tuple(
        replace(p, speed_mps=copysign(min(abs(p.speed_mps), speed_mps), p.speed_mps))
        for p in points
    )
