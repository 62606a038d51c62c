"""Own the English rules about looking: find, count, look, check, questions about what is there."""

from __future__ import annotations

import re
from re import Match

from planner.brain.offline.acts import count, find, look, place_of
from planner.brain.offline.english_words import PREP, THE, loc, sure_loc
from planner.brain.offline.grammar import rule, where
from planner.brain.offline.lexicon import MARK
from planner.brain.offline.meaning import Meaning, Problem, Reading, Rule, Steps

_TWORD = r"(?!(?:in|at|on|inside|into|from|to)\b)[a-z0-9'/\u3400-\u9fff-]+"
_THING = rf"(?:{THE})?(?:{_TWORD} )*?{_TWORD}"
_COUNTED = r"(?!(?:on|to|down|up|me|in|with|from)\b)[a-z0-9 '/-]+?"
_ANY_THING = rf"(?!(?:what|who|whether|if|how|that|which|where|why)\b)(?:{_THING}|{THE}{MARK})"
_FIND = (
    r"(?:find(?! out)|locate|look (?:around )?for|search for|seek|spot|pinpoint|identify|detect|"
    r"hunt for|"
    r"see (?:if you can|whether you can) find|try to find|discover)(?: me| us)?"
)
_LOOK = (
    r"(?:look around|look(?: (?:at|in|inside|into|around|over))?|check(?: (?:on|out|in))?|inspect|"
    r"scan|observe|"
    r"examine|watch|monitor|survey|have a look(?: (?:at|in|around))?|take a look(?: (?:at|in|"
    r"around))?|"
    r"explore|see|photograph|take (?:a )?(?:photo|picture|pictures|photos)(?: of)?|keep an eye on)"
)
_LOOK_VERB = (
    r"(?:tell (?:me|us)|say|find out|see|check|look|report|show me|let me know|let us know)(?: me)?"
)
_ASKS = (
    rf"(?:(?:{_LOOK_VERB} )?(?:what|which|who|whose)|{_LOOK_VERB} (?:whether|if|that|how|where|"
    r"the (?:name|pose|"
    r"gender|age|colou?r|number|size|height|position|state|clothes|posture|mood|weight|shape)))"
)
_STATE = (
    r"(?:still |really |already )?(?:open|closed|shut|on|off|empty|clean|dirty|tidy|messy|locked|"
    r"unlocked|free|occupied|"
    r"ready|charging|lit|dark|running|made|set|full|taken|busy|safe|clear|warm|cold|wet)"
)
_THERE_IS = r"(?:is there|are there|do you see|can you see|did you see|is|are|has|have|do you find)"


def _find(found: Match[str], reading: Reading) -> Meaning:
    return find(found["what"], where(found, "at"), reading)


def _find_in_unknown(found: Match[str], reading: Reading) -> Meaning:
    place = place_of(found["nowhere"], reading)
    return place if isinstance(place, Problem) else find(found["what"], found["nowhere"], reading)


def _count(found: Match[str], reading: Reading) -> Meaning:
    how = found.groupdict().get("how") or ""
    plain = re.sub(r"\b(?:there|are|is|items?|objects?)\b", " ", f"{found['what']} {how}")
    label = " ".join(plain.split()) or found["what"]
    return count(label, where(found, "at"), reading)


def _look(found: Match[str], reading: Reading) -> Meaning:
    return look(found[0], where(found, "at"), reading)


def _look_here(found: Match[str], reading: Reading) -> Meaning:
    return look(found[0], "there" if reading.scene.place else None, reading)


def _reported(found: Match[str], reading: Reading) -> Meaning | None:
    """Pass over "and tell me" after something was looked at: the outcome tells."""
    return Steps(()) if reading.scene.seen else None


