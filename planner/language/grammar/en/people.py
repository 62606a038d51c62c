"""Own the English rules about people: meet, greet, follow, guide, introduce, tell, ask."""

from __future__ import annotations

import re
from re import Match

from planner.language.catalogue import say
from planner.language.grammar.clauses import QUOTE
from planner.language.grammar.en import DESCRIPTION, PERSON, THE, loc
from planner.language.grammar.en.direct_questions import ask_directly
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.noun_phrases import is_known, several
from planner.language.grammar.parse_result import (
    ClauseProblem,
    Meaning,
    Reading,
    Rule,
    Steps,
    TopicQuestion,
    ahead,
    lacks,
    read_place,
    rule,
)
from planner.language.grammar.small_talk import Topic, answer_topic, topic_of
from planner.language.grammar.step_builders import (
    call,
    follow,
    guide,
    label_of,
    look,
    meet,
    one_at_a_time,
    place_of,
    saying,
    told_in,
)
from planner.plan import Ask, Code, ComeBack, Decide, GoToObject, Say

_FIND = (
    r"(?:find|locate|look for|search for|seek|spot|pinpoint|identify|meet(?: with)?|contact|"
    r"see|"
    r"visit|get acquainted with|get to know|talk to|speak (?:to|with)|"
    r"check (?:up )?on|"
    r"join|call on|go and see)"
)
_GO_UP = r"(?:(?:go|walk|come|drive|move) (?:up |over )?to|approach|face)"
_SEEKS = re.compile(r"(?:find|locate|look for|search for|seek|spot|pinpoint)\b")
_GREET = (
    r"(?:greet|welcome|say (?:hello|hi|good (?:morning|evening|afternoon)|welcome|"
    r"goodbye|bye) to|wish)"
)
_WISH = r"(?:good ?night|night night|sweet dreams|thank you|happy [a-z]+|merry christmas|well done)"
_FOLLOW = (
    r"(?:follow|(?:start|keep|keep on|continue|begin) following|come after|go after|go behind|"
    r"come behind|run after|walk behind|drive behind|trail|"
    r"walk with|keep behind|come along with|"
    r"go along with|come with|go with|stay (?:behind|close to|with)|keep up with)"
)
_GUIDE = r"(?:take|guide|lead|escort|accompany|conduct|bring|walk|show|usher|direct|drive)"
_FOUND = (
    r"(?:,? (?:and )?(?:who |whom )?you (?:may|can|will|could|might|should|'ll)(?: also)? (?:find|"
    r"meet|see) "
    r"(?:them|him|her) "
    rf"(?:at|in|on|near|by) (?P<found>{THE}{MARK}))?"
)
_TO = rf"(?: (?:(?:back )?(?:to|into|towards?|up to) (?P<to>{THE}[^,]+?)|(?P<back>back)))?"


def _meet(found: Match[str], reading: Reading) -> Meaning:
    if _SEEKS.match(found[0]) and several(found["who"]) is not None:
        place = place_of(read_place(found, "at"), reading)
        return (
            place
            if isinstance(place, ClauseProblem)
            else one_at_a_time(found["who"], place, reading)
        )
    sought = _SEEKS.match(found[0]) is not None
    return meet(found["who"], read_place(found, "at"), reading, sought=sought)


def _go_up_to(found: Match[str], reading: Reading) -> Meaning:
    """Drive up to a person whom the detector knows; one who is only named is met."""
    who, place = found["who"], place_of(read_place(found, "at"), reading)
    if isinstance(place, ClauseProblem) or not is_known(who, reading.things):
        return _meet(found, reading)
    if several(who) is not None:
        return one_at_a_time(who, place, reading)
    person = label_of(who, reading)
    return Steps((GoToObject(object=person, place=place),), person=person)


_WISHED = re.compile(r"say (good (?:morning|evening|afternoon)|goodbye|bye|welcome)\b")


def _greet(found: Match[str], reading: Reading) -> Meaning:
    name = label_of(found["who"], reading) if found["who"] not in ("them", "him", "her") else ""
    called = say("spoken.hello_name", name=name).en if name[:1].isupper() else None
    wish = _WISHED.match(found[0])
    if wish is not None:  # nobody is greeted with "hello" for a goodbye
        called = f"{wish[1].capitalize()}{f', {name}' if name[:1].isupper() else ''}!"
    said = called or told_in("spoken.hello", reading)
    return meet(found["who"], read_place(found, "at"), reading, said)


