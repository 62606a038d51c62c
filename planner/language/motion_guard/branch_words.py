"""Tell in which branches of a plan a step stands, and which clauses order what such a branch does.

What the words order before their condition is done before it: only what hangs on the condition, or
is said behind it, may stand in a branch. Pure.
"""

from __future__ import annotations

import re
from itertools import pairwise
from typing import TYPE_CHECKING

from planner.language.motion_guard.clause_moods import ClauseMood
from planner.language.motion_guard.meant_places import join_clauses
from planner.plan import StepNode, StepRole, parents_of

if TYPE_CHECKING:
    from planner.language.motion_guard.clauses import SaidClause

_DENIES = re.compile(r"\b(?:no|nobody|none|not|never|without|empty|unless)\b|n't|没|无|不|空")
_ELSE = re.compile(r"\bif (?:not|no)\b|要?不然|否则|[没不][有在](?=[的就,，去回到|]|$)")
"""Words that open the other branch and deny nothing."""
_BRANCHES = (StepRole.THEN, StepRole.OTHERWISE)

BranchPath = tuple[tuple[int, StepRole | None], ...]
"""In which branches a step stands: the holder of each, and which of its two."""


def path_of(row: tuple[StepNode, ...], index: int) -> BranchPath:
    """Return in which branches a step of a plan's row stands."""
    about = (index, *parents_of(row, index))
    return tuple(
        (holder, row[at].role) for at, holder in pairwise(about) if row[at].role in _BRANCHES
    )


def may_both(one: BranchPath, other: BranchPath) -> bool:
    """Tell whether two steps may both be walked: of two branches of one condition one is."""
    roles = dict(one)
    return all(roles.get(holder, role) is role for holder, role in other)


def select_of_branch(
    usable: list[SaidClause], every: list[SaidClause], roles: set[StepRole | None]
) -> list[SaidClause]:
    """Return the clauses that may order a step with these roles; a denied condition fits both.

    Args:
        usable: the clauses that order a step of its kind.
        every: all clauses of the person's words.
        roles: the step's own, and those of what holds it.
    """
    branch = roles.intersection(_BRANCHES)
    upon = [c for c in every if c.mood is ClauseMood.CONDITION]
    if len(branch) != 1 or not upon:
        return usable
    usable = [c for c in usable if c.hung or c.start > upon[0].start]
    if _DENIES.search(_ELSE.sub("", join_clauses(upon))):
        return usable
    return [c for c in usable if not c.hung or c.otherwise is (StepRole.OTHERWISE in branch)]
