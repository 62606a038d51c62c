"""Tell in both languages the robot's position and activity, and what stands in its way. Pure."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING

from planner.bridge_client.bridge_status import standing, worst_row
from planner.language.catalogue import message, say, say_or_quote
from planner.language.formatting import definite
from planner.mission.account import DRIVEN, place_name
from planner.mission.outcomes import find_place_near, spot_at
from planner.mission.state import Mission, MissionState
from planner.plan import Bilingual, Code, GoalState, say_same
from planner.site.polygon import area_m2, border_distance_m, contains
from planner.site.site_view import SiteView
from planner.skills.conditions import clock_time
from wire import Pose2, Status

if TYPE_CHECKING:
    from planner.mission.activity import RouteDoubt
    from planner.mission.recovery import ShutWay


OLD_S = 1.0
DRIVES_MPS = 0.02
"""Slower than this, a robot that does not stand is turning."""
_SHOWN = 60
_ASIDE = frozenset({"recall", "decide", "use_tool"})
"""Who only asks of before does nothing whose end is asked for."""


STOPPED = message(Code.STOPPED)
STOPPING = say("status.stopping")


def stop_told(book: MissionState) -> Bilingual:
    """Say that a stop was confirmed; that the robot stands only where it does."""
    status = book.status
    return STOPPED if status is not None and standing(status) else STOPPING


def go_on_told(book: MissionState, said: Bilingual, now_s: float) -> Bilingual:
    """Say beside a refusal or a question that the robot is still on another goal, where it is."""
    running = book.running_goal
    if running is None:
        return said
    text = _short(running.text)
    moves = book.status is not None and not standing(book.status)
    fresh = now_s - book.status_s <= OLD_S
    return say("status.drives_for" if moves and fresh else "status.is_at", said=said, text=text)


def tell_position(book: MissionState, age_s: float) -> Bilingual:
    """Say where the robot is, or that nobody knows."""
    status = book.status
    if status is None:
        return say("status.never_heard")
    pose = status.base_in_map
    if pose is None:
        return say("status.not_localized")
    spot = _spot(book.facts, pose)
    if not age_s <= OLD_S:
        return say("status.bridge_silent_s_ago_i", age_s=age_s, spot=spot)
    return say("status.at", spot=spot)


def tell_battery(book: MissionState, age_s: float) -> Bilingual:
    """Say how far the battery is charged, or that nobody knows."""
    status = book.status
    if status is None or not age_s <= OLD_S:
        return say("status.battery_silent")
    charge = status.drive.battery
    return (
        say("status.no_battery")
        if charge is None
        else say("status.battery", percent=100.0 * charge)
    )


def _spot(facts: SiteView, pose: Pose2) -> Bilingual:
    room = spot_at(facts, pose).room
    near = find_place_near(facts, pose)
    by = near.name if near is not None else None
    inside = facts.targets[room].name if room is not None else None
    if inside is not None and by is not None:
        return say("status.spot_both", room=inside, place=by)
    if inside is not None:
        return say("status.spot_room", room=inside)
    return say("status.spot_near", place=by) if by is not None else say("status.spot_unknown")


def doing(book: MissionState, age_s: float, asking: str = "") -> Bilingual:
    """Tell the robot's activity now; the goal that asks (``asking``) is not counted."""
    motion = _motion(book.status, age_s)
    task = _task(book, asking)
    waiting = len([i for i in book.queue if i != asking])
    more = say("status.more_in_queue", waiting=waiting) if waiting else say_same("")
    return say("status.whole", task=task, motion=motion, more=more)


def tell_outcome(book: MissionState, asking: str = "") -> Bilingual | None:
    """Tell how the newest order ended, or how far it is; None where there was none."""
    done = [
        m
        for m in book.missions.values()
        if m.id != asking and any(step.kind not in _ASIDE for step in m.steps)
    ]
    last = max(done, key=lambda m: m.order, default=None)
    if last is None:
        return None
    if last.outcome is None:
        return _running(book, last) if last.id == book.running else _task(book, asking)
    return say("status.outcome", text=_short(last.text), outcome=last.outcome.message)


