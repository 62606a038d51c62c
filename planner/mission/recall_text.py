"""Tell memories in words: what, where, when, how sure. Pure; honest about age and doubt."""

from __future__ import annotations

from datetime import datetime
from typing import TYPE_CHECKING

from planner.language.catalogue import join, message, say
from planner.language.object_names import name_object, tell_words
from planner.memory import FACT, PERSON
from planner.plan import Code
from planner.skills.result_text import name_one

if TYPE_CHECKING:
    from planner.memory import Memo
    from planner.mission.effects import AskMemory
    from planner.plan import Bilingual, Span
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
        what = say("memory.asked_when", what=what, span=tell_span(ask.when))
    return what


def _offer(ask: AskMemory) -> tuple[Bilingual, ...]:
    """Offer what would find out: an order, which the person must give."""
    if not ask.label or ask.label == PERSON or ask.when is not None or ask.witnessed:
        return ()
    return (say("memory.offer", what=tell_words(ask.label)),)


def tell_span(when: Span) -> Bilingual:
    """Name a time that was asked about."""
    return say(f"memory.span_{when}")


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
