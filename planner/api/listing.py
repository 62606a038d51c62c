"""Show many goals at once: texts shortened, all within a size that is quickly sent and read.

One goal asked for by its id is shown whole.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.plan import Goal

MOST_BYTES = 900_000
GOAL_BYTES = 24_000
"""33 goals may be open, and of those none is left out."""
PLAIN_BYTES = 3_000
"""A goal so small is shown as it is, which is quicker."""
TEXT_CHARACTERS = (300, 60, 12)
"""Of each text; the next smaller where the goal would still be larger than ``GOAL_BYTES``."""


def list_goals(goals: Iterable[Goal]) -> list[dict[str, Any]]:
    """Return goals as JSON in their order, the last ones left out where there is no room."""
    found, spent = [], 0
    for goal in goals:
        view, size = _view(goal)
        spent += size
        if spent > MOST_BYTES:
            break
        found.append(view)
    return found


def _view(goal: Goal) -> tuple[dict[str, Any], int]:
    whole, size = goal.model_dump(mode="json"), len(goal.model_dump_json().encode())
    if size <= PLAIN_BYTES and len(goal.text) <= TEXT_CHARACTERS[0]:
        return whole, size
    view = whole
    for most in TEXT_CHARACTERS:
        view = _shorten(whole, most)
        size = len(json.dumps(view, ensure_ascii=False).encode())
        if size <= GOAL_BYTES:
            break
    return view, size


def _shorten(value: Any, most: int) -> Any:
    if isinstance(value, str):
        return value if len(value) <= most else value[: most - 1] + "…"
    if isinstance(value, dict):
        return {key: _shorten(one, most) for key, one in value.items()}
    if isinstance(value, list):
        return [_shorten(one, most) for one in value]
    return value
