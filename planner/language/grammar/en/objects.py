"""Own the English rules about looking: find, count, look, check, questions about what is there."""

from __future__ import annotations

import re
from re import Match

from planner.language.folding import CHINESE
from planner.language.grammar.en import PREP, THE, loc, sure_loc
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.noun_phrases import HOW_EN, by_neighbour
from planner.language.grammar.parse_result import (
    Build,
    ClauseProblem,
    Meaning,
    Reading,
    Rule,
    Steps,
    lacks,
    read_place,
    rule,
)
from planner.language.grammar.step_builders import (
    count,
    find,
    look,
    look_everywhere,
    offer_search,
    place_of,
)
from planner.plan import Code

_TWORD = rf"(?!(?:in|at|on|inside|into|from|to)\b)[a-z0-9'/{CHINESE}-]+"
_THING = rf"(?:{THE})?(?:{_TWORD} )*?{_TWORD}"
_COUNTED = r"(?!(?:on|to|down|up|me|in|with|from|were|was|are|is|of)\b)[a-z0-9 '/-]+?"
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
    r"peek(?: (?:in|into|inside))?|explore|see|"
    r"photograph|take (?:a )?(?:photo|picture|pictures|photos)(?: of)?|keep an eye on)"
)
_LOOK_VERB = (
    r"(?:tell (?:me|us)|say|find out|see|check|look|report|show me|let me know|let us know)(?: me)?"
)
_WHAT = (
    r"what(?! (?:an?|such|luck|joy|bliss|nonsense|cheek)\b)"
    r"(?! (?:beautiful|lovely|nice|great|wonderful|gorgeous|pretty|good|bad|fine|awful|terrible"
    r"|horrible|strange|funny|fun|weather)\b(?!.*\b(?:is|are|was|were|do|does|did|can)\b))"
)
"""What asks; "what a lovely view from the kitchen!" only exclaims."""
_ASKS = (
    rf"(?:(?:{_LOOK_VERB} )?(?:{_WHAT}|which|who|whose)|{_LOOK_VERB} (?:whether|if|that|how|where|"
    r"the (?:name|pose|"
    r"gender|age|colou?r|number|size|height|position|state|clothes|posture|mood|weight|shape)))"
)
_STATE = (
    r"(?:still |really |already )?(?:open|closed|shut|on|off|empty|clean|dirty|tidy|messy|locked|"
    r"unlocked|free|occupied|"
    r"ready|charging|lit|dark|running|made|set|full|taken|busy|safe|clear|warm|cold|wet)"
)
_THERE_IS = (
    r"(?:is there|are there|do you see|can you see|did you see|is|are|do you find|"
    r"(?:has|have)(?= (?:the|any|you|my|our)\b))"
)
_SOMEBODY = r"(?:any|some)(?:one|body|thing)"
_WE_HAVE = (
    r"(?: (?:(?:we|i|they|you)(?:'ve| have)|have (?:we|i|they|you)"
    r"|do (?:we|i|they|you) (?:still )?have)"
    r"(?: still)?(?: got)?)?(?: (?:are )?left(?: over)?)?"
)
"""What says of things only that they are somebody's: "how many bottles we've got left"."""
_SEEN_HERE = (
    r"(?:(?:(?:are|do you see|can you see|you see) )?(?:in )?here|"
    r"(?:do|can) you see|you see|are (?:there )?in front of you|(?:are )?in sight|are around|"
    r"are there)(?: (?:right )?now)?"
)
"""How many of it the robot sees where it stands: for a bare question it drives nowhere."""
_ALL_ROOMS = r"(?:all (?:of )?(?:the |our |my )?|every (?:single )?|each )rooms?"
_SEARCHED = (
    r"(?:everywhere|all over|(?:in(?:to)? |through )?(?:(?:the|this) (?:whole |entire )?"
    rf"(?:house|home|flat)|{_ALL_ROOMS}))"
)
_HOME = r"(?:(?:at )?home|(?:in|around|at) (?:the |this )?(?:house|flat|apartment|building))"
_NOBODY = frozenset(
    {"i", "it", "they", "them", "we", "you", "that", "this", "everybody", "everyone"}
)


