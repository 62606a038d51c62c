"""Say what "it" and "there" stand for that lean on the goal before: the one thing, the one place.

Pure. Law: a word is put in the pronoun's place only where the newest order speaks of one thing, or
of one place, and the sentence names nothing else that could be meant; else it stays as it was said,
for a brain to ask about. A plan that waits for a yes, or got a no, names nothing that a person did
not. What comes of it is an order like any other.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.motion_guard.mentioned_names import find_places, plain
from planner.mission.place_words import names_of
from planner.plan import GoalState

if TYPE_CHECKING:
    from planner.mission.state import Mission
    from planner.site.site_view import SiteView

_SOUGHT = frozenset({"find", "count", "go_to_object", "recall"})
_LEAD = (
    r"(?:(?:please|ok|okay|well|then|now|so|just|and|go|hey|robot|no|yes|alright|all right|right"
    r"|(?:can|could|would|will) you)[ ,]+)*"
)
_IT = r"(?:it|them|him|her)"
_ABOUT_THING = re.compile(
    rf"(?P<head>{_LEAD}(?:(?:go|come|drive) (?:and )?)?(?:(?:have a )?(?:look|search|hunt) for"
    rf"|find|seek|locate|count|(?:go|drive|come|move) (?:right |back |up |over )*to))"
    rf" {_IT}(?P<rest>(?: (?!and |then )[a-z' ]+)?)"
)
_WAS = re.compile(
    r"(?:and )?(?:was|were) (?:it|they|he|she|that) (?P<where>(?:in|at|on|near|by) .+)"
)
_THERE = re.compile(
    rf"(?P<head>{_LEAD}(?:(?:what (?:all )?)?(?:did|have) you [a-z' ]+?|who (?:was|is|were)"
    r"|(?:was|were|is) (?:some|any)(?:body|one))) (?:in |over )?there"
)
_ABOUT_THING_ZH = re.compile(
    r"(?P<head>(?:请|那|那就|好|你|,|再|帮我)*(?:去[^,找]{1,8})?(?:帮我)?(?:找|数|寻找)(?:一?下|一?找)?)"
    r"(?:它们?|他们?|她们?)(?P<rest>)"
)
_SEEK_ZH = re.compile(
    r"(?:再|那|那就|然后|也|请|帮我|,)*(?P<head>去[^,找看]{1,8})(?:找一?找看?|找一下|找看看)"
)
_WAS_ZH = re.compile(
    r"(?:它|他|她|那)?(?:是)?在(?P<where>[^,看见找]{1,8}?)(?:看到|看见|见到|找到|发现)的"
)
_THERE_ZH = re.compile(
    r"(?P<head>(?:那)?你?在?)(?:那里|那儿|那边)(?P<rest>(?:都|有没有|有)?(?:看到|看见|见到|发现)了?"
    r"(?:些)?(?:什么|啥|谁|人).*)"
)


_FOUND_ZH = re.compile(r"你?(?:有没有)?找(?:到|着)(?P<what>[^了,]{0,6})了?(?P<asks>吗|没有?)?")
_SAW = re.compile(
    r"(?:(?:so|and|well|ok|okay)[ ,]+)*"
    r"(?:see|seen|saw|spot|spotted|notice|noticed|meet|met|find|found)"
    r" (?P<what>(?:any|some)(?:one|body|thing)(?: [a-z]+){0,2}|any [a-z]+(?: [a-z]+)?)"
)
_SAW_ZH = re.compile(
    r"你?(?:刚才|刚刚|一路上|路上)?(?:有没有)?(?:看到|看见|见到|发现|碰到|遇到)(?:过)?"
    r"(?P<what>[^了,在]{1,6}?)(?:了没有?|了吗|没有?|了|吗)?"
)
_ASKS_ZH = re.compile(r"没有?$|吗$|有没有")
_LOOKED = frozenset({"find", "count", "look", "patrol", "follow"})


def name_pronouns(text: str, last: Mission, facts: SiteView) -> str:
    """Return a sentence with the thing or place of the last order for its pronoun."""
    said = plain(text).strip(" .,!?;。，！？；")
    chinese = has_chinese(said)
    found = _FOUND_ZH.fullmatch(said)
    if found is not None and (found["asks"] or text.rstrip().endswith(("?", "？"))):
        return _found_in_chinese(found["what"], last) or text
    if text.rstrip().endswith(("?", "？")) or chinese:
        seen = _ask_what_was_seen(said, last, chinese=chinese)
        if seen is not None:
            return seen
    said = said.removesuffix("吗").removesuffix("呢") if chinese else said
    thing, place = _thing_of(last, chinese=chinese), _place_of(last, facts, chinese=chinese)
    return _write_out(said, thing, place, chinese=chinese) or text


def _write_out(said: str, thing: str | None, place: str | None, *, chinese: bool) -> str | None:
    sought = (_ABOUT_THING_ZH if chinese else _ABOUT_THING).fullmatch(said)
    if sought is not None and thing is not None:
        gap = "" if chinese else " the "
        return f"{sought['head']}{gap}{thing}{sought['rest']}"
    in_room = _SEEK_ZH.fullmatch(said) if chinese and thing is not None else None
    if in_room is not None:
        return f"{in_room['head']}找{thing}"
    was = (_WAS_ZH if chinese else _WAS).fullmatch(said)
    if was is not None and thing is not None:
        where = was["where"]
        return f"你在{where}看到过{thing}吗" if chinese else f"did you see the {thing} {where}"
    there = (_THERE_ZH if chinese else _THERE).fullmatch(said)
    if there is not None and place is not None:
        if chinese:
            return f"{there['head'].removesuffix('在')}在{place}{there['rest']}"
        return f"{there['head']} in the {place}"
    return None


def _ask_what_was_seen(said: str, last: Mission, *, chinese: bool) -> str | None:
    """Return "see anyone?" as the question about before that it is once a look is over."""
    looked = last.has_ended and any(step.kind in _LOOKED for step in last.steps)
    found = (_SAW_ZH if chinese else _SAW).fullmatch(said) if looked else None
    if found is None or (chinese and not _ASKS_ZH.search(said)):
        return None
    what = found["what"]
    return f"你看到过{what}吗" if chinese else f"did you see {what}"


def _found_in_chinese(what: str, last: Mission) -> str | None:
    """Return 找到了吗 after a search as the question about before that it is then."""
    looked = any(step.kind in _LOOKED for step in last.steps)
    thing = what or _thing_of(last, chinese=True)
    return f"你看到过{thing}吗" if looked and thing else None


def _was_only_proposed(last: Mission) -> bool:
    """Tell whether a plan was laid before a person, and nothing of it was begun."""
    waits = last.state in (GoalState.AWAITING_CONFIRMATION, GoalState.CANCELLED)
    return waits and not last.has_begun


def _thing_of(last: Mission, *, chinese: bool) -> str | None:
    """Return the one thing that an order speaks of, in its own words and in this language."""
    things = {step.object for step in last.steps if step.kind in _SOUGHT and step.object}
    thing = things.pop() if len(things) == 1 else None
    if thing is not None and _was_only_proposed(last) and thing not in plain(last.order_text):
        return None
    if thing is None or has_chinese(thing) is not chinese:
        return None
    return re.sub(r"^(?:the|my|our|your|an?) ", "", thing)


def _place_of(last: Mission, facts: SiteView, *, chinese: bool) -> str | None:
    """Return the name of the one place that an order speaks of."""
    named = (place for step in last.steps for place in (step.place, *step.places))
    places = {place for place in named if place in facts.targets}
    if _was_only_proposed(last):
        places &= {each.id for each in find_places(last.order_text, names_of(facts))}
    if len(places) != 1:
        return None
    return facts.targets[places.pop()].name.of("zh" if chinese else "en")
