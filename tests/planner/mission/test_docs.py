"""docs/missions.md holds the tables as the code has them."""

from __future__ import annotations

import pytest

from planner.mission import docs
from planner.mission.transitions import TRANSITIONS


def test_the_page_is_fresh() -> None:
    assert docs.main(["--check"]) == 0, "run python -m planner.mission.docs"


def test_every_transition_stands_in_it() -> None:
    rows = docs.tables_md().splitlines()
    for (state, cause), after in TRANSITIONS.items():
        assert f"| `{state.value}` | {cause.value} | `{after.value}` |" in rows


def test_a_page_without_marks_is_refused() -> None:
    with pytest.raises(ValueError, match="has no marks"):
        docs.with_tables("# Goals\n")
