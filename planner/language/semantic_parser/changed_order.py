"""Change the newest order as the learned reader reads a sentence that leans on it. Pure."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.semantic_parser.amounts import amount_value
from planner.plan import Change, Edit, LastOrder, PlanRole, StepPlan, apply

if TYPE_CHECKING:
    from planner.language.semantic_parser.plan_grammar import PlanNode

CHANGES = frozenset(
    {"again", "more", "less", "other", "skip", "also", "also_thing", "change_place"}
)
"""Forms that change the newest order."""
_IN_ITS_PLACE = frozenset({"other", "skip", "change_place"})
"""What they make of an order that is not over is done in its place."""


def change_order(node: PlanNode, last: LastOrder | None) -> StepPlan | None:
    """Return the newest order's steps as a plan of the reader changes them; None: no such change.

    Args:
        node: the one node of the plan; its form is one of ``CHANGES``.
        last: the newest order; None where there is none.
    """
    if last is None:
        return None
    named = next((value[0] for value in node.slots if value), None)
    steps = next((steps for each in _changes(node.form, named) if (steps := apply(last, each))), ())
    instead = node.form in _IN_ITS_PLACE and not last.ended
    role = PlanRole.INSTEAD if instead else PlanRole.NEW
    return StepPlan(steps=steps, does=role) if steps else None


def _changes(form: str, named: str | None) -> tuple[Change, ...]:
    """Return what a form may mean, the likelier first."""
    match form:
        case "again":
            return (Change(Edit.AGAIN, times=1 if named is None else int(amount_value(named))),)
        case "more":
            return (Change(Edit.MORE), Change(Edit.MORE, kind="closer"))
        case "less":
            return (Change(Edit.MORE, way=-1.0),)
        case "other":
            return (Change(Edit.OTHER_SIDE), Change(Edit.OTHER))
        case "skip":
            return (Change(Edit.LEAVE_OUT, place=named, denied=named),)
        case "also":
            return (Change(Edit.ALSO, place=named),)
        case "also_thing":
            return (Change(Edit.ALSO, thing=named),)
    return (Change(Edit.INSTEAD, place=named),)
