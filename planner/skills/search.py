"""Search for one thing: look again at remembered ones, then look round in rooms. Pure.

``search`` returns the next leg or gaze, the thing itself once a gaze has confirmed it, or its state
when all was looked at or the budget is spent. What is seen on the way is gone to at once.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, sin
from typing import TYPE_CHECKING, Any, TypeVar

from planner.language.color_names import may_be
from planner.perception.snapshot import Thing
from planner.skills import search_bounds, viewpoints
from planner.skills.actions import DriveLeg, Observe, Scene, Way
from planner.skills.look_around import FACING_RAD, LOOKS, leg_to, look_round, spin
from planner.skills.object_matching import (
    WORTH,
    away_m,
    bearing,
    fits,
    is_placed,
    may_fit,
    seen_now,
    spot_of,
    sure,
    turn_to,
)
from planner.skills.skill_state import (
    AimStage,
    ModelSearchState,
    RoomTourState,
    SearchState,
)

if TYPE_CHECKING:
    from planner.skills.perception import WantedObject
    from planner.skills.search_bounds import SearchBounds
    from wire import Pose2

Search = TypeVar("Search", bound=SearchState)
Tour = TypeVar("Tour", bound=RoomTourState)
VIEW_M = 1.6
"""From so far a thing is looked at again: near enough for a cup, and the floor there is in view."""
NEAR_M = 2.6
"""Nearer than this, in the same room, it is looked at from where the robot stands."""
WORTH_S = 3600.0
"""What was seen longer ago tells which room to begin with, and no more."""
AWAY = 2.5
"""A thing may be told by its room alone: how far beyond a place it still belongs to it [m]."""


def search(
    scene: Scene[Search], pose: Pose2, wanted: WantedObject
) -> DriveLeg | Observe | Thing | Search:
    """Return the next act, or the thing that was found, or the state when it was not."""
    scene = begin(scene, pose, wanted, first=True)
    next_ = _next(scene, pose, wanted)
    if isinstance(next_, (DriveLeg, Observe)):  # the order holds from its first act on
        return keep_in_bounds(scene, pose, next_)
    return next_


def _next(
    scene: Scene[Search], pose: Pose2, wanted: WantedObject
) -> DriveLeg | Observe | Thing | Search:
    inside = PlaceFilter(scene)
    seen = [t for t in seen_now(scene, wanted) if sure(t) and inside(t)]
    if seen:
        return min(seen, key=lambda t: away_m(pose, (t.x_m, t.y_m)))
    if find_spent_budget(scene) is not None:
        return scene.state
    worth = (t for t in _list_remembered(scene, wanted) if fits(t, wanted) or may_fit(t, wanted))
    known = [t for t in worth if inside(t) and t.id not in scene.state.tried]
    near = [t for t in known if _reaches(scene, pose, (t.x_m, t.y_m))]
    if not near:
        next_ = look_round(scene, pose, spots(scene, pose), wanted)
        if not isinstance(next_, SearchState):
            return next_
        if known:
            return next_.but(out_of_metres=True)
        scene = scene.but(next_)  # all was looked at: light or distance may have changed a colour
        known = [t for t in alike(scene, wanted) if t.id not in next_.tried]
        if not known:
            return next_
    nearest = min(near or known, key=lambda t: (not fits(t, wanted), away_m(pose, (t.x_m, t.y_m))))
    return _look_again(scene, pose, nearest, wanted)


def _reaches(scene: Scene[Any], pose: Pose2, at: tuple[float, float]) -> bool:
    ahead_m = search_bounds.ROUND_ABOUT * away_m(pose, at) + search_bounds.way_after_m(
        at, scene.afterwards
    )
    return scene.spent_m + ahead_m <= _bounds(scene).end_m


def keep_in_bounds(
    scene: Scene[Tour], pose: Pose2, act: DriveLeg | Observe
) -> DriveLeg | Observe | Tour:
    """Return an act that ends with the search's own metres; its last state where they won't last.

    They are to last for the act and for the plan's rest.
    """
    if isinstance(act, DriveLeg) and act.way is not Way.SPIN:
        if not _reaches(scene, pose, (act.goal.x_m, act.goal.y_m)):
            state: Tour = act.otherwise or scene.state  # type: ignore[assignment]  # its skill's own
            return state.but(missed=None, out_of_metres=True)
        left_m = max(0.0, _bounds(scene).end_m - scene.spent_m)
        act = replace(act, limit_m=left_m if act.limit_m is None else min(act.limit_m, left_m))
    return replace(act, state=scene.state)


def find_spent_budget(scene: Scene[SearchState] | Scene[ModelSearchState]) -> str | None:
    """Return the budget that a search has used up, or None."""
    bounds = _bounds(scene)
    if scene.state.out_of_metres or not scene.spent_m <= bounds.begin_m:
        return "metres"
    return None if scene.spent_s <= bounds.seconds else "seconds"


def _bounds(scene: Scene[Any]) -> SearchBounds:
    return search_bounds.bound_search(scene.facts, scene.left_m)


def list_unseen(scene: Scene[Any]) -> tuple[str, ...]:
    """Return the rooms of a search that were not looked in, in its order; shut ones are apart."""
    state = scene.state
    return tuple(r for r in state.order if r not in state.rooms and r not in state.shut)


def ran_out(scene: Scene[Any]) -> bool:
    """Tell whether a search ended before all was looked at: for want of a way, time or pictures.

    A search that its eyes could not carry out has not run out: nothing is known.
    """
    state = scene.state
    return any(room not in state.rooms for room in state.shut) or may_go_on(scene)


def may_go_on(scene: Scene[Any]) -> bool:
    """Tell whether nothing but its own bounds ended a search."""
    shown = getattr(scene.state, "shown", 0)
    return (shown > 0 and shown >= search_bounds.bound_pictures(scene)) or find_spent_budget(
        scene
    ) is not None


class PlaceFilter:
    """Judge things by the place that a step names; without one all are meant."""

    def __init__(self, scene: Scene[Any]) -> None:
        self._target = scene.facts.targets.get(scene.step.place or "")
        self._facts = scene.facts
        self._room = viewpoints.room_of(scene.facts, scene.step.place)

    def __call__(self, thing: Thing) -> bool:
        if self._target is None:
            return True
        if self._target.room:
            room = thing.room or self._facts.room_at(thing.x_m, thing.y_m)
            return room == self._target.id
        return away_m(self._target.pose, (thing.x_m, thing.y_m)) <= AWAY


def spots(scene: Scene[RoomTourState], pose: Pose2) -> tuple[viewpoints.Viewpoint, ...]:
    """Return all spots to look round from, in order.

    A room is looked through from all its spots before the next, as long as the metres last for the
    other rooms; else those come first, and what was passed over is looked at with what is left.
    """
    facts, target = scene.facts, scene.facts.targets.get(scene.step.place or "")
    if target is not None and not target.room:
        at = (target.pose.x_m, target.pose.y_m)
        return (viewpoints.Viewpoint(f"{target.id}/0", viewpoints.room_of(facts, target.id), at),)
    first = scene.state.here or (pose.x_m, pose.y_m)
    room, order = facts.room_at(*first), scene.state.order
    rooms = [facts.targets[r] for r in order if r != room and r in facts.targets]
    groups: list[tuple[viewpoints.Viewpoint, ...]] = []
    if room in order:
        groups.append(
            (
                viewpoints.Viewpoint(viewpoints.HERE, room, first),
                *viewpoints.spots_in(facts.targets[room], first)[1:],
            )
        )
    elif room is None and target is None:
        groups.append((viewpoints.Viewpoint(viewpoints.HERE, None, first),))
    groups += [viewpoints.spots_in(target) for target in rooms]
    near = [*viewpoints.near_spot(facts.targets[room], first)] if room in order else []
    # what lay before the feet comes last: it is seldom there
    near += [spot for target in rooms for spot in viewpoints.near_spot(target)]
    return (*_rooms_first(scene, pose, groups), *near)


def _rooms_first(
    scene: Scene[RoomTourState], pose: Pose2, groups: list[tuple[viewpoints.Viewpoint, ...]]
) -> list[viewpoints.Viewpoint]:
    """Put off the further spots of rooms where the metres would not last for the other rooms."""
    state, at = scene.state, (pose.x_m, pose.y_m)
    over = (spot for spot in (state.missed, state.spot) if spot is not None)
    done = (*state.spots, *over)  # the spot that is looked round from is about to be
    ahead = tuple(group[0].at for group in groups if group[0].key not in done)
    now: list[viewpoints.Viewpoint] = []
    later: list[viewpoints.Viewpoint] = []
    for group in groups:
        inside = bool(done) and done[-1] in {spot.key for spot in group}
        if group[0].key not in done:
            now += group
        elif inside and ahead and all(_lasts(scene, (at, s.at, *ahead)) for s in group[1:]):
            now = [*group, *now]
        else:
            later = [*group, *later]
    return [*now, *later]


def _lasts(scene: Scene[Any], way: tuple[tuple[float, float], ...]) -> bool:
    """Tell whether the metres are likely to last for a way through rooms, and the plan's rest."""
    ahead_m = search_bounds.FROM_ROOM_TO_ROOM * search_bounds.way_m(
        way
    ) + search_bounds.way_after_m(way[-1], scene.afterwards)
    return scene.spent_m + ahead_m <= _bounds(scene).begin_m


