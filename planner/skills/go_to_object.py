"""Drive up to a thing: half a metre is left between it and the robot's edge, which faces it.

Precondition: the detector knows what is meant, or a vision model can point at it and a person
says yes to the point (model_pointing.py); words that pick one out by more than kind and colour
("the small cup") only a model understands. The thing is found as ``find`` does, and looked at once
more where it was seen for a moment only; the standing point is tried from this side first, then
about the thing; the route search moves one that lies in furniture to where the thing is seen from,
on the map, and leaves out what is behind a wall; last comes the nearest such point at all. Verdict:
the bridge reached the leg, and where the thing must be in view a look confirms it, or it was seen
on the way and something hides it now; where it is too near for that, it is still remembered, which
it is not when it should have been seen on the way and was not. When it is gone it is looked for
once more, then that is told. Budget: as for ``find``.
"""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

from planner.language.catalogue import message, say
from planner.language.object_classes import kind_of
from planner.language.object_names import name_object
from planner.perception.snapshot import Thing
from planner.plan import Code, Found, say_same
from planner.skills.actions import (
    AskImage,
    Fail,
    Finish,
    Observe,
    Retry,
    Scene,
    SkillAction,
)
from planner.skills.find import not_found, unknown
from planner.skills.image_errors import point_refused
from planner.skills.look_around import FACING_RAD, LOOKS, leg_to, spin
from planner.skills.model_pointing import agree_on_point
from planner.skills.object_matching import (
    WORTH,
    apart_m,
    away_m,
    bearing,
    fits,
    found,
    lasting,
    list_confirmed,
    one_of,
    seen_now,
    spot_of,
    sure,
    turn_to,
    twice,
)
from planner.skills.result_text import name_one
from planner.skills.search import PlaceFilter, search, short_of
from planner.skills.skill_state import (
    AimStage,
    ApproachStage,
    ApproachState,
    GoToObjectState,
    GoToPointState,
)

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.skills.perception import WantedObject
    from wire import Pose2

SHORT_M, ROBOT_M = 0.5, 0.3
SIDES_RAD = (0.0, pi / 4, -pi / 4, pi / 2, -pi / 2, 3 * pi / 4, -3 * pi / 4, pi)
NEAREST_M = 0.45
"""The robot's middle never stands nearer to a thing's than so."""
MOVED_M = 0.6
NEAR_ENOUGH_M = 0.1
FRESH_S = 20.0
"""What was seen for sure so recently is driven to without a second look."""


def go_to_object(scene: Scene[GoToObjectState]) -> SkillAction:
    """Return the next act on the way to the thing, or that it was reached."""
    wanted = one_of(scene)
    pointed = scene.state.pointed is not None
    if wanted is None and not (pointed or scene.eyes.model):
        return unknown(scene)
    if scene.pose is None:
        return Retry()
    if scene.state.at is not None:
        return approach(scene, scene.pose, wanted)
    if wanted is None or pointed:
        at = agree_on_point(scene, scene.pose)
        return set_off(scene, scene.pose, scene.state, at) if isinstance(at, tuple) else at
    thing = _find_nearest(scene, scene.pose, wanted) or search(scene, scene.pose, wanted)
    if isinstance(thing, Thing):
        if not lasting(thing) and thing.id not in scene.state.tried:
            tried = scene.state.but(tried=(*scene.state.tried, thing.id))
            return Observe(LOOKS, state=scene.state, then=tried)
        state = scene.state.but(label=thing.label, color=thing.color, aim=None)
        return set_off(scene, scene.pose, state, spot_of(thing), wanted)
    return _fail(scene.but(thing), wanted) if isinstance(thing, GoToObjectState) else thing


def set_off(
    scene: Scene[Any],
    pose: Pose2,
    state: ApproachState,
    at: tuple[float, float, float],
    wanted: WantedObject | None = None,
) -> SkillAction:
    """Return the first leg to an object known to be at a point."""
    near = away_m(pose, at[:2]) <= _short_m(state) + NEAR_ENOUGH_M
    state = state.but(at=at, approach=ApproachStage.FACE if near else ApproachStage.DRIVE, stand=0)
    return approach(scene.but(state), pose, wanted)


