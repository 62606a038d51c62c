"""Own what is understood and can't be done as it is said: an arm's work, the past, unseen sides.

- What takes an arm: it is refused, and what is possible is offered: go there and look for it.
- What the robot has done ("did you find the cup", 找到杯子了吗): a question or a statement, never
  an order. Nothing is driven or searched for it, and this brain keeps no record to answer from.
  Where the robot itself is, it can tell.
- The robot's own sides ("on your left", 身后): the camera looks ahead, and that is no answer
  to a question or a look there: it is not understood, and the learned reader may offer the turn.
"""

from __future__ import annotations

import re
from re import Match

from planner.language.grammar.en import PERSON, WORD, loc
from planner.language.grammar.lexicon import MARK, NAME
from planner.language.grammar.noun_phrases import several
from planner.language.grammar.parse_result import (
    ClauseProblem,
    Meaning,
    Reading,
    Rule,
    Steps,
    about,
    read_place,
    rule,
    unread,
)
from planner.language.grammar.small_talk import Topic
from planner.language.grammar.step_builders import label_of, meet, place_of
from planner.language.grammar.zh import SEE, SPOT, THING, WHAT, WHETHER
from planner.plan import Code, Find, GoTo, Step

_THE = r"(?:(?:the|a|an|my|our|your|some|any|this|that|one|two|three) )?"
_EN_THING = re.compile(
    rf"^(?:(?:me|us|up|out|him|her|them|to me|{NAME}) )?(?P<what>{_THE}{WORD}(?: {WORD}){{0,5}}?)"
    rf"(?: (?:from|in|at|on|inside|off) {_THE}(?P<src>{MARK}).*| (?:to|into|onto|from|for|in|on|at|"
    r"with)\b.*|$)"
)
_EN_FOR = re.compile(rf".*\b(?:to|for) (?P<who>{PERSON}){loc('at')}")
_EN_VERB = re.compile(
    r"^(?:(?:bring|fetch|get|grab|grasp|pick up|put down|put|place|take out|take|carry|deliver|"
    r"give|hand|"
    r"hold|lift|drop|leave|set|move|retrieve|collect|gather|offer|serve|provide|open|close|shut|"
    r"clean|"
    r"wash|wipe|dump|throw away|throw out|pass) )(?:(?:up|out|over|to me|me|us|back) )*"
)
_EN_PUT = re.compile(
    r"^(?:put|place|set|leave|drop|take|carry|move|pour|bring .* to|deliver .* to)\b"
)
_ZH_THING = re.compile(
    rf"(?:(?:去|到|从|在)?(?P<src>{MARK})(?:里面?|上面?|中)?(?:的)?(?:把|将|拿|取|端|找)?)?"
    r"(?:帮我|给我|让.{1,6}?)?(?:把|将|拿起|拿着|拿来|拿个|拿|取来|取|递|抓起|抓|搬|端来|端|捡起|"
    r"捡|拾起|提|找|送|带来|关|开)?"
    r"(?:给我|一下|来)?(?P<what>[^,把将给到放进拿去来过到上里起]{1,12}?)"
    r"(?:(?:给|交给)?(?:我|他|她)?|(?:放|拿|递|送|搬|端|取|带|倒|扔).*|(?:过来|起来|来|上|到).*|"
    r"进.*|里.*)?"
)
_ZH_NO_THING = re.compile(
    r"[它他她我你门灯窗饭菜地带送]|^(?:打开|关闭|打扫|整理|收拾|[开关倒洗扫擦烧做煮炒泡喂浇修按敲推拉盛摆叠拖削])"
)
"""What no search is offered for: a person, what belongs to the house, or another deed (洗碗)."""
_ZH_UNIT = re.compile(r"^一?[瓶杯罐盒包碗盘个只把张](?![子具垫筷柜])(?=..)")
_NO_THING = frozenset({
    "it", "them", "him", "her", "me", "us", "door", "doors", "window", "windows", "light",
    "lights", "something", "stuff", "garbage", "trash", "waste", "litter", "debris", "rubbish",
    "everyone", "everybody", "drinks", "snacks", "the", "off", "out", "lost", "easy", "home",
    "time", "break", "care", "seat", "nap", "on", "away", "down", "up", "hand", "back", "turn",
    "over", "rid", "going", "started", "ready",
})  # fmt: skip


