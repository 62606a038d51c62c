"""Tell what the robot did: the goals of a time, each with how it ended. Pure.

Law: what a model said of a picture, or wrote after it, is not among it.
"""

from __future__ import annotations

from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from planner.language.catalogue import join, message, say
from planner.plan import Code, GoalState, StepState, say_same

if TYPE_CHECKING:
    from planner.mission.state import Mission, MissionState
    from planner.plan import Bilingual, Span, StepRecord


MOST_TOLD = 6
_ORDER, _TOLD = 60, 90  # characters
_NO_DEEDS = frozenset({"recall", "decide", "say", "ask", "use_tool"})
_BEGUN = frozenset({StepState.RUNNING, StepState.SUCCEEDED, StepState.FAILED})
_UNBEGUN = frozenset({GoalState.PLANNING, GoalState.QUEUED, GoalState.REFUSED})


def find_deeds(
    book: MissionState, asking: str, bounds: Bounds, place: str | None = None
) -> tuple[Mission, ...]:
    """Return the goals of a time for which something was done, oldest first.

    Args:
        book: all goals at hand.
        asking: the goal that asks.
        bounds: since and until [s], by the wall clock.
        place: only what was done there; None: wherever it was done.
    """
    since, until = bounds
    found = [
        mission
        for mission in book.missions.values()
        if mission.id != asking
        and mission.state not in _UNBEGUN
        and _has_done(mission)
        and (place is None or any(_was_at(step, place) for step in mission.steps))
        and (since is None or mission.updated_unix_s >= since)
        and (until is None or mission.created_unix_s <= until)
    ]
    return tuple(sorted(found, key=lambda m: m.order))


def _has_done(mission: Mission) -> bool:
    """Return whether anything of a goal was begun: a plan that was declined is no deed."""
    moved = mission.outcome is not None and (mission.outcome.metres or 0.0) > 0.0
    deeds = [step for step in mission.steps if step.kind not in _NO_DEEDS]
    return bool(deeds) and (moved or any(step.state in _BEGUN for step in deeds))


def _was_at(step: StepRecord, place: str) -> bool:
    """Return whether a step brought the robot to a place, or looked round in it."""
    if step.kind in _NO_DEEDS or any(stop.place == place and stop.shut for stop in step.stops):
        return False
    reached = step.reached is not None and place in (step.reached.place, step.reached.room)
    done = step.state is StepState.SUCCEEDED and place in (step.place, *step.places)
    seen = any(stop.place == place for stop in step.stops)
    return reached or done or seen or place in step.places[: step.visited or 0]


def tell_deeds(
    deeds: tuple[Mission, ...], when: Span | None, now: datetime, place: Bilingual | None = None
) -> Bilingual:
    """Return the newest deeds in their order, and how many there were before.

    Args:
        deeds: the goals, oldest first.
        when: the time that was asked about.
        now: by people's clock.
        place: the place that was asked about.
    """
    span = say(f"memory.span_{when}") if when else say("memory.span_ever")
    at = "_at" if place is not None else ""
    if not deeds:
        what = say(f"memory.deeds_of{at}", span=span, place=place)
        return message(Code.NOT_REMEMBERED, what=what)
    told = [_tell(mission, now) for mission in deeds[-MOST_TOLD:]]
    more = len(deeds) - len(told)
    code = f"memory.deeds{'_more' if more else ''}{at}"
    head = say(code, span=span, count=len(deeds), more=more, place=place)
    return join((head, *told))


def _tell(mission: Mission, now: datetime) -> Bilingual:
    at = datetime.fromtimestamp(mission.created_unix_s).astimezone()
    clock = f"{at:%H:%M}" if at.date() == now.date() else f"{at:%Y-%m-%d %H:%M}"
    text = mission.text[:_ORDER]
    return say("memory.deed", at=clock, text=text, result=_result(mission))


def _result(mission: Mission) -> Bilingual:
    """Return how a goal ended; where a picture was read for it, its state alone."""
    read = any(step.read is not None for step in mission.steps)
    if mission.outcome is None or read or not mission.has_ended:
        return say(f"memory.state_{mission.state.value}")
    told = mission.outcome.message
    if max(len(told.en), len(told.zh)) <= _TOLD:
        return told
    cut = say_same("…")
    return say(
        "memory.cut",
        text=told.model_copy(update={"en": told.en[:_TOLD], "zh": told.zh[:_TOLD]}),
        cut=cut,
    )


Bounds = tuple[float | None, float | None]
"""Since and until, in seconds of the wall clock; None: unbounded."""
_HOURS = {"today": (0, 24), "morning": (5, 12), "afternoon": (12, 18), "evening": (18, 24)}


def bounds_of(when: Span | None, now: datetime) -> Bounds:
    """Return since and until; a part of the day that has not begun means yesterday's."""
    midnight = now.replace(hour=0, minute=0, second=0, microsecond=0)
    match when:
        case None:
            return None, None
        case "hour":
            return (now - timedelta(hours=1)).timestamp(), now.timestamp()
        case "week":
            return (now - timedelta(days=7)).timestamp(), now.timestamp()
        case "yesterday":
            return _day_before(midnight).timestamp(), midnight.timestamp()
        case "night":  # of the evening before until the morning
            since = _day_before(midnight).replace(hour=18)
            return since.timestamp(), midnight.replace(hour=6).timestamp()
    first, last = _HOURS[when]
    if now < midnight.replace(hour=first):
        midnight = _day_before(midnight)
    until = midnight.replace(hour=last) if last < 24 else midnight + timedelta(days=1)
    return midnight.replace(hour=first).timestamp(), until.timestamp()


def _day_before(midnight: datetime) -> datetime:
    """Return the midnight before; a day on which clocks change has 23 or 25 hours."""
    before = (midnight - timedelta(hours=12)).astimezone()
    return before.replace(hour=0, minute=0, second=0, microsecond=0)
