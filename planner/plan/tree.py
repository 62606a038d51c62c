"""Own the shape of a plan that holds plans: its steps in one row, each with its depth and its role.

The row is the tree in the order in which it is written: what holds steps comes before them, a
condition before the branches that hang on it. Depth and role alone say what belongs to what, so a
record in the journal needs no tree of its own.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

from planner.plan.steps import Attempt, ClockTime, If, Repeat, Step, UseSkill


class StepRole(StrEnum):
    """Say what a step is to the one that holds it."""

    WHEN = "when"
    """The condition of an ``if``."""
    THEN = "then"
    OTHERWISE = "otherwise"
    BODY = "body"
    """Of a ``repeat`` or a ``try``."""
    UNTIL = "until"
    """The condition that ends a ``repeat``; asked after each round."""
    ON_FAILURE = "on_failure"


JUDGED = frozenset({StepRole.WHEN, StepRole.UNTIL})
"""Roles of conditions."""


@dataclass(frozen=True, slots=True)
class StepNode:
    """Hold one step of the row, with its place in the tree."""

    step: Step | ClockTime
    depth: int = 0
    role: StepRole | None = None


def list_nodes(steps: Sequence[Step]) -> tuple[StepNode, ...]:
    """Return all steps of a plan in one row."""
    return tuple(node for step in steps for node in _walk(step, 0, None))


def holds_call(steps: Sequence[Step]) -> bool:
    """Return whether a skill is called anywhere in these steps."""
    return any(isinstance(node.step, UseSkill) for node in list_nodes(steps))


def _walk(step: Step | ClockTime, depth: int, role: StepRole | None) -> Iterator[StepNode]:
    yield StepNode(step, depth, role)
    for part, kind in _parts(step):
        yield from _walk(part, depth + 1, kind)


def _parts(step: Step | ClockTime) -> Iterator[tuple[Step | ClockTime, StepRole]]:
    match step:
        case If():
            yield step.when, StepRole.WHEN
            yield from ((each, StepRole.THEN) for each in step.then)
            yield from ((each, StepRole.OTHERWISE) for each in step.otherwise)
        case Attempt():
            yield from ((each, StepRole.BODY) for each in step.steps)
            yield from ((each, StepRole.ON_FAILURE) for each in step.on_failure)
        case Repeat():
            yield from ((each, StepRole.BODY) for each in step.steps)
            if step.until is not None:
                yield step.until, StepRole.UNTIL


class RowEntry(Protocol):
    """Be one of a row of steps."""

    @property
    def depth(self) -> int: ...


def end_of(row: Sequence[RowEntry], index: int) -> int:
    """Return where the steps that a step holds end: the index behind the last of them."""
    end = index + 1
    while end < len(row) and row[end].depth > row[index].depth:
        end += 1
    return end


def children_of(row: Sequence[RowEntry], index: int) -> tuple[int, ...]:
    """Return the steps that a step holds, without those that they hold."""
    below = range(index + 1, end_of(row, index))
    return tuple(i for i in below if row[i].depth == row[index].depth + 1)


def parent_of(row: Sequence[RowEntry], index: int) -> int | None:
    """Return the step that holds another, or None of one that none holds."""
    above = (i for i in range(index - 1, -1, -1) if row[i].depth < row[index].depth)
    return next(above, None)


def parents_of(row: Sequence[RowEntry], index: int) -> tuple[int, ...]:
    """Return all that hold a step, the nearest first."""
    found: list[int] = []
    parent = parent_of(row, index)
    while parent is not None:
        found.append(parent)
        parent = parent_of(row, parent)
    return tuple(found)


def root_of(row: Sequence[RowEntry], index: int) -> int:
    """Return the outermost step that holds one, or the step itself."""
    return (index, *parents_of(row, index))[-1]
