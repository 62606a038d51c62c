"""Write the orders of a branch in full: "there", "tell him", a name before the words. Pure.

Law: only what the condition itself names is put in; every other word stays as it was said.
"""

from __future__ import annotations

from planner.language.grammar.compound_forms import CompoundForms
from planner.plan import Ask, Say, Step


def tell_them(order: str, forms: CompoundForms) -> str:
    """Return an order with what is told to "him" as words to be said where he was seen."""
    for pattern, plain in forms.tells:
        order = pattern.sub(plain, order)
    return order


def call_by_name(steps: tuple[Step, ...], person: str, forms: CompoundForms) -> tuple[Step, ...]:
    """Put a person's name before the words for them: whoever else hears them knows it then."""
    return tuple(_put_name(step, person, forms) for step in steps)


def _put_name(step: Step, person: str, forms: CompoundForms) -> Step:
    if isinstance(step, Say) and person.lower() not in step.text.lower():
        return Say(text=f"{person}{forms.calls}{step.text}"[:500])
    if isinstance(step, Ask) and person.lower() not in step.question.lower():
        return Ask(question=f"{person}{forms.calls}{step.question}"[:500])
    return step


def name_there(order: str, name: str, forms: CompoundForms) -> str:
    """Return an order in which "there" is the place that its condition names."""
    for pattern, plain in forms.there:
        order = pattern.sub(plain, order)
    return forms.go_there.sub(lambda found: f"{found['verb']}{forms.to}{name}", order)


def search_there(order: str, thing: str, forms: CompoundForms, *, somebody: bool) -> str:
    """Return "try the bedroom" as a search there for what is not where it was looked for.

    A look tells whether somebody is there as well as a search, and more: "look in" stays one.
    """
    found = forms.tries.fullmatch(order.strip(" ,.")) if forms.tries is not None else None
    if found is None or (somebody and found["look"]):
        return order
    if thing:
        return forms.search.format(thing=thing, place=found["place"])
    return forms.look_there.format(place=found["place"]) if found["try"] else order


def tell_news(order: str, statement: str, forms: CompoundForms) -> str:
    """Return "tell Jonas" with what the condition says as the words to be told."""
    found = forms.informs.fullmatch(order.strip(" ,.")) if forms.informs is not None else None
    if found is None or not statement:
        return order
    return forms.news.format(who=found["who"] or found["let"], said=statement)


def condition_there(condition: str, name: str, forms: CompoundForms) -> str | None:
    """Return a condition about "there" with a place's name; None of any other."""
    found = forms.inside.fullmatch(condition) if forms.inside is not None else None
    return f"{found['rest']}{forms.within}{name}" if found is not None else None
