"""Name whom "him", "it" and "there" mean that lean on the orders before, in a sentence of its own.

Pure. Laws: a name is put in a pronoun's place only where the newest order that speaks of people, or
the newest order, speaks of one person, thing or place alone, which the pronoun fits; "there" is a
place that a person named, never one of an answer; a condition is written out by the question that
the newest order looks into. What is in doubt stays as it was said.

An order is completed by the answer to the grammar's question about it, and by no other: a model
reads the answer beside its question. "She's in the study" completes an order that speaks of one
person, whom it fits, and of no place; "the kitchen" stands in for the one place of an order that
nobody knows.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Protocol

from planner.language.folding import has_chinese
from planner.language.grammar.sentence_text import MOST_READ
from planner.language.leaning_condition import WhetherThere, read_whether_there, write_condition
from planner.language.motion_guard.mentioned_names import find_places, plain
from planner.language.person_names import is_given_name, people_named
from planner.plan import Code, Edit, GoalState, places_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from planner.plan import Change, PlanRecord, StepRecord, Vocabulary


class EarlierOrder(Protocol):
    """Show what is known of an order that was given before."""

    @property
    def steps(self) -> tuple[StepRecord, ...]: ...
    @property
    def plan(self) -> PlanRecord | None: ...
    @property
    def order_text(self) -> str: ...
    @property
    def has_changed_steps(self) -> bool: ...
    @property
    def state(self) -> GoalState: ...
    @property
    def has_begun(self) -> bool: ...


ORDERS_BACK = 3
"""Orders before the newest one in which a person may have been spoken of."""
_HER = re.compile(
    r"(?:mom|mum|mommy|mummy|mother|grandma|grandmother|granny|nana|nan|gran|mama|wife|daughter"
    r"|sister|aunt|auntie)$"
    r"|妈|奶奶|外婆|姥姥|姐|妹|阿姨|老婆|妻|女",
    re.IGNORECASE,
)
_HIM = re.compile(
    r"(?:dad|daddy|father|grandpa|grandfather|grand?dad|gramps|papa|husband|son|brother|uncle)$"
    r"|爸|爷爷|外公|姥爷|哥|弟|叔|老公|丈夫|儿子|先生",
    re.IGNORECASE,
)
_SPEAKS = re.compile(
    r"\b(?P<verb>tell|ask|inform|remind|warn|greet|let) (?P<who>him|her|them)\b(?! own\b)"
    r"|\b(?P<to>(?:say|speak|talk)\b[^,;]*? to) (?P<who_2>him|her|them)(?=$|[ ,.;!?])",
    re.IGNORECASE,
)
_SPEAKS_ZH = re.compile(
    r"(?P<verb>告诉|通知|提醒|问一下|问问|询问|问|跟(?=[他她]们?(?:说|讲))|对(?=[他她]们?(?:说"
    r"|讲))|和(?=[他她]们?(?:说|讲))"
    r"|叫(?=[他她])|喊(?=[他她]))(?:一下)?(?P<who>他们|她们|他|她)(?P<says>说一声|说一下|说|讲)?"
)
_GO_THERE = re.compile(
    r"(?P<head>(?:^|(?<=[ ,]))"
    r"(?:(?:go|drive|come|head|walk|move|pop)(?: (?:over|back|on|straight))?"
    r"|(?:wait|stay|look|look around|stand)(?: over)?))"
    r" there(?=$| (?:and|then|please|now)\b|[,.;!?])",
    re.IGNORECASE,
)
_GO_THERE_ZH = re.compile(r"(?P<head>去|到|回|回到|开到|前往)(?:那里|那儿|那边)")
_GO_BACK = re.compile(
    r"\b(?:go|head|pop|drive|nip)(?: right| straight)? back(?: (?:in )?there)?(?: again)?(?:,| and"
    r"| to) $"
    r"|(?:再)?(?:回去|过去|去)(?:再)?(?=$)",
    re.IGNORECASE,
)
"""Before an order about a person whose place is named besides."""
_WAITS = re.compile(r"(?:wait|stay|look|stand)", re.IGNORECASE)


def name_antecedents(text: str, orders: Sequence[EarlierOrder], names: Vocabulary) -> str | None:
    """Return a sentence with its condition, its person and its place in full; None: as it is.

    Args:
        text: as it was said; longer than the grammar reads, it stays as it is.
        orders: the orders before it, the newest first.
        names: of the places.
    """
    if not orders or len(text) > MOST_READ:
        return None
    condition = _write_condition(text, orders[0], names)
    if condition is not None:
        return condition
    chinese = has_chinese(text)
    said = _name_person(text, orders, names, chinese=chinese) or text
    placed = _name_place(said, orders[0], names, chinese=chinese)
    if placed is not None or said != text:
        return placed or said
    return _name_thing(text, orders[0], names, chinese=chinese)


def _write_condition(text: str, last: EarlierOrder, names: Vocabulary) -> str | None:
    looks = [step for step in last.steps if step.kind in ("look", "find")]
    if not looks:
        return None
    look, place = looks[-1], looks[-1].place
    asked = read_whether_there(last.order_text) or read_whether_there(look.text or "")
    if look.kind == "find" and look.object is not None:
        asked = WhetherThere(look.object, "")
    if asked is None or (place is not None and place not in names.by_id):
        return None
    target = names.by_id.get(place or "")
    tongue = "zh" if has_chinese(text) else "en"
    return write_condition(asked, target.name.of(tongue) if target is not None else "", text)


def _name_person(
    text: str,
    orders: Sequence[EarlierOrder],
    names: Vocabulary,
    *,
    chinese: bool,
) -> str | None:
    """Return a sentence with the person of an order before for "him"; None where in doubt."""
    pattern = _SPEAKS_ZH if chinese else _SPEAKS
    found = pattern.search(text)
    if found is None or len(pattern.findall(text)) > 1 or _speaks_of_people(text[: found.start()]):
        return None
    for order in orders[: ORDERS_BACK + 1]:
        if people_of(order) or _PEOPLE.search(order.order_text) is not None:
            return _put_person(text, found, order, names, chinese=chinese)
    return None


_PEOPLE = re.compile(
    r"\b(?:some|any|every)(?:one|body)\b|\bpe(?:rson|ople)\b|\b(?:guest|visitor)s?\b"
    r"|\bwho\b|人|谁|客",
    re.IGNORECASE,
)


def people_of(order: EarlierOrder) -> tuple[str, ...]:
    """Return the persons of an order, as its words or its steps name them."""
    named = (step.object for step in order.steps if step.object and is_given_name(step.object))
    return people_named(order.order_text) or tuple(dict.fromkeys(named))


def _named_places(order: EarlierOrder, names: Vocabulary) -> set[str]:
    """Return the places that a person named in an order, or in what it changes."""
    if order.has_changed_steps:
        return {place for step in order.steps for place in places_of(step)}
    return {place.id for place in find_places(order.order_text, names)}


def _speaks_of_people(text: str) -> bool:
    return bool(people_named(text)) or _PEOPLE.search(text) is not None


def _put_person(
    text: str,
    found: re.Match[str],
    order: EarlierOrder,
    names: Vocabulary,
    *,
    chinese: bool,
) -> str | None:
    people = people_of(order)
    who = found["who"] or found.groupdict().get("who_2") or ""
    if has_chinese(order.order_text) is not chinese or len(people) > 1:
        return None
    person = people[0] if people else ("人" if chinese else "the person")
    if people and not fits(who, person):
        return None
    here = find_places(text, names)
    there = _named_places(order, names)
    name = names.by_id[there.pop()].name.of("zh" if chinese else "en") if len(there) == 1 else ""
    start, end = text[: found.start()], text[found.end() :]
    if name:  # "go back and ask her": back to her
        start = _GO_BACK.sub("", start)
    if chinese:
        verb = found["verb"].replace("跟", "告诉").replace("对", "告诉").replace("和", "告诉")
        at = f"{name}的" if name and not here else ""
        return f"{start}{verb}{at}{person}{end}"
    verb = found["verb"] or found["to"]
    at = f" in the {name}" if name and not here else ""
    return f"{start}{verb} {person}{at}{end}"


def fits(pronoun: str, person: str) -> bool:
    """Tell whether a pronoun can mean a person of this name."""
    she, he = _HER.search(person) is not None, _HIM.search(person) is not None
    if pronoun.lower() in ("him", "he", "他"):
        return not she or he
    return not he or she if pronoun.lower() in ("her", "she", "她") else True


def _name_place(text: str, last: EarlierOrder, names: Vocabulary, *, chinese: bool) -> str | None:
    """Return a sentence with the one place that the newest order named for "there"."""
    if find_places(text, names):
        return None
    there = _named_places(last, names)
    found = (_GO_THERE_ZH if chinese else _GO_THERE).search(text)
    if found is None or len(there) != 1:
        return None
    name = names.by_id[there.pop()].name.of("zh" if chinese else "en")
    to = name if chinese else f" {'in' if _WAITS.match(found['head']) else 'to'} the {name}"
    return f"{text[: found.start()]}{found['head']}{to}{text[found.end() :]}"


_SOUGHT = frozenset({"find", "count", "go_to_object", "recall"})
_LEAD = (
    r"(?:(?:please|ok|okay|well|then|now|so|just|and|go|hey|robot|no|yes|alright|all right|right"
    r"|(?:can|could|would|will) you)[ ,]+)*"
)
_ABOUT_THING = re.compile(
    rf"(?P<head>{_LEAD}(?:(?:go|come|drive) (?:and )?)?(?:(?:have a )?(?:look|search|hunt) for"
    r"|find|seek|locate|count|(?:go|drive|come|move) (?:right |back |up |over )*to))"
    r" (?:it|them|him|her)(?P<rest>(?: (?!and |then )[a-z' ]+)?)"
)
_ABOUT_THING_ZH = re.compile(
    r"(?P<head>(?:请|那|那就|好|你|,|再|帮我)*(?:去[^,找]{1,8})?(?:帮我)?(?:找|数|寻找)(?:一?下|一?找)?)"
    r"(?:它们?|他们?|她们?)(?P<rest>)"
)
_THERE = re.compile(
    rf"(?P<head>{_LEAD}(?:(?:what (?:all )?)?(?:did|have) you [a-z' ]+?|who (?:was|is|were)"
    r"|(?:was|were|is) (?:some|any)(?:body|one))) (?:in |over )?there"
)
_THERE_ZH = re.compile(
    r"(?P<head>(?:那)?你?)在?(?:那里|那儿|那边)(?P<rest>(?:都|有没有|有)?(?:看到|看见|见到|发现)了?"
    r"(?:些)?(?:什么|啥|谁|人).*)"
)


def _name_thing(text: str, last: EarlierOrder, names: Vocabulary, *, chinese: bool) -> str | None:
    """Return a sentence with the one thing, or the one place, of the newest order named."""
    said = plain(text).strip(" .,!?;。，！？；")
    thing, place = thing_of(last), _place_of(last, names)
    if thing is not None and has_chinese(thing) is not chinese:
        thing = None
    about = (_ABOUT_THING_ZH if chinese else _ABOUT_THING).fullmatch(said)
    if about is not None and thing is not None:
        return f"{about['head']}{'' if chinese else ' the '}{thing}{about['rest']}"
    there = (_THERE_ZH if chinese else _THERE).fullmatch(said.removesuffix("吗"))
    if there is None or place is None:
        return None
    name = names.by_id[place].name
    return (
        f"{there['head']}在{name.zh}{there['rest']}"
        if chinese
        else f"{there['head']} in the {name.en}"
    )


def _was_only_proposed(last: EarlierOrder) -> bool:
    """Tell whether a plan was laid before a person, and nothing of it was begun."""
    waits = last.state in (GoalState.AWAITING_CONFIRMATION, GoalState.CANCELLED)
    return waits and not last.has_begun


def thing_of(last: EarlierOrder) -> str | None:
    """Return the one thing that an order speaks of, in its own words."""
    things = {step.object for step in last.steps if step.kind in _SOUGHT and step.object}
    thing = things.pop() if len(things) == 1 else None
    if thing is None:
        return None
    if _was_only_proposed(last) and thing not in plain(last.order_text):
        return None
    return re.sub(r"^(?:the|my|our|your|an?) ", "", thing)


def _place_of(last: EarlierOrder, names: Vocabulary) -> str | None:
    """Return the one place that an order speaks of."""
    places = {place for step in last.steps for place in places_of(step) if place in names}
    if _was_only_proposed(last):
        places &= {each.id for each in find_places(last.order_text, names)}
    return places.pop() if len(places) == 1 else None


_QUOTED = re.compile("“([^”]+)”")
"""A question about an unknown place tells its name first."""


def complete_place(change: Change, asked: EarlierOrder, names: Vocabulary) -> str | None:
    """Return "go to the kitchen …" of "go to the garage …"; None where another thing is asked."""
    plan, place, order = asked.plan, change.inner or change.place, asked.order_text
    if plan is None or plan.code is not Code.UNKNOWN_PLACE or plan.text is None or place is None:
        return None
    unknown = _QUOTED.search(plan.text.en)
    if unknown is None or change.act not in (Edit.WHERE, Edit.INSTEAD) or change.asks:
        return None
    name, words = names.by_id[place].name, re.escape(unknown[1])
    if has_chinese(order):
        found, said = re.findall(words, order), name.zh
    else:
        words = rf"\b(?:(?:the|my|our|your) )?{words}\b"
        found, said = re.findall(words, order, re.IGNORECASE), f"the {name.en}"
    if len(found) != 1:
        return None
    return re.sub(words, lambda _: said, order, flags=re.IGNORECASE)


def complete_person(change: Change, asked: EarlierOrder, names: Vocabulary) -> str | None:
    """Return "tell Dad in the study …" of "tell Dad …"; None where another thing is asked."""
    order, plan = plain(asked.order_text), asked.plan
    people, place = people_named(asked.order_text), change.inner or change.place
    waits = asked.state is GoalState.NEEDS_CLARIFICATION and plan is not None
    if not waits or plan is None or plan.code is not Code.INCOMPLETE or place is None:
        return None
    if len(people) != 1 or find_places(order, names):
        return None
    person = people[0]
    if change.who == "it" or (change.who and not fits(change.who, person)):
        return None
    name = names.by_id[place].name
    if has_chinese(order):
        at = order.find(plain(person))
        return f"{order[:at]}{name.zh}的{order[at:]}" if at >= 0 else None
    named = re.search(rf"\b{re.escape(person)}\b(?!'s)", asked.order_text, re.IGNORECASE)
    if named is None:
        return None
    return f"{asked.order_text[: named.end()]} in the {name.en}{asked.order_text[named.end() :]}"
