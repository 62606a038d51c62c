"""Say what becomes of a round without one of its places, or with one first: "not the bathroom".

Pure. Laws: the order goes through several places and does the same at each: it drives there, or
looks there with one question; the place is one of them, and at least one other is left. What it did
already is not begun anew. What is in doubt stays as it was said.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.language.commands import (
    LeaveOutCommand,
    intent_of,
    read_absent_place,
    read_denied_place,
    read_first_place,
    read_left_out,
)
from planner.language.folding import has_chinese
from planner.language.motion_guard.clause_moods import Mood
from planner.language.motion_guard.clauses import read_clauses
from planner.language.motion_guard.mentioned_names import find_places, place_alone
from planner.language.object_names import resolve
from planner.language.person_names import is_given_name
from planner.mission.place_words import name_place, names_of, room_of, write_drive

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.mission.state import Mission
    from planner.plan import StepRecord
    from planner.site.site_view import SiteView

_ROUND = frozenset({"go_to", "look"})
_WAY_HOME = {
    "come_back": ("then come back", "再回来"),
    "return_home": ("then go home", "再回去充电"),
}
_CLAUSE_END = re.compile(r"[,，;；.。!！](?!$)")
_ARTICLE = re.compile(r"^(?:the|my|our|your|an?|some|any) ", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class _Round:
    """Hold what an order still does, at each of several places the same."""

    stops: tuple[str, ...]
    looked: frozenset[str] = frozenset()
    """At which of them it looks."""
    asked: str | None = None
    """With which question; None: it looks nowhere."""
    patrols: bool = False
    home: str | None = None
    """The step that leads back at its end."""


def leave_out(text: str, last: Mission, facts: SiteView) -> str | None:
    """Return what is left of an order without the place that a person leaves out; None in doubt.

    Args:
        text: as it was said.
        last: the newest order.
        facts: the site.
    """
    absent = read_absent_place(text)
    place = _only_place(text, read_left_out(text) or absent, facts)
    whole = _read_round(last, facts) if place is not None else None
    if place is None or whole is None or (absent is not None and whole.asked is None):
        return None
    left = [stop for stop in whole.stops if place not in (stop, room_of(facts, stop))]
    return _write_round(whole, left, last, facts) if len(left) < len(whole.stops) else None


def put_first(text: str, last: Mission, facts: SiteView) -> str | None:
    """Return an order that goes to one of its places before all others; None in doubt.

    Args:
        text: as it was said.
        last: the newest order.
        facts: the site.
    """
    place = _only_place(text, read_first_place(text), facts)
    whole = _read_round(last, facts) if place is not None else None
    if place is None or whole is None or place not in whole.stops[1:]:
        return None
    stops = [place, *(stop for stop in whole.stops if stop != place)]
    return _write_round(whole, stops, last, facts)


def is_destination_denied(text: str, last: Mission, facts: SiteView) -> bool:
    """Tell whether a place that an order still goes to is said not to be meant.

    What follows behind a mark, "not the bedroom, he's reading in the study", changes nothing of it.
    """
    place = _only_place(text, read_denied_place(text), facts)
    first = _CLAUSE_END.split(text.strip(), maxsplit=1)[0]
    other = intent_of(text) if first != text else None
    if place is None and first != text and (other is None or isinstance(other, LeaveOutCommand)):
        place = _only_place(first, read_denied_place(first) or read_left_out(first), facts)
    return place is not None and place in _places_ahead(last)


def excludes_way(text: str, last: Mission, facts: SiteView) -> bool:
    """Tell whether a place that an order still goes to stands in what a sentence denies."""
    names = names_of(facts)
    denied = (c.text for c in read_clauses(text, names) if c.mood is Mood.DENIED)
    places = find_places(" | ".join(denied), names)
    return not _places_ahead(last).isdisjoint(each.id for each in places)


def _places_ahead(last: Mission) -> set[str]:
    ahead = last.steps[last.step :] if not last.has_ended else ()
    return {place for step in ahead for place in (step.place, *step.places) if place}


def _only_place(text: str, words: str | None, facts: SiteView) -> str | None:
    """Return the place that words name, where the sentence names no other."""
    names = names_of(facts)
    place = place_alone(words, names) if words is not None else None
    return place if {each.id for each in find_places(text, names)} == {place} else None


def _read_round(last: Mission, facts: SiteView) -> _Round | None:
    """Return the round that an order still makes; None where it does more, or something else."""
    ahead = last.steps[last.step :]
    if last.has_ended or any(step.depth for step in ahead) or last.speed_share != 1.0:
        return None  # a slow round would go on fast
    home = ahead[-1].kind if len(ahead) > 1 and ahead[-1].kind in _WAY_HOME else None
    ahead = ahead[:-1] if home is not None else ahead
    if len(ahead) == 1 and ahead[0].kind == "patrol":
        return _Round(ahead[0].places, patrols=True, home=home)
    if len(ahead) == 1 and ahead[0].kind == "find" and ahead[0].place is None:
        asked = _look_for(ahead[0].object or "", chinese=has_chinese(last.order_text))
        rooms = (each.id for each in facts.targets.values() if each.room)
        left = tuple(room for room in rooms if room not in ahead[0].rooms)
        return _Round(left, frozenset(left), asked, home=home) if asked is not None else None
    return _read_stops(ahead, home, facts)


def _read_stops(ahead: Sequence[StepRecord], home: str | None, facts: SiteView) -> _Round | None:
    """Return drives, or looks with one question, through several places."""
    stops = tuple(dict.fromkeys(step.place for step in ahead if step.place is not None))
    questions = {step.text for step in ahead if step.kind == "look"}
    looked = frozenset(step.place for step in ahead if step.kind == "look" and step.place)
    asked = next(iter(questions), None)
    several = len(questions) > 1 or (asked is not None and find_places(asked, names_of(facts)))
    if any(step.kind not in _ROUND for step in ahead) or len(stops) < 2 or several:
        return None
    return _Round(stops, looked, asked, home=home)


def _write_round(whole: _Round, stops: Sequence[str], last: Mission, facts: SiteView) -> str | None:
    """Return the order to make a round of these places; None of none, and where deeds differ."""
    chinese = has_chinese(last.order_text)
    if not stops or (whole.asked is not None and not whole.looked >= set(stops)):
        return None
    if whole.patrols:
        names = [name_place(facts, stop, chinese, last.order_text) for stop in stops]
        parts = [f"巡逻{'、'.join(names)}" if chinese else f"patrol the {' and the '.join(names)}"]
    else:
        parts = [_write_stop(facts, stop, whole.asked, last) for stop in stops]
    if whole.home is not None:
        ending = _WAY_HOME[whole.home][1 if chinese else 0]
        return f"{_join(parts, chinese=chinese)}{'，' if chinese else ', '}{ending}"
    return _join(parts, chinese=chinese)


def _join(parts: Sequence[str], *, chinese: bool) -> str:
    return ("，再" if chinese else ", then ").join(parts)


def _write_stop(facts: SiteView, stop: str, asked: str | None, last: Mission) -> str:
    drive = write_drive(facts, stop, last.order_text)
    if asked is None:
        return drive
    asked = asked.strip(" ?？.。!！")
    return f"{drive}{asked}" if has_chinese(last.order_text) else f"{drive} and {asked}"


def _look_for(thing: str, *, chinese: bool) -> str | None:
    """Return the question whether a thing or somebody is there; None of one who is called."""
    kind = resolve(thing)
    if has_chinese(thing) is not chinese or kind is None or is_given_name(thing):
        return None
    if chinese:
        return f"看看有没有{thing}"
    if kind[0] == "person":
        return "see if anybody is there"
    noun = _ARTICLE.sub("", thing)
    some = "are any" if noun.endswith("s") else f"is a{'n' if noun[0] in 'aeiou' else ''}"
    return f"see if there {some} {noun}"