def _find(found: Match[str], reading: Reading) -> Meaning:
    return find(found["what"], read_place(found, "at"), reading)


def _find_by(found: Match[str], reading: Reading) -> Meaning | None:
    """Find a thing by its neighbour; on or near a place of the site, it is found at that place."""
    by, how = found["by"], found["how"]
    marked = re.fullmatch(MARK, by) is not None
    if marked and not how.startswith(("under", "be", "close")):
        return None
    named = by_neighbour(found["what"], how, by, reading)
    return find(named, found["at"] or (by if marked else None), reading) if named else None


def _find_anywhere(found: Match[str], reading: Reading) -> Meaning:
    return find(found["what"] or found["what2"], None, reading)


def _describe(found: Match[str], reading: Reading) -> Meaning:
    return look(found[0], found["at"] or found["at2"], reading)


def _find_in_unknown(found: Match[str], reading: Reading) -> Meaning:
    place = place_of(found["nowhere"], reading)
    return (
        place
        if isinstance(place, ClauseProblem)
        else find(found["what"], found["nowhere"], reading)
    )


def _count(found: Match[str], reading: Reading) -> Meaning:
    how = found.groupdict().get("how") or ""
    plain = re.sub(r"\b(?:there|are|is|items?|objects?)\b", " ", f"{found['what']} {how}")
    label = " ".join(plain.split()) or found["what"]
    return count(label, read_place(found, "at"), reading)


def _count_everywhere(found: Match[str], reading: Reading) -> Meaning:
    return count(found["what"], None, reading)


def _look(found: Match[str], reading: Reading) -> Meaning:
    return look(found[0], read_place(found, "at"), reading)


def _look_everywhere(found: Match[str], reading: Reading) -> Meaning:
    return look_everywhere(found[0], reading)


def _question(build: Build) -> Build:
    """Return a builder for "someone in the kitchen?": without its mark it only tells."""

    def build_question(found: Match[str], reading: Reading) -> Meaning | None:
        flat = found[0].startswith("some") and not reading.marked.text.rstrip(" .!").endswith("?")
        return None if flat else build(found, reading)

    return build_question


def _look_here(found: Match[str], reading: Reading) -> Meaning:
    return look(found[0], "there" if reading.scene.place else None, reading)


def _skip_report(found: Match[str], reading: Reading) -> Meaning | None:
    """Pass over "and tell me" after something was looked at: the outcome tells."""
    return Steps(()) if reading.scene.seen else None


def _seen_here(found: Match[str], reading: Reading) -> Meaning | None:
    """Look where nothing named a place; counting elsewhere is left to the next rules."""
    return None if reading.scene.place else look(found[0], None, reading)


def _offer_search(found: Match[str], reading: Reading) -> Meaning | None:
    what = found["what"] or found.groupdict().get("what2") or ""
    return None if what in _NOBODY else offer_search(what, found[0], reading)


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
    return act(found["what"], read_place(found, "at"), reading)


_AT = loc("at")
_MUST = sure_loc("at")

