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
    return forms.go_there.sub(lambda found: f"{found['verb']}{forms.to}{name}", order)
