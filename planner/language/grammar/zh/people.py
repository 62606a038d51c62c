"""Own the Chinese rules about people: meet, greet, follow, guide, tell, ask."""

from __future__ import annotations

import re
from re import Match

from planner.language.catalogue import say
from planner.language.grammar.clauses import QUOTE, put_quotes_back
from planner.language.grammar.noun_phrases import several
from planner.language.grammar.parse_result import (
    ClauseProblem,
    Meaning,
    Reading,
    Rule,
    Steps,
    TopicQuestion,
    lacks,
    read_place,
    rule,
)
from planner.language.grammar.small_talk import Topic, answer_topic, topic_of
from planner.language.grammar.step_builders import (
    WHICH_WORDS,
    call,
    follow,
    guide,
    label_of,
    meet,
    missing,
    one_at_a_time,
    place_of,
)
from planner.language.grammar.zh import GO, IN, PERSON, SPOT, loc
from planner.plan import Ask, Code

_FIND = r"(?:接到?|找到|寻找|找找看?|找一下|找|见见|见|看看|看望|探望|拜访|叫)(?:一下)?"
_WHETHER = r"(?:(?<=找)|(?<=找看)|(?<=找一下))还?(?:有没有|是否有|是不是有|有无)"
"""Whether somebody is there is searched for where the words say so; else looking answers it."""
_GREET = (
    r"(?:打(?:个|一?声)?招呼|问(?:个|声)?好|问候|打招呼|挥手|说(?:一声)?(?:你好|您好|早上好|晚上好"
    r"|晚安|"
    r"再见|欢迎))"
)
_FOLLOW = (
    r"(?!跟着?[你我他她它]?(?:念|读|说|讲|唱|学|喊|数|做))(?:跟着|跟随|跟上|跟住|尾随|跟在|随着|跟)"
)
_GUIDE = r"(?:带着?|领着?|引导|引领|陪同?|陪着|护送|送|指引)"


def _meet_somewhere(found: Match[str], reading: Reading) -> Meaning:
    at = read_place(found, "at2") or read_place(found, "at")
    if "找" in found[0] and several(found["who"]) is not None:
        place = place_of(at, reading)
        return (
            place
            if isinstance(place, ClauseProblem)
            else one_at_a_time(found["who"], place, reading)
        )
    if "叫" in found[0]:  # who is called is looked for, and called by name
        name = call(found["who"], "", reading).rstrip(",")
        return meet(found["who"], at, reading, name, sought=True)
    return meet(found["who"], at, reading, sought="找" in found[0])


def _greet(found: Match[str], reading: Reading) -> Meaning:
    name = label_of(found["who"], reading)
    is_name = "\ue900" <= found["who"][0] <= "\ue9ff"
    said = say("spoken.hello_name", name=name) if is_name else say("spoken.hello")
    words = "晚安" if "晚安" in found[0] and not is_name else said.zh
    return meet(found["who"], read_place(found, "at"), reading, words)


def _follow(found: Match[str], reading: Reading) -> Meaning:
    end = found.groupdict().get("to")
    return follow(found["who"], read_place(found, "at"), end, reading)


def _guide(found: Match[str], reading: Reading) -> Meaning:
    return guide(found["who"], read_place(found, "at"), found["to"] or found["back"], reading)


def _tell(found: Match[str], reading: Reading) -> Meaning | None:
    topic = topic_of(found["topic"])
    if topic is None:
        return None
    who = found.groupdict().get("who")
    if who is None or who in ("我", "我们", "大家"):
        return TopicQuestion(topic)
    said = answer_topic(topic, reading.now)
    return meet(who, read_place(found, "at"), reading, said.of(reading.language)) if said else None


def _present(found: Match[str], reading: Reading) -> Meaning:
    said = answer_topic(Topic.SELF, None)
    return meet(
        found["who"], read_place(found, "at"), reading, said.of(reading.language) if said else ""
    )


def _tell_words(found: Match[str], reading: Reading) -> Meaning:
    words = put_quotes_back(reading.marked.restore(found["words"]), reading.quotes).strip('" ')
    return meet(
        found["who"], read_place(found, "at2") or read_place(found, "at"), reading, words[:500]
    )


def _what_words(found: Match[str], reading: Reading) -> Meaning:
    return missing(WHICH_WORDS, found[0], reading)


def _quote_to(found: Match[str], reading: Reading) -> Meaning:
    words = reading.quotes[ord(found["quote"]) - ord(QUOTE[1])]
    return meet(found["who"], read_place(found, "at"), reading, words[:500])


