"""Drive to places in turn; where the plan says so, look round at each and report at the end.

Law: what is told of a stop was seen there, standing, in this stay: things that are sure, of the
kinds that the detector knows. A stop without a way is told and passed over; a patrol that reached
none fails. A robot without a detector drives on and says that it saw nothing. Paused or crashed at
a stop, its look begins anew there: half a look proves nothing. Verdict: every stop was reached and
looked round at, or told why not. Budget: one leg and one turn about a place; metres and seconds are
the bridge's grant.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.catalogue import join, say
from planner.plan import Bilingual, Code, PatrolSighting, say_same
from planner.skills.actions import (
    DriveLeg,
    Fail,
    Finish,
    Observe,
    Retry,
    Scene,
    SkillAction,
)
from planner.skills.drive_to_place import drive_to
from planner.skills.look_around import look_round
from planner.skills.object_matching import drop_doubles, list_confirmed
from planner.skills.result_text import list_things, room_name
from planner.skills.search import PlaceFilter
from planner.skills.skill_state import PatrolState, SkillStateBase
from planner.skills.viewpoints import HERE, Viewpoint, room_of

if TYPE_CHECKING:
    from wire import Pose2


def patrol(scene: Scene[PatrolState]) -> SkillAction:
    """Return the leg to the next place, the next gaze there, or that all were visited."""
    places, state = scene.step.places, scene.state
    if not scene.step.look:
        if scene.part >= len(places):
            return Finish({"visited": scene.part})
        return drive_to(scene, places[scene.part])
    if len(state.stops) >= len(places):
        return _report(scene)
    place = places[len(state.stops)]
    if state.missed is not None:
        return _end_stop(scene, _name(scene, "patrol.shut", place), shut=True)
    if state.arrived_s is None:
        leg = drive_to(scene, place)
        if not isinstance(leg, DriveLeg):
            return leg
        there, missed = state.but(arrived_s=scene.spent_s), state.but(missed=place)
        return replace(leg, state=state, then=there, otherwise=missed)
    if scene.pose is None:
        return Retry()
    return _look(scene, scene.pose, place)


def so_far(state: SkillStateBase | None) -> dict[str, object]:
    """Return what a patrol has to tell before it is over: it is kept however the step ends."""
    if not isinstance(state, PatrolState) or not state.stops:
        return {}
    return {"stops": state.stops, "visited": sum(not stop.shut for stop in state.stops)}


def _look(scene: Scene[PatrolState], pose: Pose2, place: str) -> SkillAction:
    """Return the next gaze or turn at a stop; once it was looked round there, what is next."""
    lack = scene.eyes.means(scene.sight.blind, grows=scene.facts.grows).lacks("count")
    if lack is not None:
        return _end_stop(scene, _name(scene, f"patrol.{lack.value}", place))
    state = scene.state
    if state.here is None:
        state = state.but(here=(round(pose.x_m, 3), round(pose.y_m, 3)))
        # What was driven and waited for before this stop is over: sights count from here on.
        state = state.but(arrived_s=scene.spent_s)
    step = scene.step.model_copy(update={"place": place, "places": ()})
    at = replace(scene, step=step, state=state)
    spot = Viewpoint(HERE, room_of(scene.facts, place), state.here or (pose.x_m, pose.y_m))
    next_ = look_round(at, pose, (spot,), None)
    if isinstance(next_, (DriveLeg, Observe)):
        return replace(next_, state=state)
    inside, since_s = PlaceFilter(at), scene.now_s - scene.spent_s + (state.arrived_s or 0.0)
    seen = drop_doubles(t for t in list_confirmed(scene.sight, None, since_s) if inside(t))
    code = "patrol.saw" if seen else "patrol.saw_nothing"
    return _end_stop(scene, _name(scene, code, place, list_things(seen) if seen else None))


def _end_stop(scene: Scene[PatrolState], said: Bilingual, *, shut: bool = False) -> SkillAction:
    """Note a stop, and return what is next."""
    stops = scene.state.stops
    place = scene.step.places[len(stops)]
    stop = PatrolSighting(place=place, said=said, shut=shut)
    return patrol(scene.but(PatrolState(stops=(*stops, stop))))


def _report(scene: Scene[PatrolState]) -> Finish | Fail:
    """Tell what was seen where; of a patrol that came nowhere, that it failed."""
    stops = scene.state.stops
    reached = sum(not stop.shut for stop in stops)
    told = join(stop.said for stop in stops)
    figures = {"stops": stops, "visited": reached}
    if not reached:
        return Fail(Code.NO_ROUTE, Code.NO_ROUTE.value, told, figures)
    return Finish(figures, Code.SEEN, told)


def _name(
    scene: Scene[PatrolState], code: str, place: str, found: Bilingual | None = None
) -> Bilingual:
    name = room_name(scene.facts, place) or say_same(place)
    return say(code, place=name, found=found)
