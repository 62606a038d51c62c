"""Make steps of what a template about looking found: find, count, look, questions what is there."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.noun_phrases import HOW_ZH, by_neighbour, is_known
from planner.language.grammar.parse_result import ClauseProblem, Meaning, Reading, Steps, ahead
from planner.language.grammar.step_builders import (
    arrive,
    look_everywhere,
    offer_search,
    place_of,
)
from planner.language.grammar.step_builders import count as count_things
from planner.language.grammar.step_builders import find as find_thing
from planner.language.grammar.step_builders import look as look_at
from planner.plan import Code, Count, Step

if TYPE_CHECKING:
    from planner.language.templates.template_file import TemplateFind


def _place_in(found: TemplateFind, name: str = "at") -> str | None:
    return found[name] or None


def find(found: TemplateFind, reading: Reading) -> Meaning:
    """Find a thing, at a place where one is named."""
    return find_thing(found["what"], _place_in(found), reading)


def find_in_unknown(found: TemplateFind, reading: Reading) -> Meaning:
    """Ask about a place that is not known, where something is to be found there."""
    place = place_of(found["nowhere"], reading)
    if isinstance(place, ClauseProblem):
        return place
    return find_thing(found["what"], found["nowhere"], reading)


def find_by(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Find a thing by its neighbour; on or near a place of the site, it is found at that place."""
    by, how = found["by"], found["how"]
    marked = re.fullmatch(MARK, by) is not None
    if marked and not how.startswith(("under", "be", "close")) and how.isascii():
        return None
    named = by_neighbour(found["what"], how, by, reading)
    if named is None:
        return None if how.isascii() else reading.problem(Code.NOT_UNDERSTOOD, found[0])
    return find_thing(named, _place_in(found) or (by if marked else None), reading)


def find_each(found: TemplateFind, reading: Reading) -> Meaning:
    """Find one thing after the other: "杯子和球"; in 暖和的毯子, 和平鸽 no word joins things."""
    parts = re.split(r"和|以及|还有|与", found["what"])
    several = all(is_known(part, reading.things) for part in parts)
    steps: tuple[Step, ...] = ()
    meaning: Meaning = Steps(())
    for what in parts if several else [found["what"]]:
        meaning = find_thing(what, None, reading)
        if not isinstance(meaning, Steps):
            return meaning
        steps += meaning.steps
    return replace(meaning, steps=steps) if isinstance(meaning, Steps) else meaning


_COUNTING = re.compile(r"\b(?:there|are|is|items?|objects?)\b")
_UNIT = r"(?:(?:个|只|张|位|把|本|台|瓶|杯|名|条|件|辆|盒|罐|双|支|口|盏)(?!子))?"
_AND_MANY = re.compile(rf"(?:(?:和|与|跟|以及|还有|、)有?|(?<!有))(?:几|多少){_UNIT}(?=.)")


_SEEN_HERE = re.compile(r"^count .* (?:here|there|you see)$|^有[几多](?!.*[\ue000-\ue8ff])")
"""It asks for what is in sight: that is looked at."""


