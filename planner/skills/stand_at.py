"""Stand at a side of a place or of a thing that was seen, facing it; or turn to face it.

Precondition: the place is there; a thing is on the map of things, sure, and of the kind asked for:
nothing is searched. Law: every spot is free by the map (``planner.site.standing_spots``) and by the
route search; where none is, or no way leads to any, the step fails and says which. A room has
no sides. Verdict: the leg was reached; how far from it the robot then stands is told by its pose.
Budget: one leg a spot, three spots at most.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, NamedTuple

from planner.language.catalogue import message, say
from planner.language.object_names import name_object, tell_words
from planner.plan import Bilingual, Code, say_same
from planner.skills.actions import Fail, Finish, Retry, Scene, SkillAction
from planner.skills.drive_to_place import place_gone
from planner.skills.find import unknown
from planner.skills.look_around import FACING_RAD, leg_to, spin
from planner.skills.object_matching import away_m, bearing, fits, sure, turn_to, wanted_of
from planner.skills.skill_state import StandAtState

if TYPE_CHECKING:
    from planner.site.standing_spots import StandingSpot
    from wire import Pose2

NO_SPOT = "no_spot"


class _Thing(NamedTuple):
    """Hold what is stood at: its name, its nearest point, and the spots at the side asked for."""

    name: Bilingual
    at: tuple[float, float]
    spots: tuple[StandingSpot, ...]


def stand_at(scene: Scene[StandAtState]) -> SkillAction:
    """Return the leg to the next spot, the turn that faces it, or how it stands there."""
    if scene.pose is None:
        return Retry()
    state = scene.state
    if state.at is None:
        found = _place(scene, scene.pose) if scene.step.place else _thing(scene, scene.pose)
        if not isinstance(found, _Thing):
            return found
        if scene.step.side != "facing" and not found.spots:
            return _tell_no_spot(scene, found.name)
        spots = tuple((s.pose.x_m, s.pose.y_m, s.pose.yaw_rad, *s.face) for s in found.spots)
        state = state.but(name=found.name, at=found.at, spots=spots)
    if scene.step.side == "facing":
        return _face(scene, scene.pose, state)
    return _drive(scene, scene.pose, state)


def _drive(scene: Scene[StandAtState], pose: Pose2, state: StandAtState) -> SkillAction:
    name = state.name or say_same("?")
    if state.reached:
        x_m, y_m = state.spots[state.tried][3:]
        gap_m = hypot(x_m - pose.x_m, y_m - pose.y_m) - scene.facts.radius_m
        side = scene.step.side or "before"
        return Finish({}, Code.ARRIVED, say(f"stand.{side}", name=name, away=max(0.0, gap_m)))
    if state.tried >= len(state.spots):
        return _tell_no_spot(scene, name)
    x_m, y_m, yaw_rad, _, _ = state.spots[state.tried]
    there, next_ = state.but(reached=True), state.but(tried=state.tried + 1)
    return leg_to(pose, (x_m, y_m), yaw_rad, there, next_)


def _face(scene: Scene[StandAtState], pose: Pose2, state: StandAtState) -> SkillAction:
    at, name = state.at or (pose.x_m, pose.y_m), state.name or say_same("?")
    if state.reached or abs(turn_to(pose, at)) <= FACING_RAD:
        return Finish({}, Code.ARRIVED, say("stand.facing", name=name, away=away_m(pose, at)))
    return spin(pose, bearing(pose, at), state.but(reached=True))


def _tell_no_spot(scene: Scene[StandAtState], name: Bilingual) -> Fail:
    """Tell that there is no free floor where the order wants the robot."""
    far = scene.step.distance_m
    side = say(f"stand.side_{scene.step.side or 'before'}", name=name)
    code = "stand.no_spot" if far is None else "stand.no_spot_at"
    return Fail(Code.NO_ROOM, NO_SPOT, say(code, side=side, far=far))


def _place(scene: Scene[StandAtState], pose: Pose2) -> _Thing | SkillAction:
    step, facts = scene.step, scene.facts
    target = facts.targets.get(step.place or "")
    if target is None:
        return place_gone(facts, step.place or "?")
    if step.side == "facing":
        at = (target.pose.x_m, target.pose.y_m)
        if facts.floor is not None and not target.room and target.id != facts.home:  # looks away
            at = facts.floor.face_of(target.pose)
        return _Thing(target.name, at, ())
    if target.room or facts.floor is None:
        return Fail(Code.NO_ROOM, NO_SPOT, say("stand.room", name=target.name))
    spots = facts.floor.spots(target.pose, step.side or "before", step.distance_m)
    near = sorted(spots, key=lambda s: away_m(pose, (s.pose.x_m, s.pose.y_m)))
    return _Thing(target.name, facts.floor.face_of(target.pose), tuple(near))


def _thing(scene: Scene[StandAtState], pose: Pose2) -> _Thing | SkillAction:
    wanted, step, floor = wanted_of(scene), scene.step, scene.facts.floor
    if wanted is None:
        return unknown(scene)
    known = [t for t in scene.sight.things if sure(t) and fits(t, wanted)]
    thing = min(known, key=lambda t: away_m(pose, (t.x_m, t.y_m)), default=None)
    if thing is None:
        looked, name = say("stand.unseen"), tell_words(step.object or "?")
        return Fail(Code.NOT_FOUND, "unseen", message(Code.NOT_FOUND, thing=name, looked=looked))
    name, at = name_object(thing.label, thing.color), (thing.x_m, thing.y_m)
    if step.side == "facing" or floor is None:
        return _Thing(name, at, ())
    return _Thing(name, at, floor.about(at, pose, step.side or "before", step.distance_m))
