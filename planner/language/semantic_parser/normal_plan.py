"""Write plans that mean one thing in one way: to go to the kitchen and look is a look there."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.semantic_parser.plan_grammar import FORMS, LabelledPlan, PlanNode

if TYPE_CHECKING:
    from collections.abc import Iterable

_DRIVES_THERE = frozenset({"look", "check", "find", "count"})
"""With a place they drive there by themselves."""


def normalise_plan(plan: LabelledPlan) -> LabelledPlan:
    """Return the plan as training and comparison write it."""
    return tuple(_join_drives(map(_normalise_node, plan)))


def _normalise_node(node: PlanNode) -> PlanNode:
    if node.form == "inspect" and node.slots[0] != ("all",) and len(node.slots[0]) == 1:
        return PlanNode("look", (node.slots[0],))
    return replace(
        node,
        condition=normalise_plan(node.condition),
        blocks=tuple(normalise_plan(block) for block in node.blocks),
    )


def _join_drives(nodes: Iterable[PlanNode]) -> list[PlanNode]:
    """Return a row in which no drive stands before what drives to the same place by itself."""
    joined: list[PlanNode] = []
    for node in nodes:
        before = joined[-1] if joined else None
        if before is not None and before.form == "go" and node.form in _DRIVES_THERE:
            at = next(i for i, slot in enumerate(FORMS[node.form].slots) if slot.marker == "in")
            if node.slots[at] in ((), before.slots[0]):
                slots = (*node.slots[:at], before.slots[0], *node.slots[at + 1 :])
                joined[-1] = replace(node, slots=slots)
                continue
        joined.append(node)
    return joined