def lacks_arm(found: Match[str], reading: Reading) -> Meaning:
    """Refuse a clause that takes an arm; offer to go and look for its thing where that is sure."""
    text = found[0]
    offer = _offer_in_english if re.search(r"[a-z]", text) else _offer_in_chinese
    return reading.problem(Code.NO_CAPABILITY, text, offer(text, reading))


def _offer_in_english(text: str, reading: Reading) -> tuple[Step, ...]:
    rest = _EN_VERB.sub("", text)
    if rest == text:
        return _go_and_see(text, reading)
    thing = _EN_THING.match(rest)
    if thing is None or thing["what"].split()[-1] in _NO_THING:
        return _go_and_see(text, reading)
    # "put the bowl on the desk": the desk is where it goes, not where it is
    src = None if _EN_PUT.match(text) and " from " not in text else thing["src"]
    return _look_for(thing["what"], src, reading)


def _go_and_see(text: str, reading: Reading) -> tuple[Step, ...]:
    """Return the way to those who were to get something."""
    people = _EN_FOR.fullmatch(text)
    who = several(people["who"]) or people["who"] if people else ""
    met = meet(who, read_place(people, "at"), reading) if people else None
    return met.steps if isinstance(met, Steps) else ()


def _offer_in_chinese(text: str, reading: Reading) -> tuple[Step, ...]:
    thing = _ZH_THING.fullmatch(text)
    if thing is None or not thing["what"] or _ZH_NO_THING.search(thing["what"]):
        return _only_there(thing["src"] if thing else None, reading)
    return _look_for(_ZH_UNIT.sub("", thing["what"]), thing["src"], reading)


def _only_there(src: str | None, reading: Reading) -> tuple[Step, ...]:
    place = place_of(src, reading) if src else None
    return (GoTo(place=place),) if isinstance(place, str) else ()


def _look_for(words: str, src: str | None, reading: Reading) -> tuple[Step, ...]:
    place = place_of(src, reading) if src else None
    label = label_of(several(words) or words, reading)
    if isinstance(place, ClauseProblem) or not label or re.search(rf"{MARK}|\d", words):
        return ()
    there = (GoTo(place=place),) if place else ()
    return (*there, Find(object=label, place=place))


_TELLS = r"(?:tell (?:me|us)|say|report|find out|check|let (?:me|us) know|do you know)"
_ASKED = r"(?:how many|how much|what|which|who|whom|whose|whether|if)"
_DONE = (
    r"(?:found|saw|seen|counted|met|visited|noticed|spotted|detected|discovered|followed|reached"
    r"|looked|searched|been|went|gone|drove|driven)"
)

_FOUND_ZH = r"(?:看到|看见|见到|瞧见|发现|数到|找到)[了过]"


def _no_order(found: Match[str], reading: Reading) -> Meaning | None:
    """Understand nothing, and offer no drive to a place that is only spoken of.

    Behind another clause it is an order in the past tense: "go there and tell me what you saw".
    """
    if reading.scene.kind:
        return None
    return ClauseProblem(Code.NOT_UNDERSTOOD, reading.marked.restore(found[0]))


PAST_ENGLISH: tuple[Rule, ...] = (
    rule(
        rf"are you (?:still |already |now )*(?:in|at|near|on|inside|by) (?:the )?{MARK}"
        r"(?: (?:now|already|yet|right now))*",
        about(Topic.WHERE),
    ),
    rule(
        rf"(?:{_TELLS} )?{_ASKED}\b.* (?:(?:did|have|had|were) (?:you|we)(?! got\b)"
        rf"|you (?:have |had )?{_DONE})(?: .*)?",
        _no_order,
    ),
    rule(rf"(?:{_TELLS} (?:if|whether) )?(?:did|had|are|were) (?:you|we) .*", _no_order),
    rule(rf"(?:{_TELLS} (?:if|whether) )?(?:have|had) (?:you|we) (?!seen\b).*", _no_order),
    rule(rf"(?:{_TELLS} (?:if|whether) )?(?:have|had) (?:you|we) seen .*{MARK}.*", _no_order),
    rule(rf"{_TELLS} (?:if|whether) you (?:have |had )?{_DONE}\b.*", _no_order),
    rule(
        r"who (?:has |have |had )?(?:left|put|took|taken|moved|broken?|ate|eaten|used|made|did|done"
        r"|drank|drunk|spil(?:t|led)|dropped|turned|switched|opened|closed|shut|locked"
        r"|forgot(?:ten)?|stole|hid)\b.*",
        _no_order,  # what was done is not to be seen
    ),
)