def approach(scene: Scene[ApproachState], pose: Pose2, wanted: WantedObject | None) -> SkillAction:
    """Return the next act once it is known where the thing is."""
    state, at = scene.state, scene.state.at
    if at is None:
        return Retry()
    if state.approach is ApproachStage.DRIVE:
        return _drive(pose, state, at)
    if state.approach is ApproachStage.FACE and abs(turn_to(pose, at[:2])) > FACING_RAD:
        return spin(pose, bearing(pose, at[:2]), state.but(approach=ApproachStage.CHECK))
    if state.approach is not ApproachStage.JUDGE:
        near = _near(scene, at, wanted, scene.sight.things)
        if wanted is not None and scene.eyes.should_see(pose, at):
            before = near.confidence if near is not None else None
            return Observe(LOOKS + 2, then=state.but(approach=ApproachStage.JUDGE, sure=before))
        gone = wanted is not None and (near is None or not near.confidence >= WORTH)
        return _look_anew(scene, wanted) if gone else _arrive(scene, pose, wanted)
    return _judge(scene, pose, wanted)


def _find_nearest(scene: Scene[GoToObjectState], pose: Pose2, wanted: WantedObject) -> Thing | None:
    """Return the nearest that was seen just now and for a while, beyond doubt."""
    inside = PlaceFilter(scene)
    known = [t for t in list_confirmed(scene.sight, wanted, scene.now_s - FRESH_S) if inside(t)]
    known = [t for t in known if lasting(t) and t.id not in scene.state.tried]
    return min(known, key=lambda t: away_m(pose, (t.x_m, t.y_m)), default=None)


def _short_m(state: ApproachState) -> float:
    """Return how far from the thing's middle the robot's middle is to stand [m]."""
    behind_m = kind_of(state.label).behind_m if state.label is not None else 0.0
    return SHORT_M + ROBOT_M + behind_m


def _drive(pose: Pose2, state: ApproachState, at: tuple[float, float, float]) -> SkillAction:
    if state.stand > len(SIDES_RAD):
        name = name_one(state.label, state.color) if state.label is not None else say_same("?")
        return Fail(Code.NO_ROUTE, "no_route", message(Code.NO_ROUTE, place=name))
    there, otherwise = state.but(approach=ApproachStage.FACE), state.but(stand=state.stand + 1)
    if state.stand == len(SIDES_RAD):  # large furniture: wherever it is seen from, and near
        heading = bearing(pose, at[:2])
        return leg_to(pose, at[:2], heading, there, otherwise, sees=at[:2], sees_from_m=NEAREST_M)
    spot, heading = short_of(pose, at[:2], _short_m(state), SIDES_RAD[state.stand])
    return leg_to(pose, spot, heading, there, otherwise, sees=at[:2], sees_from_m=NEAREST_M)


def _judge(scene: Scene[ApproachState], pose: Pose2, wanted: WantedObject | None) -> SkillAction:
    """Say that the thing is there, go after it once where it has moved, or look for it once."""
    at = scene.state.at
    if at is not None and _near(scene, at, wanted, seen_now(scene, wanted)) is not None:
        return _arrive(scene, pose, wanted)
    near = _near(scene, at, wanted, scene.sight.things) if at is not None else None
    hidden = near is not None and _is_hidden(scene, near)
    return _arrive(scene, pose, wanted) if hidden else _look_anew(scene, wanted)


def _is_hidden(scene: Scene[ApproachState], near: Thing) -> bool:
    """Return whether an object seen on the way is out of sight from here, hidden or cut off.

    The memory knows what hides it: a thing that the looks should have shown is less sure by now.
    """
    if scene.state.sure is None or not near.seen_s >= scene.now_s - FRESH_S:
        return False
    return sure(near) and near.confidence >= scene.state.sure


