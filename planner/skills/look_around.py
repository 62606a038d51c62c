"""Look round: from one spot in all directions, from several spots one after the other. Pure.

Shared by the skills that look. A spot is driven to, then turned about by a little less than the
field of view, with a gaze at fresh pictures in each direction. What was looked at is in the
skill's state.
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, TypeVar

from planner.skills.actions import DriveLeg, Observe, Scene, Way
from planner.skills.object_matching import away_m
from planner.skills.skill_state import LookRoundState, SkillStateBase
from planner.skills.viewpoints import HERE, Viewpoint
from wire import Pose2, wrap

if TYPE_CHECKING:
    from planner.skills.perception import WantedObject

Looking = TypeVar("Looking", bound=LookRoundState)
LOOKS = 3
"""New pictures in each direction: a detector misses now and then."""
FACING_RAD = 0.12
"""The bridge calls a heading reached within 0.10."""
THERE_M = 0.35
SPIN_S, SPIN_M = 15.0, 0.5
MORE_M, SLOWEST_MPS, LEG_S = 10.0, 0.1, 60.0


def look_round(
    scene: Scene[Looking], pose: Pose2, spots: tuple[Viewpoint, ...], wanted: WantedObject | None
) -> DriveLeg | Observe | Looking:
    """Return the next leg or gaze; the state alone once every spot was looked round from."""
    state = _without_way(scene, pose, spots)
    scene = scene.but(state)
    here = next((s for s in spots if s.key == state.spot), None)
    if here is None:
        return _go(scene, pose, spots, wanted)
    view = _next_view(scene, pose, state)
    if view is None:
        done = note_spot(state, here)
        return _go(scene.but(done), pose, spots, wanted)
    heading = _heading(scene, view)
    if state.turned != view and abs(wrap(heading - pose.yaw_rad)) > FACING_RAD:
        return spin(pose, heading, state.but(turned=view))
    then = state.but(views=(*state.views, view), turned=None)
    return Observe(LOOKS, then=then, wanted=wanted)


def note_spot(state: Looking, spot: Viewpoint) -> Looking:
    """Return the state of a spot that was looked round from."""
    rooms = state.rooms
    if spot.room is not None and spot.room not in rooms:
        rooms = (*rooms, spot.room)
    return state.but(spot=None, views=(), turned=None, spots=(*state.spots, spot.key), rooms=rooms)


def spin(pose: Pose2, heading: float, then: SkillStateBase, *, watch: bool = False) -> DriveLeg:
    """Return the turn on the spot to a heading."""
    goal = Pose2(pose.x_m, pose.y_m, wrap(heading))
    return DriveLeg(
        goal, True, Way.SPIN, limit_s=SPIN_S, limit_m=SPIN_M, then=then, otherwise=then, watch=watch
    )


def leg_to(
    pose: Pose2,
    at: tuple[float, float],
    heading: float | None,
    then: SkillStateBase,
    otherwise: SkillStateBase,
    wanted: WantedObject | None = None,
    sees: tuple[float, float] | None = None,
    sees_from_m: float = 0.0,
) -> DriveLeg:
    """Return the way to a point, bounded by its distance; without a way the step goes on.

    With ``sees`` it ends where that is seen from, no nearer to it than ``sees_from_m``.
    """
    far_m = away_m(pose, at)
    goal = Pose2(at[0], at[1], heading if heading is not None else pose.yaw_rad)
    return DriveLeg(
        goal,
        heading is not None,
        limit_s=LEG_S + far_m * 2.0 / SLOWEST_MPS,
        limit_m=MORE_M + 3.0 * far_m,
        then=then,
        otherwise=otherwise,
        wanted=wanted,
        sees=sees,
        sees_from_m=sees_from_m,
    )


def _go(
    scene: Scene[Looking], pose: Pose2, spots: tuple[Viewpoint, ...], wanted: WantedObject | None
) -> DriveLeg | Observe | Looking:
    """Return the way to the next spot, or the first gaze where the robot is there already."""
    state = scene.state
    spot = next((s for s in spots if s.key not in state.spots), None)
    if spot is None:
        return state
    there = state.but(spot=spot.key, views=(), turned=None)
    if spot.key == HERE or away_m(pose, spot.at) <= THERE_M:
        return look_round(scene.but(there), pose, spots, wanted)
    return leg_to(pose, spot.at, None, there, state.but(missed=spot.key), wanted)


def _without_way(scene: Scene[Looking], pose: Pose2, spots: tuple[Viewpoint, ...]) -> Looking:
    """Give up a spot to which the way was shut; in its room, look round from where one stands."""
    state = scene.state
    spot = next((s for s in spots if s.key == state.missed), None)
    if spot is None:
        return state
    if spot.room in state.rooms:  # it was looked round in, but for what this spot shows better
        return state.but(missed=None, spots=(*state.spots, spot.key))
    if spot.room is not None and scene.facts.room_at(pose.x_m, pose.y_m) == spot.room:
        return state.but(missed=None, spot=spot.key, views=(), turned=None)
    shut = (*state.shut, spot.room) if spot.room and spot.room not in state.shut else state.shut
    return state.but(missed=None, spots=(*state.spots, spot.key), shut=shut)


def _heading(scene: Scene[LookRoundState], view: int) -> float:
    return wrap(view * 2.0 * pi / scene.eyes.views)


def _next_view(scene: Scene[LookRoundState], pose: Pose2, state: LookRoundState) -> int | None:
    """Return the direction to look in next: the one turned to, else the nearest."""
    if state.turned is not None and state.turned not in state.views:
        return state.turned
    left = [v for v in range(scene.eyes.views) if v not in state.views]
    return min(
        left, key=lambda v: _turn_cost(wrap(_heading(scene, v) - pose.yaw_rad)), default=None
    )


def _turn_cost(turn: float) -> float:
    """Return the turn needed; rightwards counts a little more, so that one way is kept."""
    return turn if turn >= 0.0 else -1.3 * turn
