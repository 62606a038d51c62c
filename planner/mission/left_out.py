"""Say what is left of an order without one of its places: "not the bathroom", 卧室就别进了.

Pure. Laws: the order goes through several places and does the same at each: it drives there, or
looks there with one question; the place that is left out is one of them, and at least one other is
left. What it did already is not begun anew. What is in doubt stays as it was said.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.commands import read_left_out
from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, place_alone
from planner.language.object_names import resolve
from planner.language.person_names import is_given_name
from planner.mission.outcomes import spot_at
from planner.mission.place_words import name_place, names_of, write_drive

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
_ARTICLE = re.compile(r"^(?:the|my|our|your|an?|some|any) ", re.IGNORECASE)


def leave_out(text: str, last: Mission, facts: SiteView) -> str | None:
    """Return what is left of an order without the place that a person leaves out; None in doubt.

    Args:
        text: as it was said.
        last: the newest order.
        facts: the site.
    """
    words = read_left_out(text)
    place = place_alone(words, names_of(facts)) if words is not None else None
    if place is None or last.has_ended:
        return None
    if {each.id for each in find_places(text, names_of(facts))} != {place}:
        return None
    ahead = last.steps[last.step :]
    if any(step.depth for step in ahead) or last.speed_share != 1.0:
        return None  # a slow round would go on fast
    home = _WAY_HOME.get(ahead[-1].kind) if len(ahead) > 1 else None
    ahead = ahead[:-1] if home is not None else ahead
    parts = _parts_without(ahead, place, last, facts)
    if not parts:
        return None
    chinese = has_chinese(last.order_text)
    ending = home[1 if chinese else 0] if home is not None else None
    return ("，再" if chinese else ", then ").join(parts) + (
        ("，" if chinese else ", ") + ending if ending is not None else ""
    )


def _parts_without(
    ahead: Sequence[StepRecord], place: str, last: Mission, facts: SiteView
) -> list[str]:
    """Return the orders that are left, one a place; none where that is in doubt."""
    chinese = has_chinese(last.order_text)
    if len(ahead) == 1 and ahead[0].kind == "patrol":
        stops = [stop for stop in ahead[0].places if not _is_at(facts, stop, place)]
        names = [name_place(facts, stop, chinese, last.order_text) for stop in stops]
        if not names or len(stops) == len(ahead[0].places):
            return []
        return [f"巡逻{'、'.join(names)}" if chinese else f"patrol the {' and the '.join(names)}"]
    if len(ahead) == 1 and ahead[0].kind == "find" and ahead[0].place is None:
        rooms = [each.id for each in facts.targets.values() if each.room]
        left = [room for room in rooms if room != place and room not in ahead[0].rooms]
        asked = _look_for(ahead[0].object or "", chinese=chinese)
        fits = place in rooms and place not in ahead[0].rooms and asked is not None
        return [_look_at(facts, room, asked or "", last) for room in left] if fits else []
    return _round_without(ahead, place, last, facts)


def _round_without(
    ahead: Sequence[StepRecord], place: str, last: Mission, facts: SiteView
) -> list[str]:
    """Return what is left of drives, or of looks with one question, through several places."""
    stops = [step.place for step in ahead if step.place is not None]
    left = [stop for stop in dict.fromkeys(stops) if not _is_at(facts, stop, place)]
    questions = {step.text for step in ahead if step.kind == "look"}
    looked = {step.place for step in ahead if step.kind == "look"}
    one_deed = len(questions) <= 1 and (not questions or looked >= set(left))
    if any(step.kind not in _ROUND for step in ahead) or len(stops) < 2 or not one_deed:
        return []
    if not left or len(left) == len(set(stops)):
        return []
    asked = next(iter(questions), None)
    if asked is None:
        return [write_drive(facts, stop, last.order_text) for stop in left]
    if find_places(asked, names_of(facts)):
        return []
    return [_look_at(facts, stop, asked, last) for stop in left]


def _is_at(facts: SiteView, stop: str, place: str) -> bool:
    """Tell whether a stop is a place, or stands in it."""
    target = facts.targets.get(stop)
    return stop == place or (target is not None and spot_at(facts, target.pose).room == place)


def _look_at(facts: SiteView, stop: str, asked: str, last: Mission) -> str:
    asked = asked.strip(" ?？.。!！")
    drive = write_drive(facts, stop, last.order_text)
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