def _motion(status: Status | None, age_s: float) -> Bilingual:
    if status is None or not age_s <= OLD_S:
        return say("status.bridge_silent_so_nobody_here")
    row = worst_row(status)
    if standing(status):
        bare = say("status.stands")
        return bare if row is None else say("status.stands_because", row=row.row)
    return say("status.drives" if abs(status.measured.v_mps) > DRIVES_MPS else "status.turns")


def _task(book: MissionState, asking: str) -> Bilingual:
    running = book.running_goal
    if running is not None:
        return _running(book, running)
    for state in (
        GoalState.PLANNING,
        GoalState.NEEDS_CLARIFICATION,
        GoalState.AWAITING_CONFIRMATION,
        GoalState.PAUSED,
    ):
        if found := book.goals_in(state, besides=asking):
            return _waiting(found[-1])
    return say("status.idle")


def _running(book: MissionState, mission: Mission) -> Bilingual:
    step = mission.steps[mission.step] if mission.step < len(mission.steps) else None
    name = place_name(book.facts, mission, step) if step is not None else None
    goes = step is not None and step.kind in DRIVEN
    to = name if goes and name is not None else None
    text = _short(mission.text)
    if to is None:
        return say("status.step", text=text)
    return say("status.step_to", text=text, place=definite(to))


def _waiting(mission: Mission) -> Bilingual:
    text = _short(mission.text)
    if mission.state is GoalState.PLANNING:
        return say("status.i_think_about", text=text)
    if mission.state is GoalState.PAUSED:
        why = say_or_quote("paused", mission.reason or "")
        return say("status.is_paused", text=text, why=why)
    if mission.state is GoalState.AWAITING_CONFIRMATION:
        return say("status.waits_for_your_yes", text=text)
    return say("status.awaits_answer", text=text)


def _short(text: str) -> str:
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 1]}…"


DOOR_M = 0.45
"""From the line between two rooms; outlines reach to the middle of walls, and what stands in a
door sticks out of it."""


def tell_obstruction(facts: SiteView, shut: ShutWay, place: Bilingual) -> Bilingual:
    """Return the sentence of a way to a place that was given up before this obstruction."""
    if shut.gap:
        return say(
            "obstruction.narrow",
            place=definite(place),
            width_m=shut.obstruction.width_m,
            where=spot_of(facts, shut.obstruction.middle),
        )
    return say(
        "obstruction.blocked",
        place=definite(place),
        width_m=max(0.1, round(shut.obstruction.width_m, 1)),
        where=spot_of(facts, shut.obstruction.middle),
        time=clock_time(shut.since_unix_s + shut.local_offset_s),
    )


def tell_occupied(place: Bilingual, near_m: float) -> Bilingual:
    """Return the sentence of a goal on which something stands, with how near the robot came."""
    return message(Code.GOAL_OCCUPIED, place=definite(place), metres=f"{near_m:.1f}")


def tell_doubt(facts: SiteView, doubt: RouteDoubt) -> Bilingual:
    """Return the sentence of a way that is doubted: why it bends, or goes on all the same."""
    return say(f"route_doubt.{doubt.code}", where=spot_of(facts, doubt.at_m))


def spot_of(facts: SiteView, point: tuple[float, float]) -> Bilingual:
    """Name a point of ``map``: the door between two rooms, else the room."""
    rooms = [t for t in facts.targets.values() if t.room and t.polygon is not None]
    inside = [room for room in rooms if contains(room.polygon or (), *point)]
    here = min(inside, key=lambda room: area_m2(room.polygon or ()), default=None)
    if here is None:
        return say("obstruction.at_point")
    others = [(border_distance_m(r.polygon or (), *point), r.name) for r in rooms if r is not here]
    far_m, other = min(others, key=lambda each: each[0], default=(inf, here.name))
    if not far_m <= DOOR_M:
        return say("obstruction.in_room", room=here.name)
    return say("obstruction.at_door", room=here.name, other=other)