def _near(
    scene: Scene[ApproachState],
    at: tuple[float, float, float],
    wanted: WantedObject | None,
    things: Iterable[Thing],
) -> Thing | None:
    """Return the one of these, seen twice at least, that was driven up to at a point."""
    label = scene.state.label
    seen = [t for t in things if t.label == label and fits(t, wanted) and twice(t)]
    near = min(seen, key=lambda t: apart_m(t, at), default=None)
    return near if near is not None and apart_m(near, at) <= MOVED_M else None


def _look_anew(scene: Scene[ApproachState], wanted: WantedObject | None) -> SkillAction:
    """Look for a lost object once more."""
    state = scene.state
    if wanted is None or not isinstance(state, GoToObjectState) or state.again > 0:
        return _fail_moved(scene)
    again = state.but(
        again=1, at=None, aim_stage=AimStage.CHOSEN, spots=(), rooms=(), here=None, tried=()
    )
    return go_to_object(scene.but(again))


def _arrive(scene: Scene[ApproachState], pose: Pose2, wanted: WantedObject | None) -> Finish:
    state, at = scene.state, scene.state.at or (pose.x_m, pose.y_m, 0.0)
    near = _near(scene, at, wanted, scene.sight.things) if state.label is not None else None
    away = away_m(pose, at[:2] if near is None else (near.x_m, near.y_m))
    figures: dict[str, object] = {"rooms": _list_rooms(state)}
    if state.label is None:
        said = say("object_step.at_point", away=away)
        return Finish(figures, Code.ARRIVED, said)
    if near is not None:
        figures["found"] = found(near, pose, scene.now_s)
    else:
        figures["found"] = Found(label=state.label, color=state.color, x_m=round(at[0], 3),
                                 y_m=round(at[1], 3), distance_m=round(away, 2))  # fmt: skip
    name = name_one(state.label, state.color)
    said = say("object_step.at_object", away=away, name=name)
    return Finish(figures, Code.ARRIVED, said)


def _fail(scene: Scene[GoToObjectState], wanted: WantedObject) -> SkillAction:
    return _fail_moved(scene) if scene.state.again > 0 else not_found(scene, wanted)


def _fail_moved(scene: Scene[ApproachState]) -> Fail:
    """Say that the thing is no more where it was seen."""
    looked = say("object_step.moved")
    bare = name_object(scene.state.label or "thing", scene.state.color)
    said = message(Code.NOT_FOUND, thing=bare, looked=looked)
    return Fail(Code.NOT_FOUND, "moved", said, {"rooms": _list_rooms(scene.state)})


def _list_rooms(state: ApproachState) -> tuple[str, ...]:
    """Return the rooms that were looked round in before the thing was driven up to."""
    return state.rooms if isinstance(state, GoToObjectState) else ()


FLOOR_M = 0.12
"""What lies lower is driven onto."""


def go_to_point(scene: Scene[GoToPointState]) -> SkillAction:
    """Return the leg to the point that a pixel shows, onto floor or short of a thing there.

    Law: the point counts in the picture that the plan was made on, from where that was taken; a
    wall, the sky and what lies outside the fence are refused before anything moves. No brain that
    plans is shown a picture or offered this step (``Means.plannable``), so no sign can choose the
    point, and nobody is asked; where a model that looks points, see model_pointing.py. Verdict: the
    bridge reached the leg. Budget: one leg.
    """
    pose, state = scene.pose, scene.state
    if pose is None:
        return Retry()
    if state.reached:
        return Finish()
    if state.stand > 0:
        return point_refused("point_no_route")
    if state.at is not None:
        return approach(scene, pose, None)
    if scene.answer is None:
        return AskImage(x=scene.step.x or 0, y=scene.step.y or 0, then=state)
    at = scene.answer.at
    if at is None:
        return point_refused(scene.answer.failure or "point_no_depth")
    if at[2] > FLOOR_M:
        return set_off(scene, pose, state, at)
    heading = bearing(pose, at[:2])
    return leg_to(pose, at[:2], heading, state.but(reached=True), state.but(stand=1))