def count(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Count one kind after the other: "几个人和几把椅子"."""
    place = _place_in(found, "at2") or _place_in(found)
    if reading.scene.place is None and _SEEN_HERE.search(found[0]):
        return None
    said = found["what"]
    if not has_chinese(said):
        said = " ".join(_COUNTING.sub(" ", f"{said} {found['how']}").split()) or said
    steps: tuple[Step, ...] = ()
    meaning: Meaning = Steps(())
    for what in _AND_MANY.split(said):
        meaning = count_things(what, place, reading)
        if not isinstance(meaning, Steps):
            return meaning
        steps += meaning.steps
        reading = ahead(reading, meaning)
    return replace(meaning, steps=steps) if isinstance(meaning, Steps) else meaning


_EXCLAIMS = re.compile(
    r"what (?:(?:an?|such|luck|joy|bliss|nonsense|cheek)\b|(?:beautiful|lovely|nice|great|wonderful"
    r"|gorgeous|pretty|good|bad|fine|awful|terrible|horrible|strange|funny|fun|weather)\b"
    r"(?!.*\b(?:is|are|was|were|do|does|did|can)\b))"
)
"""What asks; "what a lovely view from the kitchen!" only exclaims."""
_ASKING = re.compile(r"[吗谁啥哪几]|[什怎]么|么$|如何|多少|有没有|有无|是否|是不是")
"""What makes a question of words that else only tell: "客厅的灯亮着" asks for nothing."""


def look(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Look, at a place where one is named; said flatly it asks for nothing."""
    said = reading.marked.text.rstrip(" .。!")
    asks = said.endswith("?") or "请问" in said or _ASKING.search(found[0]) is not None
    if (found["flat"] and not asks) or _EXCLAIMS.match(found[0]):
        return None
    return look_at(found[0], _place_in(found), reading)


def look_there(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Look where the clauses before have led, or here."""
    if found["flat"] or _EXCLAIMS.match(found[0]):
        return look(found, reading)
    return look_at(found[0], "there" if reading.scene.place else None, reading)


def look_here(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Look where nothing named a place; counting elsewhere is left to other templates."""
    return None if reading.scene.place else look_at(found[0], None, reading)


def look_all(found: TemplateFind, reading: Reading) -> Meaning:
    """Look in every room."""
    return look_everywhere(found[0], reading)


def report(_found: TemplateFind, reading: Reading) -> Meaning | None:
    """Pass over "and tell me" after something was looked at: the outcome tells."""
    return Steps(()) if reading.scene.seen else None


def tell_back(_found: TemplateFind, reading: Reading) -> Meaning | None:
    """Add nothing behind "come back": who is back tells what came of the order by itself."""
    return Steps(()) if reading.scene.kind == "come_back" else None


_NOBODY = frozenset(
    {"i", "it", "they", "them", "we", "you", "that", "this", "everybody", "everyone"}
)


def seek(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Offer a search for what a question asks about."""
    return None if found["what"] in _NOBODY else offer_search(found["what"], found[0], reading)


_SPOT = re.compile(rf"(?:(?P<prep>[a-z ]+) )?(?:(?:the|a|an|my|our|your|this|that) )?{MARK}")


def next_thing(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Read a bare thing after one that is looked for, or a bare place to look in too."""
    kind, before = reading.scene.kind, reading.scene.thing
    if kind not in ("find", "count"):
        return None
    act = find_thing if kind == "find" else count_things
    if found["spot"]:
        return act(before, found["spot"], reading) if before else None
    if not found["what"].startswith(("the ", "a ", "an ", "some ", "my ")):
        return None
    return act(found["what"], _place_in(found), reading)


_SEVERAL = re.compile(r"[和与跟几]|以及|还有|多少")
_ASIDE = re.compile(rf"{HOW_ZH}的")
"""The neighbour of a neighbour."""
_LEAD = re.compile(r"^(?:(?:所有|全部)的?|[把张台个])")
"""Before a neighbour's name: all of them, or what "那把" leaves, whose 那 is taken for "so"."""


def _name_by_neighbour(found: TemplateFind, reading: Reading) -> str | None:
    """Return the thing's words with its neighbour's, where eyes know that one; else None."""
    by, how, what = found["by"], found["how"], found["what"] or "东西"
    known = by_neighbour(what, how, _LEAD.sub("", by), reading)
    if known is None or _SEVERAL.search(what) or _ASIDE.search(by):
        return None
    every = by.startswith(("所有", "全部"))
    return f"{by}{how}的{reading.marked.restore(what)}"[:80] if every else known


def count_by(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Count things by their neighbour."""
    named, place = _name_by_neighbour(found, reading), place_of(_place_in(found), reading)
    if named is None or isinstance(place, ClauseProblem):
        return place if named is not None and isinstance(place, ClauseProblem) else None
    steps = (*arrive(place, reading), Count(object=named, place=place))
    return Steps(steps, thing=named, seen=True)


def look_by(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Look where it is asked about what stands there; said flatly it is no question."""
    flat = found["flat"] and not reading.marked.text.rstrip(" 。!").endswith("?")
    if flat or _name_by_neighbour(found, reading) is None:
        return None
    return look_at(found[0], _place_in(found) or "那里", reading)