def _next_thing(found: Match[str], reading: Reading) -> Meaning | None:
    """Read a bare thing after one that is looked for, or a bare place to look in too."""
    kind, before = reading.scene.kind, reading.scene.thing
    if kind not in ("find", "count"):
        return None
    act = find if kind == "find" else count
    if re.fullmatch(rf"(?:{PREP} )?{THE}{MARK}", found["what"]):
        spot = re.sub(rf"^{PREP} ", "", found["what"])
        return act(before, spot, reading) if before else None
    if not found["what"].startswith(("the ", "a ", "an ", "some ", "my ")):
        return None
    return act(found["what"], where(found, "at"), reading)


_AT = loc("at")
_MUST = sure_loc("at")

RULES: tuple[Rule, ...] = (
    rule(
        r"(?:(?:tell|inform|show|let) (?:me|us)(?: know)?|report(?: back)?(?: to (?:me|us))?|"
        r"say it|say so|"
        r"tell me about it)(?: (?:the (?:result|results|number|answer|count)|what you (?:see|find|"
        r"found|saw|have seen)|"
        r"how many(?: there are| you (?:see|found))?|what is there|where (?:it|he|she|they) (?:is|"
        r"are)|it))?",
        _reported,
    ),
    rule(
        r"(?:(?:tell (?:me|us)|say|report|find out|check|let me know|"
        rf"see) )?how many (?P<what>{_COUNTED})"
        r"(?: (?:there are|are there|are|is|do you see|can you see|you see|"
        rf"were))?(?: there)?{_MUST}"
        r"(?: (?:who |that )?(?:(?:there )?are )?(?P<how>[a-z' -]+?))?",
        _count,
    ),
    rule(
        r"(?:(?:tell (?:me|us)|say|report|find out|check|let me know|"
        rf"see) )?how many (?P<what>{_COUNTED})"
        r"(?: (?:there are|are there|are|do you see|can you see|you see))?(?: (?P<at_there>there|"
        r"here))?(?P<at>)?",
        _count,
    ),
    rule(
        rf"count(?: up)?(?: the number of| how many)? (?P<what>{_COUNTED})(?: (?:you (?:see|find)|"
        r"there are|are|that are))?"
        rf"{_AT}",
        _count,
    ),
    rule(rf"search {THE}?(?P<at>{MARK})(?P<at_there>)? for (?P<what>{_THING})", _find),
    rule(
        r"(?:look|search|"
        rf"check)(?: around)? {PREP} (?P<at>{THE}{MARK})(?P<at_there>)? for (?P<what>{_THING})",
        _find,
    ),
    rule(rf"{_FIND} (?P<what>{_ANY_THING}){_AT}", _find),
    rule(
        rf"{_FIND} (?P<what>{_THING}) (?:in|inside|at|on) (?P<nowhere>(?:the|my|our) [a-z0-9' -]+)",
        _find_in_unknown,
    ),
    rule(rf"(?:{_ASKS}|{_THERE_IS})\b[^\ue000-\ue7ff]*?{_MUST}(?: [a-z' -]+)?", _look),
    rule(
        rf"(?:{_LOOK_VERB} (?:if|whether) |is |are )(?P<at>{THE}{MARK})(?P<at_there>)? (?:is |"
        rf"are )?{_STATE}",
        _look,
    ),
    rule(
        rf"{_LOOK}(?: (?:the|a|an|all|for|who|what)\b[a-z0-9' -]*?)?{_MUST}(?: [a-z' -]+)?", _look
    ),
    rule(
        rf"(?:{_LOOK}) (?P<at>{THE}{MARK})(?P<at_there>)?(?: (?:for|is|are)\b[a-z0-9' -]*)?", _look
    ),
    rule(
        rf"(?:{_ASKS}|what do you see|is there|are there|do you see|did you see|"
        rf"{_LOOK})\b[a-z0-9' -]*",
        _look_here,
    ),
    rule(
        r"(?:is|are) (?:the|a|an|any|there|some(?:one|body)|any(?:one|body))\b[a-z0-9' -]*?"
        r"(?: in (?:the|this) room)?",
        _look_here,
    ),
    rule(rf"(?P<what>.+?){_AT}", _next_thing),
)
