"""The suite of standing orders can be read, and the offline brain reaches its goal on it."""

from __future__ import annotations

import asyncio

import pytest

from planner.brain import OfflineBrain
from planner.site import Site
from pons.evals.orders import read_order_cases, score_orders, show_orders
from pons.evals.suites import HOME_SITE


@pytest.mark.parametrize(("name", "least"), [("en", 126), ("zh", 118)])
def test_the_suite_is_read_and_its_figures_stay(name: str, least: int) -> None:
    cases = read_order_cases(name)
    assert len(cases) >= 60
    verdicts = asyncio.run(score_orders(cases, OfflineBrain(), Site.load(HOME_SITE)))
    assert sum(v.right for v in verdicts) >= least, show_orders(name, verdicts)
    wrong = [v for v in verdicts if v.case.wanted in ("none", "stops") and not v.right]
    assert wrong == []