RULES: tuple[Rule, ...] = (
    rule(
        rf"(?:{_LOOK_VERB} )?(?:count )?how many (?P<what>people|persons) (?:are|is|there are)"
        rf"(?: there)? (?:in|{_HOME})(?: (?:right )?now)?",
        _count_everywhere,
    ),
    rule(
        r"(?:(?:tell|inform|show|let) (?:me|us)(?: know)?|report(?: back)?(?: to (?:me|us))?|"
        r"say it|say so|"
        r"tell me about it)(?: (?:the (?:result|results|number|answer|count)|what you (?:see|find|"
        r"found|saw|have seen)|"
        r"how many(?: there are| you (?:see|found))?|what is there|where (?:it|he|she|they) (?:is|"
        r"are)|it))?",
        _skip_report,
    ),
    rule(r"look (?:up|down|out|away|after)(?:wards?)?\b.*", lacks(Code.NOT_UNDERSTOOD)),
    rule(rf"(?:{_LOOK_VERB} )?how many {_COUNTED} {_SEEN_HERE}", _seen_here),
    rule(rf"count {_COUNTED} (?:(?:in )?here|in this room|around you|you see)", _seen_here),
    rule(
        r"(?:(?:tell (?:me|us)|say|report|find out|check|let me know|"
        rf"see) )?how many (?P<what>{_COUNTED}){_WE_HAVE}"
        r"(?: (?:there are|are there|are|is|do you see|can you see|you see|"
        rf"were))?(?: there)?{_MUST}"
        r"(?: (?:who |that )?(?:(?:there )?are )?(?P<how>[a-z' -]+?))?",
        _count,
    ),
    rule(
        r"(?:(?:tell (?:me|us)|say|report|find out|check|let me know|"
        rf"see) )?how many (?P<what>{_COUNTED}){_WE_HAVE}"
        r"(?: (?:there are|are there|are|do you see|can you see|you see))?(?: (?P<at_there>there|"
        r"here))?(?P<at>)?",
        _count,
    ),
    rule(
        rf"count(?: up)?(?: the number of"
        rf"| how many)? (?P<what>{_COUNTED})(?: (?:you (?:can )?(?:see|find)|"
        r"there are|are|that are))?"
        rf"{_AT}",
        _count,
    ),
    rule(
        r"(?:(?:tell|show) (?:me|us) )?"
        r"(?:where (?:is|are|can i find|did (?:i|you|we) (?:leave|put|see))|have you seen)"
        rf" (?P<what>{_THING}?)(?: now| anywhere| around| lately)?",
        _offer_search,
    ),
    rule(
        rf"(?:(?:tell|show) (?:me|us)|do you know) where (?P<what>{_THING}?) (?:is|are)(?: now)?",
        _offer_search,
    ),
    rule(
        rf"(?:(?:{_LOOK_VERB} (?:if|whether) )?(?:is|are) (?:there )?(?P<what>{_SOMEBODY})|"
        rf"{_LOOK_VERB} (?:if|whether) (?P<what2>{_SOMEBODY}) is)(?: there)? {_HOME}",
        _offer_search,
    ),
    rule(rf"(?:{_SOMEBODY}|any (?!chance\b)[a-z ]+?)(?: else)?{_MUST}", _question(_look)),
    rule(
        rf"(?:{_SOMEBODY}|any [a-z ]+?(?= (?:around|here|there|in sight)))(?: else)?"
        r"(?: (?:around|about|here|there|in here|out there|in sight))?",
        _question(_look_here),
    ),
    rule(rf"check (?:up )?on (?P<what>(?:the|my|our) (?:cat|dog|puppy|kitten)){_AT}", _find),
    rule(
        rf"(?:look|search|hunt|check) {_SEARCHED} for (?P<what>{_THING})"
        rf"|(?:find|look for|search for|locate) (?P<what2>{_THING}) (?:somewhere )?"
        rf"(?:in )?{_SEARCHED}",
        _find_anywhere,
    ),
    rule(
        rf"(?:(?:have |take )a )?(?:look|peek|glance)(?: around)? (?:in|into|inside) {_ALL_ROOMS}",
        _look_everywhere,
    ),
    rule(rf"describe (?P<at>{THE}{MARK})|tell (?:me|us) about (?P<at2>{THE}{MARK})", _describe),
    rule(
        rf"(?:search|check|scan|scour) {THE}?(?P<at>{MARK})(?P<at_there>)?"
        rf" for (?P<what>{_THING})",
        _find,
    ),
    rule(
        r"(?:look|search|"
        rf"check)(?: around)? {PREP} (?P<at>{THE}{MARK})(?P<at_there>)? for (?P<what>{_THING})",
        _find,
    ),
    rule(
        rf"{_FIND} {THE}?(?P<what>[a-z0-9][a-z0-9' -]*?) (?P<how>{HOW_EN}) {THE}"
        rf"(?P<by>[a-z][a-z -]*?|{MARK})(?: (?:in|inside) (?P<at>{THE}{MARK}))?",
        _find_by,
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
