"""Walk a plan that holds plans: which step is next, and what becomes of those that hold it. Pure.

The plan is one row of records with depths and roles (``planner.plan.tree``); where its walk stands
is one index and what the records say, so that the journal holds all of it and a crash in the middle
of a branch or a round forgets nothing. Laws: a branch that was not chosen is skipped and never
walked; a condition that can't be told chooses none; every repeat ends.
"""

from __future__ import annotations

from dataclasses import dataclass

from planner.plan import (
    CONTROL,
    JUDGED,
    StepRecord,
    StepRole,
    StepState,
    children_of,
    end_of,
    parent_of,
    parents_of,
)

NOT_CHOSEN = "not_chosen"
"""The reason of a step that was left out because another branch was taken; never renamed."""
MAX_LOOP_M = 300.0
"""Metres of a goal after which no new round begins."""
_MOST_TOLD = 10
"""What so many rounds came to is kept."""

Row = tuple[StepRecord, ...]


@dataclass(frozen=True, slots=True)
class WalkPoint:
    """Say where a walk stands."""

    row: Row
    index: int
    """Of the step to do now; behind the row where nothing is left."""
    unmet: bool = False
    """The repeat about this step has no round left, and what it waited for never came."""


@dataclass(frozen=True, slots=True)
class RoundBudget:
    """Hold what a goal has spent when a round ends."""

    now_unix_s: float
    metres: float = 0.0


def enter(row: Row, index: int, now_unix_s: float) -> WalkPoint:
    """Go down to the first step to do at this index."""
    while index < len(row) and row[index].kind in CONTROL:
        began = {"round": 1, "began_unix_s": now_unix_s} if row[index].kind == "repeat" else {}
        row = _put(row, index, state=StepState.RUNNING, reason=None, **began)
        index += 1
    return WalkPoint(row, index)


def go_on(row: Row, index: int, spent: RoundBudget) -> WalkPoint:
    """Return what is next once the step at this index is over, as its record says."""
    parent = parent_of(row, index)
    if parent is None:
        return _first_left(row, end_of(row, index), spent)
    match row[parent].kind, row[index].role:
        case "if", StepRole.WHEN:
            row, first = _choose(row, parent, holds=row[index].holds is True)
            if first is None:
                return _close(row, parent, spent)
            return enter(row, first, spent.now_unix_s)
        case "repeat", StepRole.UNTIL:
            if row[index].holds is True:
                return _close(row, parent, spent)
            return _next_round(row, parent, index, spent)
    sibling = _next_sibling(row, index)
    if sibling is not None:
        return enter(row, sibling, spent.now_unix_s)
    if row[parent].kind == "repeat":
        return _end_of_body(row, parent, index, spent)
    return _close(row, parent, spent)


def catch(row: Row, index: int, now_unix_s: float) -> WalkPoint | None:
    """Return the walk after a step that failed: at the nearest ``on_failure``; None without one."""
    within = index
    for parent in parents_of(row, index):
        if row[parent].kind == "try" and row[within].role is StepRole.BODY:
            first = next(i for i in children_of(row, parent) if row[i].role is StepRole.ON_FAILURE)
            return enter(_skip(row, parent + 1, first, keep=index), first, now_unix_s)
        within = parent
    return None


def close_open(row: Row, index: int) -> Row:
    """Return the row with all that holds a step ended: what comes next stands behind it."""
    for parent in parents_of(row, index):
        row = _put(row, parent, state=StepState.SUCCEEDED)
    return row


def is_left_open(row: Row, index: int) -> bool:
    """Tell whether nothing is owed of a step: it holds others, or its branch was never chosen."""
    record = row[index]
    if record.kind in CONTROL or record.reason == NOT_CHOSEN or record.role in JUDGED:
        return True
    for at in (index, *parents_of(row, index)):
        parent, role = parent_of(row, at), row[at].role
        beside = [row[i] for i in children_of(row, parent)] if parent is not None else []
        if role in (StepRole.THEN, StepRole.OTHERWISE):
            judged = next(each for each in beside if each.role is StepRole.WHEN)
            if judged.holds is not (role is StepRole.THEN):
                return True
        tried = (StepState.PENDING, StepState.SKIPPED)
        if role is StepRole.ON_FAILURE and all(
            each.state in tried for each in beside if each.role is role
        ):
            return True
    return False


