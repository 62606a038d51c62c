"""Change the newest order as the learned reader reads a sentence that leans on it. Pure."""

from __future__ import annotations

from dataclasses import replace

from planner.language.semantic_parser.amounts import amount_value
from planner.language.semantic_parser.plan_grammar import (
    FORMS,
    POINTED_BEFORE,
    LabelledPlan,
    PlanNode,
    SlotKind,
)
from planner.plan import (
    Change,
    Edit,
    LastOrder,
    PlanRole,
    StepPlan,
    apply,
    list_nodes,
    places_of,
)

CHANGES = frozenset(
    {"again", "more", "less", "other", "skip", "also", "also_thing", "change_place"}
    | {"change_thing"}
)
"""Forms that change the newest order."""
_IN_ITS_PLACE = frozenset({"other", "skip", "change_place", "change_thing"})
"""What they make of an order that is not over is done in its place."""


def name_pointed(plan: LabelledPlan, last: LastOrder | None) -> LabelledPlan:
    """Return a plan whose ``there`` and ``it`` are what the newest order spoke of, where it did."""
    if last is None:
        return plan
    places = [place for node in list_nodes(last.steps) for place in places_of(node.step)]
    meant = {SlotKind.PLACE: places[-1:], SlotKind.THING: [last.thing] if last.thing else []}
    return tuple(_name_pointed(node, meant) for node in plan)


def _name_pointed(node: PlanNode, meant: dict[SlotKind, list[str]]) -> PlanNode:
    kinds = [slot.kind for slot in FORMS[node.form].slots]
    slots = tuple(
        tuple(meant[kind]) if meant.get(kind) and value == (POINTED_BEFORE[kind],) else value
        for kind, value in zip(kinds, node.slots, strict=True)
    )
    inner = (tuple(_name_pointed(each, meant) for each in block) for block in node.blocks)
    condition = tuple(_name_pointed(each, meant) for each in node.condition)
    return replace(node, slots=slots, condition=condition, blocks=tuple(inner))


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


def put_first(plan: StepPlan, last: LastOrder | None) -> StepPlan:
    """Return a plan that is done before what is left of the newest order, in that order's place."""
    if last is None or not last.ahead:
        return plan
    return StepPlan(steps=(*plan.steps, *last.ahead), does=PlanRole.INSTEAD)


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
        case "change_thing":
            return (Change(Edit.INSTEAD, thing=named),)
    return (Change(Edit.INSTEAD, place=named),)