def _present_itself(found: Match[str], reading: Reading) -> Meaning:
    said = answer_topic(Topic.SELF, None)
    words = said.of(reading.language) if said else ""
    return meet(found["who"], read_place(found, "at"), reading, words)


def _follow(found: Match[str], reading: Reading) -> Meaning:
    return follow(found["who"], read_place(found, "at") or found["start"], found["to"], reading)


def _guide(found: Match[str], reading: Reading) -> Meaning:
    start = found["found"] or read_place(found, "at") or found["start"]
    return guide(found["who"], start, found["to"] or found["back"], reading)


def _introduce(found: Match[str], reading: Reading) -> Meaning:
    """Lead one person to another, and name both."""
    first = meet(found["who"], read_place(found, "at"), reading)
    if not isinstance(first, Steps):
        return first
    then = ahead(reading, first)
    second = meet(found["other"], read_place(found, "at2"), then)
    if not isinstance(second, Steps):
        return second
    words = told_in("spoken.this_is", reading, name=first.person or "")
    come = Say(text=told_in("spoken.come", reading))
    return Steps((*first.steps, come, *second.steps, Say(text=words)), person=second.person)


def _tell(found: Match[str], reading: Reading) -> Meaning | None:
    """Tell a topic to the person there, or to one who is found first."""
    topic = topic_of(found["topic"])
    if topic is None:
        return None
    who = found.groupdict().get("who")
    if who is None:
        return TopicQuestion(topic)
    said = answer_topic(topic, reading.now)
    return meet(who, read_place(found, "at"), reading, said.of(reading.language)) if said else None


def _tell_words(found: Match[str], reading: Reading) -> Meaning:
    words = found["words"]
    return meet(found["who"], read_place(found, "at"), reading, reading.marked.restore(words)[:500])


def _quote_to(found: Match[str], reading: Reading) -> Meaning:
    words = reading.quotes[ord(found["quote"]) - ord(QUOTE[1])]
    return meet(found["who"], read_place(found, "at"), reading, words[:500])


def _request(found: Match[str], reading: Reading) -> Meaning:
    words = f"Please {reading.marked.restore(found['deed'])}."
    if found["who"] is None:
        return saying(words, reading)
    return meet(found["who"], read_place(found, "at"), reading, words[:500])


def _ask(found: Match[str], reading: Reading) -> Meaning:
    words = ask_directly(reading.marked.restore(found["question"]))
    if found["who"] is None:
        return Steps((Ask(question=words[:500]),))
    met = meet(found["who"], read_place(found, "at"), reading, words)
    if not isinstance(met, Steps):
        return met
    asked = Ask(question=call(found["who"], words, reading)[:500])
    return Steps((*met.steps[:-1], asked), person=met.person)


def _ask_quoted(found: Match[str], reading: Reading) -> Meaning:
    words = reading.quotes[ord(found["quote"]) - ord(QUOTE[1])]
    met = meet(found["who"], read_place(found, "at"), reading, words)
    if not isinstance(met, Steps):
        return met
    asked = Ask(question=call(found["who"], words, reading)[:500])
    return Steps((*met.steps[:-1], asked), person=met.person)


def _bring_answer(_found: Match[str], reading: Reading) -> Meaning | None:
    """Come back with what somebody answered, where they were searched for to be asked."""
    if reading.scene.kind == "come_back":
        return Steps(())
    return Steps((ComeBack(),)) if reading.scene.kind == "ask" and reading.scene.person else None


def _describe(found: Match[str], reading: Reading) -> Meaning:
    """Look at somebody or something and tell about it, here or to another person."""
    seen = look(found["what"], read_place(found, "at"), reading)
    if not isinstance(seen, Steps) or not found.groupdict().get("who"):
        return seen
    met = meet(found["who"], read_place(found, "at2"), ahead(reading, seen))
    if not isinstance(met, Steps):
        return met
    tell = Decide(question=reading.marked.restore(found[0])[:500])
    return Steps((*seen.steps, *met.steps, tell), person=met.person, seen=True)


def _no_dialogue(found: Match[str], reading: Reading) -> Meaning:
    """Say no to a conversation; offer to go to whom it is to be held with."""
    who = found.groupdict().get("who")
    met = meet(who, read_place(found, "at"), reading) if who else None
    before = met.steps if isinstance(met, Steps) else ()
    return reading.problem(Code.NO_CAPABILITY, found[0], before)