def _first_left(row: Row, index: int, spent: RoundBudget) -> WalkPoint:
    """Return the first step from here on that was not left out."""
    while index < len(row) and row[index].state is StepState.SKIPPED:
        index = end_of(row, index)
    return enter(row, index, spent.now_unix_s)


def _next_sibling(row: Row, index: int) -> int | None:
    """Return the next step of the same branch that was not left out."""
    parent, role = parent_of(row, index), row[index].role
    if parent is None:
        return None
    later = (i for i in children_of(row, parent) if i > index and row[i].role is role)
    return next((i for i in later if row[i].state is not StepState.SKIPPED), None)


def _choose(row: Row, parent: int, *, holds: bool) -> tuple[Row, int | None]:
    """Leave the other branch out; return the first step of the chosen one, if it has any."""
    chosen = StepRole.THEN if holds else StepRole.OTHERWISE
    first = None
    for child in children_of(row, parent):
        if row[child].role is StepRole.WHEN:
            continue
        if row[child].role is not chosen:
            row = _skip(row, child, end_of(row, child))
        elif first is None:
            first = child
    return row, first


def _close(row: Row, index: int, spent: RoundBudget) -> WalkPoint:
    """End what holds steps, and go on behind it."""
    if row[index].kind == "try":
        for child in children_of(row, index):
            if row[child].role is StepRole.ON_FAILURE and row[child].state is StepState.PENDING:
                row = _skip(row, child, end_of(row, child))
    return go_on(_put(row, index, state=StepState.SUCCEEDED), index, spent)


def _end_of_body(row: Row, parent: int, index: int, spent: RoundBudget) -> WalkPoint:
    until = next((i for i in children_of(row, parent) if row[i].role is StepRole.UNTIL), None)
    if until is None:
        return _next_round(row, parent, index, spent)
    return enter(row, until, spent.now_unix_s)


def _next_round(row: Row, parent: int, index: int, spent: RoundBudget) -> WalkPoint:
    """Begin the next round, or end the repeat where none is left."""
    record = row[parent]
    began_s = record.began_unix_s if record.began_unix_s is not None else spent.now_unix_s
    in_time = spent.now_unix_s - began_s < (record.seconds or 0.0)
    if record.round < (record.times or 1) and in_time and spent.metres <= MAX_LOOP_M:
        row = _put(row, parent, round=record.round + 1)
        row = tuple(
            _anew(each) if parent < i < end_of(row, parent) else each for i, each in enumerate(row)
        )
        return enter(row, parent + 1, spent.now_unix_s)
    if row[index].role is StepRole.UNTIL:
        return WalkPoint(row, index, unmet=True)
    return _close(row, parent, spent)


_ASKED = frozenset(
    {"kind", "place", "places", "object", "text", "seconds", "angle_rad", "distance_m"}
    | {"x", "y", "depth", "role", "times", "word", "time", "after", "before"}
    | {"span", "deeds", "look", "side", "map_id", "x_m", "y_m", "yaw_rad"}
)
"""What a plan asks of a step; the rest of its record says what came of it."""


def _anew(record: StepRecord) -> StepRecord:
    """Return a step as it was planned, with what it came to kept among its earlier results."""
    asked = {name: getattr(record, name) for name in _ASKED}
    earlier = record.earlier if record.said is None else (*record.earlier, record.said)
    return StepRecord(**asked, earlier=earlier[-_MOST_TOLD:])


def asked_of(record: StepRecord) -> dict[str, object]:
    """Return what a plan asks of a step, without what it does not say."""
    return record.model_dump(mode="json", include=set(_ASKED), exclude_defaults=True)


def _skip(row: Row, start: int, end: int, keep: int | None = None) -> Row:
    left = (StepState.PENDING, StepState.RUNNING)
    for i in range(start, end):
        if i != keep and row[i].state in left:
            row = _put(row, i, state=StepState.SKIPPED, reason=NOT_CHOSEN)
    return row


def _put(row: Row, index: int, **changes: object) -> Row:
    return (*row[:index], row[index].model_copy(update=changes), *row[index + 1 :])
