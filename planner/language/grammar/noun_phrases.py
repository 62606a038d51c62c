"""Read what a phrase names: a place, whole or with what adds nothing to it, or things.

A thing is one that eyes know, or more than one ("all the cups"): the robot drives up to one at a
time.
"""

from __future__ import annotations

import re

from planner.language.catalogue import say
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.parse_result import ClauseProblem, Meaning, Reading, Steps
from planner.plan import Code, GoTo, GoToObject

_THE_PLACE = r"(?:(?:the|a|my|our|your|this|that) )?"
_PLACE_EN = re.compile(
    rf"(?:(?P<near>next to|near|by|beside|close to|up to) |at |over to )?{_THE_PLACE}(?P<a>{MARK})"
    rf"(?: room| area)?(?: (?:in|of|inside) {_THE_PLACE}(?P<room>{MARK}))?"
)
_PLACE_ZH = re.compile(
    rf"(?:这个|那个|那边的|我的|我们的)?(?:(?P<room>{MARK})(?:里面?)?的?)?(?P<a>{MARK})"
    r"(?:(?P<near>的?(?:旁边|边上|附近|跟前|边|旁))|里面?|内|那边|那里|那儿|这边|这里|处)?"
)
_IT = re.compile(
    r"(?:(?:over|up|close|next) to )?(?:it|that|them|him|her)|[它他她]们?(?:那[里儿边])?"
)
_DETERMINER = re.compile(r"^(?:(?:the|a|an|my|our|your) )+")
_ZH_TAIL = re.compile(r"(?:里面?|内|那边|那里|那儿|这边|这里|旁边|附近|跟前)$")


def go_to(phrase: str, reading: Reading) -> Meaning:
    """Return the go-to step of a place phrase, or why there is none."""
    phrase = phrase.strip(" \"'")
    if _IT.fullmatch(phrase):
        return _read_pronoun(phrase, reading)
    found = _PLACE_EN.fullmatch(phrase) or _PLACE_ZH.fullmatch(phrase)
    if found:
        return _read_name(found, phrase, reading)
    if re.search(MARK, phrase):
        return reading.problem(Code.NOT_UNDERSTOOD, phrase)
    return _read_unknown(phrase, reading)


def _read_pronoun(phrase: str, reading: Reading) -> Meaning:
    """Return the step that drives up to what the clauses before spoke of; "it" is no place."""
    thing = reading.scene.thing or reading.scene.person
    if thing is None or not is_known(thing, reading.things):
        return reading.problem(Code.NOT_UNDERSTOOD, phrase)
    return Steps((GoToObject(object=thing),), thing=thing)


def _read_name(found: re.Match[str], phrase: str, reading: Reading) -> Meaning:
    mention = reading.marked.mention(found["a"])
    room = found["room"]
    if len(mention.ids) > 1:
        ids = mention.ids
        return ClauseProblem(Code.AMBIGUOUS, reading.marked.restore(phrase), places=ids)
    entry = reading.vocabulary.by_id[mention.ids[0]]
    about_a_room = entry.kind == "room" and found["near"] is not None
    in_its_room = room is None or entry.room in reading.marked.mention(room).ids
    if about_a_room or not in_its_room:  # "near the kitchen" is not in it; the sofa is elsewhere
        return reading.problem(Code.NOT_UNDERSTOOD, phrase)
    return Steps((GoTo(place=entry.id),))


def _read_unknown(phrase: str, reading: Reading) -> Meaning:
    name = _ZH_TAIL.sub("", _DETERMINER.sub("", phrase)).strip()
    if not any(char.isalnum() for char in name):
        return reading.problem(Code.NOT_UNDERSTOOD, phrase)
    meant = reading.lexicon.typo(name)
    if meant is not None:
        return Steps((GoTo(place=meant),))
    name = reading.marked.restore(name)
    return ClauseProblem(Code.UNKNOWN_PLACE, name, places=reading.lexicon.near(name), name=name)


ONE_AT_A_TIME = say("grammar.one_at_a_time")
_NUMBER = r"(?:two|three|four|five|six|seven|eight|nine|ten|\d+)"
_MANY = r"(?:[a-z0-9'-]+s|people|men|women|children|sheep|mice)"
_MANY_EN = re.compile(
    r"(?:all|every|each|both|several|many|a few|a couple of)\b(?! one\b)(?: of)?"
    r"(?: (?:the|my|our))? "
    rf"(?P<all>.+)|(?:the |my |our )?{_NUMBER} (?P<some>(?:[^ ]+ )*?{_MANY}\b.*)"
)
_UNIT = r"[个只张位把本台瓶杯名条件辆盒罐双支口盏颗种]"
_MANY_ZH = re.compile(
    rf"(?:(?:所有|全部)的?|每一?{_UNIT}?|各{_UNIT}|[这那]?(?:[两二三四五六七八九十几]|\d+){_UNIT})"
    r"(?P<all>.+)|(?P<some>.+)都"
)
_PEOPLE = re.compile(r"every(?:one|body)(?P<rest>.*)|(?:大家|所有人|每个人)")
_ONE = re.compile(r"(?:every|each)\b(?! of)")


