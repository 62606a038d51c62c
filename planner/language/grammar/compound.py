"""Read a sentence whose orders hang on something: a condition, a failure, rounds, a wait.

One way for all tongues; the words are each language's own (``en/compound.py``, ``zh/compound.py``).
Law: the sentence is cut, and every part must be an order, or a question that a look answers, which
the grammar reads alone with all its vetoes; else nothing is read here and the sentence is judged as
a whole. So no condition becomes a plan that nobody can look at, and "don't", "or" and harm in any
part still hold everything back.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from planner.language.grammar.answered_orders import read_answered
from planner.language.grammar.branch_orders import (
    call_by_name,
    condition_there,
    name_there,
    search_there,
    tell_news,
    tell_them,
)
from planner.language.grammar.compound_forms import CompoundForms, ConditionParts, PartReaders
from planner.language.grammar.lasting_orders import (
    read_follow,
    read_follow_until,
    read_hunt,
    read_rounds,
    read_wait,
)
from planner.language.grammar.polled_orders import read_poll, read_spin
from planner.language.object_names import resolve
from planner.plan import Ask, Attempt, ClockTime, Find, GoTo, If, Look, Recall, Say, Step, StepPlan

MOST_CUTS = 40
"""Places at which a condition without a comma may end, tried one after the other."""


def read_compound(said: str, forms: CompoundForms, read: PartReaders) -> StepPlan | None:
    """Return the plan of a sentence of such a form; None of any other."""
    if forms.trigger.search(said) is None:
        return None
    slow = forms.slowly.sub(" ", said)
    if slow != said:
        plain = " ".join(slow.split()).strip(" ,")
        inner = read_compound(plain, forms, read)
        steps = inner.steps if inner is not None else read.steps(plain)
        return StepPlan(steps=steps, pace="slow") if steps else None
    steps = (
        _read_failure(said, forms, read)
        or read_answered(said, forms, read)
        or _read_condition(said, forms, read)
        or read_wait(said, forms, read)
        or read_rounds(said, forms, read)
        or read_follow(said, forms, read)
        or read_follow_until(said, forms, read)
        or read_hunt(said, forms, read)
        or read_poll(said, forms, read, lambda each: _plain_look(each, forms, read))
        or read_spin(said, forms, lambda each: _plain_look(each, forms, read))
    )
    return StepPlan(steps=steps) if steps else None


def _read_condition(said: str, forms: CompoundForms, read: PartReaders) -> tuple[Step, ...] | None:
    for pattern in forms.conditions:
        found = pattern.fullmatch(said)
        if found is None:
            continue
        parts = found.groupdict()
        pairs = (
            _cut(parts["body"], forms.cuts) if parts.get("body") else [(parts["if"], parts["then"])]
        )
        for condition, order in pairs:
            flips = parts.get("unless") is not None
            made = _branch(condition, order, parts.get("else"), forms, read, flips=flips)
            if made is not None:
                return made
    return None


def _cut(body: str, cuts: re.Pattern[str]) -> Iterator[tuple[str, str]]:
    """Yield each way to cut a condition from the order that follows it: the longest one first.

    Where a comma stands, it ends there and nowhere else.
    """
    comma = re.search(r",(?: then)? ", body)
    found = [comma] if comma is not None else list(cuts.finditer(body))[-MOST_CUTS:]
    for cut in reversed(found):
        condition, order = body[: cut.start()].strip(" ,"), body[cut.end() :].strip(" ,")
        if condition and order:
            yield condition, order


def _branch(
    condition: str,
    order: str,
    other: str | None,
    forms: CompoundForms,
    read: PartReaders,
    *,
    flips: bool = False,
) -> tuple[Step, ...] | None:
    condition = _in_full(condition, order, forms, read)
    eyes = None
    when: ClockTime | Recall | Look
    asked = _asked_of_clock(condition, forms) or _asked_of_memory(condition, forms, read)
    if asked is not None:
        when, denied = asked
    elif (eyes := _asked_of_eyes(condition, forms, read)) is not None:
        when, denied = eyes.look, eyes.denied
    else:
        return None
    denied ^= flips
    if not isinstance(when, ClockTime) and when.place is not None:
        name = read.name(when.place)
        order = name_there(order, name, forms)
        other = name_there(other, name, forms) if other else None
    if eyes is not None and eyes.is_somebody:
        order, other = tell_them(order, forms), tell_them(other, forms) if other else None
    if eyes is not None:
        if denied:
            order = search_there(order, eyes.thing, forms, somebody=eyes.is_somebody)
        elif other:
            other = search_there(other, eyes.thing, forms, somebody=eyes.is_somebody)
        order = order if flips else tell_news(order, eyes.statement, forms)
    told = eyes is not None and forms.reports.fullmatch(order.strip(" ,.")) is not None
    yes, no = () if told else read.steps(order), read.steps(other) if other else ()
    if yes is None or no is None:
        return None
    if eyes is not None and told and not no:
        return (eyes.look,)
    if denied:
        yes, no = no, yes
    if eyes is not None and eyes.person and all(isinstance(step, Say | Ask) for step in yes):
        when, yes = eyes.anybody or eyes.look, call_by_name(yes, eyes.person, forms)
    return (If(when=when, then=yes, otherwise=no),)


def _in_full(condition: str, order: str, forms: CompoundForms, read: PartReaders) -> str:
    """Return a condition about "there" with the place that the order itself drives to."""
    if condition_there(condition, "", forms) is None:
        return condition
    steps = read.steps(order) or ()
    place = steps[0].place if steps and isinstance(steps[0], GoTo) else None
    return (condition_there(condition, read.name(place), forms) or "") if place else condition


_WHERE_WITHIN = re.compile(r" (?:in|on|at|under|inside|near|by|behind|beside) |里|上|下|旁")


def _asked_of_clock(condition: str, forms: CompoundForms) -> tuple[ClockTime, bool] | None:
    """Return the hour that a condition is about; an hour of an unnamed half of the day is none."""
    found = forms.clock.fullmatch(condition.strip(" ,"))
    if found is None:
        return None
    hour = forms.time((found["after"] or found["before"]).strip())
    if hour is None:
        return None
    return (ClockTime(after=hour) if found["after"] else ClockTime(before=hour)), False


def _asked_of_memory(
    condition: str, forms: CompoundForms, read: PartReaders
) -> tuple[Recall, bool] | None:
    """Return what memory is asked, and whether it holds where nothing is remembered.

    A place that is not known is no part of a thing's name: then nothing is read.
    """
    parts = forms.read_memory(condition.strip(" ,"))
    asked = read.memory(parts.question) if parts is not None else None
    if parts is None or asked is None or asked.deeds or _WHERE_WITHIN.search(asked.object or ""):
        return None
    return asked, parts.denied


@dataclass(frozen=True, slots=True)
class SightCondition:
    """Hold a condition that eyes tell: the look, and who is meant where somebody is."""

    look: Look
    denied: bool
    """It holds where the look says no."""
    is_somebody: bool
    person: str = ""
    """A person's name, as it is written."""
    anybody: Look | None = None
    """The look for anybody, where one is named: no eye tells who is who."""
    thing: str = ""
    """What may be searched for elsewhere: one person or thing, and not just anybody."""
    statement: str = ""
    """The condition, as words to be told."""


