"""The judge of killed orders sees a run given twice, one that nobody told, a wrong history."""

from __future__ import annotations

from typing import Any

import pytest

from tools.bench.measure.order_kills import judge_run, rows_of

GOAL, OTHER = {"id": "g1"}, {"id": "g2"}


def firing(state: str, goal: str | None = None, reason: str | None = None) -> dict[str, Any]:
    return {"state": state, "goal": goal, "reason": reason, "count": 1}


GIVEN, MISSED = firing("given", "g1"), firing("missed", reason="interrupted")


@pytest.mark.parametrize(
    ("history", "goals", "verdict"),
    [
        ([GIVEN], [GOAL], "fired"),
        ([firing("ended", "g1")], [GOAL], "fired"),
        ([MISSED], [], "missed: interrupted"),
        ([GIVEN], [GOAL, OTHER], "doubled"),
        ([GIVEN, MISSED], [GOAL], "doubled"),
        ([MISSED | {"count": 2}], [], "doubled"),
        ([], [], "silent"),
        ([], [GOAL], "contradicted"),
        ([firing("begun")], [GOAL], "unsettled"),
        ([GIVEN], [], "contradicted"),
        ([GIVEN], [OTHER], "contradicted"),
        ([MISSED], [GOAL], "contradicted"),
        ([firing("missed")], [], "contradicted"),
    ],
)
def test_it_says_what_came_of_a_run(
    history: list[dict[str, Any]], goals: list[dict[str, Any]], verdict: str
) -> None:
    assert judge_run(history, goals) == verdict


def test_the_table_counts_what_went_wrong() -> None:
    told = {"kills": 1, "offset_s": 0.1, "verdicts": ["fired", "doubled", "silent"]}
    twice, silent, contradicted, killed = rows_of([told, told])
    assert (twice.value, silent.value) == ("2", "2")
    assert contradicted.value.startswith("0 of 6")
    assert killed.note == "2 kills in 2"
    assert not rows_of([])[0].valid