def _ask(found: Match[str], reading: Reading) -> Meaning:
    words = _OF_THEM.sub("你", reading.marked.restore(found["question"]))
    who = found["who"]
    if who is None or who in ("大家", "他们", "她们"):
        return Steps((Ask(question=words[:500]),))
    met = meet(who, read_place(found, "at2") or read_place(found, "at"), reading, words)
    if not isinstance(met, Steps):
        return met
    asked = Ask(question=call(who, words, reading)[:500])
    return Steps((*met.steps[:-1], asked), person=met.person)


_OF_THEM = re.compile(r"^(?:他|她)(?!们)")
"""Asked of themselves: 问妈妈她想吃什么 is 妈妈，你想吃什么."""

_AT = rf"(?:{loc('at')})?"
_AT2 = rf"(?:{loc('at2')})?"
_PASSES = r"[^,]{1,6}?(?:先|好|能)?(?:过去|过一下|过路|走过去|通过)(?:一下)?$"
"""What somebody is made room for: 往后退一退，让姥姥先过去 tells her nothing."""
_WHO = rf"(?P<who>{PERSON})"

GUIDE: tuple[Rule, ...] = (
    rule(
        rf"把{_WHO}从(?P<at>{SPOT})(?P<back>)?(?:{_GUIDE})(?:到|去|回)(?P<to>{SPOT}){IN}",
        _guide,
    ),
    rule(
        rf"(?:从)?{_AT}(?:{_GUIDE}){_WHO}(?:(?:{GO})(?P<to>{SPOT}|[^,把给拿放]{{1,12}}?)(?:去|"
        r"来)?|(?P<back>回去|回来))?",
        _guide,
    ),
)
"""Tried ahead of what takes an arm: one verb says both."""

RULES: tuple[Rule, ...] = (
    rule(rf"{_AT}(?:和|跟|向|对|给)?{_WHO}(?:们)?{_GREET}", _greet),
    rule(rf"{_AT}(?:问候|欢迎|迎接){_WHO}", _greet),
    rule(rf"{_AT}(?:向|对|给|跟){_WHO}(?:做个?)?(?:自我介绍|介绍(?:一下)?你?自己)", _present),
    rule(
        rf"{_AT}(?:告诉|对|跟|和|向|给|通知){_WHO}(?:说|讲|报告|说说|讲讲)?(?:一下|"
        r"一声)?(?P<topic>.+)",
        _tell,
    ),
    rule(
        r"(?:告诉我|请问|说说?|讲讲?|报告|给我们?[讲说]|跟我[讲说]|对我[讲说]|来)?(?:一下|"
        r"一声)?(?P<topic>.+)",
        _tell,
    ),
    rule(rf"{_AT}(?:告诉|对|跟|和|向|通知){_WHO}(?:说|讲|喊)?[:]?(?P<quote>{QUOTE})", _quote_to),
    rule(
        rf"{_AT}(?:告诉|通知|提醒|跟|对|和|向|给){_AT2}{_WHO}(?:也|再|都)?(?:(?:说|讲|告诉|通知)(?:一?[声下句])?|一?[声句])",
        _what_words,
    ),
    rule(
        rf"{_AT}(?:(?:告诉|通知|提醒|叫|喊|让(?!{_PASSES})|请|催|对|跟)|给(?=[^,]{{1,8}}[说讲])){_AT2}{_WHO}(?:说|讲)?(?:一下|"
        r"一声|一句|[声句](?![音子明]))?(?P<words>(?![说讲]$)[^,]+)",
        _tell_words,
    ),
    rule(
        rf"{_AT}(?:问问|问一下|问下|问|询问)(?:一下)?(?:{_AT2}(?P<who>{PERSON}))?(?:一下"
        rf"|一声)?(?P<question>.+)",
        _ask,
    ),
    rule(
        rf"{_AT}{_FOLLOW}(?P<who>我们?|{PERSON})(?:走|来|后面?|的?后面)?(?:(?:去|到|"
        rf"来)(?P<to>{SPOT}))?",
        _follow,
    ),
    rule(
        rf"{_AT}{_FIND}{_AT2}(?:{_WHETHER})?{_WHO}(?:在家?|在不在|在没在)?",
        _meet_somewhere,
    ),
    rule(
        rf"{_AT}(?:回答|解答)(?:一个|一下)?(?:他|她|他们|[^,]*人)?的?问题",
        lacks(Code.NO_CAPABILITY),
    ),
)