def several(words: str) -> str | None:
    """Return the thing meant by words for several, without their number; None for a single one."""
    people = _PEOPLE.fullmatch(words)
    if people is not None:
        return f"people{people['rest']}" if words.isascii() else "人"
    found = _MANY_EN.fullmatch(words) or _MANY_ZH.fullmatch(words)
    if found is None:
        return None
    what = found["all"] or found["some"]
    plain = _ONE.match(words) and " " not in what and not what.endswith("s")
    return f"{what}s" if plain else what


_THE = r"(?:(?:the|a|an|my|our|your|this|that) )?"
_EN = re.compile(
    rf"(?:(?:over|up|close|next) to |near |by |beside |at )?{_THE}(?P<what>[a-z][a-z' -]*?)"
    rf"(?: (?:in|inside|of) {_THE}(?P<at>{MARK}))?"
)
_ZH = re.compile(
    rf"(?:(?P<at>{MARK})(?:里面?|里边|内)?的?)?(?:这个|那个|这把|那把)?(?P<what>[^{MARK[1:-1]}]+?)"
    r"(?:的?(?:旁边|边上|附近|跟前|前面|面前|身边|身旁|那边|那里|那儿|这边|这里|处))?"
)


HOW_EN = r"(?:on(?: top of)?|under(?:neath)?|beneath|below|near|next to|beside|close to|by)"
HOW_ZH = r"(?:上面?|上边|旁边?|边上|附近|下面?|下边|底下)"
"""How a thing may stand to its neighbour; `planner.language.questions` reads it in questions."""
_BY_EN = re.compile(
    rf"(?:(?:over|up|close|next) to )?{_THE}(?P<what>[a-z][a-z' -]*?) (?P<how>{HOW_EN}) "
    rf"(?P<the>{_THE})(?P<by>{MARK})(?: (?:in|inside|of) {_THE}(?P<at>{MARK}))?"
)
_BY_ZH = re.compile(
    rf"(?:(?P<at>{MARK})(?:里面?|里边|内)?的?)?(?P<by>{MARK})(?P<how>{HOW_ZH})的(?P<what>[^{MARK[1:-1]}]+?)"
    r"(?:的?(?:旁边|边上|附近|跟前|前面|面前|身边|身旁|那边|那里|那儿|这边|这里|处))?"
)
_ASIDE_ZH = re.compile(rf"{HOW_ZH}的")


_BEFORE_ZH = re.compile(
    r"(?:.*的|[这那一两几][个把只张台件本瓶杯盆棵扇]?|.*[红橙黄绿蓝紫粉棕黑灰白]色?|[大小新旧高矮圆方])?"
)


def up_to(phrase: str, reading: Reading) -> Steps | None:
    """Return the step that drives up to a thing, or None where the phrase names none."""
    phrase = phrase.strip(" \"'")
    related = _BY_EN.fullmatch(phrase) or _BY_ZH.fullmatch(phrase)
    if related is not None:
        named = by_neighbour(related["what"], related["how"], related["by"], reading)
        place = _only(related["at"] or related["by"], reading)
        if named is None or place is None:
            return None
        return Steps((GoToObject(object=named, place=place),), thing=named)
    found = _EN.fullmatch(phrase) or _ZH.fullmatch(phrase)
    what = found["what"].strip(" 的") if found else ""
    if found is None or not is_known(what, reading.things) or _ASIDE_ZH.match(what):
        return None
    ids = reading.marked.mention(found["at"]).ids if found["at"] else (None,)
    if len(ids) != 1:
        return None
    label = reading.marked.restore(what)
    return Steps((GoToObject(object=label, place=ids[0]),), thing=label)


def several_of(phrase: str, reading: Reading) -> tuple[str, str | None] | None:
    """Return the words for several things that eyes know, and where they are; None for others."""
    phrase = phrase.strip(" \"'")
    found = _EN.fullmatch(phrase) or _ZH.fullmatch(phrase)
    what = found["what"].strip(" 的") if found else ""
    plain = several(what) or ""
    if found is None or not (
        is_known(plain, reading.things) or is_known(plain.removesuffix("s"), reading.things)
    ):
        return None
    return what, _only(found["at"], reading) if found["at"] else None


def by_neighbour(what: str, how: str, by: str, reading: Reading) -> str | None:
    """Return a thing's words with its neighbour's, where eyes know that neighbour; else None.

    A neighbour may be a place of the site as well: "the cup on the desk".
    """
    near = reading.marked.restore(by)
    if not is_known(near, reading.things):
        return None
    thing = reading.marked.restore(what)
    joined = f"{thing} {how} the {near}" if how.isascii() else f"{near}{how}的{thing}"
    return joined[:80]


def _only(mark: str, reading: Reading) -> str | None:
    ids = reading.marked.mention(mark).ids
    return ids[0] if len(ids) == 1 else None


def is_known(what: str, things: frozenset[str]) -> bool:
    """Tell whether a phrase ends in the name of something that eyes know, as a word of its own."""
    if not what.isascii():
        names = [name for name in things if not name.isascii() and what.endswith(name)]
        return any(_BEFORE_ZH.fullmatch(what.removesuffix(name)) for name in names)
    words = what.split()
    return any(" ".join(words[-count:]) in things for count in (1, 2, 3) if count <= len(words))