PAST_CHINESE: tuple[Rule, ...] = (
    rule(
        rf"(?!{SEE}(?![到见]))(?:.*{SPOT}.*{_FOUND_ZH}.*|.*{_FOUND_ZH}.*{SPOT}.*)",
        _no_order,
    ),
)


_NO_PLACE = r"[^,\ue000-\ue8ff]*"
_LOOK = r"(?:(?:have |take )a (?:quick )?look|look|check|inspect|peek|glance)(?! (?:around )?for\b)"
_TOLD = r"(?: (?:and|to) (?:tell me|see) what [a-z ]+)?"
_TELL = r"(?:(?:tell|show) (?:me|us)|let (?:me|us) know|say|find out|see|check|report)"
_SEES = r"(?:is|are|do you see|can you see|you (?:can )?see|(?:is|are) (?:there|standing|sitting))"
_WHICH = r"(?:what|who|whose|which|how many|if|whether|any[a-z]*|some[a-z]*)"
_ASK = (
    rf"(?:{_TELL} {_WHICH}|{_WHICH}|tell (?:me|us) about|is|are|(?:do|did|can|have) you|report|"
    r"describe|count|see behind)"
)
_OWN = (
    r"(?:behind(?: (?:you|me|us)\b|$)|at your back|(?:on|to|at|by) your (?:left|right)\b"
    r"|(?:left|right)(?: (?:hand )?side)? of (?:you|me)\b)"
)

ASIDE_ENGLISH: tuple[Rule, ...] = (
    rule(
        rf"{_LOOK} (?:(?:to )?(?:the |your )?(?:left|right)|behind(?: you)?"
        rf"|(?<=look )back(?:wards?)?){_TOLD}"
        rf"|{_LOOK}\b{_NO_PLACE}? (?:behind you|(?:on|to|at) your (?:left|right)){_TOLD}",
        unread,
    ),
    rule(
        rf"(?:{_TELL} )?what (?:is|do you see|can you see) behind.*"
        r"|what (?:is|do you see|can you see) (?:on|to) (?:your|the) (?:left|right).*",
        unread,
    ),
    rule(rf"(?={_ASK}\b){_NO_PLACE}?\b{_OWN}{_NO_PLACE}", unread),
    rule(
        rf"(?:(?:{_TELL} )?(?:what|who) {_SEES}(?: there)?|(?:is|are) there{_NO_PLACE}?) "
        r"(?:on|to) the (?:left|right)(?: side)?",
        unread,
    ),
)
"""Tried ahead of what is said of people: "can you see anyone behind you" orders no search."""

_SIDE = r"(?:[左右后](?:手?边|面|侧|方)|背后|身后)"
_YOUR = r"(?:你|您|我)?(?:自己)?的?"
_TELLING = r"(?:告诉我们?|说说|说一下|讲讲|描述一下|描述|描绘|报告|汇报)"
_LOOKS = rf"(?!描|告诉|说)(?:{SEE})(?![到见])"
_SEEN = r"(?:(?:看得?|瞧|见)[到见]|发现|数一数|数一下|数数|数|清点|统计)"
_THERE = (
    rf"(?:{WHAT}{_NO_PLACE}|(?:{WHETHER}|[都还]?有){THING}[吗呢么]?|的{THING}"
    rf"|的?(?:是|[坐站躺]着)(?:谁|什么|啥){_NO_PLACE})"
)

ASIDE_CHINESE: tuple[Rule, ...] = (
    rule(
        rf"(?:往|向|朝)[左右后](?:边|面|侧)?{_LOOKS}(?:{_THERE})?"
        rf"|{_LOOKS}{_YOUR}(?:[左右后]|{_SIDE}(?:{_THERE})?)",
        unread,
    ),
    rule(
        rf"(?:你|您)?(?:能|可以)?(?:{_TELLING}|{SEE}|{_SEEN})(?:一下|下|了)?"
        rf"(?:{_NO_PLACE}?在)?{_YOUR}(?:{_SIDE}|左右){_NO_PLACE}",
        unread,
    ),
)
