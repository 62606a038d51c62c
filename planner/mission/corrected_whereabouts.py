"""Say what an order means once a person says where else somebody is: "no, she's in the study now".

Pure. Laws: the order speaks of one person, whom the pronoun fits, or searches for one thing; it
names one place at most, and the place that is denied is that one.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, place_alone, plain
from planner.language.person_names import people_named
from planner.mission.antecedents import fits
from planner.mission.place_words import names_of, put_place
from planner.mission.whereabouts import THEM, put_person_at, search_of_place, sought_thing

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.site.site_view import SiteView

MAX_READ = 90
_ENDS = " .!,;:。~…，；！"
_NO = (
    r"(?:(?:no|nope|wait|oh|ah|sorry|actually|hang on|hold on|wrong room|wrong|not there"
    r"|oops)[ ,.!;]+)"
)
_AT = r"(?:in|at|on|by|near|out in|over in|up in|down in)"
_NAME = r"(?:(?:the|my|our|his|her|their) )?[a-z][a-z' -]{1,30}?"
_MOVED = re.compile(
    rf"(?P<no>{_NO}*)(?P<who>he|she|they|it)(?:'s|'re| is| are)(?: (?:now|actually|really|just|back"
    rf"|already|still))*(?: not {_AT} (?P<not>{_NAME})[,;.]? (?:but |(?:he|she|they|it)(?:'s|'re"
    rf"| is| are) )?)?(?: ?{_AT} )(?P<place>{_NAME})"
    rf"(?: (?:now|at the moment|right now|today|again|already|instead))*"
    rf"(?:[,;.]? (?:and )?not (?:{_AT} )?(?P<not2>{_NAME})(?: any ?more| any longer)?)?"
)
_NO_ZH = r"(?:[哎哦噢啊诶欸唉呀]|不对|不是|不|错了|等等|等一下|抱歉|不好意思|,)"
_MOVED_ZH = re.compile(
    rf"(?P<no>{_NO_ZH}*)(?P<who>他|她|它)们?(?:现在|已经|刚才?|其实)*"
    r"(?:不在(?P<not>[^,在]{1,8}?)(?:了)?,?(?:[他她它]们?)?(?:现在|已经|而是|是)*)?"
    r"(?:去|到|跑到|回)?在?(?P<place>[^,不在]{1,8}?)(?:里|那边|那儿)?(?:呢|了|啦)*"
    r"(?:,(?:已经)?(?:不在|不是)(?P<not2>[^,]{1,8}?)(?:了)?)?(?:呢|了|啦)*"
)


def correct_whereabouts(text: str, last: Mission, facts: SiteView) -> str | None:
    """Return the order before at the place where its person is said to be instead; None in doubt.

    Args:
        text: as it was said.
        last: the newest order.
        facts: the site.
    """
    said = plain(text).strip(_ENDS)
    chinese = has_chinese(said)
    if chinese:
        said = re.sub(r"[，。；!！]", ",", "".join(said.split()))
    if not 0 < len(said) <= MAX_READ or text.rstrip().endswith(("?", "？")):
        return None
    found = (_MOVED_ZH if chinese else _MOVED).fullmatch(said)
    if found is None or (chinese and "在" not in said):
        return None
    denied = found["not"] or found["not2"]
    if not (found["no"] or denied):
        return None
    names = names_of(facts)
    place = place_alone(found["place"], names)
    before = {each.id for each in find_places(last.order_text, names)}
    if place is None or place in before or len(before) > 1:
        return None
    if denied and before and place_alone(denied, names) not in before:
        return None
    return _order_there(found["who"], last, place, facts, has_place=bool(before))


def _order_there(
    who: str, last: Mission, place: str, facts: SiteView, *, has_place: bool
) -> str | None:
    """Return the order at another place, for whom or what a pronoun means."""
    people = people_named(last.order_text)
    if who in ("it", "它"):
        return search_of_place(last, place, facts) if sought_thing(last) and not people else None
    pronoun = THEM.get(who)
    if len(people) != 1 or (pronoun is not None and not fits(pronoun, people[0])):
        return None
    if has_place:
        return put_place(facts, last.order_text, place, "")
    tongue = "zh" if has_chinese(last.order_text) else "en"
    return put_person_at(last.order_text, people[0], facts.targets[place].name.of(tongue), who)
