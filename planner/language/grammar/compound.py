"""Read a sentence whose orders hang on a condition, or are done so often or slowly.

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

from planner.language.grammar.compound_forms import (
    CompoundForms,
    ConditionParts,
    PartReaders,
    read_hour,
)
from planner.language.object_names import resolve
from planner.plan import (
    Ask,
    ClockTime,
    If,
    Look,
    Recall,
    Repeat,
    Say,
    Step,
    StepPlan,
)

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
    steps = _read_condition(said, forms, read) or _read_rounds(said, forms, read)
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
        order = _name_there(order, name, forms)
        other = _name_there(other, name, forms) if other else None
    if eyes is not None and eyes.is_somebody:
        order, other = _tell_them(order, forms), _tell_them(other, forms) if other else None
    yes, no = read.steps(order), read.steps(other) if other else ()
    if yes is None or no is None:
        return None
    if denied:
        yes, no = no, yes
    if eyes is not None and eyes.person and all(isinstance(step, Say | Ask) for step in yes):
        when, yes = eyes.anybody or eyes.look, _call_by_name(yes, eyes.person, forms)
    return (If(when=when, then=yes, otherwise=no),)


_WHERE_WITHIN = re.compile(r" (?:in|on|at|under|inside|near|by|behind|beside) |里|上|下|旁")


def _asked_of_clock(condition: str, forms: CompoundForms) -> tuple[ClockTime, bool] | None:
    """Return the hour that a condition is about; an hour of an unnamed half of the day is none."""
    found = forms.clock.fullmatch(condition.strip(" ,"))
    if found is None:
        return None
    hour = read_hour((found["after"] or found["before"]).strip())
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
    return SightCondition(look, parts.denied, somebody, person or "", anybody)


def _look(question: str, parts: ConditionParts, read: PartReaders) -> Look | None:
    """Return the look that answers a question, where one does; the way there is its own.

    Where a place is said, it must be known: else the words are cut in the wrong spot.
    """
    steps = read.steps(question)
    last = steps[-1] if steps else None
    if not isinstance(last, Look) or steps is None or (parts.is_placed and last.place is None):
        return None
    return last if all(step.kind in ("go_to", "look") for step in steps) else None


def _tell_them(order: str, forms: CompoundForms) -> str:
    """Return an order with what is told to "him" as words to be said where he was seen."""
    for pattern, plain in forms.tells:
        order = pattern.sub(plain, order)
    return order


def _call_by_name(steps: tuple[Step, ...], person: str, forms: CompoundForms) -> tuple[Step, ...]:
    """Put a person's name before the words for them: whoever else hears them knows it then."""
    return tuple(_put_name(step, person, forms) for step in steps)


def _put_name(step: Step, person: str, forms: CompoundForms) -> Step:
    if isinstance(step, Say) and person.lower() not in step.text.lower():
        return Say(text=f"{person}{forms.calls}{step.text}"[:500])
    if isinstance(step, Ask) and person.lower() not in step.question.lower():
        return Ask(question=f"{person}{forms.calls}{step.question}"[:500])
    return step


def _name_there(order: str, name: str, forms: CompoundForms) -> str:
    """Return an order in which "there" is the place that its condition names."""
    return forms.go_there.sub(lambda found: f"{found['verb']}{forms.to}{name}", order)


def _read_rounds(said: str, forms: CompoundForms, read: PartReaders) -> tuple[Step, ...] | None:
    """Read how many times an order is to be carried out."""
    found = forms.rounds.fullmatch(said)
    if found is None:
        return None
    times, again = forms.count(found["times"]), read.steps(found["main"].strip(" ,"))
    if times is None or not again:
        return None
    return (Repeat(times=times, steps=again),) if 1 <= times <= 20 else None
