"""Say no to what takes an arm, and offer what is possible: go there and look for the thing."""

from __future__ import annotations

import re
from re import Match

from planner.language.grammar.en.words import PERSON, WORD, loc
from planner.language.grammar.grammar import where
from planner.language.grammar.lexicon import MARK, NAME
from planner.language.grammar.objects import several
from planner.language.grammar.parse_result import Meaning, Problem, Reading, Steps
from planner.language.grammar.step_builders import label_of, meet, place_of
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
_NO_THING = frozenset(
    (
        "it",
        "them",
        "him",
        "her",
        "me",
        "us",
        "door",
        "doors",
        "window",
        "windows",
        "light",
        "lights",
        "something",
        "stuff",
        "garbage",
        "trash",
        "waste",
        "litter",
        "debris",
        "rubbish",
        "everyone",
        "everybody",
        "drinks",
        "snacks",
        "the",
        "off",
        "out",
        "lost",
        "easy",
        "home",
        "time",
        "break",
        "care",
        "seat",
        "nap",
        "on",
        "away",
        "down",
        "up",
        "hand",
        "back",
        "turn",
        "over",
        "rid",
        "going",
        "started",
        "ready",
    )
)


def lacks_arm(found: Match[str], reading: Reading) -> Meaning:
    """Refuse a clause that takes an arm; offer to go and look for its thing where that is sure."""
    text = found[0]
    offer = _english(text, reading) if re.search(r"[a-z]", text) else _chinese(text, reading)
    return reading.problem(Code.NO_CAPABILITY, text, offer)


def _english(text: str, reading: Reading) -> tuple[Step, ...]:
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
    met = meet(who, where(people, "at"), reading) if people else None
    return met.steps if isinstance(met, Steps) else ()


def _chinese(text: str, reading: Reading) -> tuple[Step, ...]:
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
    if isinstance(place, Problem) or not label or re.search(rf"{MARK}|\d", words):
        return ()
    there = (GoTo(place=place),) if place else ()
    return (*there, Find(object=label, place=place))