def begin(
    scene: Scene[Tour], pose: Pose2, wanted: WantedObject | None, *, first: bool = False
) -> Scene[Tour]:
    """Return the scene with where the robot stood first, and the rooms in their order.

    Where the ``first`` that is found ends the step, likely rooms come early; else all is looked at,
    and the shorter way counts.
    """
    if scene.state.here is not None:
        return scene
    # Where its neighbour is, it may well be.
    known = tuple(
        t for t in scene.sight.things if wanted is not None and fits(t, wanted.by or wanted)
    )
    here = (round(pose.x_m, 3), round(pose.y_m, 3))
    place = scene.facts.targets.get(scene.step.place or "")
    order = (
        viewpoints.in_order(scene.facts, pose, known, wanted if first else None)
        if place is None
        else (place.id,)
    )
    return scene.but(scene.state.but(here=here, order=order))


def alike(scene: Scene[Any], wanted: WantedObject) -> list[Thing]:
    """Return the things that would fit if their colour were seen wrongly, as from afar."""
    inside, others = PlaceFilter(scene), _list_remembered(scene, wanted)
    return [
        t for t in others if inside(t) and not fits(t, wanted) and may_be(t.color, wanted.color)
    ]


def _list_remembered(scene: Scene[Any], wanted: WantedObject) -> list[Thing]:
    oldest_s = scene.now_s - WORTH_S
    return [
        t
        for t in scene.sight.things
        if t.label == wanted.label
        and t.seen_s >= oldest_s
        and t.confidence >= WORTH
        and is_placed(t, wanted, scene.sight.things)
    ]