_AT = loc("at")
_WHO = rf"(?P<who>{PERSON})"

RULES: tuple[Rule, ...] = (
    rule(
        r"(?:tell (?:me|us)|let (?:me|us) know|report(?: back)?(?: to (?:me|us))?) "
        r"(?:(?:what|how|if|"
        r"whether) (?:he|she|they) (?:says?|said|answers?|answered|thinks?|wants?|replied|does)"
        r"|(?:what )?(?:his|her|their|the) (?:answer|reply)(?: is| was)?)",
        _bring_answer,
    ),
    rule(rf"introduce (?P<who>{PERSON}){_AT} to (?P<other>{PERSON}){loc('at2')}", _introduce),
    rule(rf"(?:introduce|present) yourself(?: to {_WHO}{_AT})", _present_itself),
    rule(rf"{_GREET} {_WHO}{_AT}", _greet),
    rule(rf"(?:say|shout) (?P<words>{_WISH}) to {_WHO}{_AT}", _tell_words),
    rule(
        rf"(?:answer|reply to|take|respond to) (?:a|an|the|some|any|his|her|their)?(?: |)questions?"
        rf"(?: (?:to|of|from|by|for) {_WHO}{_AT})?",
        _no_dialogue,
    ),
    rule(
        r"(?:tell|say|speak|give|report|announce)(?: (?:me|"
        rf"us))? ?(?P<topic>{DESCRIPTION})(?: to {_WHO}{_AT})?",
        _tell,
    ),
    rule(rf"tell {_WHO}{_AT} (?P<topic>{DESCRIPTION})", _tell),
    rule(rf"(?:say|announce|tell) ?(?P<quote>{QUOTE}) to {_WHO}{_AT}", _quote_to),
    rule(rf"tell {_WHO}{_AT} ?(?P<quote>{QUOTE})", _quote_to),
    rule(
        rf"{_FOLLOW} (?P<who>me|us|{PERSON}){_AT}"
        rf"(?: (?:from|starting at) (?P<start>{THE}{MARK}))?(?: (?:to|into) (?P<to>{THE}{MARK}))?",
        _follow,
    ),
    rule(
        rf"{_FOLLOW} (?:the|our|my|that|this|a) (?:cat|dog|ball|puppy|kitten|car|hoover"
        rf"|vacuum)(?: .*)?",
        lacks(Code.NO_CAPABILITY),
    ),
    rule(
        rf"{_GUIDE} {_WHO}{_AT}(?: from (?P<start>{THE}{MARK}))?{_TO}{_FOUND}",
        _guide,
    ),
    rule(rf"{_FIND} {_WHO}{_AT}", _meet),
    rule(rf"{_GO_UP} {_WHO}{_AT}", _go_up_to),
    rule(
        r"(?:describe|tell (?:me|us) (?:about|how(?! many))|report (?:about|"
        rf"on)) (?P<what>{DESCRIPTION}){_AT}"
        rf"(?: (?:looks?(?: like)?|is|are))?(?: to (?:me|us|(?P<who>{PERSON}){loc('at2')}))?",
        _describe,
    ),
    rule(
        rf"(?:tell|ask|let|have|make|invite|remind|order) (?P<who>{PERSON}){_AT} to (?P<deed>.+)",
        _request,
    ),
    rule(
        rf"ask(?: (?P<who>{PERSON}){_AT})? (?P<question>(?:what|where|who|how|when|why|which|for|"
        r"about|their|his|her|if|whether) .+)",
        _ask,
    ),
    rule(rf"ask {_WHO}{_AT} ?(?P<quote>{QUOTE})", _ask_quoted),
    rule(
        rf"(?:tell|inform|remind) (?P<who>{PERSON}){_AT} (?:that )?(?P<words>(?!(?:in|at|on|near|"
        r"by|from) )[^,]+)",
        _tell_words,
    ),
    rule(rf"let {_WHO}{_AT} know,? (?:that )?(?P<words>[^,]+)", _tell_words),
    rule(
        rf"(?:chat|talk|converse|have a (?:chat|talk|conversation))(?: (?:with|to) {_WHO}{_AT})?",
        _no_dialogue,
    ),
    rule(
        r"(?:wave|bow|nod|shake hands|handshake|high five|hug|kiss|dance|sing|call|phone)\b.*",
        lacks(Code.NO_CAPABILITY),
    ),
)