def _asked_of_eyes(
    condition: str, forms: CompoundForms, read: PartReaders
) -> SightCondition | None:
    """Return the look that tells a condition, and whether that holds where it says no."""
    parts = forms.read_condition(condition.strip(" ,"))
    person = read.person(parts.thing) if parts is not None else None
    kind = resolve(parts.thing) if parts is not None else None
    if parts is None or (kind is None and person is None):
        return None
    look = _look(parts.question, parts, read)
    if look is None:
        return None
    somebody = person is not None or (kind is not None and kind[0] == "person")
    anybody = _look(parts.anybody, parts, read) if person and parts.anybody else None
    thing = person or ("" if somebody else f"{forms.the}{parts.thing}")
    return SightCondition(
        look, parts.denied, somebody, person or "", anybody, thing, parts.statement
    )


def _plain_look(condition: str, forms: CompoundForms, read: PartReaders) -> Look | None:
    """Return the look whose yes tells a condition; None where a no does, or who somebody is."""
    eyes = _asked_of_eyes(condition, forms, read)
    return None if eyes is None or eyes.denied or eyes.person else eyes.look


def _look(question: str, parts: ConditionParts, read: PartReaders) -> Look | None:
    """Return the look that answers a question, where one does; the way there is its own.

    Where a place is said, it must be known: else the words are cut in the wrong spot.
    """
    steps = read.steps(question)
    last = steps[-1] if steps else None
    if not isinstance(last, Look) or steps is None or (parts.is_placed and last.place is None):
        return None
    return last if all(step.kind in ("go_to", "look") for step in steps) else None


def _read_failure(said: str, forms: CompoundForms, read: PartReaders) -> tuple[Step, ...] | None:
    found = forms.failures.fullmatch(said)
    if found is None:
        return None
    tried = read.steps(found["main"].strip(" ,;."))
    if not tried:
        return None
    last, other = tried[-1], found["else"].strip(" ,;.")
    if isinstance(last, Find):
        somebody = read.person(last.object) is not None
        thing = last.object if somebody else f"{forms.the}{last.object}"
        other = search_there(other, thing, forms, somebody=somebody)
    instead = read.steps(other)
    if not instead:
        return None
    return (Attempt(steps=tried, on_failure=instead),)