def _look_again(
    scene: Scene[SearchState], pose: Pose2, thing: Thing, wanted: WantedObject
) -> DriveLeg | Observe:
    """Go to where a thing can be seen, face it, gaze; then it is confirmed, or was tried."""
    state, at = scene.state, spot_of(thing)
    stage = state.aim_stage if state.aim == thing.id else AimStage.CHOSEN
    tried = state.but(tried=(*state.tried, thing.id), aim=None, aim_stage=AimStage.CHOSEN)
    if stage is AimStage.CHOSEN and not _in_sight(scene, pose, thing):
        stand, heading = short_of(pose, at[:2], VIEW_M)
        there = state.but(aim=thing.id, aim_stage=AimStage.NEAR)
        return leg_to(pose, stand, heading, there, tried)
    if stage is not AimStage.FACING and abs(turn_to(pose, at[:2])) > 2.0 * FACING_RAD:
        facing = state.but(aim=thing.id, aim_stage=AimStage.FACING)
        return spin(pose, bearing(pose, at[:2]), facing)
    return Observe(LOOKS + 2, then=tried, wanted=wanted)


def _in_sight(scene: Scene[Any], pose: Pose2, thing: Thing) -> bool:
    """Tell whether a turn on the spot is likely to show a thing."""
    away = away_m(pose, (thing.x_m, thing.y_m))
    room = thing.room or scene.facts.room_at(thing.x_m, thing.y_m)
    return 0.7 <= away <= NEAR_M and room == scene.facts.room_at(pose.x_m, pose.y_m)


def short_of(
    pose: Pose2, at: tuple[float, float], short_m: float, turn_rad: float = 0.0
) -> tuple[tuple[float, float], float]:
    """Return the point before a thing, seen from the robot, and the heading that faces it.

    ``turn_rad`` goes about the thing to another side.
    """
    heading = bearing(pose, at) + turn_rad
    return (at[0] - short_m * cos(heading), at[1] - short_m * sin(heading)), heading
