"""Make steps of what a template about people found: meet, greet, follow, guide, tell, ask."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.catalogue import say
from planner.language.folding import has_chinese
from planner.language.grammar.en.direct_questions import ask_directly
from planner.language.grammar.lexicon import NAME
from planner.language.grammar.noun_phrases import is_known, several
from planner.language.grammar.parse_result import (
    ClauseProblem,
    Meaning,
    Reading,
    Steps,
    TopicQuestion,
    ahead,
)
from planner.language.grammar.quotes import QUOTE, put_quotes_back
from planner.language.grammar.small_talk import Topic, answer_topic, topic_of
from planner.language.grammar.step_builders import (
    WHICH_WORDS,
    call,
    label_of,
    look,
    missing,
    one_at_a_time,
    place_of,
    told_in,
)
from planner.language.grammar.step_builders import follow as follow_person
from planner.language.grammar.step_builders import guide as guide_person
from planner.language.grammar.step_builders import meet as meet_person
from planner.plan import MAX_FOLLOW_S, Ask, Code, ComeBack, Decide, Follow, GoToObject, Say

if TYPE_CHECKING:
    from planner.language.templates.template_file import TemplateFind


def _place_in(found: TemplateFind, name: str = "at") -> str | None:
    return found[name] or None


def _at(found: TemplateFind) -> str | None:
    return _place_in(found, "at2") or _place_in(found)


def meet(found: TemplateFind, reading: Reading) -> Meaning:
    """Go to somebody; several people are not sought one after the other."""
    sought = found["how"] == "sought"
    if sought and several(found["who"]) is not None:
        return _one_at_a_time(found, reading)
    return meet_person(found["who"], _at(found), reading, sought=sought)


def _one_at_a_time(found: TemplateFind, reading: Reading) -> Meaning:
    place = place_of(_at(found), reading)
    return (
        place if isinstance(place, ClauseProblem) else one_at_a_time(found["who"], place, reading)
    )


def call_somebody(found: TemplateFind, reading: Reading) -> Meaning:
    """Look for somebody, and call them by name."""
    name = call(found["who"], "", reading).rstrip(",")
    return meet_person(found["who"], _at(found), reading, name, sought=True)


def go_up_to(found: TemplateFind, reading: Reading) -> Meaning:
    """Drive up to a person whom the detector knows; one who is only named is met."""
    who, place = found["who"], place_of(_place_in(found), reading)
    if isinstance(place, ClauseProblem) or not is_known(who, reading.things):
        return meet(found, reading)
    if several(who) is not None:
        return one_at_a_time(who, place, reading)
    person = label_of(who, reading)
    return Steps((GoToObject(object=person, place=place),), person=person)


_WISHED = re.compile(r"say (good (?:morning|evening|afternoon)|goodbye|bye|welcome)\b")


def greet(found: TemplateFind, reading: Reading) -> Meaning:
    """Go to somebody and greet them, by name where it is known."""
    who = found["who"]
    is_name = re.match(NAME, who) is not None
    name = label_of(who, reading) if is_name or who not in ("them", "him", "her") else ""
    if has_chinese(found[0]):
        said = (say("spoken.hello_name", name=name) if is_name else say("spoken.hello")).zh
        said = "晚安" if "晚安" in found[0] and not is_name else said
        return meet_person(who, _place_in(found), reading, said)
    called = say("spoken.hello_name", name=name).en if name[:1].isupper() else None
    wish = _WISHED.match(found[0])
    if wish is not None:  # nobody is greeted with "hello" for a goodbye
        called = f"{wish[1].capitalize()}{f', {name}' if name[:1].isupper() else ''}!"
    return meet_person(who, _place_in(found), reading, called or told_in("spoken.hello", reading))


def present_itself(found: TemplateFind, reading: Reading) -> Meaning:
    """Tell somebody about the robot."""
    said = answer_topic(Topic.SELF, None)
    words = said.of(reading.language) if said else ""
    return meet_person(found["who"], _place_in(found), reading, words)


def follow(found: TemplateFind, reading: Reading) -> Meaning:
    """Find somebody and follow them, to a place where one is named."""
    start = _place_in(found) or _place_in(found, "start")
    followed = follow_person(found["who"], start, _place_in(found, "to"), reading)
    far_s = found.amounts.get("duration")
    if far_s is None or not isinstance(followed, Steps):
        return followed
    if not 0.0 < far_s <= MAX_FOLLOW_S:
        return replace(reading.problem(Code.NOT_UNDERSTOOD, found[0]), places=())
    update = {"seconds": far_s}
    steps = (s.model_copy(update=update) if isinstance(s, Follow) else s for s in followed.steps)
    return replace(followed, steps=tuple(steps))


def guide(found: TemplateFind, reading: Reading) -> Meaning:
    """Find somebody and drive ahead of them."""
    start = _place_in(found, "found") or _place_in(found) or _place_in(found, "start")
    end = _place_in(found, "to") or _place_in(found, "back")
    return guide_person(found["who"], start, end, reading)


def introduce(found: TemplateFind, reading: Reading) -> Meaning:
    """Lead one person to another, and name both."""
    first = meet_person(found["who"], _place_in(found), reading)
    if not isinstance(first, Steps):
        return first
    second = meet_person(found["other"], _place_in(found, "at2"), ahead(reading, first))
    if not isinstance(second, Steps):
        return second
    words = told_in("spoken.this_is", reading, name=first.person or "")
    come = Say(text=told_in("spoken.come", reading))
    return Steps((*first.steps, come, *second.steps, Say(text=words)), person=second.person)


_US = frozenset({"", "我", "我们", "大家"})


def tell_topic(found: TemplateFind, reading: Reading) -> Meaning | None:
    """Tell a topic to the person there, or to one who is found first."""
    topic = topic_of(found["topic"])
    if topic is None:
        return None
    if found["who"] in _US:
        return TopicQuestion(topic)
    said = answer_topic(topic, reading.now)
    words = said.of(reading.language) if said else None
    return meet_person(found["who"], _place_in(found), reading, words) if words else None


def tell_words(found: TemplateFind, reading: Reading) -> Meaning:
    """Go to somebody and tell them words of the sentence."""
    words = put_quotes_back(reading.marked.restore(found["words"]), reading.quotes).strip('" ')
    return meet_person(found["who"], _at(found), reading, words[:500])


def ask_for_words(found: TemplateFind, reading: Reading) -> Meaning:
    """Ask which words somebody is to be told."""
    return missing(WHICH_WORDS, found[0], reading)


def _quotation(found: TemplateFind, reading: Reading) -> str:
    return reading.quotes[ord(found["quote"]) - ord(QUOTE[1])]


def tell_quote(found: TemplateFind, reading: Reading) -> Meaning:
    """Go to somebody and tell them a quotation."""
    return meet_person(found["who"], _place_in(found), reading, _quotation(found, reading)[:500])


def request(found: TemplateFind, reading: Reading) -> Meaning:
    """Ask somebody to do something."""
    words = f"Please {reading.marked.restore(found['deed'])}."
    return meet_person(found["who"], _place_in(found), reading, words[:500])


_OF_THEM = re.compile(r"^(?:他|她)(?!们)")
"""Asked of themselves: 问妈妈她想吃什么 is 妈妈，你想吃什么."""
_EVERYBODY = frozenset({"", "大家", "他们", "她们"})


def ask_somebody(found: TemplateFind, reading: Reading) -> Meaning:
    """Ask somebody a question; those who are there where nobody is named."""
    if found["quote"]:
        words = _quotation(found, reading)
    else:
        words = reading.marked.restore(found["question"])
        words = _OF_THEM.sub("你", words) if has_chinese(words) else ask_directly(words)
    if found["who"] in _EVERYBODY:
        return Steps((Ask(question=words[:500]),))
    met = meet_person(found["who"], _at(found), reading, words)
    if not isinstance(met, Steps):
        return met
    asked = Ask(question=call(found["who"], words, reading)[:500])
    return Steps((*met.steps[:-1], asked), person=met.person)


def bring_answer(_found: TemplateFind, reading: Reading) -> Meaning | None:
    """Come back with what somebody answered, where they were searched for to be asked."""
    if reading.scene.kind == "come_back":
        return Steps(())
    return Steps((ComeBack(),)) if reading.scene.kind == "ask" and reading.scene.person else None


def describe(found: TemplateFind, reading: Reading) -> Meaning:
    """Look at somebody or something and tell about it, here or to another person."""
    seen = look(found["what"], _place_in(found), reading)
    if not isinstance(seen, Steps) or not found["who"]:
        return seen
    met = meet_person(found["who"], _place_in(found, "at2"), ahead(reading, seen))
    if not isinstance(met, Steps):
        return met
    tell = Decide(question=reading.marked.restore(found[0])[:500])
    return Steps((*seen.steps, *met.steps, tell), person=met.person, seen=True)


def hold_dialogue(found: TemplateFind, reading: Reading) -> Meaning:
    """Say no to a conversation; offer to go to whom it is to be held with."""
    met = meet_person(found["who"], _place_in(found), reading) if found["who"] else None
    before = met.steps if isinstance(met, Steps) else ()
    return reading.problem(Code.NO_CAPABILITY, found[0], before)


def lacks_means(found: TemplateFind, reading: Reading) -> Meaning:
    """Say no to what is understood and can't be done."""
    return reading.problem(Code.NO_CAPABILITY, found[0])
