"""What is read of standing orders and questions to memory: the suites' figures stay."""

from __future__ import annotations

import asyncio

import pytest

from planner.brain import OfflineBrain
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons.evals.matchers import BadMatcher
from pons.evals.suites import HOME_SITE
from tools.evals.lines import read_line, read_lines, show_lines
from tools.evals.said import hear_memory, hear_order

HEARS = {"orders": hear_order, "memory": hear_memory}
NAMES = vocabulary_of(Site.load(HOME_SITE))


@pytest.mark.parametrize(
    ("suite", "language", "count", "least"),
    [("orders", "en", 131, 129), ("orders", "zh", 121, 120), ("memory", "en", 60, 60),
     ("memory", "zh", 57, 57)],
)  # fmt: skip
def test_the_figures_of_a_suite_stay(suite: str, language: str, count: int, least: int) -> None:
    lines = read_lines(suite, language, 2)
    held = [asyncio.run(HEARS[suite](line, OfflineBrain(), NAMES)) for line in lines]
    assert len(held) == count
    assert sum(each.right for each in held) >= least, show_lines(suite, held)
    assert not any(each.wrong for each in held)


@pytest.mark.parametrize(
    "row", ["tuned\tx\tgo", "some\tx\tgo\tnone", "tuned\tx\tgo\t", "tuned\tx\tgo\tnone\tmore", "x"]
)
def test_a_line_that_cannot_be_read_is_named(row: str) -> None:
    with pytest.raises(BadMatcher, match="expected tuned or held"):
        read_line(row, 2)


def test_an_unknown_kind_of_order_is_named() -> None:
    with pytest.raises(BadMatcher, match="unknown kind"):
        asyncio.run(hear_order(read_line("held\tx\tgo\tmonthly 3", 2), OfflineBrain(), NAMES))
