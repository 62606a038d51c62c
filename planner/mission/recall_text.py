"""Tell memories in words: what, where, when, how sure, and what the robot did, goal by goal.

Pure; honest about age and doubt. Law: what a model said of a picture, or wrote after it, is not
among it.
"""

from __future__ import annotations

from datetime import datetime, timedelta
from typing import TYPE_CHECKING

from planner.language.catalogue import join, message, say
from planner.language.object_names import name_object, tell_words
from planner.memory import FACT, PERSON, Memo
from planner.plan import Bilingual, Code, GoalState, Span, StepRecord, StepState, say_same
from planner.skills.result_text import name_one

if TYPE_CHECKING:
    from planner.mission.effects import AskMemory
    from planner.mission.state import Mission, MissionState
    from planner.site.site_view import SiteView


MOST_NAMED, MOST_LISTED = 4, 8
"""Memories in one answer: of what was named, and of everything."""
UNSURE = 0.75
"""Confidence under which it is said that the robot is not sure."""
STALE_S = 90.0
"""What was seen longer ago may have moved."""
VISIT_S = 120.0
"""What was in view so long was there from then to then."""


def tell_memos(
    facts: SiteView, memos: tuple[Memo, ...], ask: AskMemory, now: datetime
) -> Bilingual:
    """Return the answer to a question: what fits, or that nothing does and what comes nearest."""
    fitting = tuple(m for m in memos if m.fits or not ask.label)
    if not fitting:
        nothing = message(Code.NOT_REMEMBERED, what=_name_question(facts, ask))
        near = [_tell(facts, memo, now) for memo in memos[:2]]
        return join((nothing, *((say("memory.nearest"), *near) if near else _offer(ask))))
    most = MOST_NAMED if ask.label else MOST_LISTED
    told = [_tell(facts, memo, now) for memo in fitting[:most]]
    if len(fitting) > most:
        told.append(say("memory.more", count=len(fitting) - most))
    newest = fitting[0]
    age_s = now.timestamp() - newest.last_unix_s
    if ask.label and ask.label != PERSON and newest.kind != FACT and age_s > STALE_S:
        told.append(say("memory.may_have_moved"))
    return join(told)


def _name_question(facts: SiteView, ask: AskMemory) -> Bilingual:
    what = say("memory.asked", what=tell_words(ask.label)) if ask.label else say("memory.anything")
    if ask.label == PERSON:
        what = say("memory.somebody")
    place = facts.targets.get(ask.place or "")
    if place is not None:
        what = say("memory.asked_in", what=what, place=place.name)
    if ask.when is not None:
        what = say("memory.asked_when", what=what, span=say(f"memory.span_{ask.when}"))
    return what


def _offer(ask: AskMemory) -> tuple[Bilingual, ...]:
    """Offer what would find out: an order, which the person must give."""
    if not ask.label or ask.label == PERSON or ask.when is not None or ask.witnessed:
        return ()
    return (say("memory.offer", what=tell_words(ask.label)),)


def _tell(facts: SiteView, memo: Memo, now: datetime) -> Bilingual:
    if memo.kind == FACT:
        return _tell_fact(facts, memo, now)
    what = name_one(memo.label, memo.color)
    place = facts.targets.get(memo.room or "")
    where = say("memory.in", place=place.name) if place is not None else say("memory.somewhere")
    if memo.support is not None:
        where = say("memory.on", where=where, what=name_object(memo.support))
    unsure = not memo.confidence >= UNSURE
    code = "memory.maybe_saw" if unsure else "memory.saw"
    return say(code, what=what, where=where, when=_tell_when(memo, now))


def _tell_fact(facts: SiteView, memo: Memo, now: datetime) -> Bilingual:
    when = tell_time(memo.last_unix_s, now)
    place = facts.targets.get(memo.room or "")
    if place is not None and not _names(memo.words, place.name):
        return say("memory.told_of", words=memo.words, when=when, place=place.name)
    return say("memory.told", words=memo.words, when=when)


def _names(words: str, name: Bilingual) -> bool:
    return name.en.casefold() in words.casefold() or name.zh in words


def _tell_when(memo: Memo, now: datetime) -> Bilingual:
    last = tell_time(memo.last_unix_s, now)
    if memo.last_unix_s - memo.first_unix_s < VISIT_S:
        return last
    first = datetime.fromtimestamp(memo.first_unix_s).astimezone()
    same = first.date() == datetime.fromtimestamp(memo.last_unix_s).astimezone().date()
    return say(
        "memory.since", last=last, first=f"{first:%H:%M}" if same else f"{first:%Y-%m-%d %H:%M}"
    )


def tell_time(at_unix_s: float, now: datetime) -> Bilingual:
    """Tell when something was as people do: "20 minutes ago, at 14:03", "yesterday at 14:03"."""
    at = datetime.fromtimestamp(at_unix_s).astimezone()
    clock, age_s = f"{at:%H:%M}", now.timestamp() - at_unix_s
    days = (now.date() - at.date()).days
    if age_s < 60.0:
        return say("memory.now")
    if age_s < 3600.0:
        minutes = int(age_s // 60)
        return say("memory.minute" if minutes == 1 else "memory.minutes", count=minutes, at=clock)
    if days == 0:
        hours = int(age_s // 3600)
        return say("memory.hour" if hours == 1 else "memory.hours", count=hours, at=clock)
    if days == 1:
        return say("memory.yesterday", at=clock)
    if days < 7:
        return say("memory.days", count=days, at=clock)
    return say("memory.date", date=f"{at:%Y-%m-%d}", at=clock)


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
    told = [_tell_deed(mission, now) for mission in deeds[-MOST_TOLD:]]
    more = len(deeds) - len(told)
    code = f"memory.deeds{'_more' if more else ''}{at}"
    head = say(code, span=span, count=len(deeds), more=more, place=place)
    return join((head, *told))


def _tell_deed(mission: Mission, now: datetime) -> Bilingual:
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
